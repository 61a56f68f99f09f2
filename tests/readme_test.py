"""The C++ of README.md that is said to be compiled is, up to white space, the named file of the tests.

Usage: readme_test.py SOURCE_DIR
"""

import pathlib
import re
import sys

# A paragraph that says "compiled" and names a file of the tests, and the block that follows it.
CLAIM = re.compile(r"compiled[^`]*`(tests/[\w/]+\.cpp)`[^\n]*:\n\n```cpp\n(.*?)```", re.DOTALL)


def complaints(readme, read):
    claims = CLAIM.findall(readme)
    if len(claims) < 2:
        yield f"README.md claims only {len(claims)} compiled blocks: is this test still right?"
    for path, block in claims:
        if block.split() != read(path).split():
            yield f"{path} is not the block of README.md that begins {block[:50]!r}"


def self_test():
    readme = "It is compiled and tested in `tests/a.cpp`:\n\n```cpp\nint x;\n  int y;\n```\n" * 2
    assert not list(complaints(readme, lambda path: "int  x;\nint y;\n"))
    assert len(list(complaints(readme, lambda path: "#include <x>\nint x; int y;"))) == 2
    assert list(complaints("", lambda path: ""))


if __name__ == "__main__":
    self_test()
    top = pathlib.Path(sys.argv[1])
    found = list(complaints((top / "README.md").read_text(), lambda path: (top / path).read_text()))
    print("\n".join(found) or "what README.md shows is compiled")
    sys.exit(1 if found else 0)
