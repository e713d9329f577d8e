"""Every kind of NetCDF file that the programs write, judged by the compliance-checker of IOOS by CF 1.11.

usage: conventions_test.py PROGRAMS
"""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import netCDF4
from compliance_checker.suite import CheckSuite

PROGRAMS = Path(sys.argv[1])
ROOT = Path(__file__).resolve().parents[4]
MUNK = ROOT / "sim/ocean/environments/munk_flat.toml"
CHARTED = ROOT / "tests/sim/sonar/hilly.toml"
NEAR = ["--max-range-km", "1", "--output-step-m", "100", "--receiver-depth-m", "300"]


class Conventions(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        CheckSuite.load_all_available_checkers()

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.file = self.folder / "a.nc"

    def write(self, program: str, *arguments: str | Path) -> None:
        subprocess.run([PROGRAMS / program, *arguments, "--quiet"], check=True, cwd=self.folder)

    def errors(self) -> list[str]:
        suite = CheckSuite()
        data = suite.load_dataset(str(self.file))
        self.addCleanup(data.close)
        results, exceptions = suite.run_all(data, ["cf:1.11"])["cf:1.11"]
        self.assertEqual(exceptions, {})
        self.assertGreater(len(results), 10)  # it did judge
        grouped = suite.build_structure("cf:1.11", results, str(self.file))
        return [message for result in grouped["high_priorities"] for message in result.msgs]

    def song(self, name: str) -> Path:
        path = self.folder / name
        subprocess.run([PROGRAMS / "fin_song", path, self.folder / "song.txt"], check=True, stdout=subprocess.DEVNULL)
        return path

    def test_hold_in_a_field_along_one_bearing(self) -> None:
        self.write("earshot-field", MUNK, "-o", self.file, *NEAR)
        self.assertEqual(self.errors(), [])

    def test_hold_in_a_field_of_a_band(self) -> None:
        self.write("earshot-field", MUNK, "-o", self.file, *NEAR, "--band-hz", "15", "25", "--frequencies", "2")
        self.assertEqual(self.errors(), [])

    def test_hold_in_a_map(self) -> None:
        self.write("earshot-field", MUNK, "-o", self.file, *NEAR, "--radials", "4", "--map", "--fluctuation-db", "6")
        self.assertEqual(self.errors(), [])

    def test_hold_in_a_map_over_charts(self) -> None:
        rows = [f"{0.1 * i},{0.1 * j},-2500" for i in (-1, 0, 1) for j in (-1, 0, 1)]
        (self.folder / "chart.csv").write_text("\n".join(["latitude_deg,longitude_deg,elevation_m", *rows, ""]))
        shutil.copy(CHARTED, self.folder)
        self.write("earshot-field", CHARTED.name, "-o", self.file, *NEAR, "--radials", "4", "--map")
        with netCDF4.Dataset(self.file) as file:
            self.assertEqual(file["map_snr"].grid_mapping, "local_plane")
        self.assertEqual(self.errors(), [])

    def test_hold_in_a_library(self) -> None:
        text = (ROOT / "sim/field_library/example_library.toml").read_text()
        for old, new in (
            ("../ocean", f"{ROOT}/sim/ocean"),
            ("20_000.0]", "]"),
            ("count = 12", "count = 4"),
            ("max_range_km = 30.0", "max_range_km = 1.0"),
        ):
            self.assertIn(old, text)
            text = text.replace(old, new)
        (self.folder / "library.toml").write_text(text)
        self.write("earshot-field", "--library", "library.toml", "-o", self.file)
        self.assertEqual(self.errors(), [])

    def test_hold_in_levels_without_a_date_and_a_calibration(self) -> None:
        self.write("earshot-listen", self.song("song.wav"), "--levels", self.file)
        self.assertEqual(self.errors(), [])

    def test_hold_in_levels_with_both(self) -> None:
        song = self.song("song_20200912_000200.wav")
        dated = ["--time-format", "%Y%m%d_%H%M%S", "--full-scale-db", "176"]
        self.write("earshot-listen", song, "--levels", self.file, *dated)
        self.assertEqual(self.errors(), [])

    def test_are_those_that_the_checker_knows(self) -> None:
        self.write("earshot-field", MUNK, "-o", self.file, *NEAR)
        with netCDF4.Dataset(self.file, "a") as file:
            file["snr"].units = "dB"
        self.assertEqual(self.errors(), ['units for snr, "dB" are not recognized by UDUNITS'])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
