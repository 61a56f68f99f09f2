"""Figures for papers, of what `shoal run`, `shoal sweep` or `shoal solve --profiles` wrote."""

import argparse
import csv
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

import catalogue  # noqa: E402
import style  # noqa: E402
from panels import TooMuch  # noqa: E402
from recorded_run import NoRun  # noqa: E402


class Parser(argparse.ArgumentParser):
    def error(self, message):
        complain(message + "; see shoal figures --help", 2)


def given(kind):
    """An argument of that kind: an unset variable in a job's script must not stand for a default."""
    def converted(text):
        if not text:
            raise argparse.ArgumentTypeError("is empty")
        return kind(text)

    converted.__name__ = kind.__name__  # which messages say
    return converted


def read(what):
    """The figures there are, by name; of what cannot be read, one line."""
    try:
        return catalogue.figures_of(what)
    except NoRun as error:
        complain(error, 2)
    except OSError as error:
        if error.errno and error.errno > 0:  # below stands what netCDF makes of a file
            complain(f"cannot read {what}: {error.strerror}", 2)
        complain(f"{what} is damaged: {error.strerror or error}", 2)
    except (ValueError, RuntimeError, csv.Error) as error:  # no text, no TOML, no CSV
        complain(f"{what} is damaged: {' '.join(str(error).split())}", 2)


def main():
    parser = Parser(prog="shoal figures", description=__doc__)
    parser.add_argument("what", type=given(pathlib.Path),
                        help="folder of shoal run or shoal sweep, or file of performance profiles")
    parser.add_argument("--only", type=given(str), nargs="+", metavar="FIGURE",
                        help="some of them: tables of a study, or, of a run, "
                        + ", ".join(catalogue.FIGURES))
    parser.add_argument("--columns", type=given(int), choices=(1, 2), default=1,
                        help="width, in columns of a paper (default: 1)")
    parser.add_argument("--out", type=given(pathlib.Path), help="default: figures in or beside it")
    options = parser.parse_args()
    what = options.what
    known = read(what)
    for name in options.only or []:
        if name not in known:
            complain(f"{what} has no figure \"{name}\"; there are {', '.join(known)}", 2)
    out = options.out or (what if what.is_dir() else what.parent) / "figures"
    made, refused = [], []
    try:
        for name in options.only or known:
            with style.page(options.columns):
                try:
                    figure = catalogue.drawn(known[name])
                except TooMuch as reason:
                    refused.append(reason)
                    continue
                if figure is not None:
                    made += style.save(figure, out, name)
        if made and not options.only and not options.out:  # a folder of its own
            style.remove_others(out, made)
    except NoRun as error:
        complain(error, 2)
    except OSError as error:
        complain(f"cannot write {error.filename or out}: {error.strerror}", 1)
    if refused and not made:
        complain(refused[0], 2)
    for reason in refused:
        print(f"not drawn: {reason}")
    if not made:
        complain(f"{what} has nothing that these figures show", 2)
    print("written: " + ", ".join(map(str, made)))


if __name__ == "__main__":
    main()
