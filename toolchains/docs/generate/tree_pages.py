"""Markdown of the tree as pages of the site.

Links lead to pages, and Markdown is written as the site's generator reads it. The site's own Markdown
(toolchains/docs/site) becomes the pages at its top. Every README, and every other file that some page links to, becomes
a page below `tree/`, so that no link leaves the site.
"""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path, PurePosixPath

SITE = PurePosixPath("toolchains/docs/site")
PICTURES = (".png", ".svg", ".jpg", ".gif")
LANGUAGES = {
    ".cpp": "cpp", ".hpp": "cpp", ".py": "python", ".toml": "toml", ".lcm": "c", ".json": "json", ".cmake": "cmake",
    ".service": "ini", ".yml": "yaml",
}  # fmt: skip
LONGEST_LISTING = 400_000  # bytes

_FENCE = re.compile(r"^```.*?^```[ \t]*$", re.MULTILINE | re.DOTALL)
_LINK = re.compile(r"(\]\()([^()\s]+)(?=[^()]*\))|((?:href|src)=\")([^\"]+)(?=\")")
# Of a page that is made with the site the tree holds only the name and, in a comment, the place.
_MADE = re.compile(r"\*([^*\n]+)\*<!-- page: (\S+) -->")
_MARK = re.compile(r"^<!-- test: .* -->\n", re.MULTILINE)
_LIST_ITEM = re.compile(r"(?:[-*]|\d+\.) ")


def page_of(name: str, is_folder: bool) -> str:
    """Where a file or folder of the tree stands among the pages."""
    path = PurePosixPath(name)
    if path.is_relative_to(SITE):
        return str(path.relative_to(SITE))
    # The site's generator leaves out whatever has a name that begins with a dot.
    path = PurePosixPath(*(part.lstrip(".") or part for part in path.parts))
    if is_folder:
        return str(PurePosixPath("tree") / path / "README.md")
    if path.suffix == ".md" or path.suffix in PICTURES:
        return str(PurePosixPath("tree") / path)
    return str(PurePosixPath("tree") / f"{path}.md")


def for_the_site(text: str) -> str:
    """GitHub's Markdown as Python-Markdown reads it: a blank line before a list or a table, no marks for the tests.

    The name of a page that is made with the site becomes a link to it.
    """
    text = _MADE.sub(r"[\1](\2)", _MARK.sub("", text))
    lines: list[str] = []
    is_code = False
    for line in text.split("\n"):
        before = lines[-1] if lines else ""
        if line.startswith("```"):
            is_code = not is_code
        begins = bool(_LIST_ITEM.match(line)) or line.startswith("|")
        goes_on = (
            before.startswith("|") if line.startswith("|") else bool(_LIST_ITEM.match(before)) or before.startswith(" ")
        )
        if begins and not is_code and before.strip() and not goes_on:
            lines.append("")
        lines.append(line)
    return "\n".join(lines)


class TreePages:
    """Writes pages, and remembers which other files of the tree they link to."""

    def __init__(self, root: Path, folder: Path) -> None:
        self.root, self.folder = root, folder
        self._linked: set[str] = set()
        self._written: set[str] = set()

    def add(self, name: str, head: str = "") -> None:
        """The page of a Markdown file of the tree, `head` (YAML) before it."""
        self.write(page_of(name, False), (self.root / name).read_text(), PurePosixPath(name).parent, head)

    def write(self, page: str, text: str, stands_in: PurePosixPath, head: str = "") -> None:
        """A page of a text whose relative links start at the folder `stands_in` of the tree."""
        text = self._with_links_of(page, for_the_site(text), stands_in)
        place = self.folder / page
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(f"---\n{head}---\n{text}" if head else text)
        self._written.add(page)

    def add_linked(self, head: str) -> None:
        """Pages of all that was linked to and has none yet; pictures are copied."""
        while todo := sorted(
            name for name in self._linked if page_of(name, (self.root / name).is_dir()) not in self._written
        ):
            for name in todo:
                self._add_file(name, head)

    def _add_file(self, name: str, head: str) -> None:
        source, page = self.root / name, page_of(name, (self.root / name).is_dir())
        self._written.add(page)
        if source.is_dir():
            self._add_folder(name, head)
        elif source.suffix in PICTURES:
            (self.folder / page).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, self.folder / page)
        elif source.suffix == ".md":
            self.add(name, head)
        else:
            self.write(
                page,
                f"# {source.name}\n`{name}`, as it stands in the tree.\n\n{_listing_of(source)}",
                PurePosixPath("."),
                head,
            )

    def _add_folder(self, name: str, head: str) -> None:
        readme = f"{name}/README.md"
        if (self.root / readme).is_file():
            self.add(readme, head)
        else:
            files = sorted(file.name for file in (self.root / name).iterdir() if not file.name.startswith("."))
            text = f"# {name}\n" + "".join(f"- [{file}]({file})\n" for file in files)
            self.write(page_of(name, True), text, PurePosixPath(name), head)

    def _with_links_of(self, page: str, text: str, stands_in: PurePosixPath) -> str:
        def changed(match: re.Match[str]) -> str:
            begin, written = match.group(1) or match.group(3), match.group(2) or match.group(4)
            target, _, anchor = written.partition("#")
            if not target or re.match(r"[a-z]+:", target):
                return match.group(0)
            name = os.path.normpath(stands_in / target)
            source = self.root / name
            if name.startswith("..") or not source.exists():
                return match.group(0)  # the site's generator says so
            self._linked.add(name)
            place = os.path.relpath(page_of(name, source.is_dir()), PurePosixPath(page).parent)
            return begin + place + (f"#{anchor}" if anchor and source.suffix in ("", ".md") else "")

        pieces, end = [], 0
        for fence in _FENCE.finditer(text):
            pieces += [_LINK.sub(changed, text[end : fence.start()]), fence.group(0)]
            end = fence.end()
        return "".join([*pieces, _LINK.sub(changed, text[end:])])


def _listing_of(source: Path) -> str:
    if source.stat().st_size > LONGEST_LISTING:
        return f"{source.stat().st_size} bytes, too long to be shown here.\n"
    try:
        text = source.read_text()
    except UnicodeDecodeError:
        return f"{source.stat().st_size} bytes, not a text.\n"
    return f"````{LANGUAGES.get(source.suffix, 'text')}\n{text.rstrip()}\n````\n"
