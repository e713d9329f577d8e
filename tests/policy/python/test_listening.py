"""`earshot.listen` and `earshot.Listener`: what the program writes, bit for bit, and what is known of a sound.

Run by ctest (run in this folder).
"""

import datetime
import pickle
import unittest
import warnings
from typing import Any

import numpy as np
import pandas
from listening_cases import Cases, in_steps, same_frames, song, write_wav

import earshot

# Each a tenth of a decade from the next, from 10 Hz up: IEC 61260-1.
THIRD_OCTAVES_HZ = 10.0 ** (np.arange(10, 40) / 10.0)


class Files(Cases):
    def test_give_what_the_program_gives(self):
        two = np.column_stack([song(150, [20, 90]), song(150, [5.5, 60, 148.7], seed=2)])
        cases: list[tuple[Any, int, list[str], dict[str, Any]]] = [
            (in_steps(song(200, [0.2, 30, 130, 198.9]), np.int16), 1000, [], {}),
            (in_steps(two, np.int16), 1000, ["--channel", "2", "--threshold", "6"], {"channel": 2, "threshold_db": 6}),
            (in_steps(song(90, [30]), np.uint8), 500, ["--band", "18", "40"], {"band": (18, 40)}),
            (40_000.0 * song(100, [50]).astype(np.float32), 1000, ["--preset", "tone"], {"preset": "tone"}),
            (
                in_steps(song(30, [10], 200_000), np.int16),
                200_000,
                ["--levels-interval-s", "7"],
                {"levels_interval": 7},
            ),
            (in_steps(song(60, [30]), np.int32), 1000, ["--full-scale-db", "176.1"], {"full_scale_db": 176.1}),
        ]
        for i, (samples, rate, options, arguments) in enumerate(cases):
            with self.subTest(case=i):
                file = write_wav(self.folder / f"{i}.wav", samples, rate)
                heard = earshot.listen(file, **arguments)
                self.require_as_program(heard, file, *options)
                self.assertEqual(earshot.listen(str(file), **arguments).noise_db, heard.noise_db)

    def test_of_a_sequence_have_times_in_utc_and_their_gap_is_warned_of(self):
        files = [
            write_wav(self.folder / f"{name}.wav", in_steps(song(60, [20], seed=seed), np.int16))
            for seed, name in enumerate(("b_20200912_000200", "a_20200912_000000"))
        ]
        with self.assertWarnsRegex(earshot.RecordingWarning, "begins 60 s after the end of a_20200912"):
            heard = earshot.listen(files)
        self.require_as_program(heard, *files)
        self.assertEqual(str(heard.detections["begin_utc"].iloc[1])[:17], "2020-09-12 00:02:")
        self.assertEqual(list(heard.files["begin_s"]), [0.0, 60.0])
        self.assertEqual(str(heard.levels.index[1]), "2020-09-12 00:02:00+00:00")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            same_frames(self, earshot.listen(self.folder), heard)

    def test_take_a_calibration_as_the_program_does(self):
        file = write_wav(self.folder / "a.wav", in_steps(song(60, [30]), np.int16))
        chain = {"sensitivity_db_re_1v_per_upa": -170.0, "gain_db": 20.0, "full_scale_v": 2}
        toml = self.folder / "chain.toml"
        toml.write_text("".join(f"{key} = {value}\n" for key, value in chain.items()))
        from_file = earshot.listen(file, calibration=toml)
        self.require_as_program(from_file, file, "--calibration", toml)
        same_frames(self, earshot.listen(file, calibration=chain), from_file)
        self.assertEqual(from_file.calibration, "chain.toml")
        # 20 lg 2 - (-170) - 20
        self.assertAlmostEqual(from_file.full_scale_level_db or 0.0, 156.0206, places=4)

    def test_begin_when_somebody_says_so(self):
        file = write_wav(self.folder / "a.wav", in_steps(song(60, [30]), np.int16))
        zone = datetime.timezone(datetime.timedelta(hours=10))
        begin = datetime.datetime(2021, 2, 5, 3, 59, 46, 250_000, zone)
        heard = earshot.listen(file, begin=begin)
        self.require_as_program(heard, file, "--begin", "2021-02-05T03:59:46.250+10:00")
        self.assertEqual(str(heard.files["start_utc"][0]), "2021-02-04 17:59:46.250000+00:00")


class Anything(Cases):
    def test_gives_what_the_program_gives(self):
        rng = np.random.default_rng(58)
        for i in range(8):
            rate, seconds = int(rng.choice([200, 1000, 8000, 96_000, 250_000])), int(rng.uniform(15, 30))
            samples = song(seconds, rng.uniform(0, seconds - 1, 3), rate, i, rng.uniform(0.02, 0.3))
            dtype = str(rng.choice(["u1", "i2", "i4", "f4", "f8"]))
            samples = (100.0 * samples).astype(dtype) if dtype[0] == "f" else in_steps(samples, dtype)
            threshold_db, interval_s = float(rng.uniform(3.0, 12.0)), float(rng.integers(1, 20))
            with self.subTest(case=i, rate=rate, dtype=dtype):
                file = write_wav(self.folder / "a.wav", samples, rate)
                options = ["--threshold", repr(threshold_db), "--levels-interval-s", interval_s]
                asked: dict[str, Any] = {"threshold_db": threshold_db, "levels_interval": interval_s}
                self.require_as_program(earshot.listen(file, **asked), file, *options)
                self.require_as_program(earshot.listen(samples, rate, **asked), file, *options, is_of_files=False)


