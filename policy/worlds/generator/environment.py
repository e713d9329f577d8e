"""Reading the environment that variants are made of: its numbers, judged as Earshot's own reader judges them."""

from __future__ import annotations

import math
import os
import reprlib
import stat
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

MOST_BYTES = 1_000_000


@dataclass(frozen=True)
class Range:
    low: float
    high: float
    above: bool = False  # low itself is outside

    def holds(self, value: float) -> bool:
        return math.isfinite(value) and self.low <= value <= self.high and not (self.above and value == self.low)

    def words(self) -> str:
        return f"above {self.low:g}, at most {self.high:g}" if self.above else f"{self.low:g} to {self.high:g}"


DEEPEST_M = 12_000.0
DEPTH = Range(0.0, DEEPEST_M)
BELOW_SURFACE = Range(0.0, DEEPEST_M, above=True)
SOUND_SPEED = Range(100.0, 10_000.0)
IN_PLANE = Range(-1e6, 1e6)
LEVEL = Range(-100.0, 300.0)

# By table and key, as sim/ocean/file has them.
SOURCE = {
    "frequency_hz": Range(1.0, 10_000.0),
    "level_db_re_1upa_at_1m": Range(0.0, 300.0),
    "depth_m": BELOW_SURFACE,
    "north_m": IN_PLANE,
    "east_m": IN_PLANE,
}
MUNK = {
    "axis_sound_speed_mps": SOUND_SPEED,
    "axis_depth_m": DEPTH,
    "scale_m": BELOW_SURFACE,
    "perturbation": Range(0.0, 0.1),
}
SEA_FLOOR = {
    "density_g_per_cm3": Range(0.5, 20.0),
    "attenuation_db_per_wavelength": Range(0.0, 20.0),
}


def text_of(file: Path) -> str:
    """The text of a regular file of at most a megabyte. Throws OSError, ValueError."""
    descriptor = os.open(
        file, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC
    )  # so that a pipe does not wait for its other end
    with open(descriptor, "rb") as opened:
        if not stat.S_ISREG(os.fstat(descriptor).st_mode):
            raise ValueError("no regular file")
        data = opened.read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise ValueError(f"longer than {MOST_BYTES} bytes, which no environment is")
    return data.decode()


def judge(keys: dict[str, Any]) -> None:
    """Throws ValueError (table and key, value, range) where a number of an environment with one half-space cannot be.

    KeyError where it lacks what every environment has.
    """
    _judge_text(keys, "name")
    seabed, water = _table(keys, "seabed"), _table(keys, "water")
    _judge_numbers("source", _table(keys, "source"), SOURCE)
    _judge_numbers("noise", _table(keys, "noise"), {}, {"level_db_re_1upa": LEVEL})
    _judge_numbers("seabed", seabed, {"depth_m": BELOW_SURFACE})
    _judge_numbers("seabed.layers", seabed["layers"][0], {"sound_speed_mps": SOUND_SPEED}, SEA_FLOOR)
    if keys["source"]["depth_m"] >= seabed["depth_m"]:
        raise ValueError(
            f"[source] depth_m: {keys['source']['depth_m']!r}: must be above the sea floor, {seabed['depth_m']:g}"
        )
    profile = water["profile"]
    if profile == "munk":
        _judge_numbers("water", water, MUNK)
    elif profile == "table":
        _judge_profile(water, seabed["depth_m"])
    else:
        raise ValueError(f'[water] profile: {reprlib.repr(profile)}: of "munk" and "table" variants are written')


def _table(keys: dict[str, Any], name: str) -> dict[str, Any]:
    if not isinstance(keys[name], dict):
        raise ValueError(f"{name}: {reprlib.repr(keys[name])}: must be a table")
    return dict(keys[name])


def _judge_text(keys: dict[str, Any], key: str) -> None:
    if not isinstance(keys[key], str):
        raise ValueError(f"{key}: {reprlib.repr(keys[key])}: must be text")


def _judge_number(where: str, value: object, allowed: Range) -> None:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ValueError(f"{where}: {reprlib.repr(value)}: must be a number, {allowed.words()}")
    # An integer of TOML can be larger than any float.
    if (isinstance(value, int) and abs(value) > 10**9) or not allowed.holds(value):
        raise ValueError(f"{where}: {reprlib.repr(value)}: must be {allowed.words()}")


def _judge_numbers(
    table: str, keys: object, needed: dict[str, Range], optional: dict[str, Range] | None = None
) -> None:
    if not isinstance(keys, dict):
        raise ValueError(f"[{table}]: {reprlib.repr(keys)}: must be a table")
    there = {key: within for key, within in (optional or {}).items() if key in keys}
    for key, within in {**needed, **there}.items():
        _judge_number(f"[{table}] {key}", keys[key], within)


def _judge_profile(water: dict[str, Any], floor_m: float) -> None:
    for key, allowed in (("depth_m", DEPTH), ("sound_speed_mps", SOUND_SPEED)):
        values = water[key]
        if not isinstance(values, list) or not values:
            raise ValueError(f"[water] {key}: {reprlib.repr(values)}: must be a list of numbers, {allowed.words()}")
        for number, value in enumerate(values, start=1):
            _judge_number(f"[water] {key}, value {number}", value, allowed)
    depths, speeds = water["depth_m"], water["sound_speed_mps"]
    if len(depths) != len(speeds):
        raise ValueError(f"[water] sound_speed_mps: {len(speeds)} values: must be {len(depths)}, as depth_m has")
    if depths[0] != 0 or not _increase(depths):
        raise ValueError(f"[water] depth_m: {reprlib.repr(depths)}: must begin at 0 and increase")
    if depths[-1] < floor_m:
        raise ValueError(f"[water] depth_m: ends at {depths[-1]!r}: must extend to the sea floor, {floor_m:g}")


def _increase(values: Iterable[float]) -> bool:
    row = list(values)
    return all(lower < upper for lower, upper in zip(row, row[1:], strict=False))
