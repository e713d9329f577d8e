"""`earshot.Belief` and `earshot.tables`: the belief that flew, and the tables of the program.

Run by ctest (run in this folder).
"""

import copy
import os
import pickle
import subprocess
import tempfile
import unittest
from pathlib import Path
from typing import Any

import numpy as np

import earshot

ROOT = Path(__file__).resolve().parents[3]
PROGRAMS = os.environ["EARSHOT_PROGRAMS"]
PAPER = ROOT / "sim/ocean/environments/munk_flat.toml"
SHIPPED = ROOT / "policy/tables/shipped/20hz_300m.tables"
THREE: Any = 3
TEXT: Any = "ten"
ONE_NUMBER: Any = (1.0,)
BYTES: Any = b"x.tables"


def shallow(**changed):
    given = {
        "sound_speed": 1_500.0,
        "bathymetry": 100.0,
        "sediment": earshot.Layer(1_600.0),
        "frequency": 40.0,
        "source_depth": 30.0,
        "source_level": 180.0,
        "noise_level": 90.0,
        "name": "shallow",
    }
    return earshot.Environment(**{**given, **changed})


class OfAFlight(unittest.TestCase):
    def test_is_what_the_vehicle_believed_at_each_decision(self):
        flight = earshot.fly(seed=7, programs=PROGRAMS)
        belief = earshot.Belief(flight.folder / "journal.tables")
        self.assertGreater(len(flight.decisions), 5)
        for _, decision in flight.decisions.iterrows():
            belief.update((decision.north_m, decision.east_m), snr=decision.snr_db, too_faint=bool(decision.too_faint))
            summary = belief.summary
            self.assertEqual(summary["likeliest"], (decision.likeliest_north_m, decision.likeliest_east_m))
            self.assertEqual(summary["mean"], (decision.mean_north_m, decision.mean_east_m))
            self.assertEqual(summary["spread"], decision.spread_m)
            self.assertEqual(np.float32(summary["mismatch_bits"]), np.float32(decision["surprise_bits"]))
            self.assertEqual(belief.declaration is not None, bool(decision.found))


