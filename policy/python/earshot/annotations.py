"""What an annotator marked in a recording: tables of selections, and detections scored against them."""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from earshot import arguments, core
from earshot.arguments import is_path, number
from earshot.errors import BadInput, BadType
from earshot.heard import Heard, RecordingWarning

if TYPE_CHECKING:
    import pandas

__all__ = ["Score", "read", "score"]

_MOST_CHANNELS = 65_535

Selections = Union[str, "os.PathLike[str]", "pandas.DataFrame"]


@dataclass(frozen=True)
class Score:
    """How detections compare with selections, as the JSON of `earshot listen --score` has it.

    hits                   pairs of a selection and a detection, each used once
    misses, false_alarms   selections and detections that are in none
    recall                 hits / selections; NaN where there are none
    precision              hits / detections; NaN where there are none
    false_alarms_per_hour  of sound that was listened to
    """

    selections: int
    detections: int
    hits: int
    misses: int
    false_alarms: int
    recall: float
    precision: float
    false_alarms_per_hour: float


def read(path: str | os.PathLike[str]) -> pandas.DataFrame:
    """Reads a selection table of Raven, labels of Audacity, or a CSV table (start, end, label): a row a selection.

    begin_s, end_s   s, as the table counts them
    low_hz, high_hz  Hz, NaN where it has none
    channel          from 1, <NA> where it has none
    begin_file       name of the file, "" where it has none
    file_offset_s    s, of the begin in that file, NaN where it has none

    Raises BadInput with file, line, key and value of the first of all problems, which its text lists; BadType for no
    path.
    """
    import pandas

    file = arguments.path("path", path)
    try:
        rows = core.selections(file)
    except BadInput as bad:
        raise bad.about(str(file), core.printable(file), key="path", value=path) from None
    begins, ends, lows, highs, channels, files, offsets = map(list, zip(*rows)) if rows else ([] for _ in range(7))
    has_frequency = np.array(highs, dtype=float) > 0.0
    table = pandas.DataFrame(
        {
            "begin_s": np.array(begins, dtype=float),
            "end_s": np.array(ends, dtype=float),
            "low_hz": np.where(has_frequency, np.array(lows, dtype=float), np.nan),
            "high_hz": np.where(has_frequency, np.array(highs, dtype=float), np.nan),
            "channel": pandas.array([channel or None for channel in channels], dtype="Int64"),
            "begin_file": pandas.Series(files, dtype=object),
            "file_offset_s": np.array([np.nan if offset is None else offset for offset in offsets], dtype=float),
        }
    )
    table.attrs["units"] = {"begin_s": "s", "end_s": "s", "low_hz": "Hz", "high_hz": "Hz", "file_offset_s": "s"}
    return table


def score(
    detections: Heard | pandas.DataFrame,
    truth: Selections,
    *,
    tolerance_s: float = 2.0,
    listened_s: float | None = None,
) -> Score:
    """Scores detections against what is truly there, as `earshot listen --score` does.

    detections   what `earshot.listen` gave; or a DataFrame of a detector of your own, with begin_s and end_s or
                 duration_s, from the start of the recording
    truth        a file for `read`, or what it gave, or a DataFrame with begin_s and end_s
    tolerance_s  0 to 3600 s: a detection and a selection are a pair when they overlap or lie no further apart
    listened_s   s of sound, for false alarms per hour, where `detections` is a DataFrame

    Selections of other files, channels and frequencies than were listened to do not count, where `detections` is that
    of `earshot.listen`: RecordingWarning gives their number. Of an array, the names of files in `truth` do not count.

    Raises BadInput with the argument as `key`, also where the table is not of these files or none of it was listened
    to; BadType for what is of another kind.
    """
    import pandas

    tolerance = number("tolerance_s", tolerance_s)
    table = truth if isinstance(truth, pandas.DataFrame) else read(truth)
    intervals = _intervals("truth", table)
    if isinstance(detections, Heard):
        if listened_s is not None:
            raise BadInput("listened_s: not with what earshot.listen gave", key="listened_s", value=listened_s)
        found = _intervals("detections", detections.detections)
        listened = detections.listened_s
        intervals = _placed(detections, table, intervals, truth)
    elif isinstance(detections, pandas.DataFrame):
        found = _intervals("detections", detections)
        listened = number("listened_s", listened_s) if listened_s is not None else np.nan
        if not listened > 0.0:
            raise BadInput("listened_s: must be given with a DataFrame, and be more than 0", key="listened_s")
    else:
        raise BadType("detections: must be what earshot.listen gave, or a DataFrame", key="detections")
    return Score(**core.score(truth=intervals, found=found, tolerance_s=tolerance, listened_s=listened))


