"""An ocean's variants: what a chart does not say of it."""

from __future__ import annotations

import json
import math
import tomllib
from typing import Any

import waters
from environment import judge
from oceans import water_text
from sea_beds import SCALE, Bed
from waters import Water

# Metres; each is nearer to its neighbours than a source's depth is known.
SOURCE_DEPTHS_M = (10.0, 20.0, 60.0, 100.0, 140.0, 200.0)


def variants(environment: str) -> dict[str, str]:
    """The environment over every sea floor of the scale, in other waters, and with its source at other depths.

    Each differs from it in one thing. @param environment  the text of its file, with one half-space as sea floor
    Throws ValueError where it has another, or a number that cannot be.
    """
    keys = tomllib.loads(environment)
    _require_half_space(keys)
    judge(keys)
    at_floor_mps = _speed_at_floor_mps(keys)
    texts = {f"over_{bed.name.replace(' ', '_')}": _over(environment, bed, at_floor_mps) for bed in SCALE}
    for kind in waters.OF_TEMPERATURE:
        texts[f"in_{kind}_water"] = _in(environment, Water(kind, (0.5, 0.5, 0.5)), keys["seabed"], at_floor_mps)
    for depth_m in SOURCE_DEPTHS_M:
        if depth_m != keys["source"]["depth_m"] and depth_m < keys["seabed"]["depth_m"]:
            texts[f"source_at_{depth_m:g}m"] = _with(environment, {("source", "depth_m"): f"{depth_m:.1f}"})
    # JSON's texts are TOML's.
    named = {
        name: _with(text, {("", "name"): json.dumps(f"{keys['name']}: {name}", ensure_ascii=False)})
        for name, text in texts.items()
    }
    for name, text in named.items():
        try:
            judge(
                tomllib.loads(text)
            )  # a key over several lines: no TOML any more; a sea floor of 12 km in a water of 6
        except ValueError as error:
            raise ValueError(f"its variant {name}: {error}") from error
    return named


def _require_half_space(keys: dict[str, Any]) -> None:
    beyond = [key for key in ("oceans", "family", "field_library") if key in keys]
    if beyond:
        raise ValueError(f"[{beyond[0]}]: has oceans of its own; of one without it variants are written")
    seabed = keys.get("seabed", {})
    layers = seabed.get("layers", []) if isinstance(seabed, dict) else []
    if not isinstance(layers, list):
        raise ValueError(f"[seabed] layers: {layers!r}: must be a list of tables")
    if len(layers) != 1:
        raise ValueError(f"[[seabed.layers]]: {len(layers)} of them; of one half-space variants are written")


def _over(environment: str, bed: Bed, at_floor_mps: float) -> str:
    return _with(
        environment,
        {
            ("seabed.layers", "sound_speed_mps"): f"{bed.speed_ratio * at_floor_mps:.1f}",
            ("seabed.layers", "density_g_per_cm3"): f"{bed.density_g_per_cm3:.3f}",
            ("seabed.layers", "attenuation_db_per_wavelength"): f"{bed.attenuation_db_per_wavelength:.3f}",
        },
    )


def _in(environment: str, water: Water, seabed: dict[str, Any], at_floor_mps: float) -> str:
    """In other water; what the sea floor is made of stays, so its sound speed follows that of the water above it."""
    floor_m: float = seabed["depth_m"]
    speed_ratio = seabed["layers"][0]["sound_speed_mps"] / at_floor_mps
    at_floor_now_mps = waters.profile(water)(floor_m)
    text = _with(environment, {("seabed.layers", "sound_speed_mps"): f"{speed_ratio * at_floor_now_mps:.1f}"})
    lines: list[str] = []
    table = ""
    for line in text.splitlines():
        header = _header(line)
        table = header or table
        if header == "water":
            lines += water_text(water, floor_m).splitlines()
        elif table != "water":
            lines.append(line)
    return "\n".join(lines) + "\n"


def _header(line: str) -> str | None:
    """The table that begins with the line, if one does."""
    text = line.split("#")[0].strip()
    return text.strip("[]").strip() if text.startswith("[") and text.endswith("]") and "=" not in text else None


def _speed_at_floor_mps(keys: dict[str, Any]) -> float:
    """Munk: J. Acoust. Soc. Am. 55 (1974) 220; between two depths of a table linear."""
    water, floor_m = keys["water"], keys["seabed"]["depth_m"]
    if water["profile"] == "munk":
        eta = 2 * (floor_m - water["axis_depth_m"]) / water["scale_m"]
        # At an eta of -700 no sea is meant, and exp would overflow.
        return float(water["axis_sound_speed_mps"] * (1 + water["perturbation"] * (eta + math.exp(min(-eta, 700)) - 1)))
    depths, speeds = water["depth_m"], water["sound_speed_mps"]
    for upper in range(len(depths) - 1):
        if depths[upper] <= floor_m <= depths[upper + 1]:
            part = (floor_m - depths[upper]) / (depths[upper + 1] - depths[upper])
            return float(speeds[upper] + part * (speeds[upper + 1] - speeds[upper]))
    return float(speeds[-1])


def _with(environment: str, values: dict[tuple[str, str], str]) -> str:
    """The text with other values of these keys, by table and key; nothing else of it changes."""
    lines, table, left = [], "", dict(values)
    for line in environment.splitlines():
        text = line.strip()
        table = _header(line) or table
        value = left.pop((table, text.split("=")[0].strip()), None) if "=" in text else None
        lines.append(line if value is None else f"{text.split('=')[0].strip()} = {value}")
    if left:
        table, key = next(iter(left))
        raise ValueError(f"[{table}] {key}: not on a line of its own")
    return "\n".join(lines) + "\n"