class Arrays(Cases):
    def test_give_what_the_program_gives_of_a_file_of_them(self):
        sound = song(150, [0.2, 40, 100, 149])
        with_channels = np.column_stack([song(150, [20]), sound])
        cases: list[tuple[Any, dict[str, Any]]] = [
            (in_steps(sound, np.int16), {}),
            (in_steps(sound, np.int32), {}),
            (in_steps(sound, np.uint8), {}),
            (sound.astype(np.float32), {}),
            (sound, {}),
            (3_000.0 * sound, {}),
            (in_steps(with_channels, np.int16), {"channel": 2}),
        ]
        for samples, arguments in cases:
            with self.subTest(dtype=samples.dtype, shape=samples.shape):
                options = ["--channel", arguments["channel"]] if arguments else []
                heard = earshot.listen(samples, 1000, **arguments)
                self.assertGreaterEqual(len(heard.detections), 3)
                file = write_wav(self.folder / "a.wav", samples)
                self.require_as_program(heard, file, *options, is_of_files=False)

    def test_of_any_layout_are_the_same(self):
        steps = in_steps(song(30, [12]), np.int16)
        expected = earshot.listen(steps, 1000)
        apart = np.zeros((steps.size, 3), np.int16)
        apart[:, 1] = steps
        frozen = steps.copy()
        frozen.flags.writeable = False
        for given in (
            apart[:, 1],
            steps[::-1].copy()[::-1],
            steps.astype(">i2"),
            frozen,
            memoryview(steps),
            steps[:, None],
        ):
            same_frames(self, earshot.listen(given, 1000), expected)
        same_frames(self, earshot.listen(np.asfortranarray(apart), 1000.0, channel=2), expected)
        # Read as floating point, by a reader that keeps no word of the file's bits.
        same_frames(self, earshot.listen(steps / 32768.0, 1000, bits=16), expected)
        same_frames(self, earshot.listen(pandas.Series(steps), 1000), expected)

    def test_of_every_number_type_have_the_level_of_their_full_scale(self):
        sound = song(30, [12], amplitude=0.25)
        # A sine's mean square, less what the noise adds: 0.0004 * 15 / 500, nothing beside it.
        expected = 10.0 * np.log10(0.25**2 / 2.0)
        for dtype in ("i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f2", "f4", "f8", "g"):
            samples = sound.astype(dtype) if np.dtype(dtype).kind == "f" else in_steps(sound * (1 - 2**-9), dtype)
            heard = earshot.listen(samples, 1000)
            self.assertEqual(len(heard.detections), 1, dtype)
            self.assertAlmostEqual(heard.detections["level_db_re_full_scale"][0], expected, delta=0.3, msg=dtype)

    def test_of_a_tone_have_its_level(self):
        rate, seconds, amplitude = 1000, 120, 0.1
        t = np.arange(rate * seconds) / rate
        noise = 1e-4 * np.random.default_rng(3).standard_normal(t.size)
        tone = amplitude * np.sin(2.0 * np.pi * 20.0 * t) + noise
        heard = earshot.listen(tone, rate, full_scale_db=170.0, preset="tone", levels_interval=30.0)
        # Full scale is a peak of 170 dB re 1 uPa; the mean square of a sine is half of its peak's square.
        expected = 170.0 + 20.0 * np.log10(amplitude) - 10.0 * np.log10(2.0)
        self.assertEqual((heard.level_unit, heard.levels.attrs["units"]["level"]), ("dB re 1 uPa", "dB re 1 uPa"))
        self.assertEqual(heard.detections.attrs["units"]["level_db_re_1upa"], "dB re 1 uPa")
        self.assertAlmostEqual(heard.detections["level_db_re_1upa"][0], expected, delta=0.05)
        self.assertEqual(heard.levels.shape[0], 4)
        bands = THIRD_OCTAVES_HZ[(THIRD_OCTAVES_HZ > 10.1) & (THIRD_OCTAVES_HZ < 450.0)]
        np.testing.assert_allclose(heard.levels.columns, bands, rtol=1e-12)
        of_twenty_hz = heard.levels.iloc[:, np.argmin(np.abs(bands - 20.0))]
        np.testing.assert_allclose(of_twenty_hz, expected, atol=0.01)  # a Hann window's leak beyond the band
        middle = heard.level_percentiles.xs(50.0, level="percentile")
        np.testing.assert_allclose(middle.iloc[:, np.argmin(np.abs(bands - 20.0))], expected, atol=0.01)

    def test_have_no_level_where_they_are_silent(self):
        sound = song(60, [12])
        sound[40_000:] = 0.0
        levels = earshot.listen(sound, 1000, levels_interval=10.0).levels
        np.testing.assert_array_equal(np.isnan(levels.to_numpy()).all(axis=1), [False] * 4 + [True] * 2)
        with self.assertRaisesRegex(earshot.BadInput, "every sample alike"):
            earshot.listen(0.0 * sound, 1000)

    def test_begin_when_somebody_says_so(self):
        heard = earshot.listen(song(30, [12]), 1000, begin="2024-06-01 05:31:14")
        begin = heard.detections["begin_utc"][0]
        seconds = (begin - pandas.Timestamp("2024-06-01T05:31:14Z")).total_seconds()
        self.assertAlmostEqual(seconds, heard.detections["begin_s"][0], places=6)
        self.assertEqual(str(heard.levels.index[0]), "2024-06-01 05:31:14+00:00")

    def test_can_be_heard_without_levels_and_their_rows_pickled(self):
        heard = earshot.listen(song(30, [12]), 1000, levels_interval=None)
        self.assertTrue(heard.levels.empty and heard.level_percentiles.empty)
        again = pickle.loads(pickle.dumps(heard))
        pandas.testing.assert_frame_equal(again.detections, heard.detections)
        self.assertEqual(again.detections.attrs, heard.detections.attrs)


