"""Oceans: from an environment file, or from numbers and arrays, which become the text of one."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earshot import arguments
from earshot.arguments import number
from earshot.core import MOST_TOML_BYTES, Ocean, RadialCase, printable
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

__all__ = ["PAPER_ENVIRONMENT", "Environment"]

PAPER_ENVIRONMENT = Path(__file__).parent / "gym" / "environments" / "munk_flat.toml"  # of Clark et al. 2022

# How the files of other propagation models are read, by the name of the function that does.
_CASES = {
    "from_acoustics_toolbox": RadialCase.from_acoustics_toolbox,
    "from_ram": RadialCase.from_ram,
}

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

# A key that is not the one that a problem begins with.
_OTHER_KEY = re.compile("(?<= )(?:" + "|".join(re.escape(key) for key in _ARGUMENT_OF if "." in key) + ")(?!\\w)")


def _as_argument(bad: BadInput) -> BadInput:
    """What is wrong with the text, as it is wrong with an argument."""
    problems = [re.sub(f"^{_NAME}:([0-9]+:)? ", "", line) for line in str(bad).splitlines()]
    problems = [_OTHER_KEY.sub(lambda key: _ARGUMENT_OF[key[0]], problem) for problem in problems]
    stated = bad if bad.key is not None else BadInput(problems[0])
    argument = next((name for start, name in _ARGUMENT_OF.items() if (stated.key or "").startswith(start)), None)
    return BadInput(
        "\n".join([f"{argument}: {problems[0]}" if argument else problems[0], *problems[1:]]),
        key=argument,
        value=stated.value,
    )


class Environment:
    """An ocean, and the source and the noise in it where they are known. Nothing of it changes.

    `Environment.from_toml(path)` reads an environment file, as `earshot field` does; `from_acoustics_toolbox(path)` and
    `from_ram(path)` read the input of other propagation models. From numbers and arrays:

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
    Where frequency, source_depth, source_level or noise_level is None, it is not known.

    Arrays may be of any layout and number type; they are not kept. Each argument holds at most a million numbers.

    Raises BadInput, with the argument as `key`; BadType for what is of another kind.

    >>> env = Environment(sound_speed=Munk(), bathymetry=3000.0, sediment=Layer(1505.0))
    """

    _reader: str  # of a file: the name of the function that reads it

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
        self._case: RadialCase | None = None
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
        environment._path = _resolved(path)
        environment._case = None
        environment._text = ""
        environment._ocean = _read(Ocean.from_file, environment._path, path)
        ocean = environment._ocean
        environment._given = {
            "frequency": ocean.frequency,
            "source_depth": ocean.source_depth,
            "source_level": ocean.source_level,
            "noise_level": ocean.noise_level,
        }
        return environment

    @classmethod
    def from_acoustics_toolbox(
        cls,
        path: str | os.PathLike[str],
        *,
        source_level: float | None = None,
        noise_level: float | None = None,
    ) -> Environment:
        """The ocean of an .env file of the Acoustics Toolbox (BELLHOP, KRAKEN, SCOOTER), with .ssp and .bty beside it.

        Its source, its receivers and how far it goes are what `earshot.field` computes where nothing else is asked.
        Such a file names no levels: give them where SNR is wanted. `sim/ocean/file/acoustics_toolbox` lists what is
        understood.

        source_level  dB re 1 uPa at 1 m, 0 to 300;   noise_level  in the detector's band, dB re 1 uPa, -100 to 300

        Raises BadInput with file, line, key and value of what is wrong, or has no meaning here.
        """
        return cls._of_case("from_acoustics_toolbox", path, source_level, noise_level)

    @classmethod
    def from_ram(
        cls,
        path: str | os.PathLike[str],
        *,
        source_level: float | None = None,
        noise_level: float | None = None,
    ) -> Environment:
        """The ocean of a ram.in file of RAM 1.5. Its receivers are those of RAM's tl.grid.

        All else is as of `from_acoustics_toolbox`; `sim/ocean/file/ram` lists what is understood.
        """
        return cls._of_case("from_ram", path, source_level, noise_level)

    @classmethod
    def _of_case(cls, reader: str, path: Any, source_level: Any, noise_level: Any) -> Environment:
        levels = {"source_level": source_level, "noise_level": noise_level}
        known = {name: None if level is None else number(name, level) for name, level in levels.items()}
        environment = cls.__new__(cls)
        environment._path = _resolved(path)
        environment._text = ""
        environment._reader = reader
        case = _read(_CASES[reader], environment._path, path)
        environment._case = case
        environment._ocean = case.ocean.with_levels(**{name: level or 0.0 for name, level in known.items()})
        depths = case.source_depth
        environment._given = {
            "frequency": environment._ocean.frequency,
            "source_depth": depths[0] if len(depths) == 1 else None,
            **known,
        }
        return environment

    def to_toml(self) -> str:
        """The environment file of this ocean, which all of Earshot's programs read.

        Raises BadInput where frequency, source_depth, source_level or noise_level is not known, for an ocean that was
        read from a file (that file is it), and for one of so many numbers that the programs would refuse its file.
        """
        if self._path is not None:
            raise BadInput(f"to_toml: this ocean is that of {self._path}", key="to_toml", value=self._path)
        return self._text_of_file("to_toml")

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
        """m, positive down; None: not known, or one of several `source_depths`."""
        return self._given["source_depth"]

    @property
    def source_depths(self) -> NDArray[np.float64] | None:
        """[n] m, increasing: all that a file states; None: not known."""
        if self._case is not None:
            return np.array(self._case.source_depth)
        return None if self.source_depth is None else np.array([self.source_depth])

    @property
    def receiver_depth(self) -> NDArray[np.float64] | None:
        """[n] m, increasing: where an .env or ram.in file asks for sound, in the water or not; None: not stated."""
        return np.array(self._receiver_depths()) if self._receiver_depths() else None

    @property
    def receiver_range(self) -> NDArray[np.float64] | None:
        """[n] m, increasing, from 0 on: where such a file asks for sound; None: not stated."""
        return np.array(self._receiver_ranges()) if self._receiver_ranges() else None

    @property
    def max_range(self) -> float | None:
        """m, how far an .env or ram.in file goes; None: not stated."""
        return None if self._case is None else self._case.max_range

    def _scenario(self) -> Path | Ocean:
        """What a search needs: the environment file with all that it says, or an ocean of known source and noise."""
        if self._path is not None and self._case is None:
            return self._path
        self._require_levels("a search needs it")
        return self._ocean

    def _text_of_file(self, argument: str) -> str:
        """Of an ocean that came from no file."""
        self._require_levels("an environment file states it")
        size = len(self._text.encode())
        if size > MOST_TOML_BYTES:
            raise BadInput(
                f"{argument}: the environment file would have {size} bytes, and Earshot's programs read no more than "
                f"{MOST_TOML_BYTES}: give fewer numbers",
                key=argument,
                value=size,
            )
        return self._text

    def _require_levels(self, why: str) -> None:
        for name, value in self._given.items():
            if value is None:
                raise BadInput(f"{name}: must be given, {why}", key=name)

    def _receiver_depths(self) -> list[float]:
        return [] if self._case is None else self._case.receiver_depth

    def _receiver_ranges(self) -> list[float]:
        return [] if self._case is None else self._case.receiver_range

    def _require_frequencies(self, frequencies: Any) -> None:
        """The attenuation of an .env or ram.in file is that at its own frequency."""
        if self._case is None:
            return
        for frequency in np.atleast_1d(frequencies).tolist():
            if frequency != self.frequency:
                raise BadInput(
                    f"frequency = {frequency:g}: must be {self.frequency:g}, at which {self._path} states attenuation",
                    key="frequency",
                    value=frequency,
                )

    def _provenance(self, title: str) -> dict[str, Any]:
        """Attributes of a Dataset with sound in this ocean."""
        return {
            "title": f"{title}: {self.name}",
            "source": "Earshot, one-way parabolic equation",
            "environment": self.name,
            "environment_crc32": f"0x{self.crc32:08x}",
        }

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
        reader = "from_toml" if self._case is None else self._reader
        return _unpickled, (self._path, self._text, self._given, self.crc32, reader)


def _resolved(path: Any) -> Path:
    return Path(os.path.realpath(arguments.path("path", path)))


def _read(reader: Callable[[Path], Any], path: Path, given: Any) -> Any:
    """What is wrong with the whole of a file is wrong with the argument that names it."""
    try:
        return reader(path)
    except BadInput as bad:
        raise bad.about(str(path), printable(path), key="path", value=given) from None


def _unpickled(
    path: Path | None, text: str, given: dict[str, float | None], crc32: int, reader: str = "from_toml"
) -> Environment:
    if path is not None:
        levels = {name: given[name] for name in ("source_level", "noise_level")} if reader in _CASES else {}
        environment: Environment = getattr(Environment, reader)(path, **levels)
        if environment.crc32 != crc32:
            raise BadInput(f"environment: {path}, or a file that it names, is not what it was when this was pickled")
        return environment
    environment = Environment.__new__(Environment)
    environment._path, environment._text, environment._given = None, text, given
    environment._case = None
    environment._ocean = Ocean.from_text(_NAME, text)
    return environment
