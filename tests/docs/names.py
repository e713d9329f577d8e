"""Names in code that only Earshot's authors know, as the rows `name` of forbidden_words.txt list them.

A row lists words as they follow one another in a name: `hand over` is HandOver, hand_over and kHandOver. Names of
tests are sentences; they are not here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

Row = tuple[bool, list[str], str]  # whether tests may have it, the words, what to write

_CPP = re.compile(
    r'R"(?P<mark>\w*)\(.*?\)(?P=mark)"|"(?:[^"\\\n]|\\.)*"|//[^\n]*|/\*.*?\*/'
    r"|\b\d(?:'?[\w.])*|'(?:[^'\\\n]|\\.)+'|(?P<name>[A-Za-z_]\w*)",
    re.DOTALL,
)
_PYTHON = re.compile(
    r"""(?P<mark>\"{3}|'{3})(?:[^\\]|\\.)*?(?P=mark)|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'|\#[^\n]*"""
    r"|\b\d[\w.]*|(?P<name>[A-Za-z_]\w*)",
    re.DOTALL,
)
_TEST = re.compile(r"\bTEST(?:_[FP])?\(\w+,\s*(\w+)\)")
_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+")
_ROW = re.compile(r"name(?P<is_allowed> outside tests)?: (?P<words>.*?) \| (?P<instead>.*)")


def read_rows(file: Path) -> list[Row]:
    found = [_ROW.fullmatch(line) for line in file.read_text().splitlines()]
    return [(m["is_allowed"] is not None, m["words"].split(", "), m["instead"]) for m in found if m]


def of_code(text: str, pieces: re.Pattern[str]) -> Iterator[tuple[int, str]]:
    """Each with where it begins."""
    sentences = {match.start(1) for match in _TEST.finditer(text)}
    for match in pieces.finditer(text):
        name = match["name"]
        if name and match.start() not in sentences and not name.startswith("test_"):
            yield match.start(), name


def of_file(path: str, text: str) -> Iterator[tuple[int, str]]:
    """Those in it, and before them its own name."""
    is_cpp = path.endswith((".cpp", ".hpp"))
    if is_cpp or path.endswith(".py") or re.match(r"#!.*python", text):
        yield -1, PurePosixPath(path).stem
        yield from of_code(text, _CPP if is_cpp else _PYTHON)


def forbidden(path: str, text: str, rows: list[Row]) -> list[tuple[int, str, str]]:
    """Line (0 for the file's own name), name, and what to write."""
    counting = [
        (words, instead) for is_allowed, words, instead in rows if not (is_allowed and path.startswith("tests/"))
    ]
    problems = []
    verdicts: dict[str, str | None] = {}
    for place, name in of_file(path, text):
        if name not in verdicts:
            spelt = f" {' '.join(_WORD.findall(name)).lower()} "
            hits = (instead for words, instead in counting if any(f" {word} " in spelt for word in words))
            verdicts[name] = next(hits, None)
        if (instead := verdicts[name]) is not None:
            problems.append((text.count("\n", 0, place) + 1 if place >= 0 else 0, name, instead))
    return problems
