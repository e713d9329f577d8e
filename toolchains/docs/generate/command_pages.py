"""Pages of the programs' own `--help`: what each is for, how it is called, every option."""

from __future__ import annotations

import html
import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

DESCRIPTION_COLUMN = 30  # where the programs begin to say what an option does
_OPTION = re.compile(
    r"(?P<names>\S+)"
    r"(?: (?!Excludes:|Needs:|REQUIRED)(?P<what>.*?))?"
    r"(?P<more>(?: (?:Excludes|Needs):.*| REQUIRED.*)?)$"
)
_SECTION = re.compile(r"^(Positionals|Options|Subcommands):$")


@dataclass
class Option:
    """`-o,--output TEXT REQUIRED`, and what it does."""

    written: str
    meaning: str


@dataclass
class Help:
    about: str = ""
    usage: str = ""
    sections: dict[str, list[Option]] = field(default_factory=dict)
    rest: str = ""  # examples, lists of names


def read(text: str) -> Help:
    """A program's help as CLI11 lays it out."""
    found, section, lines = Help(), "", text.rstrip().split("\n")
    about: list[str] = []
    rest: list[str] = []
    for number, line in enumerate(lines):
        if line.startswith("Usage: "):
            found.usage = line.removeprefix("Usage: ")
        elif header := _SECTION.match(line):
            section = header.group(1)
            found.sections[section] = []
        elif section and line.startswith(" " * DESCRIPTION_COLUMN):
            option = found.sections[section][-1]
            option.meaning = f"{option.meaning} {line.strip()}".strip()
        elif section and re.match(r"  \S", line) and not rest:
            is_alone = number + 1 < len(lines) and lines[number + 1].startswith(" " * DESCRIPTION_COLUMN)
            cut = len(line) if is_alone else DESCRIPTION_COLUMN
            found.sections[section].append(Option(line[:cut].strip(), line[cut:].strip()))
        elif not found.usage:
            about.append(line)
        elif line or rest:
            rest.append(line)
    found.about, found.rest = "\n".join(about).strip(), "\n".join(rest).strip()
    return found


def plain(text: str) -> str:
    """Text in which Markdown and HTML find no signs of theirs."""
    return re.sub(r"([\\`*_\[\]|])", r"\\\1", html.escape(text, quote=False))


def _values(written: str) -> str:
    """`FLOAT:0 to 5=2 REQUIRED Needs: --map` in words."""
    parts = _OPTION.match(written)
    if not parts:
        return ""
    words = []
    what = (parts["what"] or "").replace(" REQUIRED", "")
    if what:
        kind, _, allowed = what.partition(":")
        allowed, _, default = (allowed or "").rpartition("=") if "=" in allowed else (allowed, "", "")
        if not allowed and "=" in kind:
            kind, _, default = kind.partition("=")
        named = {"TEXT": "text", "FLOAT": "number", "UINT": "whole number", "INT": "whole number"}.get(
            kind.split()[0], kind
        )
        words.append(named + (f", {len(kind.split()) > 1 and kind.split(' ', 1)[1]}" if len(kind.split()) > 1 else ""))
        if allowed:
            words.append(allowed.strip("{}").replace(",", ", "))
        if default:
            words.append(f"default {default}")
    if "REQUIRED" in written:
        words.append("must be given")
    for word, meaning in (("Excludes", "not with"), ("Needs", "only with")):
        if named_there := re.search(rf"{word}: ((?:--?[\w-]+ ?)+)", parts["more"]):
            words.append(f"{meaning} {named_there.group(1).strip()}")
    return "; ".join(words)


def page(title: str, text: str, more: str = "", level: int = 1) -> str:
    """Markdown of a help text."""
    found = read(text)
    sign = "#" * level
    pieces = [f"{sign} {title}\n", plain(found.about).replace("\n", "  \n") + "\n", more]
    if found.usage:
        pieces.append(f"```text\n{found.usage}\n```\n")
    for name, options in found.sections.items():
        pieces.append(f"{sign}# {'Arguments' if name == 'Positionals' else name}\n")
        for option in options:
            names = option.written.split(" ")[0]
            values = _values(option.written)
            pieces.append(
                f"`{names}`"
                + (f" ({plain(values)})" if values else "")
                + f"\n:   {plain(option.meaning) or 'see above'}\n"
            )
    if found.rest:
        pieces.append(f"{sign}# More\n\n```text\n{found.rest}\n```\n")
    return "\n".join(piece for piece in pieces if piece)


def help_of(program: Path, *words: str) -> str:
    return subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=True).stdout


def verbs_of(programs: Path) -> list[tuple[str, str, str]]:
    """What `earshot help` lists: package, verb, what it does in a line."""
    text = subprocess.run([programs / "earshot", "help"], capture_output=True, text=True, check=True).stdout
    verbs, package = [], ""
    for line in text.splitlines():
        if line.startswith("Package "):
            package = line.removeprefix("Package ").rstrip(":")
        elif (verb := re.match(r"  ([a-z-]+) +(\S.*)$", line)) and package:
            verbs.append((package, verb.group(1), verb.group(2)))
    return verbs
