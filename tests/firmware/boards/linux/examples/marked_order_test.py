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


@dataclass
class Order:
    """Likewise of operator_command_t.lcm."""

    utime: int = 1
    expiry_utime: int = 2
    issuer: int = 3
    number: int = 4
    command: int = 5
    max_depth_m: float = 6.0
    max_speed_mps: float = 7.0
    max_time_s: float = 8.0
    mark: bytes = b""


# What lcm-gen makes is not needed to judge challenges.
stand_in = types.ModuleType("earshot")
vars(stand_in).update(challenge_t=Challenge, operator_command_t=Order)
sys.modules["earshot"] = stand_in
sys.path.insert(0, str(ROOT / "firmware/boards/linux/examples"))
import marked_order  # noqa: E402


class MarkerTest(unittest.TestCase):
    """A program that gives orders, which hears challenges."""

    def setUp(self) -> None:
        self.marker = marked_order.Marker(argparse.Namespace(key_file=None, vehicle_id="auv-7", mission=None))
        self.marker.key = KEY

    def hear(self, start: int, utime: int, key: bytes = KEY) -> int:
        """Of a start of the vehicle. @return the start that the next order is marked for"""
        challenge = Challenge(utime, bytes([start]) * 16)
        parts = b"EARSHOT CHALLENGE1", struct.pack("<q", utime), marked_order.challenge_bytes(challenge)
        challenge.mark = marked_order.blake2b(key, *parts)
        self.marker.hear(challenge)
        return self.next_start()

    def next_start(self) -> int:
        """@return the start that the next order is marked for"""
        kept = self.marker.start()
        return kept.challenge.nonce[0] if kept else 0

    def mark(self) -> int:
        """@return the start that an order is marked for"""
        start = self.next_start()
        self.assertTrue(self.marker.mark(Order()))
        return start

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

    def test_tries_every_start_in_turn_while_recordings_go_on(self) -> None:
        tried = []
        for utime in range(5):
            self.hear(2, 1000 + utime)
            self.hear(1, 500 + utime)
            tried.append(self.mark())
        self.assertEqual(tried, [1, 2, 1, 2, 1])

    def test_tries_a_start_at_once_that_was_not_heard_before(self) -> None:
        self.hear(1, 500)
        self.mark()
        self.mark()
        self.hear(2, 5)
        self.assertEqual(self.mark(), 2)

    def test_takes_a_refusal_for_final_once_every_start_was_tried_often(self) -> None:
        for start in (1, 2):
            self.hear(start, 1000)
        for _ in range(2 * self.marker.MOST_TRIES):
            self.assertFalse(self.marker.is_final("NOT_VERIFIED"))
            self.mark()
        self.assertTrue(self.marker.is_final("NOT_VERIFIED"))

    def test_takes_any_other_answer_for_final(self) -> None:
        self.hear(1, 1000)
        self.assertTrue(self.marker.is_final("OBEYED"))

    def test_takes_a_refusal_for_final_without_a_key(self) -> None:
        self.marker.key = None
        self.assertTrue(self.marker.is_final("NOT_VERIFIED"))

    def test_takes_no_challenge_of_who_does_not_know_the_key(self) -> None:
        self.assertEqual(self.hear(1, 1000, bytes(32)), 0)


if __name__ == "__main__":
    unittest.main()
