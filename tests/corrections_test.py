"""What the sources call C and a number is explained in notebooks/corrections.md, and nothing else is.

    /usr/bin/python3 corrections_test.py
"""

import pathlib
import re
import unittest

TOP = pathlib.Path(__file__).resolve().parent.parent
PAGE = TOP / "notebooks" / "corrections.md"
SOURCES = ["core", "solvers", "formations", "scenarios", "analysis"]
COLUMNS = ["Number", "Equation", "Printed", "Used here", "Why"]

# Of C++, all that may hold what looks like a comment, and comments; lines of // that follow one
# another are one.
TOKEN = re.compile(
    r"""R"(?P<mark>[^()\s\\]*)\(.*?\)(?P=mark)"
      | "(?:\\.|[^"\\\n])*"
      | \b\d(?:'?[\w.])*
      | '(?:\\.|[^'\\\n])+'
      | (?P<comment>/\*.*?\*/ | //[^\n]*(?:\n[ \t]*//[^\n]*)*)""", re.DOTALL | re.VERBOSE)
LINE_BREAK = re.compile(r"\s*\n\s*(?:///?<?|\*(?!/))?\s*")
NUMBER = re.compile(r"\bC([1-9][0-9]?)\b")
RANGE = re.compile(r"\bC([1-9][0-9]?)\s*(?:-|to)\s*C([1-9][0-9]?)\b")
CELL_END = re.compile(r"(?<!\\)\|")


def comments(source):
    """(line, text) of each."""
    for token in TOKEN.finditer(source):
        if token["comment"]:
            line = source.count("\n", 0, token.start()) + 1
            yield line, LINE_BREAK.sub(" ", token["comment"])


def numbers(comment):
    found = {int(n) for n in NUMBER.findall(comment)}
    for first, last in RANGE.findall(comment):
        found.update(range(int(first), int(last) + 1))
    return found


def references():
    """{number: [where a comment has it]}"""
    found = {}
    for folder in SOURCES:
        for path in sorted((TOP / folder).rglob("*")):
            if path.suffix not in (".cpp", ".hpp"):
                continue
            for line, text in comments(path.read_text()):
                for number in numbers(text):
                    found.setdefault(number, []).append(f"{path.relative_to(TOP)}:{line}")
    return found


def tables(page):
    """[[cells of a row]] of each, without the line below the head."""
    for block in re.findall(r"(?:^\|.*\n)+", page, re.MULTILINE):
        rows = [[cell.strip() for cell in CELL_END.split(line)[1:-1]] for line in block.splitlines()]
        yield [rows[0], *rows[2:]]


class Corrections(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.places = references()

    def setUp(self):
        self.tables = list(tables(PAGE.read_text()))
        self.rows = [int(NUMBER.fullmatch(row[0])[1]) for _, *rows in self.tables for row in rows]

    def test_have_a_row_each_that_says_everything(self):
        self.assertEqual(sorted(set(self.rows)), sorted(self.rows), "a number has two rows")
        for head, *rows in self.tables:
            self.assertEqual(head, COLUMNS)
            for row in rows:
                self.assertEqual((len(row), "" in row), (len(COLUMNS), False), row)

    def test_that_a_comment_refers_to_have_a_row(self):
        missing = {f"C{n}": places for n, places in self.places.items() if n not in self.rows}
        self.assertEqual(missing, {})

    def test_that_have_a_row_are_referred_to(self):
        self.assertEqual([f"C{n}" for n in self.rows if n not in self.places], [])


class Reading(unittest.TestCase):
    def found(self, source):
        return {(line, n) for line, text in comments(source) for n in numbers(text)}

    def test_finds_numbers_and_ranges_in_comments(self):
        self.assertEqual(self.found("int a;  // x (C5): y\nint b /* C33 */ = 1;\n"), {(1, 5), (2, 33)})
        self.assertEqual(self.found("\n/// with C36\n/// to C39.\n"), {(2, n) for n in range(36, 40)})
        self.assertEqual(self.found("/* of\n * C56-\n * C58 */"), {(1, 56), (1, 57), (1, 58)})
        self.assertEqual(self.found("int n = 1'000;  // C4, it's C6"), {(1, 4), (1, 6)})

    def test_finds_none_elsewhere(self):
        for source in ('scaling("C1");', 'x = R"(// C2)";', "int C3 = 4;", "'\"'; // C_d0, C++, C100",
                       '"a\\"// C7"'):
            with self.subTest(source):
                self.assertEqual(self.found(source), set())

    def test_splits_a_table(self):
        page = "a\n\n| b | c |\n|---|---|\n| 1 | `x \\| y` |\n\nd\n"
        self.assertEqual(list(tables(page)), [[["b", "c"], ["1", "`x \\| y`"]]])


if __name__ == "__main__":
    unittest.main()
