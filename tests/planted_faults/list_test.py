"""faults.toml is kept up with the sources: each text to be replaced is there, once.

    /usr/bin/python3 tests/planted_faults/list_test.py
"""

import collections
import pathlib
import tomllib
import unittest

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parent.parent
KEYS = {"file", "is", "becomes", "kind", "about"}
LAYERS = ["solvers", "formations", "scenarios", "analysis"]
LEAST_OF_A_LAYER = 20


class FaultsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with (HERE / "faults.toml").open("rb") as file:
            cls.faults = tomllib.load(file)["fault"]

    def check_each(self, check):
        for number, fault in enumerate(self.faults, 1):
            with self.subTest(number=number, file=fault.get("file")):
                check(fault)

    def test_there_are_a_hundred_in_all_layers(self):
        self.assertEqual(len(self.faults), 100)
        of_layer = collections.Counter(fault["file"].split("/")[0] for fault in self.faults)
        for layer in LAYERS:
            self.assertGreaterEqual(of_layer[layer], LEAST_OF_A_LAYER, layer)

    def test_each_says_all_and_nothing_else(self):
        def check(fault):
            self.assertEqual(set(fault), KEYS)
            self.assertTrue(all(isinstance(value, str) and value.strip() for value in fault.values()))

        self.check_each(check)

    def test_each_changes_a_source_that_is_built_into_a_library(self):
        def check(fault):
            path = TOP / fault["file"]
            self.assertTrue(path.is_file())
            # A header of a member is included by its own source; another would rebuild everything.
            self.assertTrue(path.suffix == ".cpp" or path.with_suffix(".cpp").is_file())
            self.assertFalse({"program", "tools", "python"} & set(path.relative_to(TOP).parts))

        self.check_each(check)

    def test_each_text_occurs_once_and_is_changed(self):
        def check(fault):
            source = (TOP / fault["file"]).read_text()
            self.assertEqual(source.count(fault["is"]), 1, fault["is"])
            self.assertNotEqual(fault["is"].split(), fault["becomes"].split())

        self.check_each(check)

    def test_no_two_are_the_same(self):
        planted = collections.Counter((fault["file"], fault["is"]) for fault in self.faults)
        self.assertEqual([fault for fault, count in planted.items() if count > 1], [])


if __name__ == "__main__":
    unittest.main()
