"""Reads what the programs print for --help, and writes it as tables."""

import re
import subprocess
import textwrap
from dataclasses import dataclass, field

COMMANDS = {
    "sward": ["bake", "info", "validate", "compare", "export", "terrain", "plan", "tile", "merge", "edit", "trace", "grow", "lidar"],
    "sward-view": ["", "render", "bench", "dataset", "lidar", "devices"],
}
LONGEST_ROW = 200  # of a table; no line of a page is longer
FACTS = r"required|default: |not with |environment: "


@dataclass
class Option:
    """One entry of a help page: `-o, --output OUT  File to write (required)`."""
    names: list          # ["-o", "--output"]; of an argument its own name
    value: str           # "OUT", empty for a flag
    text: str            # without what stands in the last brackets
    facts: list          # ["required", "default: 3"]

    @property
    def default(self):
        found = [fact for fact in self.facts if fact.startswith("default: ")]
        return found[0].removeprefix("default: ") if found else ""

    @property
    def usage(self):
        return ", ".join(self.names) + (f" {self.value}" if self.value else "")

    @property
    def is_only_in_dev_builds(self):
        return "(dev build only)" in self.text


@dataclass
class Page:
    """The help of one command."""
    name: str
    about: str = ""
    usage: str = ""
    groups: dict = field(default_factory=dict)     # title -> [Option]
    commands: list = field(default_factory=list)
    examples: list = field(default_factory=list)
    notes: list = field(default_factory=list)      # paragraphs

    @property
    def options(self):
        return [option for group in self.groups.values() for option in group]


def help_of(program, command):
    words = [str(program), *([command] if command else []), "--help"]
    return subprocess.run(words, capture_output=True, text=True, check=True,
                          stdin=subprocess.DEVNULL).stdout


def option_of(left, text):
    facts = []
    brackets = re.search(rf"^(.*) \(((?:{FACTS}).*)\)$", text)
    if brackets:
        text, facts = brackets.group(1), brackets.group(2).split("; ")
    if not left.startswith("-"):
        return Option([left], "", text, facts)
    *first, last = left.split(", ")
    last, _, value = last.partition(" ")
    return Option([*first, last], value, text, facts)


def parse(name, text):
    """The page of a command from what it prints."""
    blocks = text.rstrip("\n").split("\n\n")
    page = Page(name, " ".join(blocks[0].split()), blocks[1].removeprefix("Usage: "))
    for block in blocks[2:]:
        lines = block.split("\n")
        if lines[0] == "Commands:":
            page.commands = [line.split()[0] for line in lines[1:] if re.match(r"  \S", line)]
            continue
        titles = [i for i, line in enumerate(lines) if re.fullmatch(r"\S.*:", line)]
        if titles and lines[titles[0]] == "Example:":
            page.notes += [" ".join(lines[:titles[0]])] if titles[0] else []
            page.examples = [line.strip() for line in lines[titles[0] + 1:]]
        elif titles == [0]:
            page.groups[lines[0][:-1]] = entries(lines[1:])
        else:
            page.notes.append(" ".join(lines))
    return page


def entries(lines):
    """Options of the lines of a group: names at two blanks, texts beside or below."""
    found = []
    for line in lines:
        if re.match(r"  \S", line):
            left, _, text = line.strip().partition("  ")
            found.append([left, text.strip()])
        else:
            found[-1][1] = f"{found[-1][1]} {line.strip()}".strip()
    return [option_of(left, text) for left, text in found]


def pages(programs):
    """All pages, by (program, command)."""
    return {(program, command): parse(f"{program} {command}".strip(), help_of(path, command))
            for program, path in programs.items() for command in COMMANDS[program]}


def prose(text):
    """Names of options, and what Markdown would read as its own signs, as code."""
    return re.sub(r"\{.*?\}|(?<![\w-])--[a-z][a-z-]*|[^\s,.]*~[^\s,.]*", r"`\g<0>`", text)


def cell(text):
    return text.replace("|", "\\|")


def paragraph(text):
    return "\n".join(textwrap.wrap(text, 150, break_long_words=False, break_on_hyphens=False))


def table(options):
    """The options of a group; a meaning that would make a row too long is a paragraph below the rows."""
    rows, long = ["| option | meaning | default |", "| --- | --- | --- |"], []
    for option in options:
        others = [fact for fact in option.facts if not fact.startswith("default: ")]
        meaning = prose(option.text + "".join(f"; {fact}" for fact in others))
        row = f"| `{cell(option.usage)}` | {cell(meaning)} | {cell(option.default)} |"
        if len(row) > LONGEST_ROW:
            long.append(paragraph(f"`{option.usage}`: {meaning}."))
            row = f"| `{cell(option.usage)}` | see below the table | {cell(option.default)} |"
        rows.append(row)
    return "\n\n".join(["\n".join(rows), *long])


def markdown(every):
    """Tables of all pages. A group that an earlier command has too is named, not repeated."""
    text, printed = [], {}
    for (program, command), page in every.items():
        text += [f"## {page.name}", f"{page.about.rstrip('.')}: `{page.usage}`"]
        same = {}
        groups = dict(page.groups)
        groups[""] = groups.pop("Arguments", []) + groups.pop("Options", [])
        for title, group in sorted(groups.items(), key=lambda item: item[0] != ""):
            options = [option for option in group if "--help" not in option.names and
                       "--version" not in option.names and not option.is_only_in_dev_builds]
            if not options:
                continue
            rows = table(options)
            if rows in printed:
                same.setdefault(printed[rows], []).append(title or "arguments")
                continue
            if len(options) > 1:
                printed[rows] = page.name
            text += [f"**{title}**", rows] if title else [rows]
        for other, titles in same.items():
            text.append(f"As of `{other}`: {', '.join(titles)}.")
        text += [paragraph(prose(note)) for note in page.notes]
        if page.examples:
            text.append("```sh\n" + "\n".join(page.examples) + "\n```")
    return "\n\n".join(text) + "\n"
