"""A member of a family is known by name in its own file alone: adding another is one more file.

Reads the sources for the names of all members that the built program lists. A name counts where it
stands as a whole text that is compared, chosen, looked up or listed, as a part of a key
("guidance.drift.period_s"), or as what a message tells to write. Only a name of several words counts
wherever it is a whole text: others have further meanings ("energy", "none", "plan"). A default
(`Choice<Loss> loss{"least_squares"}`, `solver = "newton"`) may name a member.

    python3 members_test.py SHOAL SOURCE_DIR
"""

import collections
import pathlib
import re
import subprocess
import sys

LAYERS = ["core", "solvers", "formations", "scenarios", "analysis"]
SOURCES = {".cpp", ".hpp", ".py", ".pyi", ".js", ".mjs", ".html"}
NOT_OURS = {"library", "sets", "uPlot"}
# What scenarios of earlier versions wrote, beside what is written now: history, not use.
HISTORY = {"scenarios/moved_keys.cpp"}
# What looks like a member in use, and is another thing of that name.
HOMONYMS = {("analysis/reporting/page/chart_groups.js", "mean"),  # of vehicles, in a series' name
            ("analysis/reporting/page/gestures.js", "text")}  # the type of a field of the page
# Their members are never chosen by name, and share their names with what they measure.
NOT_CHOSEN = {"measure", "evaluation"}
LIBRARY = {"scenario", "set", "study"}  # listed beside families
MEMBER = re.compile(r"  (?! )(.{26,}?) ")  # a column of 26 letters, or more

TEXT = re.compile(r'"((?:[^"\\\n]|\\.)*)"|\'((?:[^\'\\\n]|\\.)*)\'')
DOCUMENTATION = re.compile(r'^[ \t]*r?"""(?:.|\n)*?"""', re.MULTILINE)
PYTHON_COMMENT = re.compile(r"(?<!['\"])#[^'\"\n]*$", re.MULTILINE)
COMMENT = re.compile(r"(?<![:\"'])//.*$", re.MULTILINE)
DEFAULT = re.compile(r"(?:\bChoice<[\w:]+>\s+\w+\s*\{|[^=!<>]=)\s*$")
# What stands before a text that is a name in use, or behind it.
BEFORE = re.compile(r"(?:[=!]=\s*|\bcase\s+|\bin\s*[\[({]\s*"
                    r"|\b(?:make|posed|instance\(\)\.find)\(\s*|\bChoice<[\w:]+>\s*[({]\s*"
                    r"|\b(?:options|behaviour|settings?)\[\s*)$")
LOOP = re.compile(r"\bfor\s+[\w, ()]+\bin\s*[\[({]\s*$")
AFTER = re.compile(r"\s*(?:[=!]==?)")
OF_A_LIST = re.compile(r"\s*,\s*$")


class Member:
    """A name, and what stands for it."""

    def __init__(self, name):
        self.name = name
        self.families = set()
        self.files = set()  # that register it

    @property
    def is_ordinary(self):
        return not re.search(r"[_. ]", self.name)

    @property
    def is_chosen(self):
        return bool(self.families - NOT_CHOSEN)

    def owns(self, path):
        """A file that registers it, and what stands beside that and is called after either."""
        stem = path.stem.lstrip("_")
        return any((path.parent == file.parent or file.parent in path.parents)
                   and (stem.startswith(file.stem) or stem.startswith(self.name.split(".")[0]))
                   for file in self.files)


def listed(program):
    """name -> families, of all that the program lists."""
    done = subprocess.run([program, "list"], check=True, capture_output=True, text=True)
    names, family = collections.defaultdict(set), ""
    for line in done.stdout.splitlines():
        if match := re.match(r"(\w+): ", line):
            family = match[1]
        elif family not in LIBRARY and (match := MEMBER.match(line)):
            names[match[1].rstrip()].add(family)
    return names


def sources(root):
    for layer in LAYERS:
        for path in sorted((root / layer).rglob("*")):
            if path.suffix in SOURCES and not NOT_OURS & set(path.relative_to(root).parts):
                yield path.relative_to(root), path.read_text(encoding="utf-8")


def code_of(path, text):
    """The text without comments, in the same lines."""
    def blank(match):
        return "\n" * match[0].count("\n")
    if path.suffix in (".py", ".pyi"):
        text = DOCUMENTATION.sub(blank, text)
        return PYTHON_COMMENT.sub("", text)
    return COMMENT.sub("", text)


