"""What oceans are made of, and the tables of an environment file that it becomes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from earshot.arguments import axis, is_labelled, number, rank
from earshot.errors import BadInput, BadType

__all__ = [
    "Bathymetry",
    "Layer",
    "Munk",
    "Profile",
    "SeaWater",
    "Sediment",
    "absorption_table",
    "sea_floor_tables",
    "seabed_layers",
    "water_table",
]

_MOST_NUMBERS = 1_000_000  # of an argument: some 40 MB of text


@dataclass(frozen=True)
class Munk:
    """Munk's sound-speed profile, c(z) = c1 [1 + eps (eta + exp(-eta) - 1)] with eta = 2 (z - z1) / B.

    axis_sound_speed  c1, m/s;  axis_depth  z1, m, positive down;  scale  B, m;  perturbation  eps
    """

    axis_sound_speed: float = 1500.0
    axis_depth: float = 1300.0
    scale: float = 1300.0
    perturbation: float = 0.00737


@dataclass(frozen=True)
class Layer:
    """A fluid sediment, linear in depth from its top to its base; where nothing is given for the base, as at the top.

    sound_speed, sound_speed_at_base  m/s, 100 to 10 000
    density, density_at_base          g/cm3, 0.5 to 20; the water's is 1
    attenuation, attenuation_at_base  dB per wavelength, 0 to 20
    thickness                         m; None for the last layer, which is a half-space
    """

    sound_speed: float
    density: float = 1.5
    attenuation: float = 0.5
    thickness: float | None = None
    sound_speed_at_base: float | None = None
    density_at_base: float | None = None
    attenuation_at_base: float | None = None


@dataclass(frozen=True)
class SeaWater:
    """Water that absorbs sound: temperature in degC, salinity in psu, depth in m, acidity as pH (NBS scale)."""

    temperature: float
    salinity: float
    depth: float
    acidity: float = 8.0


_LAYER_KEYS = {
    "sound_speed": "sound_speed_mps",
    "density": "density_g_per_cm3",
    "attenuation": "attenuation_db_per_wavelength",
    "thickness": "thickness_m",
    "sound_speed_at_base": "sound_speed_at_base_mps",
    "density_at_base": "density_at_base_g_per_cm3",
    "attenuation_at_base": "attenuation_at_base_db_per_wavelength",
}

Profile = Union[float, Munk, tuple[Any, ...], Any]
Bathymetry = Union[float, tuple[Any, Any], Any]
Sediment = Union[Layer, Sequence[Layer], Mapping[float, Sequence[Layer]], Any]


def _require_few(name: str, numbers: int) -> None:
    if numbers > _MOST_NUMBERS:
        raise BadInput(f"{name}: holds {numbers} numbers, may hold {_MOST_NUMBERS}", key=name, value=numbers)


def _array(numbers: NDArray[np.float64]) -> str:
    return "[" + ", ".join(map(repr, numbers.tolist())) + "]"


def _labelled(name: str, value: Any, dimensions: tuple[str, ...]) -> tuple[NDArray[np.float64], ...]:
    """Coordinates and values of a DataArray with these dimensions, in whatever order it has them."""
    if sorted(map(str, value.dims)) != sorted(dimensions):
        raise BadType(f"{name}: must have the dimensions {dimensions}, has {tuple(value.dims)}", key=name, value=value)
    for dimension in dimensions:
        if dimension not in value.coords:
            raise BadInput(f"{name}: must have the coordinate {dimension}", key=name, value=value)
    ordered = value.transpose(*dimensions)
    axes = [axis(f"{name}.{dimension}", ordered.coords[dimension].values) for dimension in dimensions]
    return (*axes, axis(name, ordered.values, len(dimensions)))


def _parts(name: str, value: Any, allowed: tuple[int, ...]) -> tuple[Any, ...]:
    if not isinstance(value, (tuple, list)) or len(value) not in allowed:
        raise BadType(
            f"{name}: must be one of the forms that its docstring lists, not {value!r:.80}", key=name, value=value
        )
    return tuple(value)


def _as_long(name: str, what: str, wanted: int, given: int) -> None:
    if wanted != given:
        raise BadInput(f"{name}: {given} numbers for {wanted} {what}", key=name, value=given)


def _table(depth: NDArray[np.float64], speed: NDArray[np.float64]) -> str:
    return f"depth_m = {_array(depth)}\nsound_speed_mps = {_array(speed)}\n"


def water_table(sound_speed: Profile) -> str:
    """What stands in the table [water]."""
    name = "sound_speed"
    if isinstance(sound_speed, Munk):
        numbers = {f.name: number(f"{name}.{f.name}", getattr(sound_speed, f.name)) for f in fields(Munk)}
        return (
            f'profile = "munk"\naxis_sound_speed_mps = {numbers["axis_sound_speed"]!r}\n'
            f"axis_depth_m = {numbers['axis_depth']!r}\nscale_m = {numbers['scale']!r}\n"
            f"perturbation = {numbers['perturbation']!r}\n"
        )
    labelled: Any = sound_speed
    parts: tuple[NDArray[np.float64], ...]
    if is_labelled(labelled):
        dimensions = ("range", "depth") if "range" in labelled.dims else ("depth",)
        parts = _labelled(name, labelled, dimensions)
    elif not isinstance(sound_speed, (tuple, list)) and rank(name, sound_speed) == 0:
        parts = (np.array([0.0, 12_000.0]), np.full(2, number(name, sound_speed)))
    else:
        given = _parts(name, sound_speed, (2, 3))
        axes = [axis(f"{name}[{i}]", part) for i, part in enumerate(given[:-1])]
        parts = (*axes, axis(f"{name}[{len(axes)}]", given[-1], len(axes)))
    _require_few(name, parts[-1].size)
    if len(parts) == 2:
        depth, speed = parts
        _as_long(name, "depths", depth.size, speed.size)
        return 'profile = "table"\n' + _table(depth, speed)
    ranges, depth, speed = parts
    if speed.shape != (ranges.size, depth.size):
        raise BadInput(
            f"{name}: must have the shape [n_range x n_depth], {(ranges.size, depth.size)}, has {speed.shape}",
            key=name,
            value=speed.shape,
        )
    stations = (
        f"[[water.stations]]\nrange_m = {at!r}\n" + _table(depth, row) for at, row in zip(ranges.tolist(), speed)
    )
    return 'profile = "table"\n' + "".join(stations)


def sea_floor_tables(bathymetry: Bathymetry) -> tuple[str, str]:
    """What stands of it in the table [seabed], and the table [bathymetry]."""
    name = "bathymetry"
    if is_labelled(bathymetry):
        ranges, depth = _labelled(name, bathymetry, ("range",))
    elif isinstance(bathymetry, (tuple, list)):
        ranges, depth = (axis(f"{name}[{i}]", part) for i, part in enumerate(_parts(name, bathymetry, (2,))))
    else:
        return f"depth_m = {number(name, bathymetry)!r}\n", ""
    _as_long(name, "ranges", ranges.size, depth.size)
    _require_few(name, ranges.size)
    text = f'[bathymetry]\nlayout = "section"\nrange_m = {_array(ranges)}\ndepth_m = {_array(depth)}\n'
    return "", text


def _layers(table: str, layers: Any) -> str:
    given = [layers] if isinstance(layers, Layer) else layers
    if not isinstance(given, (tuple, list)) or not given or not all(isinstance(layer, Layer) for layer in given):
        raise BadType(f"sediment: must be one Layer or more, not {layers!r:.80}", key="sediment", value=layers)
    _require_few("sediment", len(given))
    text = ""
    for i, layer in enumerate(given):
        text += f"[[{table}.layers]]\n"
        for name, key in _LAYER_KEYS.items():
            value = getattr(layer, name)
            if value is not None:
                text += f"{key} = {number(f'sediment[{i}].{name}', value)!r}\n"
    return text


def _layers_of_dataset(dataset: Any) -> list[Layer]:
    """A Dataset with the dimension `layer` whose variables are named as a Layer's fields; NaN: not given."""
    unknown = [str(name) for name in dataset.data_vars if str(name) not in _LAYER_KEYS]
    if unknown or "sound_speed" not in dataset.data_vars:
        raise BadInput(
            f"sediment: must have the variables {tuple(_LAYER_KEYS)}, has {unknown}", key="sediment", value=unknown
        )
    columns = {str(name): axis(f"sediment.{name}", dataset[name].values) for name in dataset.data_vars}
    if np.isnan(columns["sound_speed"]).any():
        raise BadInput("sediment: sound_speed must be known of every layer", key="sediment", value=dataset)
    rows = zip(*columns.values())
    return [Layer(**{k: float(v) for k, v in zip(columns, row) if not np.isnan(v)}) for row in rows]


