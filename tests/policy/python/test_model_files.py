"""Files of other propagation models: .env and ram.in in, .shd and tl.grid out; the bytes of `earshot field`.

Run by ctest (run in this folder).
"""

import copy
import os
import pickle
import tempfile
import unittest
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from field_cases import require_written, run_program

import earshot

ROOT = Path(__file__).resolve().parents[3]
PROGRAMS = os.environ["EARSHOT_PROGRAMS"]
PEKERIS = ROOT / "sim/ocean/environments/pekeris.env"
SLOPE = ROOT / "sim/ocean/environments/slope.in"
FIELD = ("range", "depth", "transmission_loss", "sea_floor_depth")

# A sound channel and a bank in 300 m of water; receivers from the surface to below the sea floor, two sources.
BANK_ENV = """'bank'
60.0
1
'QVW'
0  0.0  300.0
    0.0  1500.0 /
  150.0  1490.0 /
  300.0  1495.0 /
'A~'  0.0
  300.0  1650.0  0.0  1.7  0.4 /
2
  40.0 90.0 /
7
  0.0 320.0 /
6
  0.0 1.5 /
'C'
"""
BANK_SSP = "2\n0.0 2.0\n1500.0 1502.0\n1490.0 1491.0\n1495.0 1495.0\n"
BANK_BTY = "'L'\n3\n0.0 300.0\n1.0 250.0\n2.0 280.0\n"


def require_written_where_computed(file, dataset, names):
    """Asserts the file's bits at the receivers in the water; it holds those at the surface and below the floor, too."""
    with xarray.open_dataset(file) as written:
        places = {"range": dataset.range.values, "depth": dataset.depth.values}
        there = written.sel(places, method="nearest", tolerance=1e-3).load()
        for name in names:
            if name not in places:
                np.testing.assert_array_equal(dataset[name].values, there[name].values, err_msg=name)
                np.testing.assert_equal(dataset[name].dtype, there[name].dtype)
        if 0.0 in written.depth:
            surface = written.sel(depth=0.0, range=written.range[written.range > 0.0])
            np.testing.assert_array_equal(surface.transmission_loss, 300.0)


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def bank(self):
        for name, text in (("bank.env", BANK_ENV), ("bank.ssp", BANK_SSP), ("bank.bty", BANK_BTY)):
            (self.folder / name).write_text(text)
        return self.folder / "bank.env"

    def written(self, name, *arguments):
        """What the program writes under a name."""
        file = self.folder / f"program_{name}"
        done = run_program(PROGRAMS, *arguments, "-o", file, "--force")
        self.assertEqual(done.returncode, 0, done.stderr)
        return file