def members_of(names, texts):
    members = {name: Member(name) for name in names}
    for name, families in names.items():
        members[name].families |= families
    begins = re.compile(r"\bRegister\w*\b[^;]*?\{\s*\"|\.name = \"|RegisterLeftOut[^;]*\"")
    for path, text in texts.items():
        if path.suffix != ".cpp" or not begins.search(text):
            continue
        for statement in re.findall(r"\bRegister\w*\b[^;]*;|\.name = \"[\w.]+\"", text):
            for match in TEXT.finditer(statement):
                if match[1] in members:
                    members[match[1]].files.add(path)
    return members


def keys_of(texts):
    """The names of options that choose a member."""
    return {key for text in texts.values() for key in re.findall(r"\.choice\(\s*\"(\w+)\"", text)}


def named(code, members, keys):
    """(place in the code, member, text) of each name in use."""
    before_it = None
    for match in TEXT.finditer(code):
        text = match[1] if match[1] is not None else match[2]
        before, after = code[:match.start()][-60:], code[match.end():match.end() + 20]
        member = members.get(text)
        if member and not DEFAULT.search(before):
            used = AFTER.match(after) or (BEFORE.search(before) and not LOOP.search(before))
            beside = (before_it and OF_A_LIST.fullmatch(code[before_it[0]:match.start()])
                      and member.families & before_it[1].families - NOT_CHOSEN)
            if not member.is_ordinary or (member.is_chosen and (used or beside)):
                yield match.start(), member, text
        before_it = (match.end(), member) if member else None
        yield from ((match.start(), each, text) for each in within(text, members, keys))


def within(text, members, keys):
    """Members that a longer text names: as a part of a key, or as what to write."""
    for first, second in re.findall(r"(?=\b(\w+)\.(\w+))", text):
        if first in keys and second in members:
            yield members[second]
    for word in re.findall(r'\bkind\s*=\s*\\"([\w.]+)\\"|\bkind=([\w.]+)', text):
        if (name := word[0] or word[1]) in members:
            yield members[name]


def complaints(texts, members):
    keys = keys_of(texts)
    for path, text in texts.items():
        if str(path) in HISTORY:
            continue
        code = code_of(path, text)
        for place, member, found in named(code, members, keys):
            if not member.owns(path) and (str(path), found) not in HOMONYMS:
                line = code[:place].count("\n") + 1
                families, files = (", ".join(sorted(map(str, each)))
                                   for each in (member.families, member.files))
                yield (f"{path}:{line}: \"{found}\" names {member.name} ({families}), which is "
                       f"registered in {files}")


def self_test():
    own, other = pathlib.Path("formations/guidances/drift.cpp"), pathlib.Path("scenarios/world.cpp")
    names = {"drift": {"guidance"}, "circle": {"obstacle"}, "ellipse": {"obstacle"},
             "k_nearest": {"selection"}}
    registers = 'const Register<X, Y> registered{"%s", ""};\n'
    texts = {own: registers % "drift", pathlib.Path("a.cpp"): registers % "circle",
             pathlib.Path("b.cpp"): registers % "ellipse",
             pathlib.Path("c.cpp"): registers % "k_nearest",
             pathlib.Path("k.cpp"): 'o.choice("guidance", &S::guidance, "");'}
    members = members_of(names, texts)

    def wrong(line, path=other):
        return len(list(complaints({**texts, path: line}, members)))

    for line in ('if (kind == "circle")', 'f("guidance.drift.period_s")', 'f("k_nearest")',
                 'known{"circle", "ellipse"}', r'"set guidance.kind = \"drift\""',
                 'Choice<Obstacle>("circle").make()', 'make("circle", x)', 'options["drift"]',
                 'if kind in ("circle", x):'):
        assert wrong(line) >= 1, line
    for line in ('Choice<Obstacle> shape{"circle"};', 'f("circle")', '// kind == "circle"',
                 'x = "k_nearest"', 'o.number("drift", x)', 'for x in ("circle", "square"):'):
        assert wrong(line) == 0, line
    assert wrong('kind == "drift"', own) == 0
    assert wrong('kind == "drift"', own.with_suffix(".hpp")) == 0


def main():
    self_test()
    program, root = sys.argv[1], pathlib.Path(sys.argv[2])
    texts = dict(sources(root))
    members = members_of(listed(program), texts)
    lost = sorted(name for name, member in members.items() if not member.files)
    found = [f"{name}: no file that registers it was found" for name in lost]
    found += complaints(texts, members)
    print("\n".join(found) or f"{len(members)} members are named in their own files only")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
