"""Calls in recordings, found by the vehicle's own detector."""

from __future__ import annotations

import contextlib
import datetime
import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Union

import numpy as np
from numpy.typing import DTypeLike, NDArray

from earshot.arguments import axis, is_path, number, path, require_callable, text, whole_number
from earshot.core import Listening, SoundStream, listen_to_files, printable
from earshot.errors import BadInput, BadType
from earshot.heard import Completed, Heard, completed_of, heard_of, in_python, joined
from earshot.sounds import array, bits_of, blocks_of, files_of, largest_magnitude, one_channel, scaled

__all__ = ["Listener", "listen"]

Recordings = Union[str, "os.PathLike[str]", Sequence[Union[str, "os.PathLike[str]"]]]
Begin = Union[str, datetime.datetime, None]
Calibration = Union[str, "os.PathLike[str]", Mapping[str, float], None]

# What is wrong with these begins with their name.
_ARGUMENT = re.compile(
    "(band|begin|bits|calibration|channel|full_scale_db|largest_magnitude|levels_interval|preset|rate"
    "|threshold_db|time_format)"
    "(?: =|:) "
)
_KEYS_OF_CALIBRATION = {
    "full_scale_level_db_re_1upa",
    "full_scale_v",
    "gain_db",
    "high_pass_corner_hz",
    "sensitivity_db_re_1v_per_upa",
}


def listen(
    samples: Recordings | NDArray[Any] | Sequence[float],
    rate: float | None = None,
    *,
    preset: str = "fin",
    band: tuple[float, float] | None = None,
    threshold_db: float | None = None,
    channel: int = 1,
    calibration: Calibration = None,
    full_scale_db: float | None = None,
    begin: Begin = None,
    time_format: str | None = None,
    bits: int | None = None,
    levels_interval: float | None = 60.0,
    progress: Callable[[float], object] | None = None,
) -> Heard:
    """Finds calls in sound with the detector that flies: what `earshot listen` finds, bit for bit.

    samples          a file (WAV, FLAC), a folder, or several: they are one recording, as the program takes them; or an
                     array [n_sample] or [n_sample x n_channel] of any integer or floating-point type. Full scale is 1
                     for floating point, else the largest number of the type; unsigned ones have 0 in the middle
    rate             Hz, of an array; files state theirs
    preset           "fin", "blue", "antarctic" or "tone": what is listened for
    band             (low, high), Hz, 1 to 1000, in place of the preset's
    threshold_db     SNR of a detection, -10 to 60 dB; None: 10 dB
    channel          which of the channels, from 1
    calibration      a TOML file, or its keys and values: full_scale_level_db_re_1upa, or full_scale_v, gain_db and
                     sensitivity_db_re_1v_per_upa; also high_pass_corner_hz. None: what the recorder wrote into the file
    full_scale_db    dB re 1 uPa (peak) of a sample of full scale, in place of a calibration
    begin            when the only file, or the array, begins: a datetime, or a text such as 2021-02-05T03:59:46+10:00;
                     without a zone it is UTC
    time_format      how files' names give their begin, such as "%y%m%d_%H%M%S"
    bits             that a sample of an array carries, 8 to 32, where its type has more: 16 for a 16-bit recording that
                     was read as floating point. None: those of its type, 24 at most for floating point.
    levels_interval  s, 1 to 86400, of third-octave levels; None: no levels
    progress         called now and then with the share of the work that is done, 0 to 1

    Floating-point samples may exceed 1: then levels are of the samples as they are, and nothing counts as clipped.

    Returns a `Heard`: DataFrames `detections`, `levels` and `level_percentiles`, `files`, and what holds of all.

    Warns (RecordingWarning) of what is missing of files, or unknown. Raises BadInput with the argument as `key`, for
    samples that are not finite, masked or too few, too; BadType for what is of another kind; KeyboardInterrupt within
    0.1 s. Other threads of Python run meanwhile.
    """
    require_callable(progress)
    asked = _asked(preset, band, threshold_db, channel, calibration, full_scale_db, levels_interval)
    files = files_of(samples)
    if files is None:
        if rate is None:
            raise BadInput("rate: must be given with an array", key="rate")
        if time_format is not None:
            raise BadInput("time_format: not with an array", key="time_format", value=time_format)
        sound = one_channel("samples", array("samples", samples), channel, is_whole=True)
        if sound.size == 0:
            raise BadInput("samples: must hold one sample or more", key="samples", value=samples)
        stream = _stream(rate, sound.dtype, bits, begin, asked, largest_magnitude("samples", sound), calibration)
        with _refusals("samples", samples, calibration):
            parts = [*_pushed(stream, sound, progress), stream.finish()]
        if progress is not None:
            progress(1.0)
        return heard_of(joined(parts), channel)
    for name, value in (("rate", rate), ("bits", bits)):
        if value is not None:
            raise BadInput(f"{name}: not with a file, which states it", key=name, value=value)
    if begin is not None and time_format is not None:
        raise BadInput("begin: not beside time_format", key="begin", value=begin)
    named = None if time_format is None else text("time_format", time_format)
    first = _begin(begin)
    with _refusals("samples", samples, calibration, files):
        heard = listen_to_files(files=files, begin=first, time_format=named, asked=asked, progress=progress)
    if progress is not None:
        progress(1.0)
    return heard_of(heard, channel, is_of_files=True)


