"""Reads every #include: arrows point down the layers, and heavy libraries stay in .cpp files.

Usage: layers_test.py SOURCE_DIR
"""

import pathlib
import re
import sys

LAYERS = ["core", "solvers", "formations", "scenarios", "analysis"]
HEAVY = re.compile(
    r"CGAL/|boost/|nlopt|coin/|Ip[A-Z]|ceres/|glog/|netcdf|sqlite3|ginac/|muParser|toml\+\+|tbb/|CLI/|"
    r"fmt/|nlohmann/(?!json_fwd)|Random123/|dlib/"
)
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')
OUTSIDE_CORE = re.compile(r"Eigen/|[a-z_]+(\.h)?$")  # all that core's headers may take from outside


def complaints(root):
    for layer in LAYERS:
        for path in sorted((root / layer).rglob("*")):
            if path.suffix not in (".hpp", ".h", ".cpp"):
                continue
            for number, line in enumerate(path.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                if match:
                    for what in wrong(layer, path, match.group(1)):
                        yield f"{path.relative_to(root)}:{number}: {what}"


def wrong(layer, path, included):
    parts = included.split("/")
    if parts[0] == "shoal" and parts[1] in LAYERS:
        if LAYERS.index(parts[1]) > LAYERS.index(layer):
            yield f"{layer} includes {included}: arrows only point down the layers"
    elif parts[0] in LAYERS:
        yield f'includes {included}: write "shoal/{included}", as it is installed'
    elif path.suffix != ".cpp" and HEAVY.match(included):
        yield f"a header includes {included}: heavy libraries stay in .cpp files"
    elif layer == "core" and path.suffix != ".cpp" and not OUTSIDE_CORE.match(included):
        yield f"core includes {included}: it knows Eigen and the standard library only"


def self_test():
    here = pathlib.Path("x.hpp")
    assert list(wrong("core", here, "shoal/solvers/solver.hpp"))
    assert list(wrong("scenarios", here, "netcdf.h"))
    assert list(wrong("solvers", here, "nlopt.hpp"))
    assert list(wrong("formations", here, "core/angles.hpp"))
    assert not list(wrong("scenarios", pathlib.Path("x.cpp"), "netcdf.h"))
    assert not list(wrong("analysis", here, "shoal/core/angles.hpp"))


if __name__ == "__main__":
    self_test()
    found = list(complaints(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "all includes point down the layers")
    sys.exit(1 if found else 0)