def _column(name: str, table: pandas.DataFrame, of: str) -> Any:
    """Numbers, NaN where one is not known."""
    if of not in table:
        raise BadInput(f"{name}: has no column {of}", key=name)
    if table[of].ndim != 1:
        raise BadInput(f"{name}: has two columns {of}", key=name)
    try:
        return table[of].to_numpy(dtype=float, na_value=np.nan)
    except (TypeError, ValueError):
        raise BadType(f"{name}: {of} must be numbers", key=name) from None


def _intervals(name: str, table: pandas.DataFrame) -> list[tuple[float, float]]:
    begins = _column(name, table, "begin_s")
    ends = _column(name, table, "end_s") if "end_s" in table else begins + _column(name, table, "duration_s")
    if not np.all((begins >= 0.0) & (begins <= ends) & np.isfinite(ends)):
        raise BadInput(f"{name}: each must begin at 0 s or later, and end no earlier than it begins", key=name)
    return list(zip(begins.tolist(), ends.tolist()))


def _placed(
    heard: Heard, table: pandas.DataFrame, intervals: list[tuple[float, float]], truth: Selections
) -> list[tuple[float, float]]:
    """Where the selections lie in what was heard, without those that do not count."""
    import pandas

    def numbers(name: str) -> Any:
        return _column("truth", table, name) if name in table else np.full(len(table), np.nan)

    lows, highs, offsets = (numbers(name) for name in ("low_hz", "high_hz", "file_offset_s"))
    for column, values in (("low_hz", lows), ("high_hz", highs), ("file_offset_s", offsets)):
        if np.isinf(values).any():
            raise BadInput(f"truth: {column} must be finite, or NaN where it is not known", key="truth")
    channels = np.nan_to_num(numbers("channel"), nan=0.0, posinf=-1.0)
    if not np.all((channels >= 0.0) & (channels <= _MOST_CHANNELS) & (channels == np.floor(channels))):
        raise BadInput(f"truth: channel must be a whole number, 1 to {_MOST_CHANNELS}", key="truth")
    names = [""] * len(table)
    if heard.files["path"].iloc[0] != "" and "begin_file" in table:
        if table["begin_file"].ndim != 1:
            raise BadInput("truth: has two columns begin_file", key="truth")
        names = ["" if pandas.isna(file) else str(file) for file in table["begin_file"].tolist()]
        for file in filter(None, names):
            arguments.path("truth", file)
    selected = [
        (begin, end, max(low, 0.0), max(high, 0.0), int(channel), file, None if np.isnan(offset) else offset)
        for (begin, end), low, high, channel, file, offset in zip(
            intervals,
            np.nan_to_num(lows).tolist(),
            np.nan_to_num(highs).tolist(),
            channels.tolist(),
            names,
            offsets.tolist(),
        )
    ]
    name = arguments.path("truth", truth) if is_path(truth) else "truth"
    files = heard.files
    try:
        placed, remarks = core.placed(
            selected=selected,
            name=name,
            files=list(zip(files["path"], files["first_sample"], files["samples"])),
            rate=heard.sample_rate,
            channel=heard.channel,
            band=heard.band,
        )
    except BadInput as bad:
        raise BadInput(str(bad), key="truth", value=truth) from None
    for remark in remarks:
        warnings.warn(remark, RecordingWarning, stacklevel=3)
    return placed
