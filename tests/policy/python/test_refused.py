"""What cannot be is refused by Earshot's own exceptions, with the argument or the file that is wrong.

Run by ctest (run in this folder).
"""

import datetime
import os
import threading
import time
import unittest
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import xarray
from listening_cases import Cases, in_steps, song, write_wav

import earshot
import earshot.annotations
import earshot.gym

HALF = "\ud800"  # half of a character: no UTF-8 and no byte of a file's name
BYTE = "\udc80"  # as os.fsdecode gives a byte that is no UTF-8
GREAT: Any = np.longdouble("1e4000")
FAR_WEST = datetime.timezone(datetime.timedelta(hours=-5))


class OfBytes:
    def __fspath__(self):
        return b"nowhere.txt"


class OfNumbers:
    def __fspath__(self):
        return 5


def shallow(**named):
    given: dict[str, Any] = {"sound_speed": 1500.0, "bathymetry": 100.0, "sediment": earshot.Layer(1700.0)}
    return earshot.Environment(**{**given, **named})


class Refusals(Cases):
    def refusal(self, call, *arguments, **named):
        with self.assertRaises(earshot.BadInput) as caught:
            call(*arguments, **named)
        return caught.exception

    def require(self, key, call, *arguments, **named):
        bad = self.refusal(call, *arguments, **named)
        self.assertEqual(bad.key, key, str(bad))
        return bad


