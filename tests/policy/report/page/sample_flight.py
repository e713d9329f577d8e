"""Flights made by hand for the tests of the page: every answer can be read off their rules."""

import base64
import gzip
import json
import random
from collections.abc import Callable
from typing import Any

Flight = dict[str, Any]

STEP_S, END_S = 10, 1200  # rows of the strips, from 0 to the end
DECISION_S = (0, 300, 600, 900)
DETECTION_THRESHOLD_DB = 10.0
DIRECTIONS = ("N", "NE", "E", "SE")
NASTY_NAME = 'flight <script>document.title="owned"</script><img src=x onerror=alert(1)>'


def north_m(time_s: float) -> float:
    """It goes due north at 2 m/s, one and a half kilometres east of the mission's origin."""
    return 2000.0 + 2.0 * time_s


def place(north: float, east: float) -> dict[str, float]:
    return {"north_m": north, "east_m": east}


def belief(row: int, column: int, cells: int = 10, side_m: float = 10_000.0) -> Flight:
    """The likeliest cell is given; every other one is the less likely, the farther it lies from it."""
    far = [max(abs(r - row), abs(c - column)) for r in range(cells) for c in range(cells)]
    area = bytes(min(255, 36 * ring) for ring in far)
    middle = side_m / cells
    likeliest = place((row + 0.5) * middle, (column + 0.5) * middle)
    return {
        "is_the_policys": True,
        "cells_north": cells,
        "cells_east": cells,
        "south_west": place(0.0, 0.0),
        "size": place(side_m, side_m),
        "area_of_cell": base64.b64encode(area).decode(),
        "likeliest": likeliest,
        "likeliest_share": 0.125,
        "mean": likeliest,
        "ellipse": {"semi_major_m": 1500.0, "semi_minor_m": 700.0, "bearing_deg": 45.0},
        "spread_m": 1655.0,
        "area_50_km2": 12.0,
        "area_90_km2": 60.0,
    }


def action(name: str, score: float, regret: float) -> Flight:
    return {
        "name": name,
        "score": score,
        "probability": 0.5,
        "expected_snr_db": 8.0 + score,
        "expected_snr_spread_db": 3.5,
        "detected": 0.25,
        "found": 0.05,
        "approach_m": -120.0,
        "regret_steps": regret,
    }


def decision(index: int) -> Flight:
    """The first was too faint to measure, the second has a bearing with its mirror image, the last declares the source found."""
    time_s = DECISION_S[index]
    at = place(north_m(time_s), 1500.0)
    return {
        "step": index,
        "time_s": time_s,
        "at": at,
        "snr_db": (-3.0, 6.5, 12.25, 15.0)[index],
        "too_faint": index == 0,
        "detected": index >= 2,
        "bearing": {"toward_deg": 70.0, "deviation_deg": 5.0, "mirror_deg": 290.0} if index == 1 else None,
        "waypoint": place(at["north_m"] + 600.0, 1500.0),
        "direction": DIRECTIONS[index],
        "sweeping": index == 0,
        "overridden": index == 2,
        "declared": place(7000.0, 6000.0) if index == 3 else None,
        "reasons": [
            f"Reason {index}: the sound grows to the {DIRECTIONS[index]}.",
            "East was second best: it costs 0.5 steps.",
        ],
        "actions": [action(name, 4.0 - abs(i - index), 0.5 * abs(i - index)) for i, name in enumerate(DIRECTIONS)],
        "taken": index,
        "second_best": (index + 1) % 4,
        "hypotheses": [
            {
                "ocean": "Munk profile",
                "level_db": 3.0,
                "spread_db": 4.0,
                "silence_share": 0.1,
                "is_moving": False,
                "share": 0.75,
            },
            {
                "ocean": "Arctic duct",
                "level_db": -3.0,
                "spread_db": 6.0,
                "silence_share": 0.0,
                "is_moving": True,
                "share": 0.25,
            },
        ],
        "observed": [
            {"name": "distance to the south edge", "value": "2.0 km", "part": 0.02},
            {"name": "likeliest distance", "value": "5.5 km", "part": -0.7},
        ],
        "belief": belief(3 + index, 2 + index),
    }


