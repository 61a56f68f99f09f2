"""Runs every notebook, which must not fail, and whose stored outputs must be of the code as it is.

    PYTHONPATH=build/ci/python python3 notebooks_test.py [--write] [NAME ...]

With --write the outputs are stored anew.
"""

import os
import pathlib
import re
import sys

import nbclient
import nbformat

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "notebooks"
SECONDS_A_CELL = 300
os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # of the kernel's debugger, which is not used


def executed(notebook):
    fresh = nbformat.from_dict(notebook)
    nbclient.NotebookClient(fresh, timeout=SECONDS_A_CELL, kernel_name="python3",
                            resources={"metadata": {"path": str(FOLDER)}}).execute()
    for cell in fresh.cells:
        cell.metadata = {}  # times of execution
    return fresh


def kinds(notebook):
    """How every code cell ends, as far as two machines must agree."""
    return [[output.output_type for output in cell.outputs if output.output_type != "stream"]
            for cell in notebook.cells if cell.cell_type == "code"]


def main():
    words = sys.argv[1:]
    write = "--write" in words
    names = [word for word in words if word != "--write"]
    files = sorted(FOLDER.glob("*.ipynb"))
    if not files:
        sys.exit(f"there are no notebooks in {FOLDER}")
    failed = False
    for file in files:
        if names and file.stem not in names:
            continue
        stored = nbformat.read(file, as_version=4)
        try:
            fresh = executed(stored)
        except nbclient.exceptions.CellExecutionError as error:
            print(f"{file.name} fails:\n" + re.sub(r"\x1b\[[0-9;]*m", "", str(error)))
            failed = True
            continue
        if write:
            nbformat.write(fresh, file)
            print(f"written: {file}")
        elif any(cell.cell_type == "code" and not cell.execution_count for cell in stored.cells):
            print(f"{file.name} is stored without outputs; run notebooks_test.py --write")
            failed = True
        elif kinds(stored) != kinds(fresh):
            print(f"{file.name} has other outputs than are stored; run notebooks_test.py --write, and look")
            failed = True
        else:
            print(f"{file.name} runs")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
