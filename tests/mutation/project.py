"""The copy of the tree in which faults are planted, its build, and which tests could see a file."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path


class BadInput(Exception):
    """What a person asked for or listed cannot be done."""


@dataclass(frozen=True)
class Test:
    """A test of ctest's list; `program` is the built program that it runs."""

    name: str
    command: tuple[str, ...]
    environment: tuple[tuple[str, str], ...]
    folder: str
    program: str


class Commands:
    """How the compiler is called for a tree's files, from the compile_commands.json of a build folder."""

    def __init__(self, tree: Path, build: Path) -> None:
        self.tree = tree
        listed = json.loads((build / "compile_commands.json").read_text())
        self.by_name = {c["file"].removeprefix(f"{tree}/"): c["command"].split() for c in listed}

    def of(self, name: str) -> list[str]:
        """For a source its command; for a header that of the first source that includes it."""
        if name in self.by_name:
            return self.by_name[name]
        folder = str(Path(name).parent)
        near_first = sorted(self.by_name, key=lambda n: (not n.startswith(folder), n))
        for other in near_first:
            if (self.tree / other).is_file() and name in included_by(self.tree, other):
                return self.by_name[other]
        raise BadInput(f"{name}: nothing that is built includes it")


def included_by(tree: Path, name: str) -> set[str]:
    """The files of the tree that a file includes, itself among them, at any depth."""
    found, left = {name}, [name]
    while left:
        path = tree / left.pop()
        for header in re.findall(r'^#include "([^"]+)"', path.read_text(errors="replace"), re.MULTILINE):
            if header not in found and (tree / header).is_file():
                found.add(header)
                left.append(header)
    return found


class Project:
    def __init__(self, root: Path, place: Path) -> None:
        self.root, self.tree, self.build = root, place / "tree", place / "build"
        self.include = place / "include"
        self.programs: dict[str, set[str]] = {}  # test program -> the sources it is made of, below the tree

    def copy(self, planted: dict[str, str]) -> None:
        """Makes the tree as the user's is, but for the planted texts; leaves alone what is so already."""
        command = ["git", "ls-files", "-z", "-co", "--exclude-standard"]
        listed = subprocess.run(command, cwd=self.root, capture_output=True, text=True, check=True).stdout
        names = {name for name in listed.split("\0") if name and (self.root / name).is_file()}
        for name in names:
            wanted = planted[name].encode() if name in planted else (self.root / name).read_bytes()
            there = self.tree / name
            if not there.is_file() or there.read_bytes() != wanted:
                there.parent.mkdir(parents=True, exist_ok=True)
                there.write_bytes(wanted)
                shutil.copymode(self.root / name, there)
        if self.tree.is_dir():
            for path in [p for p in self.tree.rglob("*") if p.is_file() and "__pycache__" not in p.parts]:
                if str(path.relative_to(self.tree)) not in names:
                    path.unlink()

    def configure(self, header: str) -> None:
        self.include.mkdir(parents=True, exist_ok=True)
        there = self.include / "earshot_fault.hpp"
        if not there.is_file() or there.read_text() != header:
            there.write_text(header)
        command = ["cmake", "-S", str(self.tree), "-B", str(self.build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Dev"]
        command += [
            f"-DCMAKE_CXX_FLAGS=-w -I{self.include}",
            "-DCMAKE_CXX_FLAGS_DEV=-O2",
            "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON",
            "-DEARSHOT_APART=ON",
            "-DCMAKE_SUPPRESS_REGENERATION=ON",  # some tests are made of sources' text while CMake runs
        ]
        if shutil.which("ccache"):
            command += [f"-DCMAKE_{language}_COMPILER_LAUNCHER=ccache" for language in ("C", "CXX")]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        self.ninja("lcm_types_generated")  # headers that sources include: clang reads those, too
        self.read_programs()

    def ninja(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(["ninja", "-C", str(self.build), *arguments], capture_output=True, text=True, check=False)

    def read_programs(self) -> None:
        rules = (self.build / "build.ninja").read_text()
        linked = re.findall(r"^build (tests/[^\s:|]+)[^:\n]*: CXX_EXECUTABLE_LINKER", rules, re.MULTILINE)
        for program in linked:
            inputs = self.ninja("-t", "inputs", program).stdout.split("\n")
            prefix = str(self.tree) + "/"
            self.programs[program] = {line.strip()[len(prefix) :] for line in inputs if line.strip().startswith(prefix)}

    def programs_of(self, name: str) -> tuple[list[str], list[str]]:
        """Test programs that `name` is part of: those of the mirrored folder or that include it, and others."""
        header = re.sub(r"\.cpp$", ".hpp", name)
        part = name.split("/")[0]
        near: list[str] = []
        far: list[str] = []
        for program, sources in sorted(self.programs.items()):
            units = [s for s in sources if s.endswith(".cpp")]
            if name not in sources and not any(name in included_by(self.tree, u) for u in units):
                continue
            own = [u for u in units if u.startswith(f"tests/{part}/")]
            mirrored = any(str(Path(u).parent) == f"tests/{Path(name).parent}" for u in own)
            includes = any(f'#include "{header}"' in (self.tree / u).read_text() for u in own)
            (near if mirrored or includes else far).append(program)
        if not near:  # a header of plain data: what few programs are made of least
            far.sort(key=lambda program: len(self.programs[program]))
            near, far = far[:4], far[4:]
        return near, far

    def tests(self, programs: set[str]) -> list[Test]:
        shown = subprocess.run(
            ["ctest", "--test-dir", str(self.build), "--show-only=json-v1"], capture_output=True, text=True, check=True
        ).stdout
        found = []
        for test in json.loads(shown)["tests"]:
            command = test.get("command")
            if not command:
                continue
            named = [word.removeprefix(f"{self.build}/") for word in command]  # behind hil/bus/with-can, too
            program = next((word for word in named if word in programs), None)
            if program is None:
                continue
            properties = {p["name"]: p["value"] for p in test.get("properties", [])}
            pairs = tuple(tuple(e.split("=", 1)) for e in properties.get("ENVIRONMENT", []))
            folder = properties.get("WORKING_DIRECTORY", str(self.build))
            found.append(Test(test["name"], tuple(command), pairs, folder, program))
        return found