def strips(times: list[int], row: Callable[[int], Flight]) -> Flight:
    rows = [{"time_s": time_s} | row(time_s) for time_s in times]
    return {name: [one[name] for one in rows] for name in rows[0]}


def strip_row(time_s: int) -> Flight:
    latest = max(i for i, decided_s in enumerate(DECISION_S) if decided_s <= time_s)
    return {
        "north_m": north_m(time_s),
        "east_m": 1500.0,
        "depth_m": 100.0 + time_s / 100.0,
        "heading_deg": 0.0,
        "speed_mps": 2.0,
        "depth_set_m": 110.0,
        "heading_set_deg": 5.0,
        "speed_set_mps": 2.1,
        "waypoint_north_m": north_m(DECISION_S[latest]) + 600.0,
        "waypoint_east_m": 1500.0,
        "snr_db": (-3.0, 6.5, 12.25, 15.0)[latest],
        "snr_too_faint": latest == 0,
        "expected_snr_db": 9.0,
        "mismatch_bits": -2.0,
        "battery_percent": 90.0 - time_s / 100.0,
        "turn_time_ms": 0.125,
    }


EVENTS = (
    (0, "journal", "mission begins"),
    (0, "order", "order 7: start"),
    (1, "answer", "order 7 is accepted"),
    (1, "state", "SEARCHING"),
    (450, "link", "port 2 is DOWN"),
    (600, "rule", "rule 12 fired: depth below 108 m"),
    (601, "other", "currents <b>grow</b>"),
    (900, "decision", "step 3: declared found"),
)


def small() -> Flight:
    """Twenty minutes in a square of 10 km about 45° N, 30° W, with everything that a flight can have."""
    corners = [place(500.0, 500.0), place(500.0, 9500.0), place(9500.0, 9500.0), place(9500.0, 500.0)]
    return {
        "format": 1,
        "name": NASTY_NAME,
        "began_utc": "2026-11-22T15:04:00Z",
        "is_simulated": True,
        "is_over": True,
        "verdict": {"text": "Source found: declared at step 3, 707 m from it", "found": True},
        "sentences": ["The vehicle went north."],
        "shortcomings": ["The sound was not recorded after step 2."],
        "facts": [{"name": "frequency of the source", "value": "20.0 Hz", "meaning": "A fin whale calls so low."}],
        "mission": {
            "area": {"south_m": 0.0, "west_m": 0.0, "north_m": 10_000.0, "east_m": 10_000.0},
            "origin": {"latitude_deg": 45.0, "longitude_deg": -30.0},
            "fence_inside": corners,
            "fence_save": [],
            "fence_halt": [place(-1000.0, -1000.0), place(-1000.0, 11_000.0), place(11_000.0, 5000.0)],
            "no_surface_zones": [[place(8000.0, 8000.0), place(8000.0, 9000.0), place(9000.0, 9000.0)]],
            "safe_point": place(1000.0, 1000.0),
            "detection_threshold_db": DETECTION_THRESHOLD_DB,
            "source_frequency_hz": 20.0,
            "search_depth_m": 110.0,
            "max_depth_m": 200.0,
            "search_speed_mps": 2.0,
            "step_length_m": 600.0,
            "max_steps": 4,
        },
        "health": {
            "state": "DONE",
            "end_reason": "source found",
            "response": "warn",
            "authority": "COMMAND",
            "steps_taken": 4,
            "counters": [{"name": "fixes refused", "value": 3}, {"name": "orders refused", "value": 0}],
            "ports": [
                {"port": 1, "link_up": True, "received": 5000, "lost": 0, "malformed": 0, "unsent": 0},
                {"port": 2, "link_up": False, "received": 17, "lost": 4, "malformed": 1, "unsent": 2},
            ],
        },
        "strips": strips(list(range(0, END_S + 1, STEP_S)), strip_row),
        "decisions": [decision(i) for i in range(4)],
        "events": [{"time_s": time_s, "kind": kind, "text": text} for time_s, kind, text in EVENTS],
        "sound": {
            "frequency_hz": [10.0, 20.0, 30.0, 40.0],
            "time_s": [100.0, 300.0, 500.0, 700.0, 900.0, 1100.0],
            # Silent but for the lowest frequency in the first row, which is as loud as can be.
            "level_db_re_1upa2_per_hz": {
                "least": 60.0,
                "most": 90.0,
                "cells": base64.b64encode(bytes([255, *[0] * 23])).decode(),
            },
        },
        "truth": {
            "source": place(7500.0, 6500.0),
            "source_moves": False,
            "snr_of_range": {"range_m": [500.0, 1000.0, 2000.0], "snr_db": [20.0, 12.0, 5.0]},
        },
        "open_at_step": 1,
    }


