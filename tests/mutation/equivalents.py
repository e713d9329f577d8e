"""The list of faults that change nothing anybody could see, and which faults of a file its entries mean."""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from project import BadInput

if TYPE_CHECKING:  # the list can be read where clang's module, which sites.py needs, is not installed
    from sites import Fault

_TEXTS = {"file", "function", "fault", "reason"}


@dataclass(frozen=True)
class Entry:
    file: str
    function: str  # as Fault.function
    fault: str  # as Fault.kind
    reason: str  # why nobody can notice
    site: str | None = None  # "2 of 5": which of the function's faults of this kind, counted from 1, and of how many

    def told(self) -> str:
        return f"{self.file}: {self.function}: {self.fault}" + ("" if self.site is None else f", {self.site}")


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
    site = re.fullmatch(r"([1-9]\d*) of ([1-9]\d*)", texts.get("site", "1 of 2"))
    is_site = site is not None and int(site[1]) <= int(site[2]) > 1
    if texts.keys() != fields.keys() or texts.keys() - {"site"} != _TEXTS or not is_site:
        needs = 'the texts file, function, fault, reason, may have a site such as "2 of 5", and nothing else'
        raise BadInput(f"{path}: an entry needs {needs}; it has {fields}")
    return Entry(**texts)


def faults_meant(entries: list[Entry], name: str, faults: list[Fault]) -> tuple[dict[Fault, Entry], list[str]]:
    """The fault of each entry for the file `name`, and a complaint about every one that does not mean just one fault.

    @param faults  all of the file, in the order of its text
    """
    meant: dict[Fault, Entry] = {}
    complaints: list[str] = []
    for entry in entries:
        if entry.file != name:
            continue
        of_function = [f for f in faults if f.function == entry.function]
        alike = [f for f in of_function if f.kind == entry.fault]
        found = next((f for f in alike if f.switchable and f.site == entry.site), None)
        if found is None:
            complaints.append(f"{entry.told()}: {_what_is_wrong(of_function, alike)}")
        elif found in meant:
            complaints.append(f"{entry.told()}: listed twice")
        else:
            meant[found] = entry
    return meant, complaints


def _what_is_wrong(of_function: list[Fault], alike: list[Fault]) -> str:
    planted = [f for f in alike if f.switchable]
    if not of_function:
        return "no such function (any more)"
    if not alike:
        return f"no such fault in it (any more); it has: {', '.join(sorted({f.kind for f in of_function}))}"
    if not planted:
        return "only the compiler computes this, so it is not tried"
    if len(planted) == 1:
        return "it has one such fault (by now), which needs no site"
    places = "".join(f'\n    site = "{f.site}": line {f.line}: {f.change}' for f in planted)
    return f"it has {len(planted)} such faults (by now); say which:{places}"


def complain_of(path: Path, complaints: list[str]) -> None:
    if complaints:
        raise BadInput(f"{path}:" + "".join(f"\n  {complaint}" for complaint in complaints))


def show(entries: list[Entry], names: list[str] | None) -> None:
    """Prints the entries of these files, or all, with their reasons."""
    shown = [entry for entry in entries if names is None or entry.file in names]
    for entry in shown:
        print(f"{entry.told()}\n    {entry.reason}")
    print(f"{len(shown)} {'fault is' if len(shown) == 1 else 'faults are'} listed as equivalent")
