"""What was heard in a recording, as tables."""

from __future__ import annotations

import re
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas

__all__ = ["Completed", "Heard", "RecordingWarning", "completed_of", "heard_of", "in_python", "joined"]

# As the program calls what is called the same here, without dashes.
_OPTION = re.compile(r"(?<![\w-])--(band|begin|calibration|channel|full-scale-db|time-format)\b")
_UNITS = {"begin_s": "s", "duration_s": "s", "begin_utc": "UTC", "peak_s": "s", "snr_db": "dB", "file_offset_s": "s"}


class RecordingWarning(UserWarning):
    """Of a recording, or of a table about it, something is missing or left out."""


@dataclass(frozen=True, eq=False)
class Completed:
    """What a block of sound completed.

    detections         a DataFrame with a row for each detection, and the columns of `earshot listen --csv`: begin_s,
                       duration_s, begin_utc (NaT where no time is known), peak_s, snr_db, level_db_re_1upa or
                       level_db_re_full_scale, file ("" for arrays), file_offset_s, validity ("good" or "clipped");
                       numbers are not rounded
    levels             third-octave levels of the mean power, a DataFrame [n_interval x n_band]: the index is when each
                       interval begins, in UTC (`begin_utc`) where every file gives its begin, else in s (`begin_s`);
                       columns are the bands' centres in Hz; NaN for silence; empty where no levels were wanted
    level_percentiles  percentiles of the levels of one second, a DataFrame with a second index, `percentile`

    Units stand in `attrs["units"]` of each.
    """

    detections: pandas.DataFrame
    levels: pandas.DataFrame
    level_percentiles: pandas.DataFrame


@dataclass(frozen=True, eq=False)
class Heard(Completed):
    """What was heard in a recording; it can be pickled.

    files        a row for each file, or the part of one that was recorded without a gap: path, begin_s in the
                 recording, first_sample in the file, samples, start_utc, recorder
    listened_s   s, how long the detector measured
    noise_db     mean level of the noise in the band, in `level_unit`; NaN where it was never known
    not_heard_s  why and for how many seconds it did not measure, or what it measured was clipped
    level_unit   "dB re 1 uPa", or "dB re full scale" without a calibration
    calibration  whence full_scale_level_db is known, "" where it is not
    full_scale_level_db  dB re 1 uPa (peak) of a sample of full scale, or None
    sample_rate  Hz
    channel      from 1
    band         (low, high), Hz: the part of what was asked for that the sample rate holds
    threshold_db, integration_time   SNR of a detection, dB; s
    """

    files: pandas.DataFrame
    listened_s: float
    noise_db: float
    not_heard_s: dict[str, float]
    level_unit: str
    calibration: str
    full_scale_level_db: float | None
    sample_rate: float
    channel: int
    band: tuple[float, float]
    threshold_db: float
    integration_time: float


def in_python(text: str) -> str:
    """What the program calls an option, as the argument is called."""
    return _OPTION.sub(lambda option: option[1].replace("-", "_"), text)


def joined(parts: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """What a stream gave for each block and at its end, as if it were given at the end."""
    whole = dict(parts[-1])
    rows = [part["rows"] for part in parts]
    whole["rows"] = {
        name: sum((of[name] for of in rows), []) if name == "file" else np.concatenate([of[name] for of in rows])
        for name in rows[-1]
    }
    if whole["levels"] is not None:
        of_intervals = ("begin_s", "level_db", "level_percentile_db")
        whole["levels"] = {
            **whole["levels"],
            **{name: np.concatenate([part["levels"][name] for part in parts]) for name in of_intervals},
        }
    return whole


def _frames(rows: dict[str, Any], settings: dict[str, Any], is_of_files: bool) -> dict[str, Any]:
    import pandas

    columns = rows["rows"]
    level = "level_db_re_1upa" if settings["is_calibrated"] else "level_db_re_full_scale"
    files = columns["file"] if is_of_files else [""] * len(columns["file"])
    detections = pandas.DataFrame(
        {
            "begin_s": columns["begin_s"],
            "duration_s": columns["duration_s"],
            "begin_utc": _utc(columns["begin_utc_us"]),
            "peak_s": columns["peak_s"],
            "snr_db": columns["snr_db"],
            level: columns["level_db"],
            "file": pandas.Series(files, dtype=object),
            "file_offset_s": columns["file_offset_s"],
            "validity": pandas.Series(np.where(columns["is_clipped"] > 0, "clipped", "good"), dtype=object),
        }
    )
    unit = settings["level_unit"]
    detections.attrs["units"] = {**_UNITS, level: unit}
    found = rows["levels"]
    if found is None:
        return {"detections": detections, "levels": pandas.DataFrame(), "level_percentiles": pandas.DataFrame()}
    bands = pandas.Index(found["frequency_hz"], name="frequency_hz")
    index = pandas.Index(found["begin_s"], name="begin_s")
    if found["is_dated"]:
        index = _utc(np.round(1e6 * found["begin_s"]).astype(np.int64)).rename("begin_utc")
    levels = pandas.DataFrame(found["level_db"], index, bands)
    by_percentile = pandas.MultiIndex.from_product([index, found["percentile"]], names=[index.name, "percentile"])
    percentiles = pandas.DataFrame(
        found["level_percentile_db"].reshape(len(by_percentile), len(bands)), by_percentile, bands
    )
    for frame in (levels, percentiles):
        frame.attrs["units"] = {"frequency_hz": "Hz", "level": unit}
    return {"detections": detections, "levels": levels, "level_percentiles": percentiles}


def _utc(microseconds: NDArray[np.int64]) -> pandas.DatetimeIndex:
    import pandas

    return pandas.DatetimeIndex(microseconds.view("datetime64[us]")).tz_localize("UTC")


def heard_of(given: dict[str, Any], channel: int, is_of_files: bool = False) -> Heard:
    """Of what the C++ module gave at the end of a recording."""
    import pandas

    settings = given["settings"]
    for remark in given["remarks"]:
        warnings.warn(in_python(remark), RecordingWarning, stacklevel=3)  # of who called who calls this
    paths, begins, first, samples, starts, recorders = map(list, zip(*given["files"]))
    files = pandas.DataFrame(
        {
            "path": paths if is_of_files else [""],
            "begin_s": begins,
            "first_sample": first,
            "samples": samples,
            "start_utc": _utc(np.array(starts, dtype=np.int64)),
            "recorder": recorders,
        }
    )
    files.attrs["units"] = {"begin_s": "s", "start_utc": "UTC"}
    return Heard(
        **_frames(given, settings, is_of_files),
        files=files,
        listened_s=given["listened_s"],
        noise_db=given["noise_db"],
        not_heard_s=given["not_heard_s"],
        level_unit=settings["level_unit"],
        calibration=in_python(settings["calibration"]),
        full_scale_level_db=settings["full_scale_level_db"],
        sample_rate=settings["sample_rate_hz"],
        channel=int(channel),
        band=settings["band_hz"],
        threshold_db=settings["threshold_db"],
        integration_time=settings["integration_time_s"],
    )


def completed_of(given: dict[str, Any], settings: dict[str, Any]) -> Completed:
    """Of what the C++ module gave for a block."""
    return Completed(**_frames(given, settings, is_of_files=False))