def seabed_layers(sediment: Sediment) -> str:
    """The layers, or the stations with layers, of the table [seabed]."""
    if isinstance(sediment, Mapping) and not is_labelled(sediment):  # a Dataset is a Mapping, too
        if not sediment:
            raise BadInput("sediment: must hold one range or more", key="sediment", value=sediment)
        _require_few("sediment", len(sediment))
        return "".join(
            f"[[seabed.stations]]\nrange_m = {number('sediment', at)!r}\n" + _layers("seabed.stations", layers)
            for at, layers in sediment.items()
        )
    labelled: Any = sediment
    if is_labelled(labelled):
        if tuple(map(str, labelled.dims)) != ("layer",) or not hasattr(labelled, "data_vars"):
            raise BadType("sediment: must be a Dataset with the one dimension layer", key="sediment", value=sediment)
        return _layers("seabed", _layers_of_dataset(labelled))
    return _layers("seabed", sediment)


def absorption_table(absorption: SeaWater | None) -> str:
    if absorption is None:
        return ""
    if not isinstance(absorption, SeaWater):
        raise BadType("absorption: must be a SeaWater or None", key="absorption", value=absorption)
    value = {f.name: number(f"absorption.{f.name}", getattr(absorption, f.name)) for f in fields(SeaWater)}
    return (
        f"[absorption]\ntemperature_c = {value['temperature']!r}\nsalinity_psu = {value['salinity']!r}\n"
        f"acidity_ph_nbs = {value['acidity']!r}\ndepth_m = {value['depth']!r}\n"
    )
