"""`earshot.read_journal`: a simulated flight's journal, a log as lcm-logger writes it, and what is neither.

Run by ctest (run in this folder).
"""

import json
import math
import os
import struct
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pandas
from third_tick import third_tick_interrupts

import earshot
from earshot.core import journal_fields, journal_records
from earshot.journals import _unit

ROOT = Path(__file__).resolve().parents[3]
PROGRAMS = Path(os.environ["EARSHOT_PROGRAMS"])

_EVENT = struct.Struct(">IqqII")  # of LCM's log: mark, number, time in us, lengths of channel and data
_MARK = 0xEDA1DA01


def events_of(file):
    """What LCM's own event log says, by its documented layout: (time in us, channel, data)."""
    data, at, events = file.read_bytes(), 0, []
    while at < len(data):
        mark, _, time_us, channel_size, data_size = _EVENT.unpack_from(data, at)
        assert mark == _MARK
        at += _EVENT.size
        begin = at + channel_size
        events.append((time_us, data[at:begin].decode(), data[begin : begin + data_size]))
        at = begin + data_size
    return events


def flat(fields, prefix=""):
    out: dict[str, Any] = {}
    for name, value in (fields or {}).items():
        out.update(flat(value, f"{prefix}{name}.") if isinstance(value, dict) else {prefix + name: value})
    return out


class Flights(unittest.TestCase):
    folder: Path
    journal: Path
    frames: Any

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        types = cls.folder / "types"
        definitions = map(str, (ROOT / "firmware/wire/lcm").glob("*.lcm"))
        subprocess.run(["lcm-gen", "-p", "--ppath", str(types), *definitions], check=True, capture_output=True)
        sys.path.append(str(types))
        cls.addClassCleanup(sys.path.remove, str(types))
        fly = [str(PROGRAMS / "earshot-fly"), "--quiet", "--no-report", "--out", str(cls.folder / "flight")]
        subprocess.run(fly, check=True, cwd=ROOT)
        cls.journal = cls.folder / "flight/journal.lcmlog"
        cls.frames = earshot.read_journal(cls.journal)

    def test_hold_every_record_that_the_program_writes(self):
        lines = self.folder / "records.jsonl"
        subprocess.run([PROGRAMS / "earshot-journal", self.journal, "--jsonl", lines], check=True, capture_output=True)
        records = [json.loads(line) for line in lines.read_text().splitlines()]
        self.assertEqual(len(records), sum(map(len, self.frames.values())))
        rows = {topic: iter(frame.to_dict("records")) for topic, frame in self.frames.items()}
        for record in records:
            row = next(rows[record["topic"]])
            fields = {"record_number": record["number"], **flat(record["fields"])}
            unlike = [n for n, v in fields.items() if row[n] != v and not (v is None and math.isnan(row[n]))]
            if unlike:  # asked once a record, an assertion for each value would take 20 s
                self.fail(f"record {record['number']}: {unlike}")

    def test_hold_what_lcm_gens_own_types_read(self):
        from earshot import health_t, setpoint_t

        for kind, channel, topic, names in (
            (setpoint_t, "EARSHOT_SETPOINT", "setpoint", ("heading_rad", "depth_m", "speed_mps")),
            (health_t, "EARSHOT_HEALTH", "health", ("steps_taken",)),
        ):
            sent = [
                (time, kind.decode(data))
                for time, name, data in events_of(self.journal)
                if name.split(".")[0] == channel
            ]
            frame = self.frames[topic]
            self.assertGreater(len(sent), 5)
            self.assertEqual(len(frame), len(sent))
            for name in names:
                np.testing.assert_array_equal(frame[name], [getattr(message, name) for _, message in sent])
            microseconds = (frame.index - pandas.Timestamp(0, tz="UTC")) // pandas.Timedelta("1us")
            self.assertEqual(list(microseconds), [time for time, _ in sent])

    def test_have_an_index_in_utc_units_and_meanings(self):
        for topic, frame in self.frames.items():
            self.assertEqual((str(frame.index.tz), frame.index.name), ("UTC", "time"), topic)
            self.assertLessEqual(set(frame.attrs["units"]), set(frame.columns), topic)
        navigation = self.frames["navigation"]
        self.assertEqual(navigation.attrs["units"]["depth_m"], "m")
        self.assertEqual(self.frames["setpoint"].attrs["units"]["heading_rad"], "rad")
        self.assertEqual(self.frames["snr"].attrs["units"]["snr_db"], "dB")
        self.assertFalse(navigation.attrs["is_dated"])
        self.assertTrue(any(frame.attrs["meanings"] for frame in self.frames.values()))

    def test_are_found_by_their_folder(self):
        again = earshot.read_journal(self.journal.parent)
        self.assertEqual(again.keys(), self.frames.keys())
        pandas.testing.assert_frame_equal(again["decision"], self.frames["decision"])

    def test_that_lack_their_end_are_read_with_a_warning(self):
        torn = self.folder / "torn.lcmlog"
        torn.write_bytes(self.journal.read_bytes()[:-7])
        with self.assertWarnsRegex(earshot.JournalWarning, "torn.lcmlog: .*its end is torn"):
            frames = earshot.read_journal(torn)
        self.assertEqual(sum(map(len, frames.values())), sum(map(len, self.frames.values())) - 1)

    def test_that_are_damaged_never_do_more_than_warn_or_be_refused(self):
        rng, whole = np.random.default_rng(5), np.frombuffer(self.journal.read_bytes(), np.uint8)
        start = whole[:80_000]
        damaged = self.folder / "damaged.lcmlog"
        warned = 0
        for _ in range(40):
            bytes_now = start.copy()
            bytes_now[rng.integers(0, bytes_now.size, rng.integers(1, 200))] = rng.integers(0, 256)
            damaged.write_bytes(bytes_now[: rng.integers(1, bytes_now.size)].tobytes())
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                try:
                    earshot.read_journal(damaged)
                except earshot.BadInput:
                    continue
            warned += len(caught)
        self.assertGreater(warned, 10)