def at_sea() -> Flight:
    """Nobody knows where the source is, nor the latitude."""
    flight = small() | {"is_simulated": False, "truth": None, "sound": None, "open_at_step": None, "began_utc": None}
    flight["verdict"] = {"text": "The vehicle declared the source found at step 3", "found": None}
    flight["mission"] = flight["mission"] | {"origin": None}
    return flight


def under_way(decisions: int = 2) -> Flight:
    """Up to the moment before its next decision."""
    flight = small() | {"is_over": False, "open_at_step": None}
    end_s = DECISION_S[decisions]
    rows = [row for row, time_s in enumerate(flight["strips"]["time_s"]) if time_s < end_s]
    flight["strips"] = {name: [column[row] for row in rows] for name, column in flight["strips"].items()}
    flight["decisions"] = flight["decisions"][:decisions]
    flight["events"] = [event for event in flight["events"] if event["time_s"] < end_s]
    return flight


def big(rows: int = 8000, decisions: int = 100, cells: int = 50) -> Flight:
    """Twelve hours, as the largest report has them."""
    flight = small() | {"open_at_step": None}
    end_s = 12 * 3600
    draw = random.Random(59)
    times = [round(i * end_s / (rows - 1)) for i in range(rows)]

    def noisy(time_s: int) -> Flight:
        values = strip_row(min(time_s, END_S))
        values["north_m"] = 1000.0 + 8000.0 * time_s / end_s
        values["east_m"] = 1000.0 + 4000.0 * (time_s % 7200) / 7200
        return values | {"snr_db": round(draw.gauss(8.0, 4.0), 2), "turn_time_ms": round(draw.expovariate(8.0), 3)}

    flight["strips"] = strips(times, noisy)
    every_s = end_s / decisions
    flight["decisions"] = []
    for step in range(decisions):
        one = decision(step % 4) | {"step": step, "time_s": round(step * every_s), "declared": None}
        one["at"] = place(1000.0 + 8000.0 * step / decisions, 1000.0 + 4000.0 * (step % 17) / 17)
        one["belief"] = belief(step % cells, (7 * step) % cells, cells) | {
            "area_of_cell": base64.b64encode(
                bytes(max(0, byte - draw.randrange(9)) for byte in rings(step, cells))
            ).decode()
        }
        flight["decisions"].append(one)
    flight["events"] = [{"time_s": round(i * end_s / 1000), "kind": "other", "text": f"event {i}"} for i in range(1000)]
    return flight


def rings(step: int, cells: int) -> list[int]:
    """Three rings about where the sound was heard: what a belief looks like that knows a distance."""
    row, column = 0.5 * cells + 0.2 * (step % 20), 0.4 * cells + 0.1 * (step % 30)
    far = [((r - row) ** 2 + (c - column) ** 2) ** 0.5 for r in range(cells) for c in range(cells)]
    return [
        min(255, round(60 * min(abs(d - ring) for ring in (0.05 * cells, 0.25 * cells, 0.45 * cells)))) for d in far
    ]


def page_with(page: str, flight: Flight, is_compressed: bool = False) -> str:
    """The flight in the page, as page_template.cpp puts it there."""
    text = json.dumps(flight)
    kind = "gzip" if is_compressed else "json"
    data = base64.b64encode(gzip.compress(text.encode())).decode() if is_compressed else text.replace("<", "\\u003c")
    return page.replace("<!--flight-->", f'<script id="flight" type="application/{kind}">{data}</script>', 1)
