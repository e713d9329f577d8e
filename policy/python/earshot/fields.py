"""How loud a source is at every range and depth."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from earshot.arguments import Numbers, axis, number, whole_number
from earshot.core import SNR_ATTRIBUTES, TRANSMISSION_LOSS_ATTRIBUTES, radial
from earshot.errors import BadInput, BadType
from earshot.oceans import Environment

if TYPE_CHECKING:
    import xarray

__all__ = ["field"]

_WATER_MPS = 1500.0  # by which a wavelength is reckoned where none is computed

_ATTRIBUTES = {
    "range": {"long_name": "horizontal range from the source", "units": "m"},
    "depth": {"long_name": "depth of the receiver", "units": "m", "standard_name": "depth", "positive": "down"},
    "frequency": {"long_name": "frequency of the source", "units": "Hz"},
    "source_depth": {"long_name": "depth of the source", "units": "m", "positive": "down"},
    "transmission_loss": TRANSMISSION_LOSS_ATTRIBUTES,
    "snr": SNR_ATTRIBUTES,
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
}


def _asked(name: str, value: Any, known: float | None) -> Any:
    """[n], or [] of one number; what the environment knows where nothing is asked."""
    if value is None and known is None:
        raise BadInput(f"{name}: must be given, for the environment does not state it", key=name)
    given = known if value is None else value
    return np.float64(number(name, given)) if np.ndim(given) == 0 else axis(name, given)


def _optional(name: str, value: float | None) -> float | None:
    return None if value is None else number(name, value)


def field(
    environment: Environment,
    *,
    frequency: Numbers | None = None,
    source_depth: Numbers | None = None,
    receiver_depth: Numbers | None = None,
    max_range: float = 25_000.0,
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
    receiver_depth  m, increasing, above 0 and down to the sea floor; None: every `depth_spacing` down to it
    max_range       m, 1 to 2 000 000
    bearing         degrees clockwise from north; matters where the environment has charts
    depth_spacing   m; None: 10 m, in water of less than 1000 m a hundredth of it or less
    output_step     m between ranges; None: a sixth of the shortest wavelength, or `range_step` if that is given
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
    and terms of the solver (the finest).

    Raises BadInput with the argument as `key`, BadType for what is of another kind, KeyboardInterrupt within some
    tenths of a second. Other threads of Python run meanwhile.
    """
    import xarray

    if not isinstance(environment, Environment):
        raise BadType("environment: must be an earshot.Environment", key="environment", value=environment)
    if progress is not None and not callable(progress):
        raise BadType("progress: must be callable, or None", key="progress", value=progress)
    if not isinstance(starter, str):
        raise BadType("starter: must be a text", key="starter", value=starter)
    frequencies = _asked("frequency", frequency, environment.frequency)
    source_depths = _asked("source_depth", source_depth, environment.source_depth)
    edges = None
    if band is not None:
        if frequency is not None and np.ndim(frequency) > 0:
            raise BadInput("band: not with several frequencies", key="band", value=band)
        low_high = axis("band", band)
        if low_high.size != 2:
            raise BadInput("band: must be the low and the high frequency", key="band", value=band)
        edges = (float(low_high[0]), float(low_high[1]))
    step = _optional("output_step", output_step)
    march_step = _optional("range_step", range_step)
    if step is None and march_step is None and np.ndim(frequencies) > 0 and np.all(frequencies > 0.0):
        step = _WATER_MPS / 6.0 / float(np.max(frequencies))  # one axis of range for all
    shared = {
        "bearing": number("bearing", bearing),
        "max_range": number("max_range", max_range),
        "receiver_depth": []
        if receiver_depth is None
        else np.atleast_1d(_asked("receiver_depth", receiver_depth, None)).tolist(),
        "depth_spacing": _optional("depth_spacing", depth_spacing),
        "output_step": step,
        "accuracy_db": number("accuracy_db", accuracy_db),
        "band": edges,
        "band_parts": whole_number("band_parts", band_parts),
        "starter": starter,
        "range_step": march_step,
        "depth_step": _optional("depth_step", depth_step),
        "terms": whole_number("terms", terms),
        "absorber_wavelengths": _optional("absorber_wavelengths", absorber_wavelengths),
        "pressure": bool(pressure),
    }
    of_sources = [(f, d) for f in np.atleast_1d(frequencies).tolist() for d in np.atleast_1d(source_depths).tolist()]

    def march(i: int) -> dict[str, Any]:
        frequency_hz, depth_m = of_sources[i]
        report = None if progress is None else lambda share: progress((i + share) / len(of_sources))
        return radial(environment._ocean, frequency=frequency_hz, source_depth=depth_m, progress=report, **shared)

    return _dataset(xarray, environment, frequencies, source_depths, [march(i) for i in range(len(of_sources))], edges)


def _dataset(
    xarray: Any, environment: Environment, frequencies: Any, source_depths: Any, fields: Any, band: Any
) -> Any:
    outer = [(n, a) for n, a in (("frequency", frequencies), ("source_depth", source_depths)) if np.ndim(a) > 0]
    shape = tuple(a.size for _, a in outer)
    dims = tuple(n for n, _ in outer)

    def stacked(name: str) -> Any:
        first = fields[0][name]
        return np.stack([f[name] for f in fields]).reshape(shape + first.shape) if shape else first

    values = {"transmission_loss": ((*dims, "range", "depth"), stacked("transmission_loss"))}
    if environment.source_level is not None and environment.noise_level is not None:
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
    dataset = xarray.Dataset(values, coordinates)
    for name in dataset.variables:
        dataset[name].attrs.update(_ATTRIBUTES[str(name)])
    dataset.attrs.update(
        title=f"Sound field of one source: {environment.name}",
        source="Earshot, one-way parabolic equation",
        environment_crc32=f"0x{environment.crc32:08x}",
    )
    if band is not None:
        dataset.attrs["band_hz"] = list(band)
    if grids:
        depth_steps, range_steps, terms, errors, _ = zip(*grids)
        dataset.attrs.update(
            predicted_error_db=float(np.max(errors)),
            depth_step_m=float(np.min(depth_steps)),
            range_step_m=float(np.min(range_steps)),
            terms=int(np.max(terms)),
        )
    unmeasured = next((f["unmeasured_water"] for f in fields if f["unmeasured_water"] is not None), None)
    if unmeasured is not None:
        dataset.attrs["unmeasured_water"] = unmeasured
    return dataset
