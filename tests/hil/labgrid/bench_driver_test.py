"""The worked example of labgrid: with a stand-in for the bench, and with a case that flies on a virtual bus.

usage: bench_driver_test.py FOLDER_OF_PROGRAMS
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from labgrid import Environment

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "page"))
sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "hil/labgrid"))
from bench_example import ROOT, calm, deaf

from bench_driver import EarshotBenchDriver

EXAMPLE = ROOT / "hil/labgrid"
STUB = ROOT / "tests/hil/command_line/stub_bench"
PROGRAMS = Path(sys.argv.pop(1)).resolve()


class Driver(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        for name in ("earshotd", "earshot-bench"):
            shutil.copy(STUB, self.folder / name)
        variables = {"EARSHOT_CAN": "here", "BENCH_RESULTS": str(self.folder / "results.json")}
        os.environ.update(variables)
        self.addCleanup(lambda: [os.environ.pop(name, None) for name in (*variables, "BENCH_ENDS")])
        options = f"""
        earshotd: {self.folder}/earshotd
        out: {self.folder}/out
        tree:"""
        place = (EXAMPLE / "this_computer.yaml").read_text().replace("\n        tree:", options)
        place = place.replace("$BASE/../..", str(ROOT))
        # A driver is registered once, as this file was imported.
        (self.folder / "place.yaml").write_text(place.split("imports:")[0])

    def fly(self, entry: dict, ends: int) -> list[str]:
        (self.folder / "results.json").write_text(json.dumps({"cases": [entry]}))
        os.environ["BENCH_ENDS"] = str(ends)
        environment = Environment(str(self.folder / "place.yaml"))
        try:
            return environment.get_target().get_driver(EarshotBenchDriver).fly("calm")
        finally:
            environment.cleanup()

    def test_says_of_a_case_that_passed_that_nothing_is_wrong(self):
        self.assertEqual(self.fly(calm(), 0), [])

    def test_says_what_is_wrong(self):
        self.assertEqual(self.fly(deaf(), 1), deaf()["wrong"])

    def test_tells_a_lost_bus_from_a_failed_case(self):
        with self.assertRaisesRegex(Exception, "hil/run ended with status 3"):
            self.fly(calm(), 3)


class Example(unittest.TestCase):
    def test_flies_a_case_as_its_readme_says(self):
        words = ["-p", "no:cacheprovider", "--lg-env", "hil/labgrid/this_computer.yaml", "hil/labgrid"]
        flown = subprocess.run(
            [sys.executable, "-B", "-m", "pytest", *words],
            cwd=ROOT,
            env={**os.environ, "EARSHOT_PROGRAMS": str(PROGRAMS)},
            capture_output=True,
            text=True,
            check=False,
        )
        self.assertEqual(flown.returncode, 0, flown.stdout + flown.stderr)
        self.assertIn("2 passed", flown.stdout)


if __name__ == "__main__":
    unittest.main()
