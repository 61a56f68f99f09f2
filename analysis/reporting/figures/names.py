"""Names of factors and measures as the words of a label."""

import re

UNITS = ("s", "h", "m", "deg", "rad", "kg", "N", "J", "W", "Wh", "Hz", "%", "m/s", "m/s2", "m/h",
         "m/Wh", "m2/s", "m2/s2", "deg/s", "deg/m", "rad/s", "s/m", "1/m", "1/m2", "1/s", "%/deg",
         "% s/deg")
# The one measure against time whose name does not end with its unit.
OTHERWISE = {"quality": "m"}
CAPITALS = {"nees": "NEES", "rms": "RMS", "nps": "NPS", "auv": "AUV"}


def spellings(unit):
    """How names end that have this unit: `_m_per_wh` or `_m_wh` of m/Wh, `_per_s` or `_1_s` of
    1/s."""
    text = unit.lower().replace("%", "percent").replace(" ", "_")
    return {"_" + text.replace("/", "_"), "_" + text.replace("/", "_per_").removeprefix("1_")}


# The longest first: a speed is no time.
ENDINGS = sorted(((ending, unit) for unit in UNITS for ending in spellings(unit)),
                 key=lambda pair: (-len(pair[0]), pair))


def parted(name):
    """(words, unit) of a name, whose unit may stand in it twice: a factor is called after its
    option, and a table adds the unit to that."""
    unit = OTHERWISE.get(name, "")
    ending = next((e for e in ENDINGS if name.endswith(e[0])), None)
    if ending:
        unit = ending[1]
        name = name.removesuffix(ending[0])
        again = next((e for e in ENDINGS if e[1] == unit and name.endswith(e[0])), None)
        name = name.removesuffix(again[0]) if again else name
    return plain(name), unit.replace("2", "\N{SUPERSCRIPT TWO}")


def plain(level):
    """`rigid_registration` as `rigid registration`; what looks like a unit at its end is none."""
    text = re.sub(r"\b(\d+)(m)\b", r"\1 \2", level.replace("_", " "))
    return " ".join(CAPITALS.get(word, word) for word in text.split())


def words(name):
    """`energy_mean_wh` as `energy mean (Wh)`."""
    text, unit = parted(name)
    return with_unit(text, unit)


def with_unit(text, unit):
    return f"{text} ({unit})" if unit else text


def sentence(text):
    return text[:1].upper() + text[1:]


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True