class OfTheSource(unittest.TestCase):
    def setUp(self):
        self.belief = earshot.Belief(SHIPPED)

    def test_is_even_before_anything_was_heard(self):
        cells = self.belief.probabilities
        self.assertEqual(cells.shape, (50, 50))
        np.testing.assert_allclose(cells, 1 / 2_500, rtol=1e-3)
        self.assertEqual(cells.north.values[[0, -1]].tolist(), [250.0, 24_750.0])

    def test_is_a_probability_after_each_measurement(self):
        for i in range(5):
            self.belief.update((3_000.0 + 1_000.0 * i, 9_000.0), snr=5.0 + i)
            self.assertAlmostEqual(float(self.belief.probabilities.sum()), 1.0, places=3)
            self.assertAlmostEqual(self.belief.hypotheses.probability.sum(), 1.0, places=3)
        self.assertEqual(self.belief.measurements, 5)
        self.assertTrue(self.belief.hypotheses.probability.is_monotonic_decreasing)

    def test_lies_along_a_bearing(self):
        for north in (5_000.0, 6_000.0, 7_000.0):
            self.belief.update((north, 5_000.0), snr=6.0, bearing=(90.0, 3.0))
        north, east = self.belief.summary["mean"]
        self.assertLess(abs(north - 6_000.0), 2_000.0)
        self.assertGreater(east, 6_000.0)

    def test_is_on_either_side_of_a_line_of_hydrophones(self):
        self.belief.update((12_500.0, 12_500.0), snr=6.0, bearing=(90.0, 5.0, 0.0))
        cells = self.belief.probabilities
        west, east = cells.sel(east=slice(None, 12_500.0)).sum(), cells.sel(east=slice(12_500.0, None)).sum()
        self.assertAlmostEqual(float(west), float(east), places=2)

    def test_goes_on_alike_copied_or_pickled(self):
        self.belief.update((3_000.0, 9_000.0), snr=5.0, bearing=(10.0, 20.0))
        twins = [copy.copy(self.belief), copy.deepcopy(self.belief), pickle.loads(pickle.dumps(self.belief))]
        for belief in [self.belief, *twins]:
            belief.update((4_000.0, 9_000.0), snr=-20.0, too_faint=True)
        self.assertEqual({twin.fingerprint for twin in twins}, {self.belief.fingerprint})
        twins[0].update((5_000.0, 9_000.0), snr=8.0)
        self.assertNotEqual(twins[0].fingerprint, self.belief.fingerprint)
        self.assertEqual(self.belief.measurements, 2)

    def test_promises_more_towards_the_source(self):
        for east in (3_000.0, 4_000.0, 5_000.0):
            self.belief.update((12_500.0, east), snr=8.0, bearing=(90.0, 5.0))
        actions = self.belief.actions
        self.assertEqual(actions.direction_deg.tolist(), [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0])
        self.assertEqual(actions.regret.min(), 0.0)
        self.assertLess(actions.regret[2], actions.regret[6])

    def test_refuses_what_cannot_be(self):
        update = self.belief.update
        for key, wrong in {
            "position": lambda: update(ONE_NUMBER, snr=1.0),
            "snr": lambda: update((1.0, 1.0), snr=float("nan")),
            "bearing": lambda: update((1.0, 1.0), snr=1.0, bearing=(400.0, 1.0)),
            "too_faint": lambda: update((1.0, 1.0), snr=1.0, too_faint=TEXT),
            "tables": lambda: earshot.Belief(THREE),
            "area": lambda: earshot.Belief(SHIPPED, area=(0.0, 1_000.0)),
            "step_length": lambda: earshot.Belief(SHIPPED, step_length=-1.0),
            "directions": lambda: earshot.Belief(SHIPPED, directions=33),
            "border_width": lambda: earshot.Belief(SHIPPED, border_width=float("inf")),
            "detection_threshold": lambda: earshot.Belief(SHIPPED, detection_threshold=TEXT),
        }.items():
            with self.subTest(key=key), self.assertRaises(earshot.BadInput) as raised:
                wrong()
            self.assertEqual(raised.exception.key, key)
        with self.assertRaisesRegex(earshot.BadInput, "^position: must be two numbers, north and east$"):
            update(THREE, snr=1.0)
        with self.assertRaisesRegex(earshot.BadInput, r"^bearing: must be \(direction, standard deviation\) or"):
            update((1.0, 1.0), snr=1.0, bearing=THREE)
        with self.assertRaises(earshot.BadInput) as raised:
            update((np.nan, 1.0), snr=1.0)
        self.assertEqual(raised.exception.key, "position")
        self.assertEqual(self.belief.measurements, 0)
        with self.assertRaisesRegex(
            earshot.BadInput, "^tables: end at 35[0-9]+ m; must extend across the area, 42427 m"
        ):
            earshot.Belief(SHIPPED, area=(30_000.0, 30_000.0))