class Cases(InAFolder):
    def test_state_what_a_field_is_asked(self):
        pekeris = earshot.Environment.from_acoustics_toolbox(PEKERIS)
        self.assertEqual((pekeris.frequency, pekeris.source_depth, pekeris.sea_floor_depth), (100.0, 36.0, 100.0))
        self.assertEqual((pekeris.source_level, pekeris.noise_level, pekeris.max_range), (None, None, 10_000.0))
        np.testing.assert_allclose(pekeris.receiver_depth, np.linspace(2.0, 98.0, 49), atol=1e-9)
        np.testing.assert_allclose(pekeris.receiver_range, np.linspace(100.0, 10_000.0, 100), atol=1e-6)
        slope = earshot.Environment.from_ram(SLOPE)
        self.assertEqual((slope.frequency, slope.source_depth, slope.max_range), (50.0, 40.0, 8_000.0))
        depths, ranges = slope.receiver_depth, slope.receiver_range
        assert depths is not None and ranges is not None
        self.assertEqual(
            (depths[0], depths[1], ranges[0], ranges[1]), (3.0, 7.0, 100.0, 200.0)
        )  # RAM's node 4, 8; step 5, 10
        paper = earshot.Environment.from_toml(ROOT / "sim/ocean/environments/munk_flat.toml")
        self.assertEqual((paper.receiver_depth, paper.receiver_range, paper.max_range), (None, None, None))

    def test_give_the_field_of_the_program(self):
        for read, file in (("from_acoustics_toolbox", PEKERIS), ("from_ram", SLOPE)):
            with self.subTest(file=file.name):
                environment = getattr(earshot.Environment, read)(file, source_level=0.0, noise_level=0.0)
                require_written_where_computed(
                    self.written("field.nc", file), earshot.field(environment), (*FIELD, "snr")
                )
                require_written(
                    self.written("field.nc", file, "--max-range-km", 1, "--depth", 20, "--accuracy-db", 0.1),
                    earshot.field(environment, max_range=1_000.0, receiver_depth=20.0, accuracy_db=0.1),
                    (*FIELD, "snr"),
                )

    def test_give_the_fan_of_the_program(self):
        environment = earshot.Environment.from_ram(SLOPE, source_level=0.0, noise_level=0.0)
        file = self.written("fan.nc", SLOPE, "--radials", 3, "--depth", 30, "--detection-threshold-db", -60)
        fan = earshot.fan(environment, radials=3, receiver_depth=30.0, detection_threshold_db=-60.0)
        require_written(file, fan, (*FIELD, "bearing", "detection_probability", "furthest_detection_range"))

    def test_give_each_source_of_a_file_with_several(self):
        bank = earshot.Environment.from_acoustics_toolbox(self.bank())
        self.assertIsNone(bank.source_depth)
        sound = earshot.field(bank)
        self.assertEqual(sound.source_depth.values.tolist(), [40.0, 90.0])
        file = self.written("bank.nc", self.bank(), "--source-depth-m", 90)
        require_written_where_computed(file, sound.sel(source_depth=90.0), FIELD)
        with self.assertRaises(earshot.BadInput) as caught:
            earshot.fan(bank, radials=2, receiver_depth=50.0)
        self.assertEqual(caught.exception.key, "source_depth")

    def test_have_no_snr_but_of_levels_that_are_given(self):
        self.assertNotIn("snr", earshot.field(earshot.Environment.from_acoustics_toolbox(PEKERIS), max_range=200.0))
        loud = earshot.Environment.from_acoustics_toolbox(PEKERIS, source_level=170.0, noise_level=80.0)
        sound = earshot.field(loud, max_range=200.0)
        np.testing.assert_array_equal(sound.snr, np.float32(90.0) - sound.transmission_loss)

    def test_pickle_and_copy(self):
        for environment in (
            earshot.Environment.from_acoustics_toolbox(self.bank(), source_level=170.0),
            earshot.Environment.from_ram(SLOPE, noise_level=60.0),
        ):
            again = pickle.loads(pickle.dumps(environment))
            self.assertEqual((again.crc32, again.name), (environment.crc32, environment.name))
            self.assertEqual(
                (again.source_level, again.noise_level), (environment.source_level, environment.noise_level)
            )
            np.testing.assert_array_equal(again.receiver_range, environment.receiver_range)
            self.assertIs(copy.deepcopy(environment), environment)
        pickled = pickle.dumps(earshot.Environment.from_acoustics_toolbox(self.bank()))
        (self.folder / "bank.bty").write_text(BANK_BTY.replace("250.0", "240.0"))
        with self.assertRaisesRegex(earshot.BadInput, "is not what it was"):
            pickle.loads(pickled)

    def test_with_mistakes_carry_their_file_line_key_and_value(self):
        wrong = self.folder / "wrong.env"
        wrong.write_text(PEKERIS.read_text().replace("100.0            ! freq", "0.5            ! freq"))
        with self.assertRaises(earshot.BadInput) as caught:
            earshot.Environment.from_acoustics_toolbox(wrong)
        bad = caught.exception
        self.assertEqual((bad.file, bad.line, bad.key, bad.value), (str(wrong), 2, "frequency in Hz", "0.5"))
        wrong = self.folder / "ram.in"
        wrong.write_text(SLOPE.read_text().replace("50.0  1490.0", "50.0  -1490.0"))
        with self.assertRaises(earshot.BadInput) as caught:
            earshot.Environment.from_ram(wrong)
        bad = caught.exception
        self.assertEqual((bad.file, bad.line, bad.value), (str(wrong), 11, "-1490"))
        for read in (earshot.Environment.from_acoustics_toolbox, earshot.Environment.from_ram):
            with self.assertRaises(earshot.BadInput) as caught:
                read(self.folder / "none.env")
            self.assertEqual(caught.exception.file, str(self.folder / "none.env"))
            not_a_path: Any = 3
            self.assertRaises(earshot.BadType, read, not_a_path)
            with self.assertRaises(earshot.BadInput) as caught:
                read(PEKERIS if read == earshot.Environment.from_acoustics_toolbox else SLOPE, source_level=400.0)
            self.assertEqual(caught.exception.key, "source_level")

    def test_are_asked_for_their_own_frequency(self):
        pekeris = earshot.Environment.from_acoustics_toolbox(PEKERIS)
        for frequency in (50.0, [100.0, 200.0]):
            with self.assertRaises(earshot.BadInput) as caught:
                earshot.field(pekeris, frequency=frequency)
            self.assertEqual(caught.exception.key, "frequency")
        self.assertEqual(earshot.field(pekeris, frequency=[100.0], max_range=200.0).sizes["frequency"], 1)

    def test_are_no_environment_files(self):
        with self.assertRaises(earshot.BadInput) as caught:
            earshot.Environment.from_ram(SLOPE).to_toml()
        self.assertEqual(caught.exception.key, "to_toml")


