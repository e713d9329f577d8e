"""Units and meanings of what Datasets hold: those of the files of `earshot field`."""

from __future__ import annotations

from typing import Any

from earshot.core import LEVEL_ATTRIBUTES

__all__ = ["describe"]

_ATTRIBUTES = {
    **LEVEL_ATTRIBUTES,
    "range": {"long_name": "horizontal range from the source", "units": "m"},
    "depth": {"long_name": "depth of the receiver", "units": "m", "standard_name": "depth", "positive": "down"},
    "frequency": {"long_name": "frequency of the source", "units": "Hz"},
    "source_depth": {"long_name": "depth of the source", "units": "m", "positive": "down"},
    "bearing": {"long_name": "bearing from the source, clockwise from grid north", "units": "degree"},
    "north": {"long_name": "northing in the local plane", "standard_name": "projection_y_coordinate", "units": "m"},
    "east": {"long_name": "easting in the local plane", "standard_name": "projection_x_coordinate", "units": "m"},
    "pressure": {
        "long_name": "complex pressure of a source of unit pressure at 1 m, without the factor exp(i k0 r)",
        "units": "1",
    },
    "reference_wavenumber": {"long_name": "k0 of the factor that the pressure lacks", "units": "m-1"},
    "sea_floor_depth": {
        "long_name": "depth of the sea floor, 0 on land",
        "standard_name": "sea_floor_depth_below_sea_surface",
        "units": "m",
    },
    "detection_probability": {"long_name": "probability of detection", "units": "1"},
    "assured_detection_range": {
        "long_name": "range up to which the signal-to-noise ratio is never below the threshold",
        "units": "m",
    },
    "furthest_detection_range": {
        "long_name": "greatest range at which the signal-to-noise ratio is at the threshold or above",
        "comment": "equal to the last range in the water where it is still heard there",
        "units": "m",
    },
    "position": {"long_name": "number of the position in the library", "units": "1"},
    "position_north": {"long_name": "northing of what stands at the position", "units": "m"},
    "position_east": {"long_name": "easting of what stands at the position", "units": "m"},
    "position_depth": {"long_name": "depth of what stands at the positions", "units": "m", "positive": "down"},
    "has_field": {"long_name": "whether the position is in the water, and has a field", "units": "1"},
}


def describe(dataset: Any, **changed: dict[str, str]) -> Any:
    """Gives all variables of a Dataset their units and meanings. `changed` gives some of them others."""
    for name, variable in dataset.variables.items():
        variable.attrs.update({**_ATTRIBUTES[str(name)], **changed.get(str(name), {})})
    return dataset