class BusLogs(unittest.TestCase):
    def test_of_any_size_are_left_at_ctrl_c(self):
        with tempfile.TemporaryDirectory() as folder:
            log, channel = Path(folder) / "long.log", b"EARSHOT_NAV_STATE"
            event = _EVENT.pack(_MARK, 0, 1, len(channel), 400) + channel + bytes(400)
            log.write_bytes(event * 300_000)  # 130 MB
            with third_tick_interrupts() as start, self.assertRaises(KeyboardInterrupt):
                start()
                journal_records(log)

    def test_are_read_with_the_loggers_dates(self):
        with tempfile.TemporaryDirectory() as folder:
            definitions = map(str, (ROOT / "firmware/wire/lcm").glob("*.lcm"))
            subprocess.run(["lcm-gen", "-p", "--ppath", folder, *definitions], check=True, capture_output=True)
            sys.path.append(folder)
            self.addCleanup(sys.path.remove, folder)
            from earshot import nav_state_t

            log, noon_us = Path(folder) / "bus.log", 1_795_953_600_000_000  # 2026-11-29 12:00 UTC: date -d @1795953600
            times_us = [
                noon_us,
                noon_us + 1_000_000,
                noon_us + 2_000_000,
                32_503_680_000_000_000,
            ]  # the last: the year 3000
            with log.open("wb") as file:
                for i, time_us in enumerate(times_us):
                    fix = nav_state_t()
                    fix.utime, fix.depth_m = noon_us + i, 100.5 + i
                    data, channel = fix.encode(), b"EARSHOT_NAV_STATE"
                    file.write(_EVENT.pack(_MARK, i, time_us, len(channel), len(data)) + channel + data)
            with self.assertWarnsRegex(earshot.JournalWarning, "bus.log: 1 times .* NaT"):
                frame = earshot.read_journal(log)["navigation"]
        self.assertEqual(list(frame["depth_m"]), [100.5, 101.5, 102.5, 103.5])
        self.assertEqual(str(frame.index[2]), "2026-11-29 12:00:02+00:00")
        self.assertEqual((frame.attrs["is_bus_log"], frame.attrs["is_dated"]), (True, True))


class Fields(unittest.TestCase):
    def test_have_the_unit_of_their_type_in_their_name(self):
        typed = [(n, unit) for fields in journal_fields().values() for n, (unit, _) in fields.items() if unit]
        self.assertGreater(len(typed), 40)
        for name, unit in typed:
            if unit != "s":  # an instant may be called as it is told: `expiry_utime`
                self.assertEqual(_unit(name, "").split()[0], unit, name)

    def test_of_every_topic_are_described(self):
        topics = journal_fields()
        self.assertIn("depth_m", topics["navigation"])
        self.assertIn("snr_db", topics["snr"])
        self.assertEqual(topics["setpoint"]["speed_mps"][0], "m/s")
        self.assertNotIn("record_number", {name for fields in topics.values() for name in fields})


class Refused(unittest.TestCase):
    def test_is_what_is_no_journal(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "notes.txt"
            for content in (b"", b"not a journal at all, but long enough to be one\n" * 100, bytes(5_000)):
                file.write_bytes(content)
                with self.assertRaises(earshot.BadInput) as caught:
                    earshot.read_journal(file)
                self.assertIn("notes.txt", str(caught.exception))
            self.assertRaises(earshot.BadInput, earshot.read_journal, folder)
        self.assertRaises(earshot.BadInput, earshot.read_journal, "/nowhere/journal.lcmlog")
        self.assertRaises(TypeError, earshot.read_journal, 3)
        self.assertRaises(earshot.BadInput, earshot.read_journal, "journal\0.lcmlog")


if __name__ == "__main__":
    unittest.main()
