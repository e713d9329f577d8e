"""Oceans: from an environment file, or from numbers and arrays, which become the text of one."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path
from typing import Any

from earshot import arguments
from earshot.arguments import number
from earshot.core import Ocean, printable
from earshot.errors import BadInput, BadType
from earshot.ocean_parts import (
    Bathymetry,
    Profile,
    SeaWater,
    Sediment,
    absorption_table,
    sea_floor_tables,
    seabed_layers,
    water_table,
)

__all__ = ["Environment"]

_NAME = "keyword arguments"  # stands for the file in what is wrong with the text

# The argument that a key of the text was made of.
_ARGUMENT_OF = {
    "source.frequency_hz": "frequency",
    "source.depth_m": "source_depth",
    "source.level_db_re_1upa_at_1m": "source_level",
    "noise": "noise_level",
    "water": "sound_speed",
    "seabed.depth_m": "bathymetry",
    "bathymetry": "bathymetry",
    "seabed": "sediment",
    "absorption": "absorption",
    "the last depth_m of the sound-speed profile": "sound_speed",
}


def _as_argument(bad: BadInput) -> BadInput:
    """What is wrong with the text, as it is wrong with an argument."""
    key = bad.key or ""
    argument = next((name for start, name in _ARGUMENT_OF.items() if key.startswith(start)), None)
    problems = [re.sub(f"^{_NAME}:([0-9]+:)? ", "", line) for line in str(bad).splitlines()]
    return BadInput(
        "\n".join([f"{argument}: {problems[0]}" if argument else problems[0], *problems[1:]]),
        key=argument,
        value=bad.value,
    )


class Environment:
    """An ocean, and the source and the noise in it where they are known. Nothing of it changes.

    `Environment.from_toml(path)` reads an environment file, as `earshot field` does. From numbers and arrays:

    sound_speed   of the water, m/s: one number; a `Munk`; (depth [n], speed [n]); (range [m], depth [n],
                  speed [m x n]); or an xarray.DataArray over depth, or over range and depth. Depth in m, from 0 to the
                  deepest sea floor; range in m from the source; linear between
    bathymetry    depth of the sea floor, m: one number; (range [n], depth [n]); or a DataArray over range
    sediment      a `Layer`, a list of them from the sea floor down, {range: list} where it changes with range, or a
                  Dataset over `layer` with variables named as a Layer's fields
    frequency     of the source, Hz, 1 to 10 000;   source_depth  m
    source_level  dB re 1 uPa at 1 m, 0 to 300;     noise_level   in the detector's band, dB re 1 uPa
    absorption    a `SeaWater`, or None: the water absorbs nothing
    name          for people

    Arrays may be of any layout and number type; they are not kept. Each argument holds at most a million numbers.

    Raises BadInput, with the argument as `key`; BadType for what is of another kind.

    >>> env = Environment(sound_speed=Munk(), bathymetry=3000.0, sediment=Layer(1505.0))
    """

    def __init__(
        self,
        *,
        sound_speed: Profile,
        bathymetry: Bathymetry,
        sediment: Sediment,
        frequency: float | None = None,
        source_depth: float | None = None,
        source_level: float | None = None,
        noise_level: float | None = None,
        absorption: SeaWater | None = None,
        name: str = "environment",
    ) -> None:
        if not isinstance(name, str) or not name.isprintable():
            raise BadType("name: must be a text of printable characters", key="name", value=name)
        self._given = {
            "frequency": frequency,
            "source_depth": source_depth,
            "source_level": source_level,
            "noise_level": noise_level,
        }
        # What the text must state and nobody has given stands in for itself: whoever needs it asks for it.
        stand_in = {"frequency": 100.0, "source_depth": 1e-6, "source_level": 0.0, "noise_level": 0.0}
        source = {k: stand_in[k] if v is None else number(k, v) for k, v in self._given.items()}
        depth_key, section = sea_floor_tables(bathymetry)
        self._path: Path | None = None
        self._text = (
            f"name = {json.dumps(name, ensure_ascii=False)}\n[source]\nfrequency_hz = {source['frequency']!r}\n"
            f"level_db_re_1upa_at_1m = {source['source_level']!r}\ndepth_m = {source['source_depth']!r}\n"
            f"north_m = 0.0\neast_m = 0.0\n[noise]\nlevel_db_re_1upa = {source['noise_level']!r}\n"
            f"{absorption_table(absorption)}[water]\n{water_table(sound_speed)}{section}"
            f"[seabed]\n{depth_key}{seabed_layers(sediment)}"
        )
        try:
            self._ocean = Ocean.from_text(_NAME, self._text)
        except BadInput as bad:
            raise _as_argument(bad) from None

    @classmethod
    def from_toml(cls, path: str | os.PathLike[str]) -> Environment:
        """The ocean of an environment file; `sim/ocean/file` lists its keys.

        Raises BadInput with file, line, key and value of the first of all problems, which its text lists.
        """
        environment = cls.__new__(cls)
        environment._path = Path(os.path.realpath(arguments.path("path", path)))
        environment._text = ""
        try:
            environment._ocean = Ocean.from_file(environment._path)
        except BadInput as bad:
            raise bad.about(str(environment._path), printable(environment._path), key="path", value=path) from None
        ocean = environment._ocean
        environment._given = {
            "frequency": ocean.frequency,
            "source_depth": ocean.source_depth,
            "source_level": ocean.source_level,
            "noise_level": ocean.noise_level,
        }
        return environment

    def to_toml(self) -> str:
        """The environment file of this ocean, which all of Earshot's programs read.

        Raises BadInput where frequency, source_depth, source_level or noise_level is not known, and for an ocean that
        was read from a file: that file is it.
        """
        if self._path is not None:
            raise BadInput(f"to_toml: this ocean is that of {self._path}", key="to_toml", value=self._path)
        for name, value in self._given.items():
            if value is None:
                raise BadInput(f"{name}: must be given, an environment file states it", key=name)
        return self._text

    @property
    def name(self) -> str:
        """For people."""
        return str(self._ocean.name)

    @property
    def frequency(self) -> float | None:
        """Of the source, Hz; None: not known."""
        return self._given["frequency"]

    @property
    def source_depth(self) -> float | None:
        """m, positive down; None: not known."""
        return self._given["source_depth"]

    @property
    def source_level(self) -> float | None:
        """dB re 1 uPa at 1 m; None: not known."""
        return self._given["source_level"]

    @property
    def noise_level(self) -> float | None:
        """In the detector's band, dB re 1 uPa; None: not known."""
        return self._given["noise_level"]

    @property
    def sea_floor_depth(self) -> float:
        """At the source, m, positive down."""
        return float(self._ocean.sea_floor_depth)

    @property
    def crc32(self) -> int:
        """Of the file and of all that it names, or of the text."""
        return int(self._ocean.crc32)

    def __repr__(self) -> str:
        return f"<earshot.Environment {self.name!r}, sea floor at {self.sea_floor_depth:g} m>"

    def __copy__(self) -> Environment:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Environment:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (self._path, self._text, self._given, self.crc32)


def _unpickled(path: Path | None, text: str, given: dict[str, float | None], crc32: int) -> Environment:
    if path is not None:
        environment = Environment.from_toml(path)
        if environment.crc32 != crc32:
            raise BadInput(f"environment: {path}, or a file that it names, is not what it was when this was pickled")
        return environment
    environment = Environment.__new__(Environment)
    environment._path, environment._text, environment._given = None, text, given
    environment._ocean = Ocean.from_text(_NAME, text)
    return environment
