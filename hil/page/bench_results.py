"""What earshot-bench wrote of its cases (results.json), read and judged.

Lengths are in metres, times in seconds since the flight began. A number that JSON cannot hold (NaN) is None.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any


class BadResults(ValueError):
    """A file that is not what earshot-bench writes; the text says what is wrong with it."""


@dataclass(frozen=True)
class Place:
    """In the mission's plane."""

    north_m: float
    east_m: float


@dataclass(frozen=True)
class Fault:
    words: str
    from_s: float
    until_s: float | None  # None: to the end

    def acts_at(self, time_s: float) -> bool:
        return self.from_s <= time_s and (self.until_s is None or time_s < self.until_s)


@dataclass(frozen=True)
class RuleEvent:
    """A rule of the mission that fired, or ceased to hold."""

    time_s: float
    rule: str
    begins: bool
    response: str
    measure: float | None
    limit: float | None


@dataclass(frozen=True)
class TrackPoint:
    """Where the vehicle truly was."""

    time_s: float
    place: Place
    depth_m: float


@dataclass(frozen=True)
class TracedFrame:
    time_s: float
    from_earshot: bool
    pgn: int
    source: int
    data: str  # hexadecimal; of a message over LCM the first 64 bytes
    channel: str = ""  # of a message over LCM, which has neither group nor source


@dataclass(frozen=True)
class CaseResult:
    """One case: what it does, what had to come of it, and what did."""

    name: str
    given: str
    when: str
    then: str
    bus: str  # "CAN" or "LCM"
    defence: str  # what makes it come so; empty: the rules that must fire
    wrong: list[str]  # empty: it passed
    faults: list[Fault]
    expected_end: str
    expected_rules: list[str]
    others_may_fire: bool
    refuses_navigation: bool | None  # at least one fix has to be refused, or none; None: as it comes
    refuses_commands: bool | None
    loses_nothing: bool  # no frame or message may be lost that arrived faster than it was read
    least_decisions: int  # that are taken after the first fault
    comes_up: bool  # at the end the vehicle must be at the surface
    releases_weight: bool
    refuses_frames: bool  # the kernel must lack room for a frame
    refuses_to_fly: bool
    end: str
    events: list[RuleEvent]
    counts: dict[str, int]  # COUNTS
    at_sea_s: float
    wall_s: float
    start: Place
    source: Place
    halt_polygon: list[Place]
    track: list[TrackPoint]
    trace: list[TracedFrame]

    @property
    def passed(self) -> bool:
        return not self.wrong

    @property
    def first_firing(self) -> RuleEvent | None:
        return next((event for event in self.events if event.begins), None)


COUNTS = (
    "setpoints",
    "navigation_refused",
    "commands_refused",
    "frames_sent",
    "frames_received",
    "frames_lost_by_kernel",
    "frames_afflicted",
)


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


def _wish(value: Any) -> bool | None:
    return None if value is None else bool(value)


def _case_of(entry: dict[str, Any]) -> CaseResult:
    if bool(entry["passed"]) == bool(entry["wrong"]):
        raise ValueError(f"{entry['name']}: passed and wrong contradict each other")
    texts = {key: str(entry[key]) for key in ("name", "given", "when", "then", "defence", "bus", "expected_end", "end")}
    return CaseResult(
        **texts,
        wrong=[str(what) for what in entry["wrong"]],
        faults=[Fault(str(f["words"]), float(f["from_s"]), _number(f["until_s"])) for f in entry["faults"]],
        expected_rules=[str(rule) for rule in entry["expected_rules"]],
        others_may_fire=bool(entry["others_may_fire"]),
        refuses_navigation=_wish(entry["refuses_navigation"]),
        refuses_commands=_wish(entry["refuses_commands"]),
        loses_nothing=bool(entry["loses_nothing"]),
        least_decisions=int(entry["least_decisions"]),
        comes_up=bool(entry["comes_up"]),
        releases_weight=bool(entry["releases_weight"]),
        refuses_frames=bool(entry["refuses_frames"]),
        refuses_to_fly=bool(entry["refuses_to_fly"]),
        events=[_event_of(event) for event in entry["events"]],
        counts={key: int(entry[key]) for key in COUNTS},
        at_sea_s=float(entry["at_sea_s"]),
        wall_s=float(entry["wall_s"]),
        start=_place_of(entry["start_m"]),
        source=_place_of(entry["source_m"]),
        halt_polygon=[_place_of(corner) for corner in entry["halt_polygon_m"]],
        track=[TrackPoint(float(t), _place_of((n, e)), float(d)) for t, n, e, d in entry["track"]],
        trace=[_frame_of(frame) for frame in entry["trace"]],
    )


def _number(value: Any) -> float | None:
    return None if value is None else float(value)


def _place_of(pair: Any) -> Place:
    north, east = pair
    return Place(float(north), float(east))


def _event_of(event: dict[str, Any]) -> RuleEvent:
    return RuleEvent(
        time_s=float(event["time_s"]),
        rule=str(event["rule"]),
        begins=bool(event["begins"]),
        response=str(event["response"]),
        measure=_number(event["measure"]),
        limit=_number(event["limit"]),
    )


def _frame_of(frame: dict[str, Any]) -> TracedFrame:
    return TracedFrame(
        time_s=float(frame["time_s"]),
        from_earshot=bool(frame["from_earshot"]),
        pgn=int(frame["pgn"]),
        source=int(frame["source"]),
        data=str(frame["data"]),
        channel=str(frame.get("channel", "")),
    )