class Streams(Cases):
    def together(self, listener, samples, sizes):
        """What push() and finish() give, joined."""
        parts, begin, i = [], 0, 0
        while begin < len(samples):
            size = sizes[i % len(sizes)]
            parts.append(listener.push(samples[begin : begin + size]))
            begin, i = begin + size, i + 1
        last = listener.finish()
        parts.append(last)
        frames = {
            name: pandas.concat([getattr(p, name) for p in parts], ignore_index=name == "detections")
            for name in ("detections", "levels", "level_percentiles")
        }
        return type(last)(**{**last.__dict__, **frames}), parts

    def test_give_the_same_rows_as_the_whole(self):
        rng = np.random.default_rng(4)
        steps = in_steps(np.column_stack([song(400, range(5, 400, 13)), song(400, [7, 200], seed=9)]), np.int16)
        arguments: dict[str, Any] = {"channel": 1, "full_scale_db": 176.1, "levels_interval": 10.0, "threshold_db": 7}
        whole = earshot.listen(steps, 1000, begin="2024-06-01T05:31:14Z", **arguments)
        self.assertEqual(len(whole.detections), 31)
        for sizes in ([1000], [400_000], [0, 1, 4095, 4096, 4097], rng.integers(1, 20_000, 50).tolist()):
            listener = earshot.Listener(1000, dtype=np.int16, begin="2024-06-01T05:31:14Z", **arguments)
            joined, parts = self.together(listener, steps, sizes)
            same_frames(self, joined, whole)
            self.assertGreater(sum(len(part.detections) > 0 for part in parts), 0)
        listener = earshot.Listener(1000, dtype=np.int16, **arguments)
        _, parts = self.together(listener, steps, [1000])
        rows = np.cumsum([len(part.detections) for part in parts])
        self.assertEqual(rows[118], 0)  # two minutes of noise are not there yet
        self.assertGreaterEqual(rows[150], 10)  # of 11 calls that began before 148 s; a row comes some seconds later

    def test_take_samples_beyond_full_scale_as_the_whole_does_when_they_know_the_largest(self):
        sound = 500.0 * song(60, [12, 30])
        whole = earshot.listen(sound, 1000)
        listener = earshot.Listener(1000, largest_magnitude=float(np.abs(sound).max()))
        joined, _ = self.together(listener, sound, [777])
        same_frames(self, joined, whole)
        self.assertEqual(set(whole.detections["validity"]), {"good"})

    def test_go_on_after_a_block_that_is_refused(self):
        sound = song(60, [12, 30])
        listener = earshot.Listener(1000)
        listener.push(sound[:20_000])
        for bad in (np.full(5, np.nan), sound[:10].astype(np.float32), np.zeros((5, 2)), np.zeros((2, 2, 2))):
            with self.assertRaises(earshot.BadInput) as caught:
                listener.push(bad)
            self.assertEqual(caught.exception.key, "block")
        listener.push(sound[20_000:])
        pandas.testing.assert_frame_equal(listener.finish().detections, earshot.listen(sound, 1000).detections)

    def test_are_over_when_they_are_finished(self):
        listener = earshot.Listener(1000)
        listener.push(song(30, []))
        listener.finish()
        self.assertRaisesRegex(RuntimeError, "finish", listener.push, np.zeros(3))
        self.assertRaisesRegex(RuntimeError, "finish", listener.finish)

    def test_too_short_are_refused(self):
        for count in (0, 1, 500):
            listener = earshot.Listener(1000)
            listener.push(song(1, [])[:count])
            self.assertRaisesRegex(earshot.BadInput, "too short", listener.finish)


if __name__ == "__main__":
    unittest.main()