class Refused(Refusals):
    def test_are_sample_rates_that_no_recorder_has(self):
        for rate in (1e15, 2.0**53, 2.0**63, 1e300):
            for bad in (
                self.require("rate", earshot.Listener, rate),
                self.require("rate", earshot.listen, song(30, [12]), rate),
            ):
                self.assertIn("no more than 1000000 Hz", str(bad))

    def test_are_texts_that_are_none(self):
        sound = song(30, [12])
        for name, value in (
            ("preset", BYTE),
            ("bits", 2**40),
            ("calibration", "a\0b"),
            ("calibration", HALF),
            ("calibration", {BYTE: 1.0}),
            ("begin", BYTE),
            ("begin", datetime.datetime.max.replace(tzinfo=FAR_WEST)),
        ):
            with self.subTest(argument=name, value=repr(value)):
                bad = self.refusal(earshot.listen, sound, 1000, **{name: value})
                self.assertIn(bad.key, (name, BYTE))
                self.assertEqual(bad.value, "1.09951e+12" if name == "bits" else value)
        self.require("samples", earshot.listen, HALF)
        self.require("time_format", earshot.listen, "x.wav", time_format=BYTE)
        self.require("begin", earshot.listen, "x.wav", begin=BYTE)
        self.require("starter", earshot.field, shallow(), frequency=100.0, source_depth=30.0, starter=BYTE)
        for pressure in (np.array([1, 2]), "no"):
            self.require("pressure", earshot.field, shallow(), frequency=100.0, source_depth=30.0, pressure=pressure)
        for dtype in (",,", BYTE, "f\0", {"names": 1}):
            self.require("dtype", earshot.Listener, 1000, dtype=dtype)

    def test_are_paths_that_are_none(self):
        (self.folder / "loop").symlink_to(self.folder / "loop")
        for call in (
            earshot.annotations.read,
            earshot.read_journal,
            earshot.Environment.from_toml,
            earshot.Tables.from_file,
        ):
            for value in ("a\0b", HALF, "", "x" * 5_000, 5, b"bytes", OfBytes(), OfNumbers(), self.folder / "loop"):
                with self.subTest(call=call.__qualname__, value=repr(value)):
                    bad = self.require("path", call, value)
                    self.assertIs(bad.value, value)
        taking: tuple[tuple[str, Any], ...] = (
            ("tables", earshot.Belief),
            ("environments", earshot.tables),
            ("folder", earshot.Flight),
            ("worlds", lambda path: earshot.evaluate("sweep", path, n=1)),
            ("tables", lambda path: earshot.evaluate("sweep", tables=path, n=1)),
            ("policies", lambda path: earshot.evaluate(path, n=1)),
        )
        for key, call in taking:
            for value in ("a\0b", HALF, "x" * 5_000):
                with self.subTest(key=key, value=repr(value)):
                    self.require(key, call, value)

    def test_name_the_file_that_is_missing(self):
        missing = self.folder / "nowhere"
        for key, call in (
            ("path", earshot.annotations.read),
            ("path", earshot.read_journal),
            ("path", earshot.Environment.from_toml),
            ("path", earshot.Tables.from_file),
            ("samples", earshot.listen),
            ("calibration", lambda path: earshot.listen(song(30, [12]), 1000, calibration=path)),
        ):
            with self.subTest(key=key):
                bad = self.require(key, call, missing)
                self.assertEqual((bad.file, bad.line), (str(missing), None))
        os.chdir(self.folder)
        for calibration in ("./miss.toml", ".//miss.toml", Path("miss.toml")):
            bad = self.require("calibration", earshot.listen, song(30, [12]), 1000, calibration=calibration)
            self.assertEqual((bad.file, bad.value), ("miss.toml", calibration))

    def test_keep_their_type_and_value(self):
        sound = song(30, [12])
        wrong: tuple[tuple[str, Any], ...] = (("bits", "many"), ("begin", 3))
        for name, value in wrong:
            with self.assertRaises(earshot.BadType) as caught:
                earshot.listen(sound, 1000, **{name: value})
            self.assertEqual((caught.exception.key, caught.exception.value), (name, value))
        self.assertEqual(self.require("preset", earshot.listen, sound, 1000, preset="whale").value, "whale")

    def test_are_calibrations_with_other_keys(self):
        for key in ("full_scale_level_db_re_1upa = 170\n#", "a.b", '"', ""):
            bad = self.require(key, earshot.listen, song(30, [12]), 1000, calibration={key: 1.0})
            self.assertIn("full_scale_level_db_re_1upa", str(bad))
        self.require("calibration", earshot.listen, song(30, [12]), 1000, calibration={5: 1.0})

    def test_are_truths_with_columns_that_cannot_be(self):
        heard = earshot.listen(song(60, [12]), 1000)
        good = pandas.DataFrame({"begin_s": [12.0, 20.0], "end_s": [13.0, 21.0]})
        for wrong in (
            good.assign(channel=["a", "b"]),
            good.assign(channel=np.inf),
            good.assign(channel=2**40),
            good.assign(channel=1.7),
            good.assign(channel=-1),
            good.assign(low_hz=["low", "low"]),
            good.assign(high_hz=np.inf),
            good.assign(file_offset_s=["1 s", "2 s"]),
            pandas.concat([good, good], axis=1),
            pandas.concat([good, good[["begin_s"]].rename(columns={"begin_s": "channel"})] * 2, axis=1),
        ):
            self.require("truth", earshot.annotations.score, heard, wrong)
        known = good.assign(
            channel=pandas.array([1, None], dtype="Int64"), low_hz=[np.nan, 15.0], high_hz=[np.nan, 25.0]
        )
        self.assertEqual(earshot.annotations.score(heard, known).selections, 2)

    def test_are_layers_without_a_sound_speed(self):
        layers = xarray.Dataset({"sound_speed": ("layer", [1600.0, np.nan]), "thickness": ("layer", [5.0, np.nan])})
        self.require("sediment", shallow, sediment=layers)

    def test_is_a_file_that_no_program_would_read(self):
        depth_m = np.linspace(0.0, 100.0, 130_001)
        whole = shallow(
            sound_speed=(depth_m, np.full(130_001, 1_500.123456789012)),
            frequency=50.0,
            source_depth=30.0,
            source_level=180.0,
            noise_level=90.0,
        )
        with self.assertRaisesRegex(
            earshot.BadInput, "to_toml: .* would have [0-9]+ bytes, .* no more than 4194304: give fewer numbers"
        ) as caught:
            whole.to_toml()
        self.assertGreater(caught.exception.value, 4 * 2**20)
        with self.assertRaises(earshot.BadInput) as caught:
            earshot.fly(environment=whole, programs=os.environ["EARSHOT_PROGRAMS"])
        self.assertEqual(caught.exception.key, "environment")


