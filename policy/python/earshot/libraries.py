"""Field libraries: sound around many positions of one region, which `earshot field --library` has computed."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from earshot import arguments
from earshot.arguments import axis, require_callable, whole_number
from earshot.core import read_library
from earshot.variables import describe

if TYPE_CHECKING:
    import xarray

__all__ = ["library"]


def library(
    path: str | os.PathLike[str],
    *,
    positions: Sequence[int] | NDArray[np.integer] | None = None,
    progress: Callable[[float], object] | None = None,
) -> xarray.Dataset:
    """A field library that `earshot field --library` has written, or some positions of it, bit for bit.

    positions  which of them, by number from 0, in any order; None: all. What is read is kept: at most 2 GiB
    progress   called now and then with the share of the positions that are read, 0 to 1

    Returns a Dataset over position, bearing (degrees clockwise from north), range (m), depth (m) and frequency (Hz:
    those whose intensities are averaged) with
      transmission_loss             dB re 1 m, float32, as it was computed; NaN where there is no water
      has_field                     over position: False on land, or where it is too shallow
      position_north, position_east over position, m in the local plane of the environment
      position_depth                m, of what stands at the positions
      source_level, noise_level     dB; SNR = source_level - transmission_loss - noise_level
    The attribute `centre` is "source", or "hydrophone" where that stands at the positions and sources stand around it.

    Raises BadInput with the file, and variable and value as key and value, for what is no finished library;
    KeyboardInterrupt between two positions. Other threads of Python run meanwhile.
    """
    import xarray

    require_callable(progress)
    file = arguments.path("path", path)
    chosen = None
    if positions is not None:
        chosen = [whole_number("positions", position) for position in axis("positions", positions).tolist()]
    given = read_library(Path(os.path.realpath(file)), positions=chosen, progress=progress)
    middle, around = ("hydrophone", "source") if given["is_around_hydrophone"] else ("source", "receiver")
    per_position = {name: (("position",), given[name]) for name in ("position_north", "position_east")}
    axes = {name: ((name,), given[name]) for name in ("position", "bearing", "range", "depth", "frequency")}
    values = {
        "transmission_loss": (("position", "bearing", "range", "depth"), given["transmission_loss"]),
        "has_field": (("position",), given["has_field"].astype(bool)),
        **{name: ((), given[name]) for name in ("source_level", "noise_level")},
    }
    dataset = describe(
        xarray.Dataset(values, {**axes, **per_position, "position_depth": ((), given["position_depth"])}),
        bearing={"long_name": f"bearing from the {middle}, clockwise from grid north"},
        range={"long_name": f"horizontal range from the {middle}"},
        depth={"long_name": f"depth of the {around}"},
        frequency={"long_name": "frequency; intensity is averaged where there are several"},
    )
    dataset.attrs.update(given["attributes"], source="Earshot, one-way parabolic equation", centre=middle)
    return dataset
