"""How loud a source is all around it, and where it is heard."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from earshot import core
from earshot.arguments import Numbers, number, require_callable, whole_number
from earshot.errors import BadInput
from earshot.fields import of_grids, warn_of
from earshot.oceans import Environment
from earshot.questions import Question, question_of
from earshot.variables import describe

if TYPE_CHECKING:
    import xarray

__all__ = ["fan", "horizontal_map"]


def fan(
    environment: Environment,
    *,
    radials: int,
    receiver_depth: Numbers,
    frequency: float | None = None,
    source_depth: float | None = None,
    max_range: float | None = None,
    output_step: float | None = None,
    detection_threshold_db: float = 10.0,
    fluctuation_db: float = 0.0,
    accuracy_db: float = 0.02,
    band: tuple[float, float] | None = None,
    band_parts: int = 16,
    starter: str = "self",
    range_step: float | None = None,
    depth_step: float | None = None,
    terms: int = 0,
    absorber_wavelengths: float | None = None,
    threads: int | None = None,
    progress: Callable[[float], object] | None = None,
) -> xarray.Dataset:
    """Sound all around a source: what `earshot field --radials` computes, bit for bit.

    Each radial is a vertical plane of its own (N x 2D). Where the environment has no charts one march serves them all.

    radials         bearings, 1 to 100 000, evenly spaced, the first north
    receiver_depth  m, increasing, above 0 and down to the deepest sea floor: one, or an array
    frequency       Hz, 1 to 10 000; None: the environment's
    source_depth    m, above the sea floor; None: the environment's
    max_range       m, 1 to 2 000 000; None: as far as the environment states, else 25 000
    output_step     m between ranges; None: a third of the shortest wavelength, or `range_step` if that is given
    detection_threshold_db   SNR needed for detection, -200 to 200
    fluctuation_db  standard deviation of the SNR in dB, 0 to 100; 0: detection is certain or impossible
    accuracy_db, band, band_parts, starter, range_step, depth_step, terms, absorber_wavelengths   as of `earshot.field`
    threads         processors used, 1 to 4096; None: all. The result does not depend on it
    progress        called now and then with the share of the work that is done, 0 to 1

    Returns a Dataset of at most 64 million values over bearing (degrees clockwise from north), range, depth with
      transmission_loss         dB re 1 m, rounded to 1/256 dB as files hold it; NaN where there is no water
      sea_floor_depth           m, over bearing and range; 0 on land
    and where the environment knows source level and noise level
      snr                       dB, of that loss
      detection_probability     P(SNR >= threshold), normal in dB
      assured_detection_range   m, over depth and bearing: heard at every range up to here; 0: not even at the first
      furthest_detection_range  m, over depth and bearing: heard here and nowhere beyond; 0: nowhere
    and in its attributes predicted_error_db (of the worst bearing), depth_step_m, range_step_m and terms, as of
    `earshot.field`, and `land`: how many bearings meet land nearer than the first range. There is no number on them.

    Warns (FieldWarning) as `earshot.field` does. Raises BadInput with the argument as `key`, BadType for what is of
    another kind, KeyboardInterrupt within some tenths of a second. Other threads of Python run meanwhile.

    Source: Urick, Principles of Underwater Sound, 3rd ed., ch. 12 (detection probability).
    """
    import xarray

    return _around(
        environment,
        dict(
            frequency=frequency,
            source_depth=source_depth,
            receiver_depth=receiver_depth,
            max_range=max_range,
            output_step=output_step,
            accuracy_db=accuracy_db,
            band=band,
            band_parts=band_parts,
            starter=starter,
            range_step=range_step,
            depth_step=depth_step,
            terms=terms,
            absorber_wavelengths=absorber_wavelengths,
        ),
        dict(
            radials=radials,
            detection_threshold_db=detection_threshold_db,
            fluctuation_db=fluctuation_db,
            threads=threads,
        ),
        progress,
    ).fan(xarray)


def horizontal_map(
    environment: Environment,
    *,
    radials: int,
    receiver_depth: Numbers,
    side: float | None = None,
    intervals: int = 200,
    frequency: float | None = None,
    source_depth: float | None = None,
    max_range: float | None = None,
    output_step: float | None = None,
    detection_threshold_db: float = 10.0,
    fluctuation_db: float = 0.0,
    accuracy_db: float = 0.02,
    band: tuple[float, float] | None = None,
    band_parts: int = 16,
    starter: str = "self",
    range_step: float | None = None,
    depth_step: float | None = None,
    terms: int = 0,
    absorber_wavelengths: float | None = None,
    threads: int | None = None,
    progress: Callable[[float], object] | None = None,
) -> xarray.Dataset:
    """What is heard on a square around a source: what `earshot field --map` lays on a grid, bit for bit.

    side       m, 1 to 4 000 000, of the square, centred on the source; None: the largest within `max_range`
    intervals  grid steps along a side, 1 to 10 000
    All other arguments are those of `earshot.fan`, which is computed; the map is linear in dB along range, then between
    bearings. The source is the map's centre. The environment must know source level and noise level.

    Returns a Dataset over depth, north, east (the first only where an array of receiver depths was given) with
      snr                    dB; NaN on land, below the sea floor and beyond the fan
      detection_probability  P(SNR >= threshold), normal in dB
    north and east in m, in the local plane of the environment.

    Warns and raises as `earshot.fan` does.
    """
    import xarray

    for name in ("source_level", "noise_level"):
        if isinstance(environment, Environment) and getattr(environment, name) is None:
            raise BadInput(f"{name}: must be given, for the environment does not state it", key=name)
    return _around(
        environment,
        dict(
            frequency=frequency,
            source_depth=source_depth,
            receiver_depth=receiver_depth,
            max_range=max_range,
            output_step=output_step,
            accuracy_db=accuracy_db,
            band=band,
            band_parts=band_parts,
            starter=starter,
            range_step=range_step,
            depth_step=depth_step,
            terms=terms,
            absorber_wavelengths=absorber_wavelengths,
        ),
        dict(
            radials=radials,
            detection_threshold_db=detection_threshold_db,
            fluctuation_db=fluctuation_db,
            threads=threads,
            side=side,
            intervals=intervals,
        ),
        progress,
    ).map(xarray, is_one_depth=np.ndim(receiver_depth) == 0)


class _Around:
    """What C++ gives of a fan, and what it was asked."""

    def __init__(self, environment: Environment, question: Question, given: dict[str, Any], around: dict[str, Any]):
        self._environment = environment
        self._question = question
        self._given = given
        self._around = around

    def fan(self, xarray: Any) -> Any:
        given = self._given
        values = {
            "transmission_loss": (("bearing", "range", "depth"), given["transmission_loss"]),
            "sea_floor_depth": (("bearing", "range"), given["sea_floor_depth"]),
        }
        if "detection_probability" in given:
            levels = self._environment.source_level, self._environment.noise_level
            values["snr"] = (("bearing", "range", "depth"), _snr(given["transmission_loss"], *levels))
            values["detection_probability"] = (("bearing", "range", "depth"), given["detection_probability"])
            for name in ("assured_detection_range", "furthest_detection_range"):
                values[name] = (("depth", "bearing"), given[name])
        axes = {name: ((name,), given[name]) for name in ("bearing", "range", "depth")}
        dataset = describe(xarray.Dataset(values, {**self._source(), **axes}))
        dataset.attrs.update(self._attributes("Sound around one source"))
        return dataset

    def map(self, xarray: Any, *, is_one_depth: bool) -> Any:
        given = self._given
        values = {
            "snr": (("depth", "north", "east"), given["map_snr"]),
            "detection_probability": (("depth", "north", "east"), given["map_detection_probability"]),
        }
        axes = {name: ((name,), given[name]) for name in ("depth", "north", "east")}
        dataset = describe(xarray.Dataset(values, {**self._source(), **axes}))
        dataset.attrs.update(self._attributes("Sound around one source"))
        return dataset.isel(depth=0) if is_one_depth else dataset

    def _source(self) -> dict[str, Any]:
        source = {"source_depth": ((), self._question.source_depths)}
        return source if self._question.band else {"frequency": ((), self._question.frequencies), **source}

    def _attributes(self, title: str) -> dict[str, Any]:
        attributes = self._environment._provenance(title)
        if self._question.band is not None:
            attributes["band_hz"] = list(self._question.band)
        if "detection_probability" in self._given:
            for name in ("detection_threshold_db", "fluctuation_db"):
                attributes[name] = self._around[name]
        attributes.update(of_grids([] if self._given["grid"] is None else [self._given["grid"]]))
        for name in ("land", "unmeasured_water"):
            if self._given[name] is not None:
                attributes[name] = self._given[name]
        return attributes


def _snr(loss_db: Any, source_level: Any, noise_level: Any) -> Any:
    return (source_level - loss_db.astype(np.float64) - noise_level).astype(np.float32)


def _one(name: str, value: Any) -> float | None:
    return None if value is None else number(name, value)


def _around(environment: Any, asked: dict[str, Any], around: dict[str, Any], progress: Any) -> _Around:
    require_callable(progress)
    for name in ("frequency", "source_depth"):
        asked[name] = _one(name, asked[name])
    if asked["receiver_depth"] is None:
        raise BadInput("receiver_depth: must be given", key="receiver_depth")
    question = question_of(environment, depth_spacing=None, **asked)
    depths = question.source_depths
    if np.ndim(depths) > 0:
        raise BadInput(
            f"source_depth: must be one of the {depths.size} that {environment.name} has, "
            f"from {depths[0]:g} to {depths[-1]:g} m",
            key="source_depth",
        )
    knows_levels = environment.source_level is not None and environment.noise_level is not None
    settings: dict[str, Any] = {
        "radials": whole_number("radials", around["radials"]),
        "threads": 0 if around["threads"] is None else _threads(around["threads"]),
        "detection_threshold_db": number("detection_threshold_db", around["detection_threshold_db"]),
        "fluctuation_db": number("fluctuation_db", around["fluctuation_db"]),
    }
    given = core.fan(
        environment._ocean,
        question.of(*question.sources()[0]),
        detection=knows_levels,
        map="side" in around,
        side=_one("side", around.get("side")),
        intervals=whole_number("intervals", around.get("intervals", 1)),
        progress=progress,
        **settings,
    )
    warn_of([given["doubt"]], stacklevel=3)
    return _Around(environment, question, given, settings)


def _threads(value: Any) -> int:
    threads = whole_number("threads", value)
    if threads == 0:
        raise BadInput("threads = 0: must be 1 or more", key="threads", value=value)
    return threads