class Listener:
    """Listens to sound as it comes: the same rows as `earshot.listen` finds in the whole, bit for bit.

    rate               Hz
    dtype              of the blocks, which decides what full scale is
    largest_magnitude  of the samples, where they are floating point and exceed 1; louder ones are clipped
    others             as those of `earshot.listen`

    The noise is learnt from the first two minutes (five with "blue" and "antarctic", eight with "tone"): they are kept,
    and what they hold is given when there are so many, or at the end.

    Raises BadInput and BadType as `earshot.listen` does; a block that is refused is not heard, and the next may follow.

    >>> listener = earshot.Listener(1000.0, dtype="int16")
    >>> for block in blocks:
    ...     print(listener.push(block).detections)
    >>> print(listener.finish().detections)
    """

    def __init__(
        self,
        rate: float,
        *,
        dtype: DTypeLike = np.float64,
        preset: str = "fin",
        band: tuple[float, float] | None = None,
        threshold_db: float | None = None,
        channel: int = 1,
        calibration: Calibration = None,
        full_scale_db: float | None = None,
        begin: Begin = None,
        bits: int | None = None,
        largest_magnitude: float = 1.0,
        levels_interval: float | None = 60.0,
    ) -> None:
        try:
            self._dtype = np.dtype(dtype)
        except (TypeError, ValueError, SyntaxError, RecursionError) as wrong:  # whatever NumPy makes of it
            raise BadType(f"dtype: must be of NumPy: {wrong}", key="dtype", value=dtype) from None
        if self._dtype.kind not in "iuf":
            raise BadType("dtype: must be of integers or of floating point", key="dtype", value=dtype)
        asked = _asked(preset, band, threshold_db, channel, calibration, full_scale_db, levels_interval)
        largest = number("largest_magnitude", largest_magnitude)
        self._channel = whole_number("channel", channel)
        self._shape: tuple[int, ...] | None = None  # of one sample
        self._stream = _stream(rate, self._dtype, bits, begin, asked, largest, calibration)

    def push(self, block: NDArray[Any] | Sequence[float]) -> Completed:
        """The next samples, [n_sample] or [n_sample x n_channel], none or more: gives the rows that they complete.

        Raises RuntimeError after finish(), while another thread is in it, and after a push that Ctrl-C ended.
        """
        sound = array("block", block)
        if sound.dtype != self._dtype and sound.size > 0:
            raise BadType(f"block: must be of {self._dtype}, as dtype gives it, not {sound.dtype}", key="block")
        if self._shape is not None and sound.shape[1:] != self._shape:
            raise BadInput(f"block: must have as many channels as before, has the shape {sound.shape}", key="block")
        shares = scaled("block", one_channel("block", sound, self._channel))
        self._shape = sound.shape[1:]
        return completed_of(self._stream.push(shares, None), self._stream.settings)

    def finish(self) -> Heard:
        """After the last block: the rows that are left, and what holds of all.

        Raises BadInput where all that was pushed is too short to know the noise.
        """
        with _refusals("block", None, None):
            return heard_of(self._stream.finish(), self._channel)


