"""Pages of the keys of Earshot's TOML files.

What a key means and its default stand in toolchains/docs/keys. What is allowed is asked of the program that reads the
file: it is given a wrong value and answers what the value must be. So a range cannot be stale, and a key that is gone
is noticed.
"""

from __future__ import annotations

import copy
import re
import subprocess
import tempfile
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from command_pages import plain

UNITS = {
    "db_re_1upa2_per_hz": "dB re 1 uPa²/Hz",
    "db_re_1upa_at_1m": "dB re 1 uPa at 1 m",
    "db_re_1upa_at_2mps": "dB re 1 uPa",
    "db_re_1upa": "dB re 1 uPa",
    "db_re_1v_per_upa": "dB re 1 V/uPa",
    "db_per_wavelength": "dB per wavelength",
    "percent_per_km": "% per km",
    "g_per_cm3": "g/cm³",
    "m_per_sqrt_km": "m per √km",
    "percent": "%",
    "mps": "m/s",
    "hz": "Hz",
    "db": "dB",
    "deg": "degrees",
    "km": "km",
    "psu": "psu",
    "m": "m",
    "s": "s",
    "v": "V",
    "c": "°C",
}
NO_KEY = "no_such_key"
WRONG_VALUES: tuple[Any, ...] = ("no such value", 0.5, [True])  # of which every kind of key refuses one


@dataclass(frozen=True)
class Key:
    name: str
    default: str
    meaning: str


@dataclass(frozen=True)
class Answer:
    """What the program says of a key."""

    allowed: str
    is_required: bool


class Unanswered(Exception):
    """The program reads no such key."""


def unit_of(name: str) -> str:
    if name in ("detection_m", "detection_n"):  # m of n, a count
        return ""
    return next((unit for suffix, unit in UNITS.items() if name.endswith("_" + suffix)), "")


def toml_of(table: dict[str, Any], path: str = "") -> str:
    """TOML of tables, arrays of tables, numbers, texts and arrays."""
    plain_keys = [f"{key} = {_value(value)}" for key, value in table.items() if not _is_table(value)]
    text = "\n".join(plain_keys) + "\n"
    for key, value in table.items():
        if isinstance(value, dict):
            text += f"[{path}{key}]\n{toml_of(value, f'{path}{key}.')}"
        elif _is_table(value):
            text += "".join(f"[[{path}{key}]]\n{toml_of(item, f'{path}{key}.')}" for item in value)
    return text


def _is_table(value: Any) -> bool:
    return isinstance(value, dict) or (isinstance(value, list) and bool(value) and isinstance(value[0], dict))


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, list):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    return repr(value)


def table_at(root: dict[str, Any], path: str) -> dict[str, Any]:
    """The table of a path such as `water.stations`, made where it is missing; of an array of tables the first."""
    for name in path.split(".") if path else []:
        root.setdefault(name, {})
        root = root[name][0] if isinstance(root[name], list) else root[name]
    return root


class Asker:
    """Asks a program about the keys of its file."""

    def __init__(self, programs: Path, command: list[str], beside: Path) -> None:
        self._programs, self._command, self._beside = programs, command, beside

    def ask(self, base: dict[str, Any], path: str, key: str) -> Answer:
        for wrong in WRONG_VALUES:
            changed = copy.deepcopy(base)
            table_at(changed, path)[key] = wrong
            stated = self._of(changed, key)
            must = [match.group(1) for line in stated if (match := re.search(r": (must .*|needs .*)$", line))]
            if must:
                must += self._of_items(base, path, key, must[0])
                break
        else:
            raise Unanswered(f"{path}.{key}: no wrong value is refused; the program printed {self.printed!r}")
        without = copy.deepcopy(base)
        table_at(without, path).pop(key, None)
        is_required = any("missing" in line for line in self._of(without, key))
        return Answer(must[-1], is_required)

    def _of_items(self, base: dict[str, Any], path: str, key: str, must: str) -> list[str]:
        """What each number of an array must be."""
        if must != "must be an array of numbers":
            return []
        changed = copy.deepcopy(base)
        table_at(changed, path)[key] = ["no number"]
        stated = [match.group(1) for line in self._of(changed, key) if (match := re.search(r": must (.*)$", line))]
        return [f"{must}, each {allowed('must ' + stated[0])}"] if stated else []

    def _of(self, root: dict[str, Any], key: str) -> list[str]:
        """What is said of the key of a file, which is refused in any case: nothing is computed."""
        root = {NO_KEY: 0, **root}
        with tempfile.NamedTemporaryFile("w", suffix=".toml", dir=self._beside) as file:
            file.write(toml_of(root))
            file.flush()
            words = [word.replace("{file}", file.name) for word in self._command]
            program = self._programs / words[0]
            done = subprocess.run([program, *words[1:]], check=False, capture_output=True, text=True, timeout=60)
        self.printed = done.stderr
        return [line for line in done.stderr.splitlines() if re.search(rf"(?:^|[ .:]){key}\b", line)]


def page(dictionary: Path, root: Path, programs: Path, scratch: Path) -> str:
    """The page of a dictionary. Raises Unanswered where it names a key that the program does not read."""
    stated = tomllib.loads(dictionary.read_text())
    pieces = [f"# {stated['title']}\n", stated["about"].strip() + "\n"]
    base_file = root / stated["base"]
    base = with_whole_paths(tomllib.loads(base_file.read_text()), base_file.parent)
    asker = Asker(programs, stated["command"], scratch)
    for table in stated["table"]:
        changed = copy.deepcopy(base)
        for name in table.get("without", []):
            changed.pop(name, None)
        merge(changed, with_whole_paths(table.get("with", {}), root))
        written = table["name"]
        heading = f"`[[{written}]]`: " if table.get("many") else f"`[{written}]`: " if written else ""
        pieces.append(f"## {heading}{table['subject']}\n\n{table['about'].strip()}\n")
        rows = []
        for item in table["keys"]:
            key = Key(*item)
            answer = asker.ask(changed, written, key.name)
            default = "must be given" if answer.is_required else key.default
            cells = [f"`{key.name}`", unit_of(key.name), plain(allowed(answer.allowed)), default, key.meaning]
            rows.append("| " + " | ".join(cells) + " |")
        pieces.append("| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n" + "\n".join(rows) + "\n")
    return "\n".join(pieces)


def allowed(must: str) -> str:
    """`must be a finite number of at least 0.1 and at most 1` without what is the same for all."""
    text = re.sub(r"^must be ", "", must)
    text = re.sub(r"^a finite number (?:of )?", "number, ", text)
    text = re.sub(r"^number, $|^a finite number$", "number", text)
    return re.sub(r"^an? ", "", text)


def merge(into: dict[str, Any], more: dict[str, Any]) -> None:
    for key, value in more.items():
        if isinstance(value, dict) and isinstance(into.get(key), dict):
            merge(into[key], value)
        else:
            into[key] = value


def with_whole_paths(value: Any, folder: Path) -> Any:
    """Names of files that are there from the folder, as whole paths: the file that is asked about stands elsewhere."""
    if isinstance(value, dict):
        return {key: with_whole_paths(item, folder) for key, item in value.items()}
    if isinstance(value, list):
        return [with_whole_paths(item, folder) for item in value]
    if isinstance(value, str) and "." in value and (folder / value).exists():
        return str((folder / value).resolve())
    return value
