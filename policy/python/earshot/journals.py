"""Journals of flights, and logs of a vehicle's bus, as tables."""

from __future__ import annotations

import json
import os
import warnings
from typing import TYPE_CHECKING, Any

from earshot import arguments
from earshot.core import journal_fields, journal_records, printable
from earshot.errors import BadInput

if TYPE_CHECKING:
    import pandas

__all__ = ["JournalWarning", "read_journal"]

# Units of numbers that have none in their type: the ends of their names.
_UNIT_OF_ENDING = {
    "_db_re_1upa": "dB re 1 uPa",
    "_db": "dB",
    "_mps": "m/s",
    "_rad": "rad",
    "_deg": "deg",
    "_hz": "Hz",
    "_percent": "%",
    "_bits": "bit",
    "_bytes": "B",
    "_us": "us",
    "_s": "s",
    "_m": "m",
}


class JournalWarning(UserWarning):
    """The journal is damaged, or lacks records or its end."""


def _unit(name: str, of_type: str) -> str:
    if of_type and of_type != "dB":  # of a level the name says against what
        return of_type
    return next((unit for ending, unit in _UNIT_OF_ENDING.items() if name.endswith(ending)), of_type)


def _flat(fields: dict[str, Any] | None, prefix: str = "") -> dict[str, Any]:
    """{"vehicle": {"mass": 1}} as {"vehicle.mass": 1}; a list stays one value."""
    flat: dict[str, Any] = {}
    for name, value in (fields or {}).items():
        if isinstance(value, dict):
            flat.update(_flat(value, f"{prefix}{name}."))
        else:
            flat[prefix + name] = value
    return flat


def read_journal(path: str | os.PathLike[str]) -> dict[str, pandas.DataFrame]:
    """What a flight's journal holds, or a log that lcm-logger wrote of a vehicle's bus: a DataFrame for each topic.

    path  a journal (.lcmlog), the folder of a flight, or a log

    Topics are those of `earshot journal --jsonl`: "navigation", "snr", "setpoint", "decision", "health", "mission" and
    others; "unknown" holds what cannot be read. The index is the record's time, UTC (a simulator's clock begins in
    1970); the column `record_number` counts all records that the journal was given. The other columns are the fields of
    the message, in SI units, which their names state; a number that is not known is NaN; states and the like are words;
    what a message holds many of is a list; a group's fields stand behind its name and a point.

    In `attrs` of each frame: `units` and `meanings`, by column; `is_dated`, whether the clock has dates; `is_bus_log`.

    Warns (JournalWarning) of what the journal lacks. Raises BadInput for what is no journal, BadType for no path.
    """
    import pandas

    file = arguments.path("path", path)
    try:
        journal = journal_records(file)
    except BadInput as bad:
        raise bad.about(str(file), printable(file), key="path", value=path) from None
    lacks = [
        f"{journal[name]} {what}"
        for name, what in (("missing_records", "records are missing"), ("damaged_bytes", "bytes are damaged"))
        if journal[name]
    ]
    lacks += ["its end is torn"] if journal["is_cut"] else []
    described = journal_fields()
    frames = {}
    undated = 0
    for topic, records in journal["records"].items():
        numbers, times, texts = zip(*records)
        frame = pandas.DataFrame([{"record_number": n, **_flat(json.loads(text))} for n, text in zip(numbers, texts)])
        unknown = [column for column in frame if frame[column].isna().all()]
        frame[unknown] = frame[unknown].astype(float)
        index = pandas.DatetimeIndex(pandas.to_datetime(list(times), unit="us", utc=True, errors="coerce"), name="time")
        undated += int(index.isna().sum())
        frame.index = index
        fields = described.get(topic, {})
        units = {column: _unit(str(column), fields.get(column, ("", ""))[0]) for column in frame}
        frame.attrs.update(
            units={column: unit for column, unit in units.items() if unit},
            meanings={column: meaning for column, (_, meaning) in fields.items() if meaning and column in frame},
            is_dated=journal["is_dated"],
            is_bus_log=journal["is_bus_log"],
        )
        frames[topic] = frame
    lacks += [f"{undated} times lie outside of the years 1678 to 2261 and are NaT"] if undated else []
    if lacks:
        warnings.warn(f"{printable(file)}: {', '.join(lacks)}", JournalWarning, stacklevel=2)
    return frames
