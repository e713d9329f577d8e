"""`earshot.fan`, `earshot.horizontal_map` and `earshot.library`: equal to the program's files bit for bit, and strict.

Run by ctest (run in this folder).
"""

import os
import pickle
import signal
import tempfile
import threading
import time
import unittest
from pathlib import Path
from typing import Any

import numpy as np
from field_cases import require_written, run_program, write_hilly_ocean

import earshot

ROOT = Path(__file__).resolve().parents[3]
PROGRAMS = os.environ["EARSHOT_PROGRAMS"]
PAPER = ROOT / "sim/ocean/environments/munk_flat.toml"

FAN = (
    "bearing",
    "range",
    "depth",
    "transmission_loss",
    "detection_probability",
    "sea_floor_depth",
    "assured_detection_range",
    "furthest_detection_range",
)
MAP = {"north": "north", "east": "east", "map_snr": "snr", "map_detection_probability": "detection_probability"}
AROUND: dict[str, Any] = {"radials": 4, "receiver_depth": 300.0, "max_range": 2_000.0}


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, environment, options):
        """What the program writes with these options."""
        file = self.folder / "written.nc"
        done = run_program(PROGRAMS, environment, *options.split(), "-o", file, "--force")
        self.assertEqual(done.returncode, 0, done.stderr)
        return file

    def write_library(self, plan):
        """The library that the program writes of this plan."""
        file = self.folder / "library.nc"
        done = run_program(PROGRAMS, "--library", plan, "-o", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        return file


class SameBits(InAFolder):
    def test_as_the_programs_fan_over_charts_with_an_island(self):
        ocean = write_hilly_ocean(self.folder)
        options = "--radials 4 --depth 100 300 --max-range-km 9 --output-step-m 100 --fluctuation-db 6"
        file = self.write(ocean, options)
        fan = earshot.fan(
            earshot.Environment.from_toml(ocean),
            radials=4,
            receiver_depth=[100.0, 300.0],
            max_range=9_000.0,
            output_step=100.0,
            fluctuation_db=6.0,
        )
        require_written(file, fan, FAN)
        self.assertGreater(int(np.isnan(fan.transmission_loss).sum()), 0)  # on the island and behind it
        np.testing.assert_array_equal(fan.snr, 190.0 - fan.transmission_loss.values.astype("f8") - 90.0)

    def test_as_the_programs_map_of_a_band(self):
        options = (
            "--radials 8 --depth 300 --max-range-km 12 --map --map-intervals 24 --map-side-km 20 "
            "--band-hz 15 25 --frequencies 2 --detection-threshold-db 12 --source-depth-m 45"
        )
        file = self.write(PAPER, options)
        asked: dict[str, Any] = {
            "radials": 8,
            "receiver_depth": 300.0,
            "max_range": 12_000.0,
            "band": (15.0, 25.0),
            "band_parts": 2,
            "detection_threshold_db": 12.0,
            "source_depth": 45.0,
        }
        ocean = earshot.Environment.from_toml(PAPER)
        drawn = earshot.horizontal_map(ocean, side=20_000.0, intervals=24, **asked)
        self.assertEqual(drawn.snr.dims, ("north", "east"))
        require_written(file, drawn, MAP)
        require_written(file, earshot.fan(ocean, **asked), FAN)

    def test_as_the_programs_map_of_the_size_that_it_chooses(self):
        file = self.write(PAPER, "--radials 4 --depth 300 --max-range-km 2 --map --map-intervals 8")
        drawn = earshot.horizontal_map(earshot.Environment.from_toml(PAPER), intervals=8, **AROUND)
        require_written(file, drawn, MAP)

    def test_on_any_number_of_threads(self):
        ocean = earshot.Environment.from_toml(write_hilly_ocean(self.folder))
        one, three = (earshot.fan(ocean, threads=n, output_step=50.0, **AROUND) for n in (1, 3))
        self.assertTrue(one.identical(three))

    def test_as_the_programs_library(self):
        write_hilly_ocean(self.folder)
        plan = self.folder / "library.toml"
        plan.write_text(
            'name = "island"\nenvironment = "hilly.toml"\nsource_depth_m = [30.0]\nreceiver_depth_m = [100.0, 300.0]\n'
            '[positions]\nlayout = "list"\nnorth_m = [-4000.0, 0.0, 3000.0]\neast_m = [-4000.0, 7000.0, 500.0]\n'
            "[radials]\ncount = 3\nmax_range_km = 2.0\nrange_step_m = 100.0\n"
        )
        file = self.write_library(plan)
        names = ["range", "depth", "bearing", "frequency", "transmission_loss", "position_north", "position_east"]
        library = earshot.library(file)
        require_written(file, library, names)
        require_written(file, library, ["position_depth", "source_level", "noise_level"])
        self.assertEqual(library.has_field.values.tolist(), [True, False, True])
        self.assertTrue(bool(np.isnan(library.transmission_loss.isel(position=1)).all()))
        self.assertEqual((library.attrs["centre"], library.attrs["environment"]), ("source", "hills"))
        self.assertEqual(
            library.attrs["environment_crc32"],
            f"0x{earshot.Environment.from_toml(self.folder / 'hilly.toml').crc32:08x}",
        )
        some = earshot.library(file, positions=[2, 0])
        np.testing.assert_array_equal(some.transmission_loss, library.transmission_loss.sel(position=[2, 0]))
        self.assertEqual(some.position_north.values.tolist(), [3000.0, -4000.0])


class Values(InAFolder):
    def test_are_the_fields_along_each_bearing(self):
        ocean = earshot.Environment.from_toml(write_hilly_ocean(self.folder))
        asked: dict[str, Any] = {"receiver_depth": [100.0, 300.0], "max_range": 3_000.0, "output_step": 100.0}
        fan = earshot.fan(ocean, radials=3, **asked)
        for bearing in (0.0, 120.0, 240.0):
            along = earshot.field(ocean, bearing=bearing, pressure=False, **asked)
            np.testing.assert_array_equal(fan.snr.sel(bearing=bearing), along.snr)

    def test_say_how_far_it_is_heard_where_levels_are_known(self):
        # A point source and its image in the surface. SNR = 170 - TL - 80 = 40 at a loss of 50 dB, near 316 m.
        ranges = np.arange(1.0, 800.0, 0.01)
        image = np.hypot(ranges, 6_000.0)
        wavenumber = 2.0 * np.pi * 50.0 / 1_500.0
        pressure = np.exp(1j * wavenumber * ranges) / ranges - np.exp(1j * wavenumber * image) / image
        is_heard = -20.0 * np.log10(np.abs(pressure)) <= 50.0
        expected = {
            "assured_detection_range": ranges[np.argmin(is_heard)],
            "furthest_detection_range": ranges[np.nonzero(is_heard)[0][-1]],
        }
        free: dict[str, Any] = {
            "sound_speed": 1_500.0,
            "bathymetry": 6_000.0,
            "sediment": earshot.Layer(1_500.0, density=1.0),
        }
        asked: dict[str, Any] = {
            "radials": 2,
            "frequency": 50.0,
            "source_depth": 3_000.0,
            "receiver_depth": 3_000.0,
            "max_range": 800.0,
            "output_step": 1.0,
            "detection_threshold_db": 40.0,
        }
        fan = earshot.fan(earshot.Environment(source_level=170.0, noise_level=80.0, **free), **asked)
        for name, range_m in expected.items():
            np.testing.assert_allclose(fan[name], range_m, rtol=0.01)  # 0.1 dB: the march, and what the floor reflects
        self.assertEqual(float(fan.detection_probability.sel(range=200.0, bearing=0.0).item()), 1.0)
        self.assertEqual(float(fan.detection_probability.sel(range=500.0, bearing=180.0).item()), 0.0)
        quiet = earshot.fan(earshot.Environment(**free), **asked)
        self.assertEqual(set(quiet.data_vars), {"transmission_loss", "sea_floor_depth"})
        self.assertNotIn("detection_threshold_db", quiet.attrs)

    def test_pickle(self):
        fan = earshot.fan(earshot.Environment.from_toml(PAPER), **AROUND)
        self.assertTrue(pickle.loads(pickle.dumps(fan)).identical(fan))

    def test_have_units_everywhere(self):
        ocean = earshot.Environment.from_toml(PAPER)
        for dataset in (earshot.fan(ocean, **AROUND), earshot.horizontal_map(ocean, intervals=2, **AROUND)):
            for name in dataset.variables:
                self.assertIn("units", dataset[name].attrs, name)

    def test_of_a_map_have_a_depth_where_several_are_asked(self):
        ocean = earshot.Environment.from_toml(PAPER)
        asked: dict[str, Any] = {**AROUND, "intervals": 4}
        both = earshot.horizontal_map(ocean, **{**asked, "receiver_depth": [100.0, 300.0]})
        self.assertEqual(both.snr.dims, ("depth", "north", "east"))
        self.assertTrue(both.sel(depth=300.0).identical(earshot.horizontal_map(ocean, **asked)))

    def test_say_which_bearings_meet_land_at_once(self):
        ocean = earshot.Environment.from_toml(write_hilly_ocean(self.folder))
        fan = earshot.fan(ocean, radials=4, receiver_depth=100.0, max_range=16_000.0, output_step=8_000.0)
        self.assertRegex(fan.attrs["land"], "^1 of 4 bearings .the first at 90 degrees. meet land")
        self.assertTrue(bool(np.isnan(fan.transmission_loss.sel(bearing=90.0)).all()))


class Waiting(InAFolder):
    LONG: dict[str, Any] = {
        "radials": 6,
        "receiver_depth": 50.0,
        "max_range": 20_000.0,
        "frequency": 400.0,
        "output_step": 500.0,
        "threads": 2,
    }

    def long(self, **changed):
        ocean = earshot.Environment.from_toml(write_hilly_ocean(self.folder))
        return earshot.fan(ocean, **{**self.LONG, **changed})

    def test_ends_at_once_with_ctrl_c(self):
        began: list[float] = []
        before = signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background ignores it
        self.addCleanup(signal.signal, signal.SIGINT, before)

        def report(share):
            if not began:
                began.append(time.monotonic())
                os.kill(os.getpid(), signal.SIGINT)

        self.assertRaises(KeyboardInterrupt, self.long, progress=report)
        self.assertLess(time.monotonic() - began[0], 1.0)  # 0.1 s on an idle machine

    def test_lets_other_threads_run_and_tells_how_far_it_is(self):
        counted = 0
        shares: list[float] = []
        done = threading.Event()

        def work():
            self.long(frequency=100.0, max_range=5_000.0, progress=shares.append)
            done.set()

        thread = threading.Thread(target=work)
        thread.start()
        while not done.is_set():
            counted += 1
            time.sleep(0.001)
        thread.join()
        self.assertGreater(counted, 10)
        self.assertEqual((shares[-1], shares), (1.0, sorted(shares)))

    def test_ends_with_what_the_callback_raises(self):
        self.assertRaises(ZeroDivisionError, self.long, progress=lambda share: 1 / 0)


class Arguments(InAFolder):
    def test_that_are_wrong_are_named(self):
        nan, inf = float("nan"), float("inf")
        ocean = earshot.Environment.from_toml(PAPER)
        wrong: dict[str, tuple[Any, ...]] = {
            "radials": (0, -1, 2.5, nan, 100_001, 1e30, "x", None, [4]),
            "receiver_depth": (0.0, -1.0, 4_000.0, nan, [20.0, 20.0], [], "x", None),
            "frequency": (0.0, nan, 1e5, "x", [20.0, 40.0]),
            "source_depth": (0.0, 3_000.0, nan, inf, "x", [10.0, 20.0]),
            "max_range": (0.0, -1.0, nan, 3e6, "x"),
            "output_step": (0.0, nan, 3_000.0, "x"),
            "detection_threshold_db": (-201.0, 201.0, nan, "x", None),
            "fluctuation_db": (-1.0, 101.0, nan, "x", None),
            "accuracy_db": (0.0, 11.0, nan, "x"),
            "band": ((60.0, 40.0), (40.0,), "x"),
            "band_parts": (2.5, -1, "x"),
            "starter": ("point", 3),
            "terms": (1, 17, 2.5, "x"),
            "range_step": (0.0, nan, "x"),
            "depth_step": (0.0, nan, "x"),
            "absorber_wavelengths": (0.0, nan, "x"),
            "threads": (0, -1, 2.5, 5_000, "x"),
            "progress": (3, "x"),
            "environment": (None, "ocean.toml"),
        }
        on_a_map: dict[str, tuple[Any, ...]] = {
            "side": (0.0, nan, 5e6, "x"),
            "intervals": (0, -1, 2.5, 20_000, "x", None),
        }
        cases = [
            (function, key, value)
            for function in (earshot.fan, earshot.horizontal_map)
            for key in wrong
            for value in wrong[key]
        ]
        cases += [(earshot.horizontal_map, key, value) for key in on_a_map for value in on_a_map[key]]
        for function, key, value in cases:
            with self.subTest(function=function.__name__, key=key, value=value):
                with self.assertRaises(earshot.BadInput) as caught:
                    given = {} if key == "environment" else {key: value}
                    function(value if key == "environment" else ocean, **{**AROUND, **given})
                self.assertEqual(caught.exception.key, key)

    def test_of_a_map_include_the_levels(self):
        silent = earshot.Environment(
            sound_speed=1_500.0, bathymetry=500.0, sediment=earshot.Layer(1_600.0), noise_level=80.0
        )
        with self.assertRaises(earshot.BadInput) as caught:
            earshot.horizontal_map(silent, frequency=50.0, source_depth=30.0, **AROUND)
        self.assertEqual(caught.exception.key, "source_level")

    def test_of_a_beach_are_refused(self):
        beach = earshot.Environment(
            sound_speed=1_500.0, bathymetry=([0.0, 300.0], [500.0, 0.0]), sediment=earshot.Layer(1_600.0)
        )
        with self.assertRaises(earshot.BadInput) as caught:
            earshot.fan(beach, frequency=50.0, source_depth=30.0, output_step=500.0, **AROUND)
        self.assertEqual((caught.exception.key, caught.exception.value), ("radials", 4.0))

    def test_of_a_library_that_are_wrong_are_named(self):
        wrong: dict[str, tuple[Any, ...]] = {
            "positions": ([-1], [4], [0.5], [], "x", [[0]], 1),
            "progress": (3, "x"),
            "path": (3, None),
        }
        file = self.write_library(ROOT / "sim/field_library/example_library.toml")
        self.assertEqual(earshot.library(file).sizes["position"], 4)
        for key, values in wrong.items():
            for value in values:
                with self.subTest(key=key, value=value):
                    with self.assertRaises(earshot.BadInput) as caught:
                        given = {} if key == "path" else {key: value}
                        earshot.library(value if key == "path" else file, **given)
                    self.assertEqual(caught.exception.key, key)

    def test_that_are_no_library_are_refused_by_their_file(self):
        fan = self.write(PAPER, "--radials 4 --depth 300 --max-range-km 1")
        for file in (fan, PAPER, self.folder / "none.nc", self.folder):
            with self.subTest(file=file.name):
                with self.assertRaises(earshot.BadInput) as caught:
                    earshot.library(file)
                self.assertEqual(caught.exception.file, str(file))


if __name__ == "__main__":
    unittest.main()
