"""The cases of a folder, as far as a person who chooses among them wants to know them.

earshot-bench reads them whole and judges every key; here a name and what the case does are enough.
"""

from __future__ import annotations

import difflib
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bad_input import BadInput

USUAL_MISSION = Path(__file__).resolve().parents[1] / "missions/search_over_can.toml"
# As many as earshot-bench takes.
_MOST_BYTES = 4 << 20


@dataclass(frozen=True)
class ListedCase:
    name: str
    when: str


def _read_table(file: Path) -> dict[str, Any]:
    """Raises BadInput. A pipe might never be written, a device never end."""
    try:
        if not file.is_file():
            raise BadInput(f"{file}: is no regular file" if file.exists() else f"{file}: no such file")
        if file.stat().st_size > _MOST_BYTES:
            raise BadInput(f"{file}: has more than {_MOST_BYTES} bytes")
        return tomllib.loads(file.read_text(encoding="utf-8"))
    except OSError as e:
        raise BadInput(f"{file}: {e.strerror}") from e
    except ValueError as e:  # no TOML, or no UTF-8
        raise BadInput(f"{file}: {e}") from e
    except RecursionError as e:
        raise BadInput(f"{file}: is nested too deeply") from e


def _when_of(file: Path) -> str:
    when = _read_table(file).get("when")
    if not isinstance(when, str):
        raise BadInput(f"{file}: when: must be a text that describes what the case does")
    return when


def _files_of(folder: Path) -> list[Path]:
    if not folder.is_dir():
        raise BadInput(f"{folder}: no such folder of cases")
    files = sorted(folder.glob("*.toml"))
    if not files:
        raise BadInput(f"{folder}: holds no case (NAME.toml)")
    return files


def require_cases(folder: Path, names: list[str]) -> None:
    """Raises BadInput that names what is alike, when one is not there."""
    there = [file.stem for file in _files_of(folder)]
    for name in names:
        if name not in there:
            alike = " or ".join(difflib.get_close_matches(name, there))
            meant = f"did you mean {alike}?" if alike else "--list prints all"
            raise BadInput(f"--case {name}: there is no {folder / name}.toml; {meant}")


def _needs_can(file: Path) -> bool:
    """Unless its mission says that all is over LCM; one that cannot be read is for earshot-bench to judge."""
    try:
        named = _read_table(file).get("mission", USUAL_MISSION)
        ports = _read_table(file.parent / named)["port"]
        return any(port["kind"] != "lcm" for port in ports)
    except (BadInput, KeyError, TypeError):
        return True


def names_over_can(folder: Path, names: list[str]) -> list[str]:
    """Of those named, or of all, the ones that are flown on a CAN bus; by name."""
    return [file.stem for file in _files_of(folder) if (not names or file.stem in names) and _needs_can(file)]


def chosen_names(folder: Path, names: list[str]) -> list[str]:
    """Those named, or all; by name."""
    return [file.stem for file in _files_of(folder) if not names or file.stem in names]


def list_cases(folder: Path, names: list[str]) -> list[ListedCase]:
    """Those named, or all; by name."""
    require_cases(folder, names)
    return [ListedCase(file.stem, _when_of(file)) for file in _files_of(folder) if not names or file.stem in names]
