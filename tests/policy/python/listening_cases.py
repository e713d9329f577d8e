"""Recordings for the tests of listening, and what `earshot listen` writes of them.

Used by them as a module beside them.
"""

import csv
import json
import os
import subprocess
import tempfile
import unittest
import wave
from pathlib import Path

import numpy as np
import pandas
from field_cases import length_in_netcdf, read_netcdf

PROGRAM = Path(os.environ["EARSHOT_PROGRAMS"]) / "earshot-listen"


def song(seconds, calls_s, rate=1000, seed=1, amplitude=0.05):
    """Noise of a root mean square of 0.02 with calls of 1 s at 20 Hz: float64, shares of full scale."""
    samples = 0.02 * np.random.default_rng(seed).standard_normal(rate * seconds)
    call = amplitude * np.sin(2.0 * np.pi * 20.0 * np.arange(rate) / rate)
    for begin in calls_s:
        at = int(begin * rate)
        samples[at : at + rate] += call[: samples[at : at + rate].size]
    return samples


def in_steps(samples, dtype):
    """As an ADC of that type gives them."""
    full_scale = 2.0 ** (8 * np.dtype(dtype).itemsize - 1)
    middle = full_scale if np.dtype(dtype).kind == "u" else 0.0
    return (np.clip(np.round(full_scale * samples), -full_scale, full_scale - 1.0) + middle).astype(dtype)


def write_wav(path, samples, rate=1000):
    """By Python's own library; floating point by the WAV format's own words, for that library knows none."""
    samples = np.ascontiguousarray(samples)
    channels = 1 if samples.ndim == 1 else samples.shape[1]
    size = samples.dtype.itemsize
    if samples.dtype.kind != "f":
        with wave.open(str(path), "wb") as file:
            file.setparams((channels, size, rate, 0, "NONE", ""))
            file.writeframes(samples.tobytes())
        return path
    data, words = samples.tobytes(), np.array
    form = words([3, channels], "<u2").tobytes() + words([rate, rate * channels * size], "<u4").tobytes()
    form += words([channels * size, 8 * size], "<u2").tobytes()
    body = b"WAVEfmt " + words([16], "<u4").tobytes() + form + b"data" + words([len(data)], "<u4").tobytes() + data
    path.write_bytes(b"RIFF" + words([len(body)], "<u4").tobytes() + body)
    return path


def same_frames(case, got, expected):
    for name in ("detections", "levels", "level_percentiles"):
        pandas.testing.assert_frame_equal(getattr(got, name), getattr(expected, name), check_exact=True, obj=name)
    for name in ("listened_s", "noise_db", "not_heard_s", "level_unit"):
        case.assertEqual(getattr(got, name), getattr(expected, name), name)


class Cases(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def program(self, *arguments):
        """What the program writes: its JSON, and rows of its CSV; exit status 0 or 1."""
        made = {kind: self.folder / f"program.{kind}" for kind in ("json", "csv", "nc")}
        command = [PROGRAM, *arguments, "--json", made["json"], "--csv", made["csv"], "--levels", made["nc"]]
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        with made["csv"].open(newline="") as file:
            return json.loads(made["json"].read_text()), list(csv.DictReader(file))

    def require_as_program(self, heard, *arguments, is_of_files=True):
        found, rows = self.program(*arguments)
        frame = heard.detections
        self.assertEqual(len(frame), len(found["detections"]))
        if rows:
            self.assertEqual(list(frame.columns), list(rows[0]))
        level = frame.columns[5]
        for row, expected in zip(frame.to_dict("records"), found["detections"], strict=True):
            for name in ("begin_s", "duration_s", "peak_s", "snr_db", "file_offset_s", "validity"):
                self.assertEqual(row[name], expected[name], name)
            self.assertEqual(row[level], expected["level_db"])
            if is_of_files:
                self.assertEqual(row["file"], expected["file"])
            utc = None if row["begin_utc"] is pandas.NaT else row["begin_utc"]
            milliseconds = expected["begin_utc"] and pandas.Timestamp(expected["begin_utc"])
            self.assertEqual(utc and utc.floor("ms"), milliseconds)
        for row, expected in zip(frame.to_dict("records"), rows, strict=True):
            self.assertEqual(f"{row['snr_db']:.2f}", expected["snr_db"])
            self.assertEqual(f"{row[level]:.2f}", expected[level])
        for name in ("listened_s", "noise_db", "not_heard_s", "level_unit"):
            self.assertEqual(getattr(heard, name), found[name], name)
        self.assertEqual((heard.sample_rate, list(heard.band)), (found["sample_rate_hz"], found["band_hz"]))
        nc, shape = self.folder / "program.nc", heard.levels.shape
        is_dated = isinstance(heard.levels.index, pandas.DatetimeIndex)
        time = "time" if is_dated else "elapsed_time"
        self.assertEqual(shape, (length_in_netcdf(nc, time), length_in_netcdf(nc, "frequency")))
        np.testing.assert_array_equal(read_netcdf(nc, "level", np.float32, shape), heard.levels.to_numpy(), strict=True)
        np.testing.assert_array_equal(
            read_netcdf(nc, "level_percentile", np.float32, (shape[0] * 5, shape[1])),
            heard.level_percentiles.to_numpy(),
        )
        np.testing.assert_array_equal(read_netcdf(nc, "frequency", np.float64, shape[1]), heard.levels.columns)
        seconds = heard.levels.index
        if is_dated:
            seconds = ((seconds - pandas.Timestamp(0, tz="UTC")) // pandas.Timedelta("1us")) / 1e6
        np.testing.assert_array_equal(read_netcdf(nc, time, np.float64, shape[0]), seconds)
        return found
