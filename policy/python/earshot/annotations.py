"""What an annotator marked in a recording: tables of selections, and detections scored against them."""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from earshot import core
from earshot.arguments import number
from earshot.errors import BadInput, BadType
from earshot.heard import Heard, RecordingWarning

if TYPE_CHECKING:
    import pandas

__all__ = ["Score", "read", "score"]

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

    if not isinstance(path, (str, os.PathLike)):
        raise BadType("path: must be a text or a path", key="path", value=path)
    rows = core.selections(path)
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


def _intervals(name: str, table: pandas.DataFrame) -> list[tuple[float, float]]:
    def column(of: str) -> Any:
        if of not in table:
            raise BadInput(f"{name}: has no column {of}", key=name)
        try:
            return table[of].to_numpy(dtype=float)
        except (TypeError, ValueError):
            raise BadType(f"{name}: {of} must be numbers", key=name) from None

    begins = column("begin_s")
    ends = column("end_s") if "end_s" in table else begins + column("duration_s")
    if not np.all((begins >= 0.0) & (begins <= ends) & np.isfinite(ends)):
        raise BadInput(f"{name}: each must begin at 0 s or later, and end no earlier than it begins", key=name)
    return list(zip(begins.tolist(), ends.tolist()))


def _placed(
    heard: Heard, table: pandas.DataFrame, intervals: list[tuple[float, float]], truth: Selections
) -> list[tuple[float, float]]:
    """Where the selections lie in what was heard, without those that do not count."""
    import pandas

    def optional(name: str, unknown: Any) -> list[Any]:
        return table[name].tolist() if name in table else [unknown] * len(table)

    def known(value: Any, unknown: Any) -> Any:
        return unknown if pandas.isna(value) else value

    is_of_files = heard.files["path"].iloc[0] != ""
    columns = zip(
        intervals,
        *(optional(name, None) for name in ("low_hz", "high_hz", "channel", "begin_file", "file_offset_s")),
    )
    selected = [
        (
            begin,
            end,
            float(known(low, 0.0)),
            float(known(high, 0.0)),
            int(known(channel, 0)),
            str(known(file, "")) if is_of_files else "",
            None if known(offset, None) is None else float(offset),
        )
        for (begin, end), low, high, channel, file, offset in columns
    ]
    name = "truth" if not isinstance(truth, (str, os.PathLike)) else os.fspath(truth)
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
