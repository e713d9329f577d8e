#!/usr/bin/python3 -B
"""Whether every relative link of every Markdown file leads to something that is there. Run by ctest (readme.links).

usage: tests/readme/links.py [FOLDER]     (default: of the tree; FOLDER: all in it, such as installed documents)
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
_BLOCK = re.compile(r"^[ \t]*(```|~~~).*?^[ \t]*\1", re.MULTILINE | re.DOTALL)
_CODE = re.compile(r"`[^`\n]*`")
# [text](target), [name]: target, <a href="target">, <img src="target">
_LINK = re.compile(
    r"\[[^\[\]]*\]\(([^()\s]+)[^()]*\)"
    r"|^ {0,3}\[[^\[\]]+\]:[ \t]+(\S+)"
    r"""|<[a-z]+\s[^<>]*?\b(?:href|src)=["']([^"']+)["']""",
    re.MULTILINE,
)
_HEADING = re.compile(r"^#+ +(.*)$", re.MULTILINE)


def blank(text: str, what: re.Pattern[str]) -> str:
    """The text with spaces for what matches; its lines keep their numbers."""
    return what.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def anchors_of(text: str) -> set[str]:
    """What a link may name behind a #: the headings in small letters, with - for a space, without punctuation."""
    return {
        re.sub(r"[^\w\- ]", "", heading).strip().lower().replace(" ", "-")
        for heading in _HEADING.findall(blank(text, _BLOCK))
    }


def anchors_at(place: Path) -> set[str]:
    """The anchors of a Markdown file, or of the README.md that a folder shows; anything else has none."""
    page = place / "README.md" if place.is_dir() else place
    return anchors_of(page.read_text()) if page.suffix == ".md" and page.is_file() else set()


def problems_of(name: str, root: Path) -> list[str]:
    """The links of the file `name` below `root` that lead nowhere, as FILE:LINE: what is wrong."""
    text = (root / name).read_text()
    # A link may have code for its text, so that only whole pieces of code that hold a link are none.
    prose = _CODE.sub(lambda code: re.sub(r"[\[\]()]", " ", code.group()), blank(text, _BLOCK))
    problems = []
    for link in _LINK.finditer(prose):
        written = link.group(1) or link.group(2) or link.group(3)
        target, _, anchor = written.partition("#")
        if re.match(r"[a-z]+:", target):
            continue
        place = Path(os.path.normpath(root / Path(name).parent / target)) if target else root / name
        where = f"{name}:{prose.count(chr(10), 0, link.start()) + 1}: "
        if not place.exists():
            problems.append(f"{where}{written}: there is no such file")
        elif anchor and anchor not in anchors_at(place):
            problems.append(f"{where}{written}: there is no such heading")
    return problems


def names_of_tree() -> list[str]:
    command = ["git", "ls-files", "-z", "-co", "--exclude-standard", "*.md"]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    return sorted(name for name in listed.split("\0") if name and (ROOT / name).is_file())


def main() -> int:
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT
    names = sorted(str(page.relative_to(root)) for page in root.rglob("*.md")) if len(sys.argv) > 1 else names_of_tree()
    problems = [problem for name in names for problem in problems_of(name, root)]
    print("".join(problem + "\n" for problem in problems) + f"{len(names)} files, {len(problems)} links lead nowhere")
    return 0 if names and not problems else 1


if __name__ == "__main__":
    sys.exit(main())
