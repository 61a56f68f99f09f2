"""What the legend of a study says of numbers that are missing, or only bounds."""

import matplotlib.lines
from long_form import without

MOST = 6  # that are named one by one


def notes(numbers, wording, against=None):
    """A mark for each level, or combination of levels, of which no number is known because its trials
    failed or did not run, and one for open marks."""
    found = [note("x", f"{wording.levels(key, full=True)} ({why(some)})")
             for key, some in missing(numbers, against, wording).items()]
    if len(found) > MOST:
        lost = [number for number in numbers if number.lost]
        found = [note("x", f"{len(found)} others ({why(lost)})")]
    if any(number.known and not number.reached for number in numbers):
        found.append(note("o", "open: not all trials reached it"))
    return found


def note(marker, label):
    return matplotlib.lines.Line2D([], [], linestyle="none", marker=marker, color="black",
                                   markerfacecolor="white", markersize=3, label=label)


def why(numbers):
    return "trials " + " or ".join(
        text for text, some in (("failed", any(n.failed for n in numbers)),
                                ("not run", any(n.not_run for n in numbers))) if some)


def missing(numbers, against, wording):
    """key -> its numbers, all of them lost: whole levels, then combinations of others. Trials that
    end leave the later times of a series without numbers."""
    known = [number for number in numbers if number.known]
    lost = [number for number in numbers if number.lost]
    seen = {level for number in known for level in number.levels.items()}
    found = {}
    for number in lost:
        for level in number.levels.items():
            is_instant = level[0] == against and wording.request.get("series")
            if level not in seen and not is_instant:
                found.setdefault((level,), []).append(number)
    whole = {key[0] for key in found}
    shown = {without(number, {against}) for number in known}
    for number in lost:
        key = without(number, {against})
        if key not in shown and not whole & set(number.levels.items()):
            found.setdefault(key, []).append(number)
    return found
