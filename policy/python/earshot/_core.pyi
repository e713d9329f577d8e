"""The C++ module: the search, and the ocean.

Positions are (north, east), metres from the south-west corner of the search domain.

What is not as it must be raises earshot.errors.BadInput.
"""

import os
from collections.abc import Callable, Sequence
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from earshot._search import BeliefState as BeliefState
from earshot._search import Tables as Tables
from earshot._search import baselines as baselines
from earshot._search import evaluate as evaluate

_Place = tuple[float, float]

# snr_db (as heard; where it was too faint to measure, the least that could have been), too_faint, position_m, source_m;
# at the end of an episode also found and detections. A plain dict, as Gymnasium wants it.
_Info = dict[str, Any]

def environment_crc32(environment: os.PathLike[str] | str) -> int:
    """CRC-32 of an environment file and of all that it names: data files, charts, other oceans, field library."""

class World:
    """A search with its ocean solved. Takes a second or so to make; any number of episodes may share it.

    Nothing of it changes: its copy is itself.
    """

    def __init__(
        self,
        *,
        environment: os.PathLike[str] | str,
        state: str,
        remembered_steps: int,
        source: str,
        start: str,
        directions: int,
        vehicle_depth_m: float,
        border_width_m: float,
        max_steps: int,
        listening: str,
        listening_window_s: int,
    ) -> None: ...
    def __copy__(self) -> World: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> World: ...
    @property
    def arguments(self) -> dict[str, Any]:
        """What it was made with."""
    @property
    def environment_crc32(self) -> int:
        """Of the environment as it was when its ocean was solved."""
    @property
    def observation_size(self) -> int: ...
    @property
    def observation_names(self) -> list[str]:
        """Of each number of an observation: "east", "step_snr_0" (the latest step's), "preference_7" (action 7's)."""
    @property
    def action_count(self) -> int: ...
    @property
    def max_steps(self) -> int: ...
    @property
    def detection_threshold_db(self) -> float: ...
    @property
    def area_m(self) -> _Place:
        """Size of the search domain, north and east."""
    @property
    def description(self) -> str:
        """What `earshot freeze` must know of a policy trained here, one line of JSON."""
    def snr_db(self, range_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """SNR in dB at horizontal ranges in metres, same shape."""

class Episodes:
    """`count` searches in one world, each with random numbers of its own.

    A copy goes on as the original would. Pickled are the random numbers that each search began with and its actions
    since; unpickling takes them again.

    Raises RuntimeError when observed or stepped before started, and when stepped after the end.
    """

    def __init__(self, world: World, count: int) -> None: ...
    def __copy__(self) -> Episodes: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> Episodes: ...
    def start(self, index: int, seed: int | None = None) -> None:
        """Draws the next search of one episode; a seed restarts its random numbers first."""
    def start_at(self, index: int, position_m: _Place, source_m: _Place) -> None:
        """Starts one episode at a given place."""
    def observations(self) -> NDArray[np.float32]:
        """[count x observation_size]"""
    def step_one(self, action: SupportsIndex) -> tuple[NDArray[np.float32], float, bool, bool, _Info]:
        """Steps episode 0: observation [observation_size], reward, terminated, truncated, info."""
    def step(
        self, actions: NDArray[np.int64]
    ) -> tuple[
        NDArray[np.float32],
        NDArray[np.float64],
        NDArray[np.bool_],
        NDArray[np.bool_],
        list[tuple[int, NDArray[np.float32], dict[str, float]]],
    ]:
        """Steps all episodes with actions [count]; one that ends starts anew at once.

        Any integer dtype will do; TypeError for others. Returns observations [count x observation_size] to act upon
        next, rewards [count], terminated [count], truncated [count], and for each episode that ended (index, last
        observation [observation_size], record).
        """
    def position_m(self, index: int) -> _Place: ...
    def source_m(self, index: int) -> _Place: ...
    def snr_db(self, index: int) -> float:
        """As heard; where it was too faint to measure, the least that could have been."""
    def is_too_faint(self, index: int) -> bool: ...
    def info(self, index: int) -> _Info: ...
    def record(self, index: int) -> dict[str, float]:
        """reward (sum so far), steps, detections (steps with SNR at or over the threshold), found"""

class FrozenPolicy:
    """A `.policy` file, run with the arithmetic that flies. The signature is not checked.

    Raises BadInput for a damaged file.
    """

    def __init__(self, file: os.PathLike[str] | str) -> None: ...
    def logits(self, observations: NDArray[np.float32]) -> NDArray[np.float32]:
        """[count x observation_size] -> [count x action_count]"""
    @property
    def provenance(self) -> str:
        """Lines "name = value"."""

class Ocean:
    """What an environment file says of the ocean, the source and the noise."""

    @staticmethod
    def from_file(path: os.PathLike[str] | str) -> Ocean: ...
    @staticmethod
    def from_text(name: str, text: str) -> Ocean:
        """Of the text of such a file; `name` stands for the file in what is wrong with it."""
    def with_levels(self, *, source_level: float, noise_level: float) -> Ocean:
        """The same ocean; dB re 1 uPa at 1 m, and dB re 1 uPa."""
    @property
    def name(self) -> str: ...
    @property
    def frequency(self) -> float:
        """Hz"""
    @property
    def source_depth(self) -> float:
        """m"""
    @property
    def source_level(self) -> float:
        """dB re 1 uPa at 1 m"""
    @property
    def noise_level(self) -> float:
        """dB re 1 uPa"""
    @property
    def sea_floor_depth(self) -> float:
        """m, at the source"""
    @property
    def crc32(self) -> int: ...

LEVEL_ATTRIBUTES: dict[
    str, dict[str, str]
]  # of transmission_loss, snr, source_level and noise_level, as NetCDF files have them

MOST_TOML_BYTES: int  # of a file that Earshot's programs read

class RadialCase:
    """The input file of another propagation model: an ocean, and where on a radial its sound is asked for."""

    @staticmethod
    def from_acoustics_toolbox(path: os.PathLike[str] | str) -> RadialCase:
        """Of an .env file, and the .ssp and .bty beside it."""
    @staticmethod
    def from_ram(path: os.PathLike[str] | str) -> RadialCase:
        """Of a ram.in file."""
    @property
    def ocean(self) -> Ocean:
        """Its source at the first of the depths; its levels are 0 dB, for such a file names none."""
    @property
    def source_depth(self) -> list[float]:
        """[n] m, increasing, at least one"""
    @property
    def receiver_depth(self) -> list[float]:
        """[n] m, increasing, >= 0; some may lie below the sea floor; empty: not stated"""
    @property
    def receiver_range(self) -> list[float]:
        """[n] m, increasing, >= 0, the last > 0; empty: not stated"""
    @property
    def max_range(self) -> float | None:
        """m; None: not stated"""

class SoundRequest:
    """What is asked of the sound in an ocean, as `earshot.field` describes it; checked where it is used."""

    def __init__(
        self,
        *,
        frequency: float,
        source_depth: float,
        max_range: float,
        receiver_depth: list[float],
        depth_spacing: float | None,
        output_step: float | None,
        accuracy_db: float,
        band: tuple[float, float] | None,
        band_parts: int,
        starter: str,
        range_step: float | None,
        depth_step: float | None,
        terms: int,
        absorber_wavelengths: float | None,
        file_depth: list[float],
        file_range: list[float],
    ) -> None:
        """An empty `receiver_depth` stands for every `depth_spacing`. `file_depth` and `file_range` are a RadialCase's
        receivers, or empty: where they are not, they say which depths, ranges and step are computed.
        """

def radial(
    ocean: Ocean,
    asked: SoundRequest,
    *,
    bearing: float,
    pressure: bool,
    snr: bool,
    progress: Callable[[float], object] | None,
) -> dict[str, Any]:
    """One march.

    transmission_loss [n_range x n_depth] float32 dB; of the same shape snr, float32 dB, and pressure, complex128, or
    None where they are not wanted; range, depth [n] float64 m; sea_floor_depth [n_range] float32 m; unmeasured_water,
    doubt, a text or None; grid, None or (depth step m, range step m, terms, predicted error dB, reference wavenumber
    1/m).
    """

def fan(
    ocean: Ocean,
    asked: SoundRequest,
    *,
    radials: int,
    threads: int,
    detection_threshold_db: float,
    fluctuation_db: float,
    detection: bool,
    map: bool,
    side: float | None,
    intervals: int,
    progress: Callable[[float], object] | None,
) -> dict[str, Any]:
    """All around the source. `threads` 0: all processors; `asked` without receivers of a file and depth spacing.

    transmission_loss [n_bearing x n_range x n_depth] float32 dB; sea_floor_depth [n_bearing x n_range] float32 m;
    bearing [n] float64 degrees; range, depth [n] float64 m; land, unmeasured_water, doubt, a text or None; grid as of
    `radial`, of all marches the finest, with the largest error.
    With `detection` also detection_probability, shaped as the loss, and assured_detection_range and
    furthest_detection_range [n_depth x n_bearing] m, all float32. With `map` also map_snr, dB, and
    map_detection_probability [n_depth x n_north x n_east] float32; north, east [intervals + 1] float64 m.
    """

def read_library(
    path: os.PathLike[str] | str, *, positions: list[int] | None, progress: Callable[[float], object] | None
) -> dict[str, Any]:
    """A field library that is finished, or some positions of it.

    transmission_loss [n_position x n_bearing x n_range x n_depth] float32 dB; position int64, position_north,
    position_east float64 m, has_field uint8 [n_position]; bearing degrees, range, depth m, frequency Hz float64;
    position_depth m; source_level, noise_level dB; is_around_hydrophone; attributes, texts of the file.
    """

def write_shade(
    path: os.PathLike[str] | str,
    *,
    range: list[float],
    depth: list[float],
    sea_floor_depth: NDArray[np.float32],
    transmission_loss: NDArray[np.float32],
    pressure: NDArray[np.complex128],
    reference_wavenumber: float,
    title: str,
    frequency: float,
    source_depth: float,
    single_precision: bool,
    receiver_depth: list[float],
    receiver_range: list[float],
    force: bool,
) -> None:
    """Arrays as `radial` gives them, contiguous; NaN where there is no wavenumber. Empty receivers: range and depth."""

def write_tl_grid(
    path: os.PathLike[str] | str,
    *,
    range: list[float],
    depth: list[float],
    sea_floor_depth: NDArray[np.float32],
    transmission_loss: NDArray[np.float32],
    pressure: NDArray[np.complex128] | None,
    receiver_depth: list[float],
    receiver_range: list[float],
    force: bool,
) -> None:
    """As `write_shade`; the loss is that of the pressure, where there is one."""

def journal_records(path: os.PathLike[str] | str) -> dict[str, Any]:
    """A journal, a flight's folder, or a log that lcm-logger wrote.

    records: topic -> list of (number, time in us of the mission's clock, fields as JSON); is_bus_log, is_dated, is_cut;
    missing_records, damaged_bytes, how many.
    """

def journal_fields() -> dict[str, dict[str, tuple[str, str]]]:
    """Topic -> field -> (unit of its type or "", meaning or ""), as the dictionary of messages has them."""

class Listening:
    """What is asked of sound, as `earshot.listen` describes it; checked where it is used."""

    def __init__(
        self,
        *,
        preset: str,
        band: tuple[float, float] | None,
        threshold_db: float | None,
        channel: int,
        calibration: os.PathLike[str] | None,
        calibration_text: str | None,
        full_scale_db: float | None,
        levels_interval: float | None,
    ) -> None:
        """`calibration` is a file, or with `calibration_text` the name of that text."""

def listen_to_files(
    *,
    files: Sequence[os.PathLike[str]],
    begin: str | None,
    time_format: str | None,
    asked: Listening,
    progress: Callable[[float], object] | None,
) -> dict[str, Any]:
    """What was heard.

    rows: by column float64 [n], begin_utc_us int64 with NumPy's "not a time", is_clipped uint8, file a list;
    levels: None, or is_dated, begin_s [n_interval] float64 s, from 1970 in UTC where dated, frequency_hz [n_band]
    float64, percentile, level_db [n_interval x n_band], level_percentile_db [n_interval x n_percentile x n_band]
    float32; settings, a dict; files: (path, begin in s, first frame, frames, start in us or "not a time", recorder);
    listened_s, noise_db, not_heard_s, remarks.
    """

class SoundStream:
    """Sound of one channel that comes in blocks. `asked.channel` does not count.

    RuntimeError after finish(), while another thread is in it, and after a push that threw.
    """

    def __init__(
        self, *, rate: float, bits: int, largest_magnitude: float, begin: str | None, asked: Listening
    ) -> None: ...
    def push(self, samples: NDArray[np.float32], progress: Callable[[float], object] | None) -> dict[str, Any]:
        """rows and levels that these samples [n], contiguous, complete."""
    def finish(self) -> dict[str, Any]:
        """As listen_to_files, but for the rows that push() gave."""
    @property
    def settings(self) -> dict[str, Any]: ...

# begin and end, s; low and high, Hz, 0 where not given; channel, from 1, or 0; file or ""; offset in it, s
_Selected = tuple[float, float, float, float, int, str, float | None]

def selections(path: os.PathLike[str] | str) -> list[_Selected]: ...
def placed(
    *,
    selected: list[_Selected],
    name: os.PathLike[str] | str,
    files: list[tuple[str, int, int]],
    rate: float,
    channel: int,
    band: tuple[float, float],
) -> tuple[list[tuple[float, float]], list[str]]:
    """Where selections lie in a recording, s, and what is not counted. Files are (path, first frame, frames)."""

def printable(path: os.PathLike[str] | str) -> str:
    """A path as messages show it."""

def score(
    *, truth: list[tuple[float, float]], found: list[tuple[float, float]], tolerance_s: float, listened_s: float
) -> dict[str, Any]: ...