class Written(InAFolder):
    def test_shade_files_are_those_of_the_program(self):
        bank = self.bank()
        depth = ["--source-depth-m", 40]
        sound = earshot.field(earshot.Environment.from_acoustics_toolbox(bank), source_depth=40.0)
        own = self.folder / "own.shd"
        for layout in ("double", "single"):
            with self.subTest(layout=layout):
                earshot.write_shd(sound, own, layout=layout)
                file = self.written("bank.shd", bank, *depth, "--shd-layout", layout)
                self.assertEqual(own.read_bytes(), file.read_bytes())
        pekeris = earshot.field(earshot.Environment.from_acoustics_toolbox(PEKERIS))
        earshot.write_shd(pekeris, own)
        self.assertEqual(own.read_bytes(), self.written("pekeris.shd", PEKERIS).read_bytes())
        paper = ROOT / "sim/ocean/environments/munk_flat.toml"
        earshot.write_shd(earshot.field(earshot.Environment.from_toml(paper), max_range=2_000.0, output_step=50.0), own)
        file = self.written("munk.shd", paper, "--max-range-km", 2, "--output-step-m", 50)
        self.assertEqual(own.read_bytes(), file.read_bytes())

    def test_tl_grids_are_those_of_the_program(self):
        for read, file, source in (("from_ram", SLOPE, 40), ("from_acoustics_toolbox", self.bank(), 90)):
            with self.subTest(file=file.name):
                own = self.folder / f"{file.stem}_of_python.grid"
                environment = getattr(earshot.Environment, read)(file)
                earshot.write_tl_grid(earshot.field(environment, source_depth=float(source)), own)
                written = self.written(f"{file.stem}.grid", file, "--source-depth-m", source)
                self.assertEqual(own.read_bytes(), written.read_bytes())

    def test_tl_grids_without_pressure_hold_the_rounded_loss(self):
        slope, own = earshot.Environment.from_ram(SLOPE), self.folder / "tl.grid"
        sound = earshot.field(slope, pressure=False, max_range=500.0, receiver_depth=[20.0, 30.0])
        earshot.write_tl_grid(sound, own)
        words = np.frombuffer(own.read_bytes(), np.float32)
        rows = words[3:].reshape(sound.sizes["range"], 4)[:, 1:3]  # 4 bytes of length stand before and behind a record
        np.testing.assert_array_equal(rows, sound.transmission_loss)

    def test_one_source_is_chosen_of_several(self):
        sound = earshot.field(earshot.Environment.from_acoustics_toolbox(self.bank()))
        with self.assertRaises(earshot.BadInput) as caught:
            earshot.write_shd(sound, self.folder / "own.shd")
        self.assertEqual(caught.exception.key, "sound")
        earshot.write_shd(sound.sel(source_depth=90.0), self.folder / "own.shd")
        file = self.written("bank.shd", self.bank(), "--source-depth-m", 90)
        self.assertEqual((self.folder / "own.shd").read_bytes(), file.read_bytes())

    def test_nothing_is_lost_of_what_was_computed(self):
        sound = earshot.field(earshot.Environment.from_acoustics_toolbox(PEKERIS))
        cut = {
            "receiver_range": [
                sound.isel(range=slice(0, 50)),
                sound.isel(range=slice(1, None)),
                sound.isel(range=slice(1, None, 2)),
            ],
            "receiver_depth": [sound.isel(depth=slice(0, None, 2))],
        }
        for key, parts in cut.items():
            for part in parts:
                with self.assertRaises(earshot.BadInput) as caught:
                    earshot.write_shd(part, self.folder / "own.shd")
                self.assertEqual(caught.exception.key, key)
        half = sound.isel(range=slice(0, 50))
        earshot.write_shd(half, self.folder / "own.shd", receiver_range=half.range.values)
        self.assertTrue((self.folder / "own.shd").exists())

    def test_no_file_of_another_kind_is_replaced(self):
        sound = earshot.field(earshot.Environment.from_acoustics_toolbox(PEKERIS), max_range=300.0)
        notes = self.folder / "notes.shd"
        notes.write_text("mine")
        for write in (earshot.write_shd, earshot.write_tl_grid):
            with self.assertRaisesRegex(earshot.BadInput, "force=True") as caught:
                write(sound, notes)
            self.assertEqual((caught.exception.file, notes.read_text()), (str(notes), "mine"))
        earshot.write_shd(sound, notes, force=True)
        earshot.write_shd(sound, notes)  # its own
        with self.assertRaises(earshot.BadInput):
            earshot.write_shd(sound, self.folder / "none" / "own.shd")

    def test_arguments_that_are_wrong_are_named(self):
        nan = float("nan")
        sound = earshot.field(earshot.Environment.from_acoustics_toolbox(PEKERIS), max_range=300.0)
        wrong: dict[str, tuple[Any, ...]] = {
            "sound": (
                None,
                3,
                sound.transmission_loss,
                sound.drop_vars("pressure"),
                sound.isel(depth=0),
                sound.isel(range=[]),
                sound.assign_coords(frequency=0.0),
                sound.assign_coords(source_depth=nan),
            ),
            "layout": ("triple", None, 3),
            "path": (3, None),
            "receiver_depth": ([20.0, 10.0], [-1.0], [nan], "x", [[1.0]], [33.3]),
            "receiver_range": ([20.0, 10.0], [-1.0], [0.0], [nan], "x", [1e6]),
        }
        for key, values in wrong.items():
            for value in values:
                with self.subTest(key=key, value=repr(value)[:40]):
                    given: dict[str, Any] = {"sound": sound, "path": self.folder / "own.shd", key: value}
                    with self.assertRaises(earshot.BadInput) as caught:
                        earshot.write_shd(given.pop("sound"), given.pop("path"), **given)
                    self.assertEqual(caught.exception.key, key)


if __name__ == "__main__":
    unittest.main()
