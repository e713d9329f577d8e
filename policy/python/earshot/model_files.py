"""Sound as the files of other propagation models: shade files of the Acoustics Toolbox, tl.grid of RAM."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earshot import arguments, core
from earshot.arguments import Numbers, axis, is_labelled, one_or_more
from earshot.errors import BadInput, BadType

__all__ = ["write_shd", "write_tl_grid"]

_SAME_RANGE_M = 1e-3
_LAYOUTS = ("double", "single")

# Kinds of number and dimensions of what `earshot.field` gives of one source.
_VARIABLES: dict[str, tuple[str, tuple[str, ...]]] = {
    "transmission_loss": ("f", ("range", "depth")),
    "range": ("iuf", ("range",)),
    "depth": ("iuf", ("depth",)),
    "sea_floor_depth": ("iuf", ("range",)),
    "source_depth": ("iuf", ()),
    "pressure": ("c", ("range", "depth")),
    "frequency": ("iuf", ()),
    "reference_wavenumber": ("iuf", ()),
}
_NEEDED = ("transmission_loss", "range", "depth", "sea_floor_depth", "source_depth")


def write_shd(
    sound: Any,
    path: str | os.PathLike[str],
    *,
    layout: str = "double",
    receiver_depth: Numbers | None = None,
    receiver_range: Numbers | None = None,
    force: bool = False,
) -> None:
    """Writes the complex pressure of `earshot.field` as a shade file (.shd), whole or not at all.

    sound    a Dataset of `earshot.field` with pressure, of one frequency and one source depth: choose with `sel`
    layout   "double": ranges, bearing and source in double precision, as the Acoustics Toolbox of 2023 and 2024 has
             them; "single": in single precision, as older ones and arlpy have them
    receiver_depth, receiver_range   m, increasing, from 0 on: where the file is to hold numbers. None: where the .env
             or ram.in file asks for them that the environment was read from, else those of the Dataset. At the surface
             the pressure is 0; NaN stands below the sea floor, on land and at range 0. Between two ranges of the
             Dataset the pressure without its phase and spreading is linear
    force    replace a file that is there already, of whatever kind it is; otherwise only one of Earshot's is replaced

    The bytes are those of `earshot field -o NAME.shd`. The phase is that of the Acoustics Toolbox, -exp(-i k r) / r.

    Raises BadInput with the argument as `key`, or naming the file; BadType for what is of another kind.
    Source: the files that the Acoustics Toolbox writes, and its readers.
    """
    if not isinstance(layout, str) or layout not in _LAYOUTS:
        raise BadInput(f'layout = {layout!r}: must be "double" or "single"', key="layout", value=layout)
    arrays = _arrays(sound, receiver_depth, receiver_range)
    if arrays["pressure"] is None or "frequency" not in sound.coords:
        raise BadInput("sound: must hold the pressure of one frequency, not of a band or without", key="sound")
    core.write_shade(
        arguments.path("path", path),
        **arrays,
        reference_wavenumber=float(sound["reference_wavenumber"]) if "reference_wavenumber" in sound else np.nan,
        title=str(sound.attrs.get("environment", "")),
        frequency=float(sound["frequency"]),
        source_depth=float(sound["source_depth"]),
        single_precision=layout == "single",
        force=arguments.truth_value("force", force),
    )


def write_tl_grid(
    sound: Any,
    path: str | os.PathLike[str],
    *,
    receiver_depth: Numbers | None = None,
    receiver_range: Numbers | None = None,
    force: bool = False,
) -> None:
    """Writes the transmission loss of `earshot.field`, in dB, as the tl.grid file of RAM 1.5, whole or not at all.

    sound    a Dataset of `earshot.field`, of one frequency or band and one source depth: choose with `sel`
    receiver_depth, receiver_range, force   as of `earshot.write_shd`. The file holds neither depths nor ranges

    The bytes are those of `earshot field -o NAME.grid`; without pressure the loss is that of the Dataset, rounded to
    1/256 dB. At the surface it is 300 dB.

    Raises as `earshot.write_shd` does.
    Source: Collins, User's Guide for RAM Versions 1.0 and 1.0p, Naval Research Laboratory.
    """
    core.write_tl_grid(
        arguments.path("path", path),
        **_arrays(sound, receiver_depth, receiver_range),
        force=arguments.truth_value("force", force),
    )


def _arrays(sound: Any, receiver_depth: Any, receiver_range: Any) -> dict[str, Any]:
    """What C++ takes of a Dataset with one source."""
    if not is_labelled(sound) or not hasattr(sound, "data_vars") or "transmission_loss" not in sound:
        raise BadType("sound: must be a Dataset of earshot.field", key="sound", value=sound)
    dims = tuple(map(str, sound["transmission_loss"].dims))
    if sorted(dims) != ["depth", "range"]:
        raise BadInput(
            f"sound: must have the dimensions range and depth alone, has {dims}; choose one source with sel",
            key="sound",
        )
    ordered = sound.transpose("range", "depth")
    for name, (kinds, its_dims) in _VARIABLES.items():
        if name not in _NEEDED and name not in ordered:
            continue
        if name not in ordered or ordered[name].dtype.kind not in kinds or ordered[name].dims != its_dims:
            raise BadInput(f"sound: must hold numbers of {name}, as earshot.field gives them", key="sound")
    for name in ("range", "depth"):
        values = ordered[name].values
        if not (np.all(np.isfinite(values)) and np.all(np.diff(values) > 0.0) and np.all(values >= 0.0)):
            raise BadInput(f"sound: its {name} must increase, from 0 m on", key="sound")
    for name, unit in (("frequency", "Hz"), ("source_depth", "m")):
        if name in ordered and not 0.0 < float(ordered[name]) < np.inf:
            raise BadInput(f"sound: its {name} must be above 0 {unit}", key="sound")
    if "frequency" not in ordered.coords and "band_hz" not in ordered.attrs:
        raise BadInput("sound: must state its frequency, or the attribute band_hz", key="sound")
    if "band_hz" in ordered.attrs:
        band: NDArray[np.float64] = axis("sound", ordered.attrs["band_hz"])
        if band.size != 2 or not np.all((band > 0.0) & np.isfinite(band)):
            raise BadInput("sound: its attribute band_hz must be two frequencies above 0 Hz", key="sound")
    arrays: dict[str, Any] = {
        "range": ordered["range"].values.tolist(),
        "depth": ordered["depth"].values.tolist(),
        "sea_floor_depth": np.ascontiguousarray(ordered["sea_floor_depth"].values, np.float32),
        "transmission_loss": np.ascontiguousarray(ordered["transmission_loss"].values, np.float32),
        "pressure": None,
    }
    if "pressure" in ordered:
        arrays["pressure"] = np.ascontiguousarray(ordered["pressure"].values, np.complex128)
    for name, value in (("receiver_depth", receiver_depth), ("receiver_range", receiver_range)):
        stated = sound.attrs.get(f"{name}_m") if value is None else value
        arrays[name] = [] if stated is None else _receivers(name, stated)
    _require_covered(arrays, None if receiver_range is not None else _finest_step(sound))
    return arrays


def _finest_step(sound: Any) -> float:
    """m, of a field whose ranges are no multiples of a step: a twelfth of the shortest wavelength in slow water."""
    highest = sound.attrs["band_hz"][1] if "band_hz" in sound.attrs else float(sound["frequency"])
    return 1500.0 / 12.0 / float(highest)


def _receivers(name: str, values: Any) -> list[float]:
    found: NDArray[np.float64] = np.atleast_1d(one_or_more(name, values))
    if not (np.all(np.isfinite(found)) and found[0] >= 0.0 and np.all(np.diff(found) > 0.0)):
        raise BadInput(f"{name}: must increase, from 0 m on", key=name, value=values)
    if name == "receiver_range" and not found[-1] > 0.0:
        raise BadInput(f"{name}: must extend further than 0 m", key=name, value=values)
    return list(map(float, found))


def _require_covered(arrays: dict[str, Any], finest_step: float | None) -> None:
    """No number that was computed may be missing, or be between two that were left out.

    finest_step  m, at which ranges may lie between those computed; None: they may anywhere
    """
    ranges, depths = np.array(arrays["range"]), np.array(arrays["depth"])
    if ranges.size == 0 or depths.size == 0:
        raise BadInput("sound: must hold one range and one depth at least", key="sound")
    if arrays["receiver_range"]:
        steps = ranges / ranges[0] - np.arange(1, ranges.size + 1)
        asked = np.array(arrays["receiver_range"])
        beside = np.abs(np.remainder(asked + _SAME_RANGE_M, ranges[0])) > 2.0 * _SAME_RANGE_M
        is_coarse = finest_step is not None and ranges[0] > finest_step * (1.0 + 1e-9) and bool(np.any(beside))
        if np.any(np.abs(steps) > 1e-6) or asked[-1] > ranges[-1] + _SAME_RANGE_M or is_coarse:
            raise BadInput(
                f"receiver_range = {asked[-1]:g}: sound must hold all ranges up to there, as they were computed",
                key="receiver_range",
                value=float(asked[-1]),
            )
    floor = float(np.max(arrays["sea_floor_depth"]))
    for depth in arrays["receiver_depth"]:
        if 0.0 < depth <= floor and depth not in depths:
            raise BadInput(
                f"receiver_depth = {depth:g}: must be among the depths of sound", key="receiver_depth", value=depth
            )
