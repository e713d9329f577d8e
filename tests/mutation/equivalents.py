"""The list of faults that change nothing anybody could see, and which faults of a file its entries mean."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from project import BadInput

if TYPE_CHECKING:  # the list can be read where clang's module, which sites.py needs, is not installed
    from sites import Fault

_TEXTS = {"file", "line", "change", "reason"}


@dataclass(frozen=True)
class Entry:
    file: str
    line: str  # without blanks around it
    change: str  # as Fault.change
    reason: str  # why nobody can notice
    occurrence: int | None = None  # which of the file's faults of this line and change, counted from 1

    def told(self) -> str:
        which = "" if self.occurrence is None else f" (occurrence {self.occurrence})"
        return f"{self.file}: {self.line}\n    {self.change}{which}"


def read_entries(path: Path, root: Path) -> list[Entry]:
    """All entries of the list at `path`, each of which names a file below `root`."""
    try:
        listed = tomllib.loads(path.read_text()).get("equivalent", [])
    except (OSError, tomllib.TOMLDecodeError) as e:
        raise BadInput(f"{path}: {e}") from None
    entries = [_entry(path, fields) for fields in listed]
    missing = [entry for entry in entries if not (root / entry.file).is_file()]
    if missing:
        raise BadInput(f"{path}: no such file (any more):" + "".join(f"\n  {e.told()}" for e in missing))
    return entries


def _entry(path: Path, fields: dict[str, object]) -> Entry:
    texts = {name: value for name, value in fields.items() if isinstance(value, str)}
    occurrence = fields.get("occurrence")
    is_number = isinstance(occurrence, int) and not isinstance(occurrence, bool) and occurrence >= 1
    if texts.keys() != _TEXTS or fields.keys() - _TEXTS - {"occurrence"} or not (occurrence is None or is_number):
        needs = "the texts file, line, change, reason, may have a number occurrence from 1 on, and nothing else"
        raise BadInput(f"{path}: an entry needs {needs}; it has {fields}")
    return Entry(**texts, occurrence=occurrence if isinstance(occurrence, int) else None)


def faults_meant(
    entries: list[Entry], name: str, text: str, faults: list[Fault]
) -> tuple[dict[Fault, Entry], list[str]]:
    """The fault of each entry for the file `name`, and a complaint about every one that does not mean just one fault.

    @param faults  all of the file, in the order of its text
    """
    lines = [line.strip() for line in text.split("\n")]
    meant: dict[Fault, Entry] = {}
    complaints: list[str] = []
    for entry in entries:
        if entry.file != name:
            continue
        alike = [f for f in faults if f.change == entry.change and lines[f.line - 1] == entry.line]
        planted = [f for f in alike if f.switchable]
        number = entry.occurrence or 1
        if not alike:
            complaints.append(f"no such fault (any more): {entry.told()}")
        elif not planted:
            complaints.append(f"only the compiler computes this, so it is not tried: {entry.told()}")
        elif entry.occurrence is None and len(planted) > 1:
            places = ", ".join(f"{n} on line {f.line}" for n, f in enumerate(planted, 1))
            complaints.append(f"{len(planted)} faults are alike, say which by occurrence = {places}: {entry.told()}")
        elif number > len(planted):
            complaints.append(f"no more than {len(planted)} such faults: {entry.told()}")
        elif planted[number - 1] in meant:
            complaints.append(f"listed twice: {entry.told()}")
        else:
            meant[planted[number - 1]] = entry
    return meant, complaints


def complain_of(path: Path, complaints: list[str]) -> None:
    if complaints:
        raise BadInput(f"{path}:" + "".join(f"\n  {complaint}" for complaint in complaints))


def show(entries: list[Entry], names: list[str] | None) -> None:
    """Prints the entries of these files, or all, with their reasons."""
    shown = [entry for entry in entries if names is None or entry.file in names]
    for entry in shown:
        print(f"{entry.told()}\n    {entry.reason}")
    print(f"{len(shown)} {'fault is' if len(shown) == 1 else 'faults are'} listed as equivalent")
