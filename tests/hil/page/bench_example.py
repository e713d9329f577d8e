"""A small file of results, written by hand as earshot-bench writes it: two cases, the second of which failed."""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "hil/page"))
from bench_results import CaseResult, read_results

ROOT = Path(__file__).resolve().parents[3]


def calm() -> dict[str, Any]:
    """Three kilometres to the north in 1500 s, and half a kilometre to the east in the next 250 s."""
    return {
        "name": "calm",
        "given": "a vehicle near the source",
        "when": "nothing is wrong",
        "then": "it goes there",
        "bus": "CAN",
        "defence": "that it is steered there",
        "passed": True,
        "wrong": [],
        "faults": [],
        "expected_end": "completed, the source is reached",
        "expected_rules": [],
        "others_may_fire": False,
        "refuses_navigation": None,
        "refuses_commands": None,
        "loses_nothing": False,
        "least_decisions": 0,
        "comes_up": False,
        "releases_weight": False,
        "refuses_frames": False,
        "refuses_to_fly": False,
        "end": "completed, the source is reached",
        "events": [],
        "setpoints": 1749,
        "navigation_refused": 0,
        "commands_refused": 0,
        "at_sea_s": 1750.0,
        "wall_s": 12.5,
        "frames_sent": 31000,
        "frames_received": 41000,
        "frames_lost_by_kernel": 0,
        "frames_afflicted": 0,
        "start_m": [1000.0, 2000.0],
        "source_m": [4000.0, 3000.0],
        "halt_polygon_m": [[0.0, 0.0], [10000.0, 0.0], [10000.0, 10000.0], [0.0, 10000.0]],
        "track": [[0.0, 1000.0, 2000.0, 300.0], [1500.0, 4000.0, 2000.0, 310.0], [1750.0, 4000.0, 2500.0, 12.5]],
        "trace": [
            {"time_s": 1749.0, "from_earshot": False, "pgn": 127250, "source": 36, "data": "c68e3dff7fff7ffc"},
            {"time_s": 1749.0, "from_earshot": True, "pgn": 65290, "source": 64, "data": "0102030405060708"},
        ],
    }


def deaf() -> dict[str, Any]:
    """The same way, on which a fault acts from 500 s to 1000 s and a rule fires at 600 s."""
    return calm() | {
        "name": "deaf",
        "defence": "",
        "when": "the hydrophone is open for a while",
        "passed": False,
        "wrong": ["the rule hydrophone_deaf did not fire", "the rule leak fired at 600 s"],
        "faults": [{"words": "deaf from 500 s for 500 s", "from_s": 500.0, "until_s": 1000.0}],
        "expected_rules": ["hydrophone_deaf"],
        "events": [
            {
                "time_s": 600.0,
                "rule": "leak",
                "begins": True,
                "response": "release",
                "measure": 1.0,
                "limit": None,
            },
            {
                "time_s": 610.0,
                "rule": "leak",
                "begins": False,
                "response": "release",
                "measure": 0.0,
                "limit": None,
            },
        ],
        "trace": [
            {"time_s": time, "from_earshot": False, "pgn": 65291, "source": 40, "data": f"{index:02x}"}
            for index, time in enumerate([590.0, 597.0, 600.0, 601.0, 602.0])
        ],
    }


def results_of(*entries: dict[str, Any]) -> list[CaseResult]:
    """As they are read from a file."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "results.json")
        file.write_text(json.dumps({"cases": entries}))
        return read_results(file)
