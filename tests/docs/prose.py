"""Whether prose can be read once: no long sentence, and no word that only Earshot's authors know.

The words stand in forbidden_words.txt, the glossary maps them to the terms of the field. Code, in `backquotes` or in a
block, may keep them: files, messages and keys that ship do.
"""

from __future__ import annotations

import re
from pathlib import Path

LONGEST_SENTENCE = 45  # words
LONGEST_ROW = 300  # characters: of a table, and of any other line that is no code

_BLOCK = re.compile(r"^```.*?^```[ \t]*$", re.MULTILINE | re.DOTALL)
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_CODE = re.compile(r"`[^`\n]+`")
_LINK = re.compile(r"!?\[([^\[\]]*)\]\([^()]*\)")
_ABBREVIATION = re.compile(r"\b(?:Proc|Mtgs|Acoust|e\.g|i\.e|No|Fig)\.")
# A row of a table, an item of a list, a heading and a paragraph are pieces of their own.
_PIECE_BEGINS = re.compile(r"^\s*(?:[-*] |\d+\. |#|\||>|!!!|$)")


def pieces_of(text: str) -> list[tuple[int, str]]:
    """Paragraphs, items, headings and cells of Markdown, each with its line; code is the word CODE."""

    def blank(match: re.Match[str]) -> str:
        return "\n" * match.group().count("\n")

    text = _COMMENT.sub(blank, _BLOCK.sub(blank, text))
    text = _LINK.sub(r"\1", _CODE.sub("CODE", text))
    pieces: list[tuple[int, str]] = []
    is_open = False
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith("|"):
            pieces += [(number, cell.strip()) for cell in line.strip().strip("|").split("|")]
            is_open = False
        elif _PIECE_BEGINS.match(line) or not is_open:
            pieces.append((number, line.strip()))
            is_open = bool(line.strip()) and not line.startswith("#")
        else:
            begin, before = pieces[-1]
            pieces[-1] = (begin, f"{before} {line.strip()}")
    return [(number, piece) for number, piece in pieces if piece]


def sentences_of(piece: str) -> list[str]:
    piece = _ABBREVIATION.sub(lambda match: match.group()[:-1], piece)
    return [sentence for sentence in re.split(r"(?<=[.!?])\s+|(?<=[.!?]\*\*)\s+", piece) if sentence]


def long_sentences(name: str, text: str) -> list[str]:
    problems = []
    for number, piece in pieces_of(text):
        for sentence in sentences_of(piece):
            words = len(re.findall(r"[\w'-]+", sentence))
            if words > LONGEST_SENTENCE:
                problems.append(f"{name}:{number}: a sentence of {words} words: {sentence}")
    return problems


def long_rows(name: str, text: str) -> list[str]:
    lines = _BLOCK.sub(lambda match: "\n" * match.group().count("\n"), text).split("\n")
    return [f"{name}:{n}: {len(line)} characters" for n, line in enumerate(lines, 1) if len(line) > LONGEST_ROW]


def read_words(file: Path) -> list[tuple[re.Pattern[str], str]]:
    """Forbidden words of prose, each with what to write in its place (names.py reads those of names)."""
    lines = [line for line in file.read_text().splitlines() if line.strip() and not line.startswith(("#", "name"))]
    pairs = [line.split(" | ") for line in lines]
    return [(re.compile(rf"\b(?:{pattern.strip()})\b"), instead.strip()) for pattern, instead in pairs]


def forbidden_words(name: str, text: str, words: list[tuple[re.Pattern[str], str]]) -> list[str]:
    problems = []
    for number, piece in pieces_of(text):
        for pattern, instead in words:
            problems += [f"{name}:{number}: {m.group()}: write {instead}: {piece}" for m in pattern.finditer(piece)]
    return problems
