"""`earshot.fly`: a flight by the programs, and what it leaves.

Run by ctest (run in this folder).
"""

import contextlib
import os
import pickle
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from typing import Any

import earshot

ROOT = Path(__file__).resolve().parents[3]
PROGRAMS = os.environ["EARSHOT_PROGRAMS"]
PAPER = ROOT / "sim/ocean/environments/munk_flat.toml"


def processes_with(argument):
    """Numbers of the processes that have it among their arguments."""
    found = []
    for place in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):
            if any(one.startswith(argument) for one in place.read_bytes().decode(errors="replace").split("\0")):
                found.append(int(place.parent.name))
    return found


def wait_until(holds):
    deadline = time.monotonic() + 60.0
    while not holds():
        if time.monotonic() > deadline:
            raise TimeoutError
        time.sleep(0.01)


class AFlight(unittest.TestCase):
    def test_has_track_decisions_and_journal(self):
        flight = earshot.fly(seed=7, programs=PROGRAMS)
        folder = flight.folder
        self.assertTrue(flight.summary["found"])
        self.assertEqual(len(flight.decisions), flight.summary["steps"])
        last = flight.track.iloc[-1]
        self.assertLess(last.range_m, 1_000.0)
        source, end = flight.summary["source"], flight.summary["end"]
        away = ((source["north_m"] - end["north_m"]) ** 2 + (source["east_m"] - end["east_m"]) ** 2) ** 0.5
        self.assertAlmostEqual(last.range_m, away, places=2)
        self.assertIn("navigation", flight.journal)
        del flight
        self.assertFalse(folder.exists(), "the folder of a flight goes with it")

    def test_is_kept_where_it_is_asked_to_be_and_flies_in_an_ocean_of_arrays(self):
        ocean = earshot.Environment(
            sound_speed=earshot.Munk(),
            bathymetry=3_000.0,
            sediment=earshot.Layer(1_505.0),
            frequency=20.0,
            source_depth=30.0,
            source_level=189.0,
            noise_level=90.0,
        )
        with tempfile.TemporaryDirectory() as folder:
            flight = earshot.fly(environment=ocean, seed=2, out=Path(folder) / "kept", programs=PROGRAMS)
            again = earshot.Flight(Path(folder) / "kept")
            self.assertEqual(again.summary, flight.summary)
            self.assertTrue(again.summary["environment"].endswith("given.toml"))

    def test_is_refused_with_the_argument_that_is_wrong(self):
        with tempfile.TemporaryDirectory() as folder:
            refused: dict[str, dict[str, Any]] = {
                "programs": {"programs": folder},
                "mission": {"mission": "/nowhere/mission.toml"},
                "environment": {"environment": 3},
                "source": {"source": "swimming"},
                "seed": {"seed": -1},
                "tables": {"tables": 3},
                "battery_percent": {"battery_percent": "full"},
                "out": {"out": 3},
            }
            for key, wrong in refused.items():
                with self.subTest(key=key), self.assertRaises(earshot.BadInput) as raised:
                    earshot.fly(**({"programs": PROGRAMS} | wrong))
                self.assertEqual(raised.exception.key, key)
            with self.assertRaisesRegex(earshot.BadInput, "holds no flight"):
                earshot.Flight(folder)
            with self.assertRaisesRegex(earshot.BadInput, "battery_percent = 200: must be 0 to 100"):
                earshot.fly(battery_percent=200.0, programs=PROGRAMS)
            (Path(folder) / "summary.json").write_text("{}")
            with self.assertRaisesRegex(earshot.BadInput, "is no summary of a flight"):
                earshot.Flight(folder).summary  # noqa: B018
            with self.assertRaisesRegex(earshot.BadInput, "has no track.csv"):
                earshot.Flight(folder).track  # noqa: B018

    def test_is_refused_where_the_programs_are_older(self):
        with tempfile.TemporaryDirectory() as folder:
            older = Path(folder) / "earshot-fly"
            older.write_text("#!/bin/sh\necho 'earshot fly: --end-with: no such option (see --help)' >&2\nexit 2\n")
            older.chmod(0o755)
            with self.assertRaisesRegex(
                earshot.BadInput, "^programs: .*/earshot-fly is of another version than this package"
            ) as raised:
                earshot.fly(programs=folder)
        self.assertEqual((raised.exception.key, raised.exception.value), ("programs", str(older)))

    def test_ends_in_order_where_python_is_killed(self):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "out"
            program = f"import earshot; earshot.fly(ignore_source=True, out={str(out)!r}, programs={PROGRAMS!r})"
            python = subprocess.Popen([sys.executable, "-c", program])
            journal = out / "unfinished-flight/journal.lcmlog"
            wait_until(lambda: journal.is_file() and b"EARSHOT_DECISION" in journal.read_bytes())
            python.kill()
            python.wait()
            wait_until(lambda: not processes_with(str(out)))
            flight = earshot.Flight(out)
            self.assertEqual(flight.summary["end_reason"], "interrupted")
            self.assertLess(flight.summary["steps"], 100)  # all that the mission has
            self.assertIn("mission", flight.journal)

    def test_goes_with_the_object_in_the_process_that_flew_alone(self):
        flight = earshot.fly(seed=7, programs=PROGRAMS)
        child = os.fork()
        if child == 0:
            del flight
            os._exit(0)
        os.waitpid(child, 0)
        self.assertTrue((flight.folder / "summary.json").is_file())
        with self.assertRaisesRegex(earshot.BadInput, "^out: must be given"):
            pickle.dumps(flight)


if __name__ == "__main__":
    unittest.main()
