"""The commands of a Markdown file, and what stands in it that no test can run.

The convention: commands stand in blocks fenced with ```sh, Python in ```python; what is neither in ```text, ```cpp or
```toml. Indented blocks are refused, because nobody can tell which they are. A comment on the line before a block,
which readers do not see, marks it:

    <!-- test: long -->     takes minutes: run by tests/readme/run --long only
    <!-- test: start -->    does not end by itself: must still run after three seconds, and end on Ctrl-C
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

MARKS = ("long", "start")
SHOWN = ("text", "cpp", "toml")  # and not run
LANGUAGES = ("sh", "python", *SHOWN)

_FENCE = re.compile(r"^```(.*)$")
_UNREAD_FENCE = re.compile(r"^(?:[ \t]+```|[ \t]*~~~)")  # a reader sees a block, this module would not
_MARK = re.compile(r"^<!-- test: (.*) -->$")
_INDENTED = re.compile(r"^(?: {4}|\t)\s*\S")
_PROGRAM = (
    r"(?:earshotd?|earshot-[a-z]+|sim/fly|hil/run|hil/bus/with-can|mpirun|cmake|ctest|pip|python3|git"
    r"|tests/run|tests/[a-z0-9]+/run|policy/[a-z]+/(?:run|make)|toolchains/(?:setup|build|format|tidy))"
)
_OF_THE_SHELL = re.compile(r"^(?:export|cd|\.|source|\w+=\S*)(?:\s|$)")  # each file has a shell of its own
_REMARK = re.compile(r"\s+#.*$")
_COMMAND_LINE = re.compile(rf"^{_PROGRAM}(?:\s|$)")
_MENTION = re.compile(rf"`({_PROGRAM}\s[^`]+)`")


@dataclass(frozen=True)
class Command:
    """What a reader types, word for word."""

    file: Path
    line: int
    text: str
    marks: frozenset[str]
    language: str = "sh"


@dataclass(frozen=True)
class Mention:
    """A command with arguments in running text."""

    file: Path
    line: int
    text: str


@dataclass
class Document:
    file: Path
    commands: list[Command]
    mentions: list[Mention]
    problems: list[str]  # FILE:LINE: what is wrong


def repeated_long_commands(documents: list[Document]) -> set[Command]:
    """Those that an earlier file has as well, so that what they make is there; but for what only a shell keeps."""
    found: set[Command] = set()
    before: set[str] = set()
    for document in documents:
        long = [c for c in document.commands if "long" in c.marks and c.language == "sh"]
        texts = [_REMARK.sub("", c.text) for c in long]
        found |= {c for c, text in zip(long, texts, strict=True) if text in before and not _OF_THE_SHELL.match(text)}
        before |= set(texts)
    return found


def read(file: Path, text: str) -> Document:
    """Everything a test needs to know of one Markdown file."""
    found = Document(file, [], [], [])
    lines = text.split("\n")
    prose: list[str] = []  # without the blocks, same line numbers
    number = 0
    while number < len(lines):
        fence = _FENCE.match(lines[number])
        if fence:
            end = next((i for i in range(number + 1, len(lines)) if lines[i].startswith("```")), len(lines))
            _read_block(
                found, file, number, fence.group(1), lines[number + 1 : end], lines[number - 1] if number else ""
            )
            prose += [""] * (end - number + 1)
            number = end + 1
            continue
        if _UNREAD_FENCE.match(lines[number]):
            found.problems.append(f"{file}:{number + 1}: a fence must be ``` and begin its line")
        before = prose[-1] if prose else ""
        if _INDENTED.match(lines[number]) and (not before.strip() or before.startswith("#")):
            found.problems.append(
                f"{file}:{number + 1}: an indented block: fence it with ```sh if a test shall run it, else with ```text"
            )
        prose.append(lines[number])
        number += 1
    for match in _MENTION.finditer("\n".join(prose)):
        line = "\n".join(prose).count("\n", 0, match.start()) + 1
        found.mentions.append(Mention(file, line, " ".join(match.group(1).split())))
    return found


def _read_block(found: Document, file: Path, number: int, language: str, body: list[str], before: str) -> None:
    mark = _MARK.match(before)
    marks = frozenset(mark.group(1).split(", ")) if mark else frozenset()
    for unknown in sorted(marks - set(MARKS)):
        found.problems.append(f"{file}:{number}: no such mark: {unknown}; there are {', '.join(MARKS)}")
    if language not in LANGUAGES:
        found.problems.append(
            f"{file}:{number + 1}: a block fenced with ```{language}: must be one of {', '.join(LANGUAGES)}"
        )
    elif language in SHOWN:
        for i, line in enumerate(body):
            if _COMMAND_LINE.match(line):
                found.problems.append(
                    f"{file}:{number + 2 + i}: a command in a block of text, where no test runs it: {line}"
                )
    elif language == "python":
        found.commands.append(Command(file, number + 2, "\n".join(body), marks, language))
    else:
        found.commands += _commands_of(file, number + 2, body, marks)


def _commands_of(file: Path, first: int, body: list[str], marks: frozenset[str]) -> list[Command]:
    """One command a line, or several lines joined by backslashes."""
    commands, begun, begin = [], "", first
    for number, line in enumerate(body, first):
        begin = begin if begun else number
        begun += line
        if line.endswith("\\"):
            begun += "\n"
            continue
        if begun.strip() and not begun.lstrip().startswith("#"):
            commands.append(Command(file, begin, begun, marks))
        begun = ""
    return commands


def problems_of_mentions(documents: list[Document], tests: list[str]) -> list[str]:
    """Mentions that nothing runs.

    A command must be (the beginning or a part of) one that stands in a block; a ctest must choose some of `tests`, the
    names of all.
    """
    shell = (command for document in documents for command in document.commands if command.language == "sh")
    run = [" ".join(command.text.split()) for command in shell]
    problems = []
    for mention in (mention for document in documents for mention in document.mentions):
        where = f"{mention.file}:{mention.line}: "
        chosen = re.match(r"ctest --preset \w+ -R ('[^']*'|\S+)$", mention.text)
        if chosen:
            for part in chosen.group(1).strip("'").split("|"):
                if not any(re.search(part, test) for test in tests):
                    problems.append(f"{where}{mention.text}: no test is called {part}")
        elif not re.match(r"earshot [a-z]+$", mention.text) and not any(mention.text in command for command in run):
            problems.append(f"{where}{mention.text}: a command that no block holds, so that no test runs it")
    return problems
