"""What `earshot.listen` and `earshot.Listener` refuse, and that whoever waits for them can go on or end them.

Run by ctest (run in this folder).
"""

import os
import signal
import threading
import time
import unittest
from typing import Any

import numpy as np
import pandas
from listening_cases import Cases, in_steps, song, write_wav

import earshot


class Waiting(Cases):
    def test_ends_at_once_when_it_is_interrupted(self):
        rate = 200_000  # decimated, which takes long
        samples = np.tile(song(10, [5], rate), 13).astype(np.float32)  # more than what is kept

        def interrupt():
            time.sleep(0.2)
            os.kill(os.getpid(), signal.SIGINT)

        def interrupted(work):
            thread = threading.Thread(target=interrupt)
            thread.start()
            self.assertRaises(KeyboardInterrupt, work)
            thread.join()

        file = write_wav(self.folder / "long.wav", samples, rate)
        shares: list[float] = []
        interrupted(lambda: earshot.listen(file, progress=shares.append))
        self.assertLess(max(shares, default=0.0), 1.0)
        for _ in range(10):  # on a busy computer the signal may come before the work has begun
            listener = earshot.Listener(rate, dtype=np.float32)
            interrupted(lambda listener=listener: listener.push(samples))
            try:
                listener.push(samples[:10])
            except RuntimeError as refused:
                self.assertIn("interrupted", str(refused))
                return
        self.fail("no push was interrupted")

    def test_shows_how_far_it_is_and_lets_others_run(self):
        samples = in_steps(np.tile(song(60, [5], 48_000), 4), np.int16)
        shares: list[float] = []
        ran, is_over = [], threading.Event()

        def count():
            while not is_over.is_set():
                ran.append(time.monotonic())
                time.sleep(0.001)

        other = threading.Thread(target=count)
        other.start()
        earshot.listen(write_wav(self.folder / "a.wav", samples, 48_000), progress=shares.append)
        is_over.set()
        other.join()
        self.assertEqual(shares, sorted(shares))
        self.assertGreaterEqual(shares[0], 0.0)
        self.assertLessEqual(shares[-1], 1.0)
        self.assertGreater(len(ran), 20)

    def test_ends_where_who_is_told_wants_it_to(self):
        def enough(share):
            raise ZeroDivisionError

        file = write_wav(self.folder / "a.wav", np.tile(in_steps(song(60, [5], 48_000), np.int16), 4), 48_000)
        self.assertRaises(ZeroDivisionError, earshot.listen, file, progress=enough)

    def test_refuses_a_second_thread_in_one_listener(self):
        samples = in_steps(np.tile(song(60, [5], 96_000), 5), np.int16)
        listener = earshot.Listener(96_000, dtype=np.int16)
        thread = threading.Thread(target=listener.push, args=(samples,))
        thread.start()
        refused = 0
        while thread.is_alive():
            try:
                listener.push(samples[:1])
            except RuntimeError:
                refused += 1
        thread.join()
        self.assertGreater(refused, 0)


