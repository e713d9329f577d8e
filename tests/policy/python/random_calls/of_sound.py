"""What the package offers of oceans, sound and recordings, with arguments that are good, to be made worse.

Used as a module by random_calls.
"""

import contextlib
import functools
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import xarray
from material import ROOT, Material
from random_values import Values
from thing import Thing

import earshot


class OfSound:
    """Its calls."""

    def __init__(self, given: Material) -> None:
        self.given = given

    def things(self) -> list[Thing]:
        with_progress = functools.partial(Thing, has_progress=True)
        return [
            Thing("Environment", self._environment, self._make_environment, 4.0),
            Thing("from_toml", lambda v: {"path": self.given.toml}, earshot.Environment.from_toml, 0.5),
            Thing("from_acoustics_toolbox", self._case("pekeris.env"), earshot.Environment.from_acoustics_toolbox, 0.5),
            Thing("from_ram", self._case("slope.in"), earshot.Environment.from_ram, 0.5),
            with_progress("field", self._question, earshot.field, 4.0),
            with_progress("fan", self._around, earshot.fan, 2.0),
            with_progress("horizontal_map", self._map, earshot.horizontal_map, 2.0),
            with_progress("library", self._library, earshot.library, 1.0),
            Thing("write_shd", self._written, earshot.write_shd, 2.0),
            Thing("write_tl_grid", self._grid, earshot.write_tl_grid, 2.0),
            with_progress("listen", self._listened, earshot.listen, 3.0),
            Thing("Listener", self._stream, self._push, 3.0),
            Thing("annotations.read", lambda v: {"path": self.given.selections}, earshot.annotations.read, 0.5),
            Thing("annotations.score", self._scored, earshot.annotations.score, 2.0),
        ]

    def _case(self, name: str) -> Callable[[Values], dict[str, Any]]:
        file = ROOT / "sim/ocean/environments" / name
        return lambda v: {"path": file, "source_level": v.number(0.0, 300.0), "noise_level": v.number(0.0, 300.0)}

    def _environment(self, v: Values) -> dict[str, Any]:
        depth = np.array([0.0, 50.0, 150.0])
        section = (np.array([0.0, 400.0, 900.0]), np.array([100.0, 80.0, 120.0]))
        profiles = (
            1_500.0,
            (depth, 1_500.0 + v.rng.uniform(-9.0, 9.0, 3)),
            (np.array([0.0, 500.0]), depth, 1_500.0 + v.rng.uniform(-9.0, 9.0, (2, 3))),
            earshot.Munk(axis_depth=v.anything() if v.chance(0.2) else 50.0),
            xarray.DataArray([1_500.0, 1_490.0, 1_510.0], {"depth": depth}, ("depth",)),
            v.labelled("range", "depth"),
        )
        layers = xarray.Dataset({"sound_speed": ("layer", [1_600.0, 1_700.0]), "thickness": ("layer", [5.0, np.nan])})
        sand = earshot.Layer(1_700.0, density=v.anything() if v.chance(0.2) else 1.8)
        sediments = (sand, [earshot.Layer(1_600.0, thickness=5.0), sand], {0.0: [sand]}, layers, v.labelled("layer"))
        water = earshot.SeaWater(10.0, v.anything() if v.chance(0.2) else 35.0, 30.0)
        floors = (v.number(60.0, 140.0), section, xarray.DataArray(section[1], {"range": section[0]}, ("range",)))
        return {
            "sound_speed": v.one_of(profiles),
            "bathymetry": v.one_of(floors),
            "sediment": v.one_of(sediments),
            "frequency": v.number(20.0, 80.0),
            "source_depth": v.number(5.0, 50.0),
            "source_level": v.number(150.0, 190.0),
            "noise_level": v.number(60.0, 90.0),
            "absorption": v.one_of((None, water)),
            "name": "random",
        }

    def _make_environment(self, **given: Any) -> earshot.Environment:
        """The three that must be stated are."""
        environment = earshot.Environment(**{**self.given.ocean(), **given})
        with contextlib.suppress(earshot.BadInput):  # an ocean that is there, but not for these receivers
            earshot.field(environment, frequency=30.0, source_depth=20.0, max_range=150.0, receiver_depth=30.0)
        return environment

    def _question(self, v: Values) -> dict[str, Any]:
        asked: dict[str, Any] = {
            "environment": self.given.shallow,
            "frequency": v.one_of((v.number(20.0, 90.0), v.ascending(20.0, 90.0, 3))),
            "source_depth": v.one_of((v.number(5.0, 90.0), v.ascending(5.0, 90.0, 3))),
            "receiver_depth": v.ascending(1.0, 99.0),
            "max_range": v.number(100.0, 800.0),
            "accuracy_db": 0.2,
        }
        rare = {
            "bearing": v.number(-400.0, 400.0),
            "depth_spacing": v.number(1.0, 20.0),
            "output_step": v.number(5.0, 50.0),
            "band": (v.number(20.0, 40.0), v.number(41.0, 60.0)),
            "band_parts": 2,
            "starter": v.one_of(("self", "gaussian")),
            "range_step": v.number(2.0, 20.0),
            "depth_step": v.number(0.5, 2.0),
            "terms": int(v.rng.integers(2, 9)),
            "absorber_wavelengths": v.number(5.0, 30.0),
            "pressure": v.chance(0.5),
        }
        return asked | {name: value for name, value in rare.items() if v.chance(0.2)}

    def _around(self, v: Values) -> dict[str, Any]:
        asked = self._question(v)
        for name in ("bearing", "depth_spacing", "pressure"):
            asked.pop(name, None)
        asked["frequency"] = v.number(20.0, 90.0)
        asked["source_depth"] = v.number(5.0, 90.0)
        asked |= {"radials": int(v.rng.integers(1, 40)), "threads": 2, "fluctuation_db": v.number(0.0, 9.0)}
        return asked | {"detection_threshold_db": v.number(-20.0, 20.0)}

    def _map(self, v: Values) -> dict[str, Any]:
        return self._around(v) | {"side": v.number(100.0, 900.0), "intervals": int(v.rng.integers(1, 60))}

    def _library(self, v: Values) -> dict[str, Any]:
        return {"path": self.given.library, "positions": v.rng.integers(0, 4, 2)}

    def _written(self, v: Values) -> dict[str, Any]:
        return self._grid(v) | {"path": self.given.folder / "sound.shd", "layout": v.one_of(("double", "single"))}

    def _grid(self, v: Values) -> dict[str, Any]:
        one = self.given.one
        sound = v.one_of((one, one, one, one.isel(range=slice(0, 9)), self.given.sound))
        if v.chance(0.3):
            name = v.one_of(list(sound.variables))
            variable = sound[name].variable
            values = v.odd_array(variable.values)
            try:
                sound = sound.assign({name: (variable.dims, values)})
            except (TypeError, ValueError):
                sound = sound.drop_vars(name)
        if v.chance(0.1):
            sound = sound.assign_attrs({v.one_of(("receiver_depth_m", "environment", "band_hz")): v.anything()})
        ranges = one["range"].values[: int(v.rng.integers(1, 9))]
        path = self.given.folder / "sound.grid"
        return {
            "sound": sound,
            "path": path,
            "receiver_depth": np.array([20.0, 50.0]),
            "receiver_range": ranges,
            "force": True,
        }

    def _asked_of_sound(self, v: Values) -> dict[str, Any]:
        rare = {
            "preset": v.one_of(("fin", "blue", "antarctic", "tone")),
            "band": (v.number(5.0, 20.0), v.number(21.0, 60.0)),
            "threshold_db": v.number(-10.0, 20.0),
            "channel": int(v.rng.integers(1, 3)),
            "calibration": {"full_scale_level_db_re_1upa": v.anything() if v.chance(0.3) else 170.0},
            "full_scale_db": v.number(100.0, 200.0),
            "begin": v.one_of(("2021-02-05T03:59:46+10:00", "2021-02-05")),
            "bits": int(v.rng.integers(8, 33)),
            "levels_interval": v.number(1.0, 100.0),
        }
        return {name: value for name, value in rare.items() if v.chance(0.2)}

    def _listened(self, v: Values) -> dict[str, Any]:
        size = int(v.one_of((self.given.noise.size, self.given.noise.size, 5_000)))
        noise = self.given.noise[:size]
        whole, wav = (noise * 2**14).astype(np.int16), self.given.wav
        sounds = (noise, whole, np.stack([noise, noise], 1), wav, [wav])
        asked = {"samples": v.one_of(sounds), **self._asked_of_sound(v)}
        return asked if isinstance(asked["samples"], (Path, list)) else asked | {"rate": 200.0}

    def _stream(self, v: Values) -> dict[str, Any]:
        dtype = v.one_of(("float64", "float32", "int16", "uint8"))
        block = (np.array(self.given.noise) * (1.0 if dtype.startswith("f") else 100.0)).astype(dtype)
        blocks = tuple(np.array_split(block, int(v.rng.integers(1, 5))))
        return {"rate": 200.0, "dtype": dtype, "largest_magnitude": 1.0, "blocks": blocks, **self._asked_of_sound(v)}

    def _push(self, blocks: Any = (), **given: Any) -> Any:
        listener = earshot.Listener(**{"rate": 200.0, **given})
        for block in blocks if isinstance(blocks, tuple) else (blocks,):
            listener.push(block)
        return listener.finish()

    def _scored(self, v: Values) -> dict[str, Any]:
        begins = np.sort(v.rng.uniform(0.0, 100.0, 5))
        frame = pandas.DataFrame({"begin_s": begins, "end_s": begins + 1.0})
        if v.chance(0.5):
            column = v.one_of(("begin_s", "end_s", "channel", "low_hz", "high_hz", "file_offset_s", "begin_file", 5))
            values = v.anything()
            try:
                frame[column] = values
            except Exception:
                frame[column] = [values] * 5  # pandas has its own opinion of columns
        truths = (frame, frame, self.given.selections)
        asked = {"detections": v.one_of((self.given.heard, frame)), "truth": v.one_of(truths)}
        return asked | {"tolerance_s": v.number(0.0, 9.0)} | ({"listened_s": 99.0} if v.chance(0.5) else {})
