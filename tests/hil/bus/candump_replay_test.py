"""A flight over CAN, recorded by earshot candump and replayed by canplayer to another earshotd. Runs where vcan0 is.

usage: candump_replay_test.py FOLDER_OF_PROGRAMS
"""

from __future__ import annotations

import json
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from collections.abc import Callable, Iterator
from pathlib import Path

PROGRAMS = Path()
ROOT = Path(__file__).resolve().parents[3]
SPEED = "20"  # seconds at sea in one of the host's
EARSHOT, OPERATOR = 0x40, 0x29  # addresses
SETPOINT = 65290
ROUND = (-1, 0, 1)  # cells of a metre, about one of them


def wait_for(what: Callable[[], bool], why: str) -> None:
    """Until what() is true; two minutes are long enough for a machine that has other things to do."""
    end = time.monotonic() + 120
    while not what():
        if time.monotonic() > end:
            raise AssertionError(why)
        time.sleep(0.2)


def fixes_in(journal: Path) -> Iterator[tuple[float, ...]]:
    """North, east, depth, heading and speed of every fix; an LCM log: head, channel, data; numbers are big-endian."""
    data = journal.read_bytes()
    at = 0
    while at + 28 <= len(data):
        _sync, _number, _time, channel_size, size = struct.unpack_from(">IqqII", data, at)
        channel = data[at + 28 : at + 28 + channel_size]
        at += 28 + channel_size + size
        if channel.startswith(b"EARSHOT_NAV_STATE."):
            yield struct.unpack_from(">5d", data, at - size + 16)


class Replay(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        # What is late is waited for: a machine that tests share may halt everything for a while.
        mission = (ROOT / "firmware/boards/linux/missions/search_over_can_alone.toml").read_text()
        mission = mission.replace("_timeout_s = 5.0", "_timeout_s = 120.0")
        frozen = str(ROOT / "policy/frozen")
        (self.folder / "mission.toml").write_text(mission.replace("../../../../policy/frozen", frozen))

    def start(self, program: str, *arguments: str) -> subprocess.Popen[bytes]:
        log = (self.folder / f"{program}.txt").open("ab")
        self.addCleanup(log.close)
        process = subprocess.Popen([str(PROGRAMS / program), *arguments], stdout=log, stderr=log)

        def kill() -> None:
            process.kill()
            process.wait()

        self.addCleanup(kill)
        return process

    def earshotd(self, out: str) -> subprocess.Popen[bytes]:
        mission = str(self.folder / "mission.toml")
        return self.start(
            "earshotd", mission, "--can-interface", "vcan0", "--speed", SPEED, "--out", str(self.folder / out)
        )

    def vehicle(self, *without: str) -> subprocess.Popen[bytes]:
        mission = str(self.folder / "mission.toml")
        place = ["--start", "12500", "12500", "--source", "2000", "2000"]
        more = ["--without", ",".join(without)] if without else []
        return self.start(
            "earshot-emulate", "--mission", mission, "--interface", "vcan0", "--speed", SPEED, *place, *more
        )

    def record(self, name: str) -> subprocess.Popen[bytes]:
        return self.start("earshot-candump", "vcan0", "--quiet", "--record", str(self.folder / name))

    def count(self, log: str, group: str) -> int:
        """Frames of a group, written as in an identifier, that Earshot sent."""
        path = self.folder / log
        return path.read_text().count(f"{group}{EARSHOT:02X}#") if path.exists() else 0

    def end(self, *processes: subprocess.Popen[bytes]) -> None:
        for process in processes:
            process.send_signal(signal.SIGINT)
        for process in processes:
            process.wait(60)

    def said(self) -> str:
        return "".join(path.read_text() for path in sorted(self.folder.glob("*.txt")))[-3000:]

    def heard(self, log: str, pgn: int) -> list[dict]:
        """What Earshot said in a recording."""
        command = [
            str(PROGRAMS / "earshot-candump"),
            str(self.folder / log),
            *("--format", "json", "--pgn", str(pgn), "--source", str(EARSHOT)),
        ]
        printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        return [json.loads(line)["signals"] for line in printed.splitlines()]

    def fly_first(self) -> list[tuple[float, ...]]:
        recorder = self.record("flight.log")
        flight = [self.earshotd("flight"), self.vehicle()]
        wait_for(lambda: self.count("flight.log", "FF0A") >= 300, "no set-points in the first flight\n" + self.said())
        self.end(*flight, recorder)
        return list(fixes_in(self.folder / "flight/journal.lcmlog"))

    def test_a_recorded_flight_replayed_by_canplayer_is_taken_and_flown(self):
        recorded = self.fly_first()
        # Earshot's own frames are left out, for it sends its own. So are the operator's: orders are dated and expire,
        # so that one gives them anew.
        lines = (self.folder / "flight.log").read_text().splitlines()
        others = [line for line in lines if int(line.split()[2].split("#")[0], 16) & 0xFF not in (EARSHOT, OPERATOR)]
        (self.folder / "replay.log").write_text("\n".join(others) + "\n")

        recorder = self.record("again.log")
        flight = [
            self.earshotd("again"),
            self.vehicle(
                *("autopilot", "compass", "speed-log", "depth-sensor", "navigation", "hydrophone"),
                *("altimeter", "battery"),
            ),
        ]
        subprocess.run(["canplayer", "-I", str(self.folder / "replay.log"), "vcan0=vcan0"], check=True)
        self.end(*flight, recorder)

        replayed = list(fixes_in(self.folder / "again/journal.lcmlog"))
        self.assertGreater(len(replayed), 0.8 * len(recorded), self.said())
        # The vehicle says its place in two messages, which are rounded differently; after a halt of the machine the
        # other may be the one that is taken. Said ten times a second or once, there is one within a metre of wherever
        # a vehicle of 2 m/s was.
        cells = {(round(fix[0]) + n, round(fix[1]) + e) for fix in recorded for n in ROUND for e in ROUND}
        known = sum((round(fix[0]), round(fix[1])) in cells for fix in replayed)
        self.assertGreater(known, 0.8 * len(replayed), self.said())
        states = [health["State"]["value"] for health in self.heard("again.log", 130950)]
        self.assertIn("SEARCH", states, self.said())
        moving = [s for s in self.heard("again.log", SETPOINT) if s["CommandedSpeed"]["value"] == 2.0]
        self.assertGreater(len(moving), 100, self.said())
        print(f"{len(others)} frames replayed; {len(recorded)} fixes, then {len(replayed)}; {len(moving)} set-points")


if __name__ == "__main__":
    PROGRAMS = Path(sys.argv.pop(1))
    os.chdir(ROOT)
    unittest.main(verbosity=2)