class Refused(Cases):
    def require(self, key, *arguments, kind: type[Exception] = earshot.BadInput, call=earshot.listen, **named):
        with self.assertRaises(kind) as caught:
            call(*arguments, **named)
        self.assertEqual(getattr(caught.exception, "key", None), key, str(caught.exception))
        return str(caught.exception)

    def test_are_arrays_that_are_no_sound(self):
        sound = song(30, [12])
        holed = sound.copy()
        holed[17] = np.nan
        self.assertIn("samples[17] = nan", self.require("samples", holed, 1000))
        masked = np.ma.masked_less(sound, 0.0)
        bad = [
            [],
            np.zeros((0, 2)),
            np.where(sound > 0.03, np.inf, sound),
            1e300 * sound,
            masked,
            sound[:, None, None],
            np.float64(3.0),
            np.zeros((2, 1000)),
            sound.astype(complex),
            sound > 0.0,
            sound.astype(object),
            ["a", 3],
            sound.astype("U6"),
            [[1.0], [1.0, 2.0]],
            None,
            {"a": 1},
            np.zeros(100),
            sound.astype("datetime64[s]"),
            b"bytes",
            "",
            object(),
        ]
        for samples in bad:
            self.require("samples", samples, None if isinstance(samples, str) else 1000)

    def test_are_wrong_arguments_by_their_names(self):
        sound = song(30, [12])
        wrong: list[tuple[str, Any]] = [
            *(("rate", rate) for rate in (0.0, -1.0, np.nan, np.inf, 20.0, 2e6, "fast", None, [1.0], True)),
            *(("preset", preset) for preset in ("whale", "", 3, None)),
            *(("band", b) for b in ((30, 15), (0.5, 20), (15, 2000), (np.nan, 20), (15,), 15, (20, 20.1), "low")),
            *(("threshold_db", threshold) for threshold in (-11, 61, np.nan, "loud", [1, 2])),
            *(("channel", channel) for channel in (0, 2, -1, 1.5, 1e9, "left")),
            *(("full_scale_db", level) for level in (-101, 401, np.nan, "loud")),
            *(("calibration", chain) for chain in (3, [1], self.folder / "nowhere.toml")),
            *(("begin", begin) for begin in ("noon", 3, pandas.NaT, "2021-02-05T03:59:46 CET", "1850-01-01")),
            *(("bits", bits) for bits in (7, 33, 16.5, "many", np.nan)),
            *(("levels_interval", interval) for interval in (0.5, 86_401, np.nan, "minute")),
            ("progress", 3),
            ("time_format", "%Y"),
        ]
        for name, value in wrong:
            with self.subTest(argument=name, value=value):
                self.require(name, sound, **{"rate": 1000, name: value})
        self.require("full_scale_db", sound, 1000, full_scale_db=170, calibration={"full_scale_level_db_re_1upa": 170})

    def test_are_wrong_calibrations_by_their_keys(self):
        sound = song(30, [12])
        self.require("gain_db", sound, 1000, calibration={"full_scale_level_db_re_1upa": 170.0, "gain_db": 3.0})
        self.require("gains_db", sound, 1000, calibration={"full_scale_level_db_re_1upa": 170.0, "gains_db": 3.0})
        self.require("sensitivity_db_re_1v_per_upa", sound, 1000, calibration={"full_scale_v": 1.0})
        self.require(
            "calibration", sound, 1000, calibration={"full_scale_level_db_re_1upa": 170.0, "high_pass_corner_hz": 20}
        )
        file = self.folder / "chain.toml"
        file.write_text("full_scale_v = 2.0\nsensitivity_db_re_1v_per_upa = 170.0\n")
        with self.assertRaises(earshot.BadInput) as caught:
            earshot.listen(sound, 1000, calibration=file)
        bad = caught.exception
        self.assertEqual((bad.file, bad.line, bad.key), (str(file), 2, "sensitivity_db_re_1v_per_upa"))

    def test_are_files_that_are_none(self):
        notes = self.folder / "notes.wav"
        notes.write_text("no sound")
        self.require("samples", "a\0b.wav")
        for path in (notes, self.folder / "nowhere.wav", "/dev/zero", "/dev/null"):
            self.assertIn(str(path), self.require("samples", path))
        empty = self.folder / "empty"
        empty.mkdir()
        self.require("samples", empty)
        good = write_wav(self.folder / "good.wav", in_steps(song(30, [12]), np.int16))
        self.require("samples", [good, good])
        self.require("rate", good, 1000)
        self.require("bits", good, bits=16)
        self.require("channel", good, channel=2)
        self.require("time_format", good, time_format="%Q")
        self.require("begin", good, begin="2021-02-05", time_format="%Y")
        with self.assertWarnsRegex(earshot.RecordingWarning, "notes.wav"):
            self.assertEqual(len(earshot.listen([good, notes]).detections), 1)

    def test_are_wrong_arguments_of_a_listener(self):
        for name, value in (
            ("rate", 0.0),
            ("dtype", "U3"),
            ("dtype", "nothing"),
            ("largest_magnitude", 0.0),
            ("bits", 3),
        ):
            arguments: dict[str, Any] = {"rate": 1000, name: value}
            self.require(name, call=earshot.Listener, **arguments)

    def test_whatever_is_given_never_ends_the_process(self):
        rng = np.random.default_rng(8)
        dtypes = ["f2", "f4", "f8", "i1", "u1", "i2", "i4", "i8", "u8", ">f4", "?", "c8", "O"]
        heard = refused = 0
        for _ in range(300):
            shape = tuple(rng.integers(0, [9_000, 4, 3][: rng.integers(0, 4)]).tolist())
            samples = np.frombuffer(rng.bytes(16 * int(np.prod(shape))), "u1")
            dtype = np.dtype(rng.choice(dtypes))
            samples = samples.astype(dtype) if dtype.kind == "O" else samples.view(dtype)
            samples = samples[: int(np.prod(shape))].reshape(shape)
            samples = samples[:: rng.choice([1, 2, -1])] if samples.ndim > 0 else samples
            with np.errstate(all="ignore"):
                try:
                    earshot.listen(
                        samples, float(rng.choice([100.0, 1000.0, 48_000.0])), channel=int(rng.integers(1, 3))
                    )
                    heard += 1
                except earshot.BadInput:
                    refused += 1
        self.assertGreater(refused, 100)
        self.assertGreater(heard, 10)


if __name__ == "__main__":
    unittest.main()
