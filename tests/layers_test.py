"""Reads every #include: arrows point down the layers and, in analysis, from room to room as listed;
heavy libraries stay in .cpp files.

Usage: layers_test.py SOURCE_DIR
"""

import pathlib
import re
import sys

LAYERS = ["core", "solvers", "formations", "scenarios", "analysis"]
# What each room of analysis knows of the others; "core" is all that some know of the layers below.
ROOMS = {
    "statistics": {"core"},
    "tables": {"core"},
    "experiments": {"statistics", "tables"},
    "benchmarking": {"statistics", "tables"},
    "reporting": {"statistics", "tables", "experiments"},
    "program": {"statistics", "tables", "experiments", "benchmarking", "reporting"},
    "python": {"statistics", "tables", "experiments", "benchmarking", "reporting"},
}
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
                    for what in wrong(path.relative_to(root), match.group(1)):
                        yield f"{path.relative_to(root)}:{number}: {what}"


def wrong(path, included):
    layer = path.parts[0]
    parts = included.split("/")
    if parts[0] == "shoal" and parts[1] in LAYERS:
        if LAYERS.index(parts[1]) > LAYERS.index(layer):
            yield f"{layer} includes {included}: arrows only point down the layers"
        if layer == "analysis":
            yield from wrong_room(path.parts[1], parts[1:], included)
    elif parts[0] in LAYERS:
        yield f'includes {included}: write "shoal/{included}", as it is installed'
    elif path.suffix != ".cpp" and HEAVY.match(included):
        yield f"a header includes {included}: heavy libraries stay in .cpp files"
    elif layer == "core" and path.suffix != ".cpp" and not OUTSIDE_CORE.match(included):
        yield f"core includes {included}: it knows Eigen and the standard library only"


def wrong_room(room, parts, included):
    if room not in ROOMS:
        yield f"analysis has no room {room}; it has {', '.join(ROOMS)}"
    elif parts[0] == "analysis" and parts[1] != room and parts[1] not in ROOMS[room]:
        yield f"{room} includes {included}: it knows {', '.join(sorted(ROOMS[room]))}"
    elif parts[0] not in ("analysis", "core") and "core" in ROOMS[room]:
        yield f"{room} includes {included}: it knows core only"


def self_test():
    def accepted(file, included):
        return not list(wrong(pathlib.Path(file), included))

    assert not accepted("core/x.hpp", "shoal/solvers/solver.hpp")
    assert not accepted("scenarios/x.hpp", "netcdf.h")
    assert not accepted("solvers/x.hpp", "nlopt.hpp")
    assert not accepted("formations/x.hpp", "core/angles.hpp")
    assert not accepted("analysis/tables/x.cpp", "shoal/scenarios/world.hpp")
    assert not accepted("analysis/tables/x.cpp", "shoal/analysis/experiments/measure.hpp")
    assert not accepted("analysis/experiments/x.cpp", "shoal/analysis/reporting/page.hpp")
    assert not accepted("analysis/loose.cpp", "shoal/core/angles.hpp")
    assert accepted("scenarios/x.cpp", "netcdf.h")
    assert accepted("analysis/tables/x.cpp", "shoal/core/text.hpp")
    assert accepted("analysis/program/x.cpp", "shoal/analysis/benchmarking/corpus.hpp")


if __name__ == "__main__":
    self_test()
    found = list(complaints(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "all includes point down the layers")
    sys.exit(1 if found else 0)
