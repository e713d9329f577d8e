"""`earshot.field` and `earshot.Environment`: equal to the program's files bit for bit, and strict with arguments.

Run by ctest (run in this folder).
"""

import copy
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
import xarray
from field_cases import random_ocean, random_question, require_same

import earshot

ROOT = Path(__file__).resolve().parents[3]
PROGRAMS = os.environ["EARSHOT_PROGRAMS"]
PAPER = ROOT / "sim/ocean/environments/munk_flat.toml"

SHALLOW: dict[str, Any] = {"sound_speed": 1_500.0, "bathymetry": 100.0, "sediment": earshot.Layer(1_600.0)}
ASKED: dict[str, Any] = {"frequency": 50.0, "source_depth": 30.0, "max_range": 500.0, "receiver_depth": [20.0, 60.0]}


def shallow(**changed):
    return earshot.Environment(**{**SHALLOW, **changed})


def sound(environment=None, **changed):
    return earshot.field(environment or shallow(), **{**ASKED, **changed})


class SameBits(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_as_the_program_in_random_oceans(self):
        rng = np.random.default_rng(58)
        computed = 0
        for i in range(24):
            ocean, (question, options) = random_ocean(rng), random_question(rng)
            with self.subTest(case=i, ocean=ocean, question=question):
                computed += require_same(PROGRAMS, self.folder, ocean, question, options)
        self.assertGreaterEqual(computed, 16)

    def test_as_the_program_for_another_source_than_the_environments(self):
        ocean = random_ocean(np.random.default_rng(3))
        ocean["absorption"] = earshot.SeaWater(temperature=10.0, salinity=35.0, depth=30.0)
        options = ["--max-range-km", "0.3"]
        self.assertTrue(require_same(PROGRAMS, self.folder, ocean, {"max_range": 300.0}, options, 310.0, 7.25))

    def test_as_the_program_in_the_papers_ocean_from_its_file(self):
        from_file = earshot.field(earshot.Environment.from_toml(PAPER), max_range=3_000.0)
        same = earshot.Environment(
            sound_speed=earshot.Munk(),
            bathymetry=3_000.0,
            sediment=earshot.Layer(1_505.0),
            frequency=20.0,
            source_depth=30.0,
            source_level=190.0,
            noise_level=90.0,
            name="Munk profile over a flat floor",
        )
        del from_file.attrs["environment_crc32"]
        from_numbers = earshot.field(same, max_range=3_000.0)
        del from_numbers.attrs["environment_crc32"]
        self.assertTrue(from_file.identical(from_numbers))

    def test_one_by_one_and_as_arrays(self):
        frequencies, depths = [40.0, 50.0], np.array([10.0, 30.0, 80.0])
        together = sound(frequency=frequencies, source_depth=depths)
        self.assertEqual(dict(together.sizes), {"frequency": 2, "source_depth": 3, "range": 100, "depth": 2})
        for frequency in frequencies:
            for depth in depths:
                alone = sound(frequency=frequency, source_depth=depth, output_step=5.0)  # of the shortest wavelength
                np.testing.assert_array_equal(
                    together.sel(frequency=frequency, source_depth=depth).pressure, alone.pressure
                )


class Values(unittest.TestCase):
    def test_pressure_is_what_the_loss_is_of(self):
        field = sound()
        loss = -20.0 * np.log10(np.abs(field.pressure))
        self.assertLessEqual(float(np.abs(loss - field.transmission_loss).max()), 0.5 / 256 + 1e-5)  # as it is rounded

    def test_pressure_has_the_phase_of_a_point_source_near_by(self):
        # In 3000 m of uniform water over a fluid of the same speed nothing but the surface's image comes back.
        water = earshot.Environment(
            sound_speed=1_500.0, bathymetry=3_000.0, sediment=earshot.Layer(1_500.0, density=1.0, attenuation=0.0)
        )
        asked: dict[str, Any] = {
            "frequency": 25.0,
            "source_depth": 200.0,
            "receiver_depth": [300.0],
            "max_range": 3_000.0,
        }
        field = earshot.field(water, output_step=100.0, **asked).isel(depth=0)
        k = 2.0 * np.pi * 25.0 / 1_500.0
        direct, image = np.hypot(field.range, 100.0), np.hypot(field.range, 500.0)
        exact = np.exp(1j * k * direct) / direct - np.exp(1j * k * image) / image
        whole = field.pressure * np.exp(1j * field.reference_wavenumber * field.range)
        far = field.range > 500.0
        error = np.abs(whole / exact - 1.0)[far]
        self.assertLess(float(error.mean()), 0.0023)  # 0.02 dB, the accuracy of the march

    def test_snr_is_there_where_levels_are_known(self):
        self.assertNotIn("snr", sound())
        self.assertNotIn("snr", sound(shallow(source_level=170.0)))
        field = sound(shallow(source_level=170.0, noise_level=80.0))
        np.testing.assert_array_equal(
            field.snr, np.float32(90.0) - field.transmission_loss
        )  # eighths of 1/32 dB: exact

    def test_is_nan_below_a_rising_sea_floor_and_on_land(self):
        field = sound(shallow(bathymetry=([0.0, 400.0], [100.0, 0.0])))
        self.assertTrue(bool(np.isfinite(field.transmission_loss.sel(depth=60.0, range=100.0))))
        self.assertTrue(bool(np.isnan(field.transmission_loss.sel(depth=60.0, range=300.0))))
        self.assertTrue(bool(np.isnan(field.pressure.sel(range=slice(400.0, None))).all()))
        self.assertEqual(float(field.sea_floor_depth.sel(range=500.0)), 0.0)

    def test_says_its_grid_and_the_error_that_it_predicts(self):
        fine, coarse = sound(accuracy_db=0.01), sound(accuracy_db=1.0)
        self.assertLessEqual(fine.attrs["predicted_error_db"], 0.01)
        self.assertLessEqual(coarse.attrs["predicted_error_db"], 1.0)
        self.assertLess(fine.attrs["depth_step_m"], coarse.attrs["depth_step_m"])
        self.assertTrue(np.isnan(sound(depth_step=0.5).attrs["predicted_error_db"]))

    def test_of_a_band_has_no_pressure(self):
        field = sound(band=(40.0, 60.0), band_parts=4)
        self.assertNotIn("pressure", field)
        self.assertEqual(field.attrs["band_hz"], [40.0, 60.0])
        self.assertTrue(bool(np.isfinite(field.transmission_loss).all()))

    def test_has_units_everywhere(self):
        field = sound(shallow(source_level=170.0, noise_level=80.0))
        for name in field.variables:
            self.assertIn("units", field[name].attrs, name)
        # As in the files of earshot field.
        self.assertEqual(field.transmission_loss.attrs["level_unit"], "dB re 1 m")
        self.assertEqual(field.transmission_loss.attrs["units"], "0.1 lg(re 1 m2)")
        self.assertEqual(field.snr.attrs["long_name"], "signal-to-noise ratio at the hydrophone, dB")


class Environments(unittest.TestCase):
    def test_are_the_same_from_numpy_and_from_xarray(self):
        depth, speed, ranges = (
            np.array([0.0, 50.0, 200.0]),
            np.array([1_500.0, 1_490.0, 1_495.0]),
            np.array([0.0, 300.0]),
        )
        floor, both = np.array([100.0, 90.0]), np.stack([speed, speed + 1.0])
        layers = xarray.Dataset({"sound_speed": ("layer", [1_550.0, 1_700.0]), "thickness": ("layer", [5.0, np.nan])})
        labelled = earshot.Environment(
            sound_speed=xarray.DataArray(both.T, {"depth": depth, "range": ranges}, ("depth", "range")),
            bathymetry=xarray.DataArray(floor, {"range": ranges}, ("range",)),
            sediment=layers,
        )
        plain = earshot.Environment(
            sound_speed=(ranges, depth, both),
            bathymetry=(ranges, floor),
            sediment=[earshot.Layer(1_550.0, thickness=5.0), earshot.Layer(1_700.0)],
        )
        self.assertEqual(labelled.crc32, plain.crc32)
        profile = earshot.Environment(
            sound_speed=xarray.DataArray(speed, {"depth": depth}, ("depth",)), bathymetry=100.0, sediment=layers
        )
        self.assertEqual(profile.sea_floor_depth, 100.0)

    def test_take_arrays_of_any_layout(self):
        depth, speed = np.array([0.0, 50.0, 200.0]), np.array([1_500.0, 1_490.0, 1_495.0])
        expected = shallow(sound_speed=(depth, speed)).crc32
        frozen = depth.copy()
        frozen.flags.writeable = False
        self.assertEqual(shallow(sound_speed=(frozen, speed)).crc32, expected)
        self.assertEqual(shallow(sound_speed=(np.repeat(depth, 2)[::2], speed[::-1][::-1])).crc32, expected)
        self.assertEqual(shallow(sound_speed=(depth.astype(np.float32), speed.astype(">f8"))).crc32, expected)
        self.assertEqual(shallow(sound_speed=(depth.astype(int), speed.tolist())).crc32, expected)

    def test_pickle_and_copy(self):
        for environment in (shallow(source_level=170.0), earshot.Environment.from_toml(PAPER)):
            again = pickle.loads(pickle.dumps(environment))
            self.assertEqual((again.crc32, again.source_level), (environment.crc32, environment.source_level))
            self.assertIs(copy.deepcopy(environment), environment)

    def test_say_what_a_file_would_have_to_state(self):
        with self.assertRaises(earshot.BadInput) as caught:
            shallow(frequency=50.0).to_toml()
        self.assertEqual(caught.exception.key, "source_depth")

    def test_name_the_profile_that_does_not_reach_the_deepest_sea_floor(self):
        with self.assertRaises(earshot.BadInput) as caught:
            shallow(sound_speed=([0.0, 200.0], [1_500.0] * 2), bathymetry=([0.0, 50.0], [100.0, 300.0]))
        self.assertEqual((caught.exception.key, caught.exception.value), ("sound_speed", "200"))
        with self.assertRaisesRegex(earshot.BadInput, "^sound_speed: .*: must extend from 0 to bathymetry$"):
            shallow(sound_speed=([0.0, 50.0], [1_500.0] * 2))

    def test_from_a_file_carry_its_file_line_and_key(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "bad.toml"
            file.write_text(PAPER.read_text().replace("depth_m = 30.0", "depth_m = 3500.0"))
            with self.assertRaises(earshot.BadInput) as caught:
                earshot.Environment.from_toml(file)
        self.assertEqual((caught.exception.file, caught.exception.key), (str(file), "source.depth_m"))


class Waiting(unittest.TestCase):
    LONG: dict[str, Any] = {
        "frequency": 400.0,
        "source_depth": 30.0,
        "max_range": 400_000.0,
        "receiver_depth": 50.0,
        "output_step": 500.0,
    }

    def test_ends_at_once_with_ctrl_c(self):
        began: list[float] = []
        before = signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background ignores it
        self.addCleanup(signal.signal, signal.SIGINT, before)

        def report(share):
            if not began:
                began.append(time.monotonic())
                os.kill(os.getpid(), signal.SIGINT)

        self.assertRaises(KeyboardInterrupt, earshot.field, shallow(), progress=report, **self.LONG)
        self.assertLess(time.monotonic() - began[0], 1.0)  # 0.1 s on an idle machine

    def test_lets_other_threads_run(self):
        ended, counted = threading.Event(), 0

        def work():
            earshot.field(shallow(), **{**self.LONG, "max_range": 40_000.0})
            ended.set()

        thread = threading.Thread(target=work)
        thread.start()
        while not ended.is_set():
            counted += 1
            time.sleep(0.001)
        thread.join()
        self.assertGreater(counted, 10)

    def test_tells_how_far_it_is(self):
        shares: list[float] = []
        sound(source_depth=[10.0, 20.0], progress=shares.append)
        self.assertEqual((shares[0] >= 0.0, shares[-1], shares), (True, 1.0, sorted(shares)))

    def test_ends_with_what_the_callback_raises(self):
        self.assertRaises(ZeroDivisionError, sound, progress=lambda share: 1 / 0)


class Arguments(unittest.TestCase):
    def test_of_field_that_are_wrong_are_named(self):
        nan, inf = float("nan"), float("inf")
        wrong: dict[str, tuple[Any, ...]] = {
            "frequency": (0.0, -5.0, nan, inf, 1e5, "x", None, [], [[50.0]], True, 1j, [50.0, nan]),
            "source_depth": (0.0, -1.0, 100.0, nan, inf, "x", None, [], [30.0, 200.0]),
            "receiver_depth": (0.0, 101.0, -1.0, nan, inf, [20.0, 20.0], [30.0, 20.0], [], "x", [[1.0]], [None]),
            "max_range": (0.0, -1.0, nan, inf, 3e6, "x", [1.0, 2.0]),
            "bearing": (400.0, nan, "x", None),
            "depth_spacing": (0.0, nan, 1e6, "x"),
            "output_step": (0.0, nan, -1.0, 1e9, "x"),
            "accuracy_db": (0.0, 11.0, nan, -1.0, "x", None),
            "band": ((60.0, 40.0), (40.0,), (0.0, 5.0), "x", (40.0, nan), 40.0),
            "band_parts": (2.5, -1, nan, "x"),
            "starter": ("point", 3, None),
            "range_step": (0.0, nan, "x"),
            "depth_step": (0.0, nan, "x"),
            "terms": (-1, 1, 17, 2.5, 1e30, "x"),
            "absorber_wavelengths": (0.0, nan, "x"),
            "progress": (3, "x"),
            "environment": (None, "ocean.toml", 5),
        }
        for key, values in wrong.items():
            for value in values:
                with self.subTest(key=key, value=value):
                    with self.assertRaises(earshot.BadInput) as caught:
                        environment = value if key == "environment" else shallow()
                        earshot.field(environment, **({} if key == "environment" else {**ASKED, key: value}))
                    self.assertEqual(caught.exception.key, key)
        self.assertGreaterEqual(sum(map(len, wrong.values())), 80)

    def test_that_the_solver_refuses_are_named(self):
        beach = shallow(bathymetry=([0.0, 3.0], [100.0, 0.0]))
        for key, environment, changed in (
            ("terms", shallow(), {"terms": 2, "range_step": 400.0}),
            ("bearing", beach, {"source_depth": 10.0, "receiver_depth": None}),
            ("environment", shallow(sound_speed=9_000.0), {}),
        ):
            with self.subTest(key=key), self.assertRaises(earshot.BadInput) as caught:
                sound(environment, **changed)
            self.assertEqual((caught.exception.key, caught.exception.file), (key, None))

    def test_of_an_environment_that_are_wrong_are_named(self):
        nan, inf, layer = float("nan"), float("inf"), earshot.Layer(1_600.0)
        text: Any = "x"
        wrong: dict[str, tuple[Any, ...]] = {
            "sound_speed": (
                nan,
                0.0,
                -1_500.0,
                "x",
                None,
                (),
                ([0.0, 50.0], [1_500.0, 1_500.0]),
                ([5.0, 200.0], [1_500.0, 1_500.0]),
                ([0.0, 200.0], [1_500.0, nan]),
                ([0.0, 200.0], [1_500.0]),
                ([0.0, 200.0, 100.0], [1_500.0] * 3),
                ([0.0], [0.0, 200.0], [[1_500.0] * 3]),
                ([], []),
                (np.arange(1_000_001.0), np.full(1_000_001, 1_500.0)),
                earshot.Munk(axis_sound_speed=nan),
                xarray.DataArray([1_500.0], dims=("x",)),
                xarray.DataArray([1_500.0, 1_500.0], dims=("depth",)),
            ),
            "bathymetry": (nan, inf, 0.0, -5.0, "x", None, [1.0, 2.0, 3.0], ([0.0, 0.0], [9.0, 9.0]), ([0.0], [])),
            "sediment": (
                None,
                [],
                1_600.0,
                earshot.Layer(nan),
                earshot.Layer(text),
                earshot.Layer(1_600.0, density=-1.0),
                earshot.Layer(1_600.0, thickness=5.0),
                [layer, layer],
                {},
                {5.0: layer, 1.0: layer},
                xarray.Dataset({"speed": ("layer", [1.0])}),
            ),
            "frequency": (nan, 0.0, "x", [50.0]),
            "source_depth": (0.0, 100.0, nan, "x"),
            "source_level": (nan, 400.0, "x"),
            "noise_level": (inf, -200.0, "x"),
            "absorption": ("x", 3.0, earshot.SeaWater(99.0, 35.0, 10.0)),
            "name": (3, "two\nlines"),
        }
        for key, values in wrong.items():
            for value in values:
                with self.subTest(key=key, value=value):
                    with self.assertRaises(earshot.BadInput) as caught:
                        shallow(**{key: value})
                    self.assertEqual(str(caught.exception.key).split("[")[0].split(".")[0], key)
        self.assertGreaterEqual(sum(map(len, wrong.values())), 50)

    def test_of_another_type_are_also_type_errors(self):
        self.assertRaises(TypeError, sound, frequency="x")
        self.assertRaises(earshot.BadInput, sound, frequency=np.ma.array([50.0, 60.0], mask=[False, True]))
        self.assertRaises(TypeError, earshot.Environment.from_toml, 3)
        self.assertRaises(earshot.BadInput, earshot.Environment.from_toml, "/nowhere/ocean.toml")


class Fuzzed(unittest.TestCase):
    def test_arrays_never_do_more_than_be_refused(self):
        rng = np.random.default_rng(8)
        pool = [0.0, -0.0, 1.0, 50.0, 100.0, 200.0, 1_500.0, 1e-300, 1e300, np.nan, np.inf, -np.inf, -5.0]

        def array():
            shape = [(), (0,), (1,), (2,), (3,), (2, 3), (3, 2), (1, 0), (2, 2, 2)][rng.integers(9)]
            made = rng.choice(pool, shape)
            with np.errstate(all="ignore"):
                made = np.asarray(made).astype(rng.choice(["f8", "f4", "f2", ">f8", "i4", "c16", "O", "U8", "?"]))
            if made.ndim and rng.random() < 0.3:
                made = np.repeat(made, 2, axis=0)[::-2]
            if rng.random() < 0.3:
                made.flags.writeable = False
            return made

        taken = 0
        for _ in range(2_000):
            calls = [
                lambda: shallow(sound_speed=(array(), array())),
                lambda: shallow(sound_speed=(array(), array(), array())),
                lambda: shallow(bathymetry=(array(), array())),
                lambda: shallow(bathymetry=array(), sound_speed=array()),
                lambda: sound(frequency=array(), max_range=20.0),
                lambda: sound(source_depth=array(), receiver_depth=array(), max_range=20.0),
            ]
            try:
                calls[rng.integers(len(calls))]()
                taken += 1
            except earshot.BadInput:
                pass
        self.assertGreater(taken, 20)


if __name__ == "__main__":
    unittest.main()
