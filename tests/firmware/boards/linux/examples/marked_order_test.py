"""Whose challenge marked_order.py marks orders for."""

import argparse
import struct
import sys
import types
import unittest
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[5]
KEY = bytes(31) + b"\x2a"


@dataclass
class Challenge:
    """As lcm-gen makes it of challenge_t.lcm."""

    utime: int
    nonce: bytes
    vehicle: bytes = b"auv-7".ljust(32, b"\0")
    mission: bytes = bytes(32)
    mark: bytes = b""


# What lcm-gen makes is not needed to judge challenges.
stand_in = types.ModuleType("earshot")
vars(stand_in).update(challenge_t=Challenge, operator_command_t=object)
sys.modules["earshot"] = stand_in
sys.path.insert(0, str(ROOT / "firmware/boards/linux/examples"))
import marked_order  # noqa: E402


class MarkerTest(unittest.TestCase):
    """A program that gives orders, which hears challenges."""

    def setUp(self) -> None:
        self.marker = marked_order.Marker(argparse.Namespace(key_file=None, vehicle_id="auv-7", mission=None))
        self.marker.key = KEY

    def hear(self, start: int, utime: int, key: bytes = KEY) -> int:
        """Of a start of the vehicle. @return the start that orders are marked for"""
        challenge = Challenge(utime, bytes([start]) * 16)
        parts = b"EARSHOT CHALLENGE1", struct.pack("<q", utime), marked_order.told(challenge)
        challenge.mark = marked_order.blake2b(key, *parts)
        self.marker.hear(challenge)
        return self.marker.challenge.nonce[0] if self.marker.challenge else 0

    def test_takes_the_challenge_of_a_vehicle_that_began_anew(self) -> None:
        self.assertEqual(self.hear(1, 1000), 1)
        self.assertEqual(self.hear(1, 1001), 1)
        self.assertEqual(self.hear(2, 2000), 2)

    def test_takes_it_though_its_clock_begins_behind(self) -> None:
        self.assertEqual(self.hear(1, 1_795_000_000_000_000), 1)
        self.assertEqual(self.hear(2, 5), 2)

    def test_does_not_go_back_to_a_recording(self) -> None:
        for utime in (1000, 1001):
            self.hear(1, utime)
        self.hear(2, 5)
        for utime in (1000, 1001):
            self.assertEqual(self.hear(1, utime), 2)
        self.assertEqual(self.hear(2, 6), 2)

    def test_comes_back_from_a_recording_that_it_had_not_heard(self) -> None:
        self.hear(2, 1000)
        self.hear(1, 500)
        self.assertEqual(self.hear(2, 1001), 2)
        self.assertEqual(self.hear(1, 500), 2)

    def test_takes_no_challenge_of_who_does_not_know_the_key(self) -> None:
        self.assertEqual(self.hear(1, 1000, bytes(32)), 0)


if __name__ == "__main__":
    unittest.main()
