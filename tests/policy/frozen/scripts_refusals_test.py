"""What the commands that make tables and measure refuse before they build anything. Expected: what their heads say."""

from __future__ import annotations

import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[3]


class RefusalsTest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="earshot-test-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def refuse(self, script: str, words: list[str], complaint: str) -> None:
        done = subprocess.run(
            [SOURCE / script, *words], capture_output=True, text=True, check=False, cwd=self.folder, timeout=10
        )
        self.assertEqual(done.returncode, 2, (words, done.stderr))
        self.assertEqual(done.stderr, f"{script}: {complaint}\n")
        self.assertEqual(done.stdout, "")

    def test_measure_takes_a_whole_number_of_at_least_five(self) -> None:
        for value in ("4", "0", "-5", "x", "1e3", "7.5", "", "007"):
            complaint = f"EPISODES: '{value}': must be a whole number, 5 to 99999999"
            self.refuse("policy/frozen/measure", [value], complaint)

    def test_tables_are_made_for_numbers_that_a_sea_can_have(self) -> None:
        for hz in ("0.5", "100.5", "nan", "twenty", "-20", ""):
            complaint = f"FREQUENCY_HZ: '{hz}': must be a number, 1 to 100"
            self.refuse("policy/tables/make_for", [self.folder, hz, "300"], complaint)
        for depth in ("0", "6001", "inf", "-1", "30m"):
            complaint = f"VEHICLE_DEPTH_M: '{depth}': must be a number, 1 to 6000"
            self.refuse("policy/tables/make_for", [self.folder, "20", "300", depth], complaint)

    def test_tables_are_put_into_a_folder_that_is_there_and_takes_them(self) -> None:
        missing = f"{self.folder}/none"
        self.refuse(
            "policy/tables/make_for", [missing, "20", "300"], f"FOLDER: '{missing}': is no folder that is there"
        )
        self.refuse("policy/tables/make_for", ["/proc", "20", "300"], "FOLDER: '/proc': cannot be written")


if __name__ == "__main__":
    unittest.main()
