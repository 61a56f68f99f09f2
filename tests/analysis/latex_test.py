"""The LaTeX of tests/analysis/golden_tables compiles, fits, and shows the numbers of the text form.

Usage: latex_test.py SOURCE_DIR [--keep DIR]

With --keep, the page is left in DIR, to look at.
"""

import argparse
import collections
import os
import pathlib
import re
import subprocess
import sys
import tempfile

# Old papers have version 2 of siunitx.
VERSIONS = {"siunitx 3": r"\usepackage{siunitx}", "siunitx 2": r"\usepackage{siunitx}[=v2]"}
WIDEST_OVERFULL_PT = 1.0
NUMBER = re.compile(r"(?<![\w.+])(?<!e-)-?\d+(?:\.\d+)?(?=e[+-]\d|[^\w.]|\.\s|\.?$)")
ON_PAGE = re.compile(r"-?\d+(?:\.\d+)?")  # superscripts follow without a blank
COMPLAINT = re.compile(r"^(?:!|.*:\d+: |Missing character|LaTeX Warning: (?!Label|There were)).*",
                       re.MULTILINE)
OVERFULL = re.compile(r"^Overfull \\[hv]box \(([\d.]+)pt too (?:wide|high).*", re.MULTILINE)


def document(siunitx, tables):
    head = (r"\documentclass{article}\usepackage[a4paper,margin=2cm]{geometry}"
            r"\usepackage{booktabs,graphicx,longtable}")
    pages = "\n\\clearpage\n".join(tables)
    return f"{head}{siunitx}\\pagestyle{{empty}}\n\\begin{{document}}\n{pages}\n\\end{{document}}\n"


def log_complaints(log):
    yield from dict.fromkeys(COMPLAINT.findall(log))  # each once
    for match in OVERFULL.finditer(log):
        if float(match.group(1)) > WIDEST_OVERFULL_PT:
            yield match.group(0)


def page_complaints(name, text, page):
    wanted = collections.Counter(NUMBER.findall(text))
    found = collections.Counter(ON_PAGE.findall(page.replace("−", "-")))
    for number, missing in sorted((wanted - found).items()):
        yield f"{name}: {number} is {missing} times less on the page than in the text"


def compiled(folder, source):
    """The log, and the text of every page."""
    (folder / "tables.tex").write_text(source)
    fonts = {"TEXMFVAR": str(folder.resolve())}  # where TeX may keep fonts that it has to draw
    subprocess.run(["pdflatex", "-interaction=nonstopmode", "-file-line-error", "tables.tex"],
                   cwd=folder, env=os.environ | fonts, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL, check=False)
    log = (folder / "tables.log").read_text(errors="replace")
    if not (folder / "tables.pdf").exists():
        return log, []
    text = subprocess.run(["pdftotext", "-layout", "tables.pdf", "-"], cwd=folder, check=True,
                          capture_output=True, text=True).stdout
    return log, text.split("\f")[:-1]


def complaints(golden, folder):
    tables = sorted(golden.glob("*.tex"))
    if len(tables) < 7:
        yield f"there are only {len(tables)} tables in {golden}"
    for version, siunitx in VERSIONS.items():
        here = folder / version.replace(" ", "")
        here.mkdir(parents=True, exist_ok=True)
        log, pages = compiled(here, document(siunitx, [table.read_text() for table in tables]))
        for what in log_complaints(log):
            yield f"{version}: {what}"
        if len(pages) != len(tables):
            yield f"{version}: {len(tables)} tables are on {len(pages)} pages"
        for table, page in zip(tables, pages):
            for what in page_complaints(table.stem, table.with_suffix(".txt").read_text(), page):
                yield f"{version}: {what}"


def self_test():
    assert NUMBER.findall("x 6.02e+23 +- 0.01e-09, [-1.5, 2] a1 v2.0.1 n = 5.") == [
        "6.02", "0.01", "-1.5", "2", "5"]
    assert list(page_complaints("t", "1.5 [1.2, 1.9]", "1.5 [1.2, 19]"))
    assert not list(page_complaints("t", "-1.5 +- 0.1^a", "Table 1 −1.5 ± 0.1a"))
    assert list(log_complaints("Overfull \\hbox (12.5pt too wide) in paragraph at lines 1--2\n"))
    assert list(log_complaints("./tables.tex:7: Undefined control sequence.\n"))
    assert not list(log_complaints("Overfull \\hbox (0.5pt too wide) in x\nLaTeX Font Info: y\n"))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("source_dir", type=pathlib.Path)
    parser.add_argument("--keep", type=pathlib.Path)
    options = parser.parse_args()
    golden = options.source_dir / "tests" / "analysis" / "golden_tables"
    with tempfile.TemporaryDirectory() as scratch:
        found = list(complaints(golden, options.keep or pathlib.Path(scratch)))
    print("\n".join(found) or "the tables compile and show their numbers")
    return 1 if found else 0


if __name__ == "__main__":
    self_test()
    sys.exit(main())
