"""What programs print and pages show, as (line, text).

These are string literals of C++ and Python, help and output of scripts, words of TOML files and comments of messages.
Other comments and docstrings are read by those who read code; they are not here.
"""

from __future__ import annotations

import ast
import re
import subprocess
from pathlib import Path

Line = tuple[int, str]

_CPP = re.compile(
    r'R"(?P<mark>\w*)\((?P<raw>.*?)\)(?P=mark)"|"(?P<text>(?:[^"\\\n]|\\.)*)"'
    r"|//[^\n]*|/\*.*?\*/|'(?:[^'\\\n]|\\.)+'",
    re.DOTALL,
)
_SCRIPT_PRINTS = re.compile(r"\b(?:echo|printf)\b|^\s*(?:usage|refuse)\b")
_TOML_FOLDERS = ("hil/cases/", "firmware/boards/linux/missions/", "sim/ocean/environments/")
# Notes and tables of what was measured.
_PAGES_OF_RESULTS = ("policy/frozen/", "policy/reproduce/", "policy/experiments/")


def of_cpp(text: str) -> list[Line]:
    found = []
    for match in _CPP.finditer(text):
        literal = match["raw"] if match["raw"] is not None else match["text"]
        begin = text.rfind("\n", 0, match.start()) + 1
        if literal and not text[begin:].startswith("#include"):
            found.append((text.count("\n", 0, match.start()) + 1, literal))
    return found


def of_python(text: str) -> list[Line]:
    tree = ast.parse(text)
    prints_docstring = "__doc__" in text
    documented = [n for n in ast.walk(tree) if isinstance(n, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef))]
    skipped = set()
    for node in documented + ([] if prints_docstring else [tree]):
        first = node.body[0] if node.body else None
        if isinstance(first, ast.Expr):
            skipped.add(id(first.value))
    constants = [n for n in ast.walk(tree) if isinstance(n, ast.Constant) and id(n) not in skipped]
    return [(n.lineno, n.value) for n in constants if isinstance(n.value, str)]


def of_script(text: str) -> list[Line]:
    """The comment at its head, which --help prints, and what it prints itself."""
    lines = text.split("\n")
    end = next((n for n, line in enumerate(lines) if not line.startswith("#")), len(lines))
    printed = [n for n in range(end, len(lines)) if _SCRIPT_PRINTS.search(lines[n])]
    return [(n + 1, lines[n]) for n in [*range(1, end), *printed]]


def of_file(name: str, text: str) -> list[Line]:
    """Nothing of what prints nothing: tests, pages of results, other kinds of files."""
    if name.startswith(("tests/", *_PAGES_OF_RESULTS)):
        return []
    if name.endswith((".cpp", ".hpp")):
        return of_cpp(text)
    head = text.split("\n", 1)[0]
    if name.endswith(".py") or (head.startswith("#!") and "python" in head):
        return of_python(text)
    if head.startswith("#!"):
        return of_script(text)
    if name.endswith(".lcm") or (name.endswith(".toml") and name.startswith(_TOML_FOLDERS)):
        return list(enumerate(text.split("\n"), 1))
    return []


def of_tree(root: Path) -> dict[str, list[Line]]:
    command = ["git", "ls-files", "-z", "-co", "--exclude-standard"]
    listed = subprocess.run(command, cwd=root, capture_output=True, text=True, check=True).stdout
    literals = {}
    for name in sorted({name for name in listed.split("\0") if name}):
        path = root / name
        if path.is_symlink() or not path.is_file():
            continue
        try:
            literals[name] = of_file(name, path.read_text())
        except UnicodeDecodeError:
            continue
    return {name: lines for name, lines in literals.items() if lines}
