"""Figures of what `shoal run` wrote, for papers: `shoal figures DIR`."""

import argparse
import pathlib
import sys


def complain(what, status):
    print(f"shoal: {what}", file=sys.stderr)
    sys.exit(status)


try:
    import matplotlib
    import netCDF4  # noqa: F401
except ImportError as missing:
    complain(f"figures need Python's {missing.name}; install python3-{missing.name.lower()}", 1)
matplotlib.use("Agg")  # no screen

import against_time  # noqa: E402
import over_ground  # noqa: E402
import style  # noqa: E402
from recorded_run import NoRun, RecordedRun  # noqa: E402

# In the order in which they are made: name -> how, or nothing where the run has none of it.
FIGURES = {
    "trajectories": over_ground.trajectories,
    "basin": over_ground.basin,
    "speeds": against_time.speeds,
    "energy": against_time.energy,
    "quality": against_time.quality,
    "thrust": against_time.thrust,
    "passage": against_time.passage,
}


class Parser(argparse.ArgumentParser):
    def error(self, message):
        complain(message + "; see shoal figures --help", 2)


def main():
    parser = Parser(prog="shoal figures", description=__doc__)
    parser.add_argument("run", type=pathlib.Path, help="folder that shoal run wrote")
    parser.add_argument("--only", nargs="+", choices=FIGURES, metavar="FIGURE",
                        help="some of them: " + ", ".join(FIGURES))
    parser.add_argument("--columns", type=int, choices=(1, 2), default=1,
                        help="width, in columns of a paper (default: 1)")
    parser.add_argument("--out", type=pathlib.Path, help="default: RUN/figures")
    options = parser.parse_args()
    try:
        run = RecordedRun(options.run)
        made = []
        for name in options.only or FIGURES:
            with style.page(options.columns):
                figure = FIGURES[name](run)
                if figure is not None:
                    made += style.save(figure, options.out or options.run / "figures", name)
    except NoRun as error:
        complain(error, 2)
    except OSError as error:
        complain(f"cannot write {error.filename}: {error.strerror}", 1)
    if not made:
        complain(f"{options.run} has nothing that these figures show", 2)
    print("written: " + ", ".join(map(str, made)))


if __name__ == "__main__":
    main()
