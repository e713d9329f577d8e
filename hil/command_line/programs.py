"""The programs that fly: built, or those of somebody who built them elsewhere."""

from __future__ import annotations

import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

from bad_input import BadInput

BENCH = "earshot-bench"
_PRESET = "release"
# In a folder whose programs are taken as they are; sim/fly knows it, too.
_FOLDER_VARIABLE = "EARSHOT_PROGRAMS"
# It may be anything that somebody calls earshotd.
_MOST_S_TO_PRINT_A_VERSION = 10.0


class BuildFailed(RuntimeError):
    """Its text is for a person; the compiler's own stands above it."""


class NoPage(RuntimeError):
    """The bench, which holds the page, did not give it; its own words stand above this."""


@dataclass(frozen=True)
class Programs:
    bench: Path
    earshotd: Path

    def version(self) -> str:
        """Of the earshotd that flies, with its commit."""
        unknown = "an earshotd that does not give its version"
        try:
            asked = subprocess.run(
                [self.earshotd, "--version"],
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
                errors="replace",
                check=False,
                timeout=_MOST_S_TO_PRINT_A_VERSION,
            )
        except (OSError, subprocess.TimeoutExpired):  # no program at all, or none that ends
            return unknown
        return asked.stdout.strip() or unknown

    def page_of(self, content: str) -> bytes:
        """HTML of a run. Raises NoPage.

        @param content  JSON, as policy/report/page/source/bench.ts describes it
        """
        made = subprocess.run([self.bench, "--page"], input=content.encode(), stdout=subprocess.PIPE, check=False)
        if made.returncode != 0:
            raise NoPage(f"{self.bench} --page ended with status {made.returncode}")
        return made.stdout


def _require_program(path: Path, why: str) -> Path:
    if not path.is_file() or not os.access(path, os.X_OK):
        raise BadInput(f"{path}: no such program; {why}")
    return path.absolute()


def _beside(earshotd: Path, stated_by: str) -> Programs:
    _require_program(earshotd, f"{stated_by} names it")
    bench = _require_program(earshotd.absolute().with_name(BENCH), f"it must stand beside the earshotd of {stated_by}")
    return Programs(bench=bench, earshotd=earshotd.absolute())


def _build(root: Path) -> Programs:
    """@throws BuildFailed"""
    set_up, build = root / "toolchains/setup", root / "toolchains/build"
    for command in ([set_up, "build", "hil"], [build, _PRESET, BENCH, "earshotd"]):
        if subprocess.run([str(word) for word in command], check=False).returncode != 0:
            raise BuildFailed("the bench cannot be built, see above")
    folder = root / "build" / _PRESET / "bin"
    return Programs(bench=folder / BENCH, earshotd=folder / "earshotd")


def programs_for(root: Path, earshotd: Path | None) -> Programs:
    """@param earshotd  taken as it is, with the earshot-bench beside it; None: those of EARSHOT_PROGRAMS, or built"""
    if earshotd is not None:
        return _beside(earshotd, "--earshotd")
    folder = os.environ.get(_FOLDER_VARIABLE)
    return _beside(Path(folder) / "earshotd", _FOLDER_VARIABLE) if folder else _build(root)