def _asked(
    preset: Any, band: Any, threshold_db: Any, channel: Any, calibration: Any, full_scale_db: Any, levels_interval: Any
) -> Listening:
    if calibration is not None and full_scale_db is not None:
        raise BadInput("full_scale_db: not beside a calibration", key="full_scale_db", value=full_scale_db)
    edges = None if band is None else axis("band", band)
    if edges is not None and edges.size != 2:
        raise BadInput("band: must be the low and the high frequency", key="band", value=band)
    file = None
    toml = None
    if isinstance(calibration, Mapping):
        file = Path("calibration")  # stands for a file in what is wrong with the text
        toml = "".join(
            f"{_key_of_calibration(key, calibration)} = {number(key, calibration[key])!r}\n" for key in calibration
        )
    elif calibration is not None:
        if not is_path(calibration):
            raise BadType("calibration: must be a path, or keys and values", key="calibration", value=calibration)
        file = path("calibration", calibration)
    return Listening(
        preset=text("preset", preset),
        band=None if edges is None else (float(edges[0]), float(edges[1])),
        threshold_db=None if threshold_db is None else number("threshold_db", threshold_db),
        channel=whole_number("channel", channel),
        calibration=file,
        calibration_text=toml,
        full_scale_db=None if full_scale_db is None else number("full_scale_db", full_scale_db),
        levels_interval=None if levels_interval is None else number("levels_interval", levels_interval),
    )


def _key_of_calibration(key: Any, calibration: Any) -> str:
    if not isinstance(key, str) or key not in _KEYS_OF_CALIBRATION:
        allowed = ", ".join(sorted(_KEYS_OF_CALIBRATION))
        raise BadInput(
            f"calibration: has the key {key!r}; may have {allowed}",
            key=key if isinstance(key, str) else "calibration",
            value=calibration,
        )
    return key


def _stream(
    rate: Any, dtype: np.dtype[Any], bits: Any, begin: Begin, asked: Listening, largest: float, calibration: Calibration
) -> SoundStream:
    given = number("rate", rate)
    carried = bits_of(dtype) if bits is None else whole_number("bits", bits)
    first = _begin(begin)
    with _refusals("rate", rate, calibration):
        return SoundStream(rate=given, bits=carried, largest_magnitude=largest, begin=first, asked=asked)


def _pushed(
    stream: SoundStream, sound: NDArray[Any], progress: Callable[[float], object] | None
) -> Iterator[dict[str, Any]]:
    """What a sound completes, given block by block."""
    for begin, block in blocks_of(sound):

        def report(share: float, begin: int = begin, size: int = block.size) -> None:
            if progress is not None:
                progress((begin + share * size) / sound.size)

        yield stream.push(scaled("samples", block), report)


def _begin(begin: Begin) -> str | None:
    if isinstance(begin, datetime.datetime):
        try:
            utc = begin if begin.tzinfo is None else begin.astimezone(datetime.timezone.utc).replace(tzinfo=None)
        except OverflowError:
            raise BadInput(f"begin = {begin}: in UTC its year must be 1 to 9999", key="begin", value=begin) from None
        return utc.isoformat()
    if begin is not None and not isinstance(begin, str):
        raise BadType("begin: must be a datetime, or a text", key="begin", value=begin)
    return None if begin is None else text("begin", begin)


@contextlib.contextmanager
def _refusals(name: str, value: Any, calibration: Calibration, files: Sequence[Path] = ()) -> Iterator[None]:
    """Within it, what the C++ module refuses is refused as an argument: this one, unless the message names another."""
    try:
        yield
    except BadType:
        raise  # of the callback that shows the progress
    except BadInput as bad:
        raise _as_argument(bad, name, value, calibration, files) from None


def _as_argument(bad: BadInput, name: str, value: Any, calibration: Calibration, files: Sequence[Path]) -> BadInput:
    refusal = BadInput(in_python(str(bad)))
    chain = Path("calibration") if isinstance(calibration, Mapping) else None
    if is_path(calibration):
        chain = path("calibration", calibration)
    if chain is not None and str(refusal).startswith(f"{printable(chain)}:"):
        refusal = refusal.about(str(chain), printable(chain), key="calibration", value=calibration)
        if isinstance(calibration, Mapping):
            refusal.file = refusal.line = None
        return refusal
    if argument := _ARGUMENT.match(str(refusal)):
        refusal.key, refusal.file = argument[1], None
        return refusal
    named = BadInput(str(refusal), key=name, value=value)
    for file in files:
        if of_file := re.match(re.escape(printable(file)) + "(/[^\n]*?)?: ", str(refusal)):
            named.file = str(file) + (of_file[1] or "")
    return named
