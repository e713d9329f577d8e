"""How loud a source is at every range and depth."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from earshot.arguments import Numbers, number, require_callable, truth_value
from earshot.core import radial
from earshot.oceans import Environment
from earshot.questions import Question, question_of
from earshot.variables import describe

if TYPE_CHECKING:
    import xarray

__all__ = ["FieldWarning", "field", "of_grids", "warn_of"]

_WATER_MPS = 1500.0  # by which a wavelength is reckoned where none is computed


class FieldWarning(UserWarning):
    """The field is not as sure as it was asked to be."""


def field(
    environment: Environment,
    *,
    frequency: Numbers | None = None,
    source_depth: Numbers | None = None,
    receiver_depth: Numbers | None = None,
    max_range: float | None = None,
    bearing: float = 0.0,
    depth_spacing: float | None = None,
    output_step: float | None = None,
    accuracy_db: float = 0.02,
    band: tuple[float, float] | None = None,
    band_parts: int = 16,
    starter: str = "self",
    range_step: float | None = None,
    depth_step: float | None = None,
    terms: int = 0,
    absorber_wavelengths: float | None = None,
    pressure: bool = True,
    progress: Callable[[float], object] | None = None,
) -> xarray.Dataset:
    """Sound of a source along one bearing, by the parabolic equation: what `earshot field` computes, bit for bit.

    frequency       Hz, 1 to 10 000: one, or an array; None: the environment's
    source_depth    m, above the sea floor: one, or an array; None: the environment's
    receiver_depth  m, increasing, above 0 and down to the sea floor; None: those in the water of an environment that
                    states receivers, else every `depth_spacing` down to the sea floor
    max_range       m, 1 to 2 000 000; None: as far as the environment states, else 25 000
    bearing         degrees clockwise from north; matters where the environment has charts
    depth_spacing   m; None: 10 m, in water of less than 1000 m a hundredth of it or less
    output_step     m between ranges; None: the longest that the ranges are multiples of which the environment states,
                    else a sixth of the shortest wavelength, or `range_step` if that is given
    accuracy_db     of transmission loss, mean over ranges, 0.0001 to 10; chooses the solver's grid
    band            (low, high), Hz: the mean intensity of `band_parts` equal parts of the band; without pressure
    starter         "self": a point source; "gaussian": a beam, weaker where it is steep
    range_step, depth_step, terms, absorber_wavelengths   the solver's grid, instead of the automatic one
    pressure        whether the complex pressure is kept: 16 bytes a value
    progress        called now and then with the share of the work that is done, 0 to 1

    Returns a Dataset over frequency, source_depth, range, depth (the first two only where an array was given) with
      transmission_loss  dB re 1 m, rounded to 1/256 dB as files hold it; NaN where there is no water
      snr                dB; where the environment knows source level and noise level
      pressure           complex128, of a source of unit pressure at 1 m; p exp(i k0 r) with `reference_wavenumber` k0
      sea_floor_depth    m, over range
    and in its attributes predicted_error_db (the largest; NaN where you chose the grid), and depth_step_m, range_step_m
    and terms of the solver (the finest). Where an .env or ram.in file states receivers that no argument replaces, the
    attributes receiver_depth_m and receiver_range_m hold them, for `earshot.write_shd` and `earshot.write_tl_grid`.

    Warns (FieldWarning) where the predicted error is ten times `accuracy_db`, and 1 dB more; refuses more than 10 dB.
    Raises BadInput with the argument as `key`, BadType for what is of another kind, KeyboardInterrupt within some
    tenths of a second. Other threads of Python run meanwhile.
    """
    import xarray

    require_callable(progress)
    question = question_of(
        environment,
        frequency=frequency,
        source_depth=source_depth,
        receiver_depth=receiver_depth,
        max_range=max_range,
        depth_spacing=depth_spacing,
        output_step=output_step,
        accuracy_db=accuracy_db,
        band=band,
        band_parts=band_parts,
        starter=starter,
        range_step=range_step,
        depth_step=depth_step,
        terms=terms,
        absorber_wavelengths=absorber_wavelengths,
    )
    settings, frequencies = question.settings, question.frequencies
    if receiver_depth is None and depth_spacing is None:
        settings["file_depth"] = environment._receiver_depths()
    if max_range is None and output_step is None and range_step is None:
        settings["file_range"] = environment._receiver_ranges()
    if output_step is None and range_step is None and np.ndim(frequencies) > 0 and np.all(frequencies > 0.0):
        settings["output_step"] = _WATER_MPS / 6.0 / float(np.max(frequencies))  # one axis of range for all
    are_levels_known = environment.source_level is not None and environment.noise_level is not None
    is_pressure_kept = truth_value("pressure", pressure)
    at = number("bearing", bearing)
    sources = question.sources()

    def march(i: int) -> dict[str, Any]:
        report = None if progress is None else lambda share: progress((i + share) / len(sources))
        return radial(
            environment._ocean,
            question.of(*sources[i]),
            bearing=at,
            pressure=is_pressure_kept,
            snr=are_levels_known,
            progress=report,
        )

    fields = [march(i) for i in range(len(sources))]
    warn_of((f["doubt"] for f in fields), stacklevel=2)
    return _dataset(xarray, environment, question, fields)


def warn_of(doubts: Iterable[str | None], stacklevel: int) -> None:
    """Once of each; `stacklevel` as of warnings.warn, 1 being who calls this."""
    for doubt in dict.fromkeys(doubt for doubt in doubts if doubt is not None):
        warnings.warn(f"{doubt}: smooth it, or choose range_step", FieldWarning, stacklevel=stacklevel + 1)


def of_grids(grids: Sequence[Any]) -> dict[str, float]:
    """Attributes that say on what grids it was marched."""
    if not grids:
        return {}
    depth_steps, range_steps, terms, errors, _ = zip(*grids)
    return {
        "predicted_error_db": float(np.max(errors)),
        "depth_step_m": float(np.min(depth_steps)),
        "range_step_m": float(np.min(range_steps)),
        "terms": int(np.max(terms)),
    }


def _dataset(xarray: Any, environment: Environment, question: Question, fields: Any) -> Any:
    frequencies, source_depths, band = question.frequencies, question.source_depths, question.band
    outer = [(n, a) for n, a in (("frequency", frequencies), ("source_depth", source_depths)) if np.ndim(a) > 0]
    shape = tuple(a.size for _, a in outer)
    dims = tuple(n for n, _ in outer)

    def stacked(name: str) -> Any:
        first = fields[0][name]
        return np.stack([f[name] for f in fields]).reshape(shape + first.shape) if shape else first

    values = {"transmission_loss": ((*dims, "range", "depth"), stacked("transmission_loss"))}
    if fields[0]["snr"] is not None:
        values["snr"] = ((*dims, "range", "depth"), stacked("snr"))
    if fields[0]["pressure"] is not None:
        values["pressure"] = ((*dims, "range", "depth"), stacked("pressure"))
    values["sea_floor_depth"] = (("range",), fields[0]["sea_floor_depth"])
    grids = [f["grid"] for f in fields if f["grid"] is not None]
    if grids and band is None:
        wavenumbers = [f["grid"][4] if f["grid"] else np.nan for f in fields]
        values["reference_wavenumber"] = (dims, np.array(wavenumbers).reshape(shape))
    coordinates = {
        "frequency": (("frequency",) if np.ndim(frequencies) else (), frequencies),
        "source_depth": (("source_depth",) if np.ndim(source_depths) else (), source_depths),
        "range": (("range",), fields[0]["range"]),
        "depth": (("depth",), fields[0]["depth"]),
    }
    if band is not None:
        del coordinates["frequency"]
    dataset = describe(xarray.Dataset(values, coordinates))
    dataset.attrs.update(environment._provenance("Sound field of one source"))
    if band is not None:
        dataset.attrs["band_hz"] = list(band)
    for name in ("depth", "range"):
        if question.settings[f"file_{name}"]:
            dataset.attrs[f"receiver_{name}_m"] = question.settings[f"file_{name}"]
    dataset.attrs.update(of_grids(grids))
    unmeasured = next((f["unmeasured_water"] for f in fields if f["unmeasured_water"] is not None), None)
    if unmeasured is not None:
        dataset.attrs["unmeasured_water"] = unmeasured
    return dataset