class Objects(Refusals):
    """Of NumPy, pandas and xarray where they cannot be: random_calls found them."""

    def require_bad_type(self, key, call, *arguments, **named):
        with self.assertRaises(earshot.BadType) as caught:
            call(*arguments, **named)
        self.assertEqual(caught.exception.key, key, str(caught.exception))

    def test_are_no_numbers(self):
        dataset = xarray.Dataset({"depth": ("x", [20.0, 30.0])})
        named: dict[str, Any] = {"frequency": 100.0, "source_depth": 30.0}
        self.require_bad_type("receiver_depth", earshot.field, shallow(), **named, receiver_depth=dataset)
        self.require_bad_type("frequency", earshot.field, shallow(), **(named | {"frequency": dataset}))
        sound = earshot.field(shallow(), **named, max_range=200.0, receiver_depth=[20.0, 30.0])
        for key in ("receiver_depth", "receiver_range"):
            self.require_bad_type(key, earshot.write_shd, sound, self.folder / "x.shd", **{key: dataset})
        self.require_bad_type("environments", earshot.tables, xarray.DataArray(5.0))
        self.require_bad_type("position_m", self.search, position_m=pandas.DataFrame({"a": [1.0], "b": [2.0]}))

    def test_are_no_words(self):
        named: dict[str, Any] = {"frequency": 100.0, "source_depth": 30.0, "max_range": 200.0}
        sound = earshot.field(shallow(), **named, receiver_depth=[20.0, 30.0])
        for layout in (np.array([1.0, 2.0]), np.zeros(3, [("a", "f8")])):
            self.require("layout", earshot.write_shd, sound, self.folder / "x.shd", layout=layout)
        self.require_bad_type("source", earshot.fly, source=pandas.Series(["fixed", "changing"]))
        self.require_bad_type("hear", earshot.fly, hear=pandas.Series(["synthetic"]))

    def test_are_no_policies(self):
        for policy in (np.float32(3.0), np.array([1, 2])):  # each has a choose(), which is NumPy's
            self.require_bad_type("policies", earshot.evaluate, [policy], n=1)

    def test_are_no_fields(self):
        named: dict[str, Any] = {"frequency": 100.0, "source_depth": 30.0, "max_range": 200.0}
        sound = earshot.field(shallow(), **named, receiver_depth=[20.0, 30.0])
        ranges = sound.sizes["range"]
        of_band = sound.drop_vars(("frequency", "pressure"))
        self.require("sound", earshot.write_tl_grid, of_band.assign_attrs(band_hz=True), self.folder / "x.grid")
        self.require("sound", earshot.write_tl_grid, of_band.assign_attrs(band_hz=[90.0]), self.folder / "x.grid")
        for changed in (
            sound.assign(sea_floor_depth=("depth", [100.0, 100.0])),
            sound.assign(source_depth=("range", np.full(ranges, 30.0))),
            sound.assign_coords(frequency=("range", np.full(ranges, 100.0))),
            sound.assign(pressure=sound.transmission_loss),
            sound.assign(reference_wavenumber=("depth", [1.0, 1.0])),
            sound.assign(transmission_loss=sound.transmission_loss.astype(str)),
        ):
            self.require("sound", earshot.write_shd, changed, self.folder / "x.shd")

    def test_are_numbers_too_great_to_be_one(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.require("max_range", earshot.field, shallow(), frequency=9.0, source_depth=5.0, max_range=GREAT)

    def test_of_gym_are_no_places_or_files(self):
        for place in ((1.0,), (1.0, 2.0, 3.0)):
            self.require("source_m", self.search, source_m=place)
        self.require("path", earshot.library, "a\0b")
        self.require("environment", earshot.gym.make_world, environment="a\0b")

    def test_of_gym_are_no_counts(self):
        for number in (0, -1, 1.5, 2**31, 10**30, True, "3", None):
            self.require("num_envs", earshot.gym.AcousticSearchVectorEnv, number)

    def search(self, **places):
        earshot.gym.AcousticSearchEnv().reset(seed=1, options=places)


class FileNames(Cases):
    """With bytes that are no UTF-8."""

    def name(self, name: bytes) -> str:
        return os.path.join(str(self.folder), os.fsdecode(name))

    def test_of_recordings_are_given_as_python_has_them(self):
        good = write_wav(self.folder / "good.wav", in_steps(song(60, [30]), np.int16))
        named = self.name(b"f\xea.wav")
        os.rename(good, named)
        heard = earshot.listen(named)
        self.assertEqual(heard.files["path"].tolist(), [named])
        self.assertEqual(heard.detections["file"].tolist(), [named])
        self.assertEqual(earshot.listen(self.folder).files["path"].tolist(), [named])
        truth = Path(self.name(b"t\xe9.txt"))
        truth.write_bytes(b"Begin File\tBegin Time (s)\tEnd Time (s)\nf\xea.wav\t30\t31\nz\xea.wav\t2\t3\n")
        table = earshot.annotations.read(truth)
        self.assertEqual(table["begin_file"].tolist(), [os.fsdecode(b"f\xea.wav"), os.fsdecode(b"z\xea.wav")])
        for given in (truth, table):
            with self.assertWarnsRegex(earshot.RecordingWarning, "1 of its selections are not counted"):
                self.assertEqual(earshot.annotations.score(heard, given).hits, 1)
        chain = Path(self.name(b"c\xe9.toml"))
        chain.write_text("full_scale_level_db_re_1upa = 170.0\n")
        self.assertEqual(earshot.listen(named, calibration=chain).calibration, "c\\xe9.toml")
        with self.assertRaises(earshot.BadInput) as caught:
            earshot.listen(self.name(b"no\xe9.wav"))
        self.assertEqual(caught.exception.file, self.name(b"no\xe9.wav"))
        self.assertIn("no\\xe9.wav: no such file", str(caught.exception))
        with self.assertRaises(earshot.BadInput) as caught:
            earshot.annotations.read(self.name(b"no\xe9.txt"))
        self.assertEqual(caught.exception.file, self.name(b"no\xe9.txt"))

    def test_of_what_is_left_out_are_shown(self):
        good = write_wav(self.folder / "good.wav", in_steps(song(60, [30]), np.int16))
        torn = self.name(b"torn\xea.wav")
        Path(torn).write_bytes(good.read_bytes()[:30])
        with self.assertWarnsRegex(earshot.RecordingWarning, r"torn\\xea.wav"):
            earshot.listen([good, torn])


class Told(unittest.TestCase):
    def test_how_far_it_is_until_it_is_done(self):
        told: list[float] = []
        earshot.listen(song(150, [12]), 1000, progress=told.append)
        self.assertEqual(told[-1], 1.0)
        self.assertEqual(told, sorted(told))

    def test_of_a_band_without_a_frequency(self):
        of_band = earshot.field(shallow(), source_depth=30.0, band=(90.0, 110.0), band_parts=2, max_range=100.0)
        known = earshot.field(
            shallow(frequency=40.0), source_depth=30.0, band=(90.0, 110.0), band_parts=2, max_range=100.0
        )
        xarray.testing.assert_equal(of_band, known)

    def test_that_a_floor_is_rough(self):
        """Its error by hand: 0.2 dB integral of tan^2 / depth; 1 / depth is ln(100 / 80) / 20 m in the mean."""
        ranges = np.arange(0.0, 10_001.0, 50.0)
        hilly_floor = (ranges, np.where(np.arange(ranges.size) % 2 == 0, 100.0, 80.0))
        hilly = shallow(bathymetry=hilly_floor)
        named: dict[str, Any] = {
            "frequency": 100.0,
            "source_depth": 30.0,
            "max_range": 10_000.0,
            "receiver_depth": 50.0,
        }
        with self.assertWarnsRegex(earshot.FieldWarning, "where 0.02 dB was asked for: the sea floor is too rough"):
            sound = earshot.field(hilly, **named)
        self.assertAlmostEqual(sound.attrs["predicted_error_db"], 0.2 * 0.4**2 * 1e4 * np.log(1.25) / 20.0, delta=0.1)
        levelled = shallow(bathymetry=hilly_floor, source_level=190.0, noise_level=90.0)
        for around in (earshot.fan, earshot.horizontal_map):
            with self.assertWarnsRegex(earshot.FieldWarning, "where 0.02 dB was asked for") as caught:
                drawn = around(levelled, radials=2, **named)
            self.assertEqual(caught.filename, __file__)
            for name in ("predicted_error_db", "depth_step_m", "range_step_m", "terms"):
                self.assertEqual(drawn.attrs[name], sound.attrs[name], name)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            earshot.field(shallow(), **named)
            earshot.field(hilly, **named, range_step=2.0)
            chosen = earshot.fan(hilly, radials=2, **named, range_step=2.0)
            self.assertTrue(np.isnan(chosen.attrs["predicted_error_db"]))
        ranges = np.arange(0.0, 10_001.0, 5.0)
        rough = shallow(bathymetry=(ranges, np.where(np.arange(ranges.size) % 2 == 0, 100.0, 80.0)))
        with self.assertRaisesRegex(earshot.BadInput, "too rough for the solver's steps: smooth it"):
            earshot.field(rough, **named)

    def test_to_others_while_tables_are_read_and_scored(self):
        many = pandas.DataFrame({"begin_s": np.ones(300_000), "end_s": np.full(300_000, 2.0)})
        ticks = [0]
        is_over = threading.Event()

        def tick():
            while not is_over.is_set():
                ticks[0] += 1
                time.sleep(0.001)

        other = threading.Thread(target=tick)
        other.start()
        begin = time.monotonic()
        try:
            self.assertEqual(earshot.annotations.score(many, many, listened_s=10.0).hits, 300_000)
        finally:
            is_over.set()
            other.join()
        self.assertLess(time.monotonic() - begin, 20.0)  # each against each took minutes
        self.assertGreater(ticks[0], 2)


if __name__ == "__main__":
    unittest.main()