class OfOceans(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def of_program(self, *files, options=()):
        output = self.folder / "program.tables"
        command = [
            f"{PROGRAMS}/earshot-tables",
            *files,
            "-o",
            output,
            "--key",
            self.folder / "a.key",
            "--new-key",
            *options,
        ]
        subprocess.run(command, check=True, capture_output=True)
        return earshot.Tables.from_file(output).to_xarray()

    def test_are_those_of_the_program(self):
        (self.folder / "shallow.toml").write_text(shallow(frequency=20.0).to_toml())
        files = [PAPER, self.folder / "shallow.toml"]
        options = ["--vehicle-depth-m", "60", "--furthest-m", "20000", "--range-step-m", "50"]
        made = earshot.tables(
            [PAPER, shallow(frequency=20.0)], vehicle_depth=60.0, max_range=20_000.0, range_step=50.0
        ).to_xarray()
        self.assertTrue(made.equals(self.of_program(*files, options=options)))
        self.assertEqual(made.attrs["sea_depth_m"], [100.0, 3_000.0])

    def test_are_merged_as_by_the_program(self):
        files = []
        for depth in (100.0, 110.0, 200.0):
            files.append(self.folder / f"{depth}.toml")
            files[-1].write_text(shallow(bathymetry=depth, name=f"{depth:g} m").to_toml())
        made = earshot.tables(files, vehicle_depth=50.0, max_range=5_000.0, at_most=2).to_xarray()
        options = ["--vehicle-depth-m", "50", "--furthest-m", "5000", "--at-most", "2"]
        self.assertTrue(made.equals(self.of_program(*files, options=options)))
        self.assertEqual(made.sizes["table"], 2)

    def test_are_saved_and_read_again(self):
        tables = earshot.tables(shallow(), vehicle_depth=50.0, max_range=1_000.0)
        tables.save(self.folder / "mine.tables")
        read = earshot.Tables.from_file(self.folder / "mine.tables")
        self.assertTrue(read.to_xarray().equals(tables.to_xarray()))
        self.assertEqual((len(read), read.frequency, read.vehicle_depth), (1, 40.0, 50.0))
        self.assertEqual([f.name for f in self.folder.iterdir()], ["mine.tables"])
        shown = subprocess.run(
            [f"{PROGRAMS}/earshot-tables", "--show", self.folder / "mine.tables"],
            check=True,
            capture_output=True,
            text=True,
        )
        self.assertIn("NOT signed", shown.stdout)

    def test_are_refused_where_they_cannot_be_made(self):
        for key, wrong in {
            "vehicle_depth": lambda: earshot.tables(shallow(), vehicle_depth=100.0),
            "source_level": lambda: earshot.tables(shallow(source_level=None), vehicle_depth=50.0),
            "environments": lambda: earshot.tables([]),
            "range_step": lambda: earshot.tables(shallow(), vehicle_depth=50.0, range_step=1.0),
            "at_most": lambda: earshot.tables(shallow(), vehicle_depth=50.0, at_most=97),
            "bearings": lambda: earshot.tables(shallow(), vehicle_depth=50.0, bearings=0),
            "max_range": lambda: earshot.tables(shallow(), vehicle_depth=50.0, max_range=0.0),
            "progress": lambda: earshot.tables(shallow(), vehicle_depth=50.0, progress=THREE),
            "path": lambda: earshot.Tables.from_file(BYTES),
        }.items():
            with self.subTest(key=key), self.assertRaises(earshot.BadInput) as raised:
                wrong()
            self.assertEqual(raised.exception.key, key)
        with self.assertRaisesRegex(earshot.BadInput, "must be one frequency in all environments") as raised:
            earshot.tables([shallow(), shallow(frequency=20.0)], vehicle_depth=50.0)
        self.assertEqual(raised.exception.key, "environments")
        (self.folder / "torn.tables").write_bytes(SHIPPED.read_bytes()[:1_000])
        with self.assertRaisesRegex(earshot.BadInput, "torn.tables"):
            earshot.Tables.from_file(self.folder / "torn.tables")
        tables = earshot.tables(shallow(), vehicle_depth=50.0)
        (self.folder / "mine.txt").write_text("mine")
        (self.folder / "link.tables").symlink_to(SHIPPED)
        for place in (
            self.folder,
            self.folder / "mine.txt",
            self.folder / "link.tables",
            self.folder / "no" / "x.tables",
        ):
            with self.subTest(place=place), self.assertRaises(earshot.BadInput) as raised:
                tables.save(place)
            self.assertEqual(raised.exception.key, "path")
        self.assertEqual((self.folder / "mine.txt").read_text(), "mine")
        tables.save(self.folder / "mine.txt", force=True)
        tables.save(self.folder / "mine.txt")


if __name__ == "__main__":
    unittest.main()
