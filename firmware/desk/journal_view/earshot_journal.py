"""A journal of Earshot in Python: its records as dictionaries, and what happened in sentences.

    import earshot_journal

    for record in earshot_journal.records("out/shown"):
        if record.topic == "decision":
            print(record.time_s, record.fields["snr_db"])
    print("\\n".join(earshot_journal.events("out/shown")))

`earshot journal` reads the file, so that fields and sentences are those of its files and its lines. The module needs
that program and Python alone.
"""

import json
import subprocess
import tempfile
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

COMMAND = ("earshot", "journal")
_LACKS_SOMETHING = 1  # its exit status


class JournalWarning(UserWarning):
    """The journal is damaged, or lacks records or its end."""


@dataclass(frozen=True)
class Record:
    """One record, as `earshot journal --jsonl` writes it."""

    number: int
    """counts all records that the journal was given, from 0"""
    time_s: float
    """of the mission's clock: at sea since 1970, UTC"""
    channel: str
    topic: str
    """"health", "decision", "navigation"; "unknown" for one that cannot be read"""
    fields: dict[str, Any]
    """by name, with units in the names; None where a number is not known"""


def records(journal: str | Path, command: Sequence[str] = COMMAND) -> Iterator[Record]:
    """All records of a journal, or of the journal in a flight's folder, in their order.

    Raises ValueError with what the program prints when it is no journal. Warns of what it lacks (JournalWarning).
    """
    with tempfile.TemporaryDirectory() as folder:
        lines = Path(folder) / "records.jsonl"
        _run([*command, str(journal), "--jsonl", str(lines)])
        with lines.open(encoding="utf-8") as file:
            for line in file:
                record = json.loads(line)
                yield Record(**{**record, "fields": record["fields"] or {}})


def events(journal: str | Path, command: Sequence[str] = COMMAND) -> list[str]:
    """What happened, a line each: orders, states, decisions, rules that acted, and what the journal lacks."""
    return _run([*command, str(journal)]).splitlines()


def _run(command: list[str]) -> str:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode == _LACKS_SOMETHING:
        warnings.warn(done.stderr.strip(), JournalWarning, stacklevel=3)
    elif done.returncode != 0:
        raise ValueError(done.stderr.strip())
    return done.stdout
