"""What earshot-bench wrote of its cases (results.json), read and judged."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any


class BadResults(ValueError):
    """A file that is not what earshot-bench writes; the text says what is wrong with it."""


@dataclass(frozen=True)
class CaseResult:
    """One case: what it does, and what came of it."""

    name: str
    given: str
    when: str
    then: str
    bus: str  # "CAN" or "LCM"
    end: str
    wall_s: float
    faults: list[str]  # in words
    wrong: list[str]  # empty: it passed
    written: dict[str, Any]  # all of it, for the page (policy/report/page/source/bench.ts)

    @property
    def passed(self) -> bool:
        return not self.wrong


def read_results(path: Path) -> list[CaseResult]:
    """Every case, in the order in which it was flown. Raises BadResults naming the file."""
    try:
        return [_case_of(entry) for entry in json.loads(path.read_text(encoding="utf-8"))["cases"]]
    except OSError as e:
        raise BadResults(f"{path}: {e.strerror}") from e
    except KeyError as e:
        raise BadResults(f"{path}: not what earshot-bench writes: {e.args[0]} is missing") from e
    except (TypeError, ValueError, AttributeError, RecursionError) as e:
        raise BadResults(f"{path}: not what earshot-bench writes: {e}") from e


def _case_of(entry: dict[str, Any]) -> CaseResult:
    if bool(entry["passed"]) == bool(entry["wrong"]):
        raise ValueError(f"{entry['name']}: passed and wrong contradict each other")
    return CaseResult(
        **{key: str(entry[key]) for key in ("name", "given", "when", "then", "bus", "end")},
        wall_s=float(entry["wall_s"]),
        faults=[str(fault["words"]) for fault in entry["faults"]],
        wrong=[str(what) for what in entry["wrong"]],
        written=entry,
    )
