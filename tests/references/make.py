#!/usr/bin/env python3
"""The reference files of tests/data, computed by programs that share nothing with shoal.

    tests/references/make.py [--check] [NAME...]

Writes the files again, or with --check compares what is stored with what is computed. The inputs of
all cases are read from the stored files. A NAME is that of a program in this folder without its .py;
by default all are run. Another machine may round the last digits differently.

Of the other files there, redsea_current_statistics.csv is what scenarios/tools/drifting_window.py
finds in the reconstructed current of the Red Sea, to six digits (tests/analysis/
current_statistics_test.py), and golden.csv is shoal's own (tests/golden.py).
"""

import argparse
import sys

import force_clamp
import nps_auv
import obstacle_geometry
import potential_field
import reference
import ukf

PROGRAMS = {module.__name__: module
            for module in (force_clamp, nps_auv, obstacle_geometry, potential_field, ukf)}


def check(each):
    """Prints how stored and computed numbers agree, and returns whether they do."""
    print(f"{each.name}: differences up to {each.tolerance:g} of the largest number are rounding")
    print(f"  {'result':<18}{'same':>5} {'of':>5}  {'largest':>8}  {'worst off':>9}")
    agree = True
    for name, result in reference.agreements(each).items():
        close = result.worst <= each.tolerance * result.largest
        agree &= close
        print(f"  {name:<18}{result.same:>5} {result.entries:>5}  {result.largest:>8.3g}  "
              f"{result.worst:>9.1e}" + ("" if close else f"  TOO FAR in line {result.line}"))
    return agree


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare, and write nothing")
    parser.add_argument("names", metavar="NAME", nargs="*", help=", ".join(PROGRAMS))
    wanted = parser.parse_args()
    if unknown := set(wanted.names) - set(PROGRAMS):
        parser.error(f"no program {', '.join(sorted(unknown))}: there are {', '.join(PROGRAMS)}")
    agree = True
    for name in wanted.names or PROGRAMS:
        for each in PROGRAMS[name].REFERENCES:
            if wanted.check:
                agree &= check(each)
            else:
                reference.write(each)
                print(f"wrote {reference.DATA / each.name}")
    if not agree:
        sys.exit("stored and computed numbers differ")


if __name__ == "__main__":
    main()
