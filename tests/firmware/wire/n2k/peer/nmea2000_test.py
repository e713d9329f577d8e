"""Earshot and canboat (PyPI's nmea2000) read the same in the same bytes.

That is every standard message, over all that its bits can hold.
"""

import random
import subprocess
import sys
import unittest
from typing import Any

from nmea2000 import _canboat as canboat
from nmea2000.decoder import NMEA2000Decoder

PAYLOADS = 300  # of each message
DATABASE = canboat.Database("si")
# Of the tables' messages, those that canboat knows under several definitions.
IDS = {59392: "isoAcknowledgement", 126464: "pgnListTransmitAndReceive"}
# Its database has these in SI; what it reads, it tells in percent and ampere hours, as we do.
PUBLISHED_UNITS = {"ratio": 100.0, "C": 1.0 / 3600.0}
SKIPPED_KINDS = {"RESERVED", "SPARE"}


class Bridge:
    """Earshot's side: one line asks, one answers."""

    def __init__(self, program: str):
        self.process = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, line: str) -> str:
        assert self.process.stdin and self.process.stdout
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()
        return self.process.stdout.readline().rstrip("\n")

    def table(self) -> list[tuple[int, str, str, list[list[str]]]]:
        rows = []
        line = self.ask("table")
        while line != ".":
            pgn, name, framing, fields = (line.split(" ") + [""])[:4]
            rows.append((int(pgn), name, framing, [field.split(":") for field in fields.split(",") if field]))
            assert self.process.stdout
            line = self.process.stdout.readline().rstrip("\n")
        return rows

    def decode(self, pgn: int, payload: bytes) -> dict[str, str]:
        answer = self.ask(f"decode {pgn} {payload.hex()}")
        return dict(part.split("=", 1) for part in answer.split("\t") if part)

    def close(self) -> None:
        assert self.process.stdin and self.process.stdout
        self.process.stdin.close()
        self.process.wait()
        self.process.stdout.close()


def info_of(pgn: int) -> Any:
    variants = DATABASE.pgn_variants(pgn)
    return next((v for v in variants if v.id == IDS.get(pgn)), variants[0])


def fields_of(pgn: int) -> list[Any]:
    """Those with a fixed place, but for reserved ones."""
    return [f for f in info_of(pgn).fields if f.field_type not in SKIPPED_KINDS and f.bit_offset is not None]


def frames_as_lines(text: str) -> list[str]:
    return [f"(1700000000.{i:06d}) can0 {frame}" for i, frame in enumerate(text.split())]


def decoded(text: str) -> Any:
    """What canboat makes of candump's frames: the message that the last of them completes."""
    decoder = NMEA2000Decoder()
    message = None
    for line in frames_as_lines(text):
        message = decoder.decode(line)
    return message


def any_bits(generator: random.Random, bits: int) -> int:
    """All that the bits can hold, its ends and the special values beside them more often than by chance."""
    top = (1 << bits) - 1
    ends = [
        0,
        1,
        top,
        top - 1,
        top - 2,
        top - 3,
        top >> 1,
        (top >> 1) - 1,
        (top >> 1) - 2,
        (top >> 1) - 3,
        (top >> 1) + 1,
        (top >> 1) + 2,
    ]
    chosen = generator.choice(ends) if generator.random() < 0.3 else generator.getrandbits(bits)
    return min(max(chosen, 0), top)


class AgreesWithCanboat(unittest.TestCase):
    bridge: Bridge
    rows: list[tuple[int, str, str, list[list[str]]]]
    compared = 0  # numbers

    @classmethod
    def setUpClass(cls):
        cls.bridge = Bridge(PROGRAM)
        cls.rows = cls.bridge.table()

    @classmethod
    def tearDownClass(cls):
        cls.bridge.close()

    def pairs(self, pgn: int, ours: list[list[str]]) -> list[tuple[list[str], Any]]:
        """Each of our fields with canboat's in the same place."""
        theirs = {f.bit_offset: f for f in fields_of(pgn)}
        return [(field, theirs[int(field[1])]) for field in ours]

    def test_every_field_lies_in_its_place_with_its_scale(self):
        self.assertGreaterEqual(len(self.rows), 24)
        for pgn, name, framing, ours in self.rows:
            self.assertEqual(info_of(pgn).packet_type, framing, name)
            for (field, first, bits, numerator, denominator, *_), theirs in self.pairs(pgn, ours):
                self.assertEqual((theirs.bit_offset, theirs.bit_length), (int(first), int(bits)), f"{name} {field}")
                if theirs.field_type in ("NUMBER", "DATE", "TIME", "DURATION"):
                    resolution = theirs.resolution * PUBLISHED_UNITS.get(theirs.unit, 1.0)
                    self.assertAlmostEqual(
                        resolution * float(denominator) / float(numerator), 1.0, 12, f"{name} {field}"
                    )

    def test_every_payload_reads_the_same(self):
        generator = random.Random(2000)
        for pgn, name, framing, ours in self.rows:
            if framing == "ISO":
                continue
            pairs = [(field, theirs) for field, theirs in self.pairs(pgn, ours) if theirs.field_type != "STRING_FIX"]
            for _ in range(PAYLOADS):
                raws = {theirs.id: any_bits(generator, theirs.bit_length) for _, theirs in pairs}
                payload = self.payload(pgn, pairs, raws)
                read = self.bridge.decode(pgn, payload)
                message = decoded(self.as_frames(pgn, framing, payload))
                self.assertIsNotNone(message, name)
                peer = self.flat(message)
                for field, theirs in pairs:
                    self.compare(
                        f"{name} {field[0]} of {payload.hex()}", field, read[field[0]], peer.get(theirs.id), theirs
                    )

        self.assertGreater(self.compared, 10_000)

    @staticmethod
    def payload(pgn: int, pairs: list[tuple[list[str], Any]], raws: dict[str, int]) -> bytes:
        size = max(((int(f[1]) + int(f[2]) + 7) // 8 for f, _ in pairs), default=8)
        size = max(size, {59904: 3, 126464: 4, 126996: 134, 129029: 43}.get(pgn, 8))
        bits = (1 << (8 * size)) - 1
        for field, theirs in pairs:
            mask = ((1 << int(field[2])) - 1) << int(field[1])
            bits = (bits & ~mask) | (raws[theirs.id] << int(field[1]))
        return bits.to_bytes(size, "little")

    @staticmethod
    def as_frames(pgn: int, framing: str, payload: bytes) -> str:
        identifier = f"{canboat.can_id_compose(6, pgn, 0x23, 255):08X}"
        if framing == "Single":
            return f"{identifier}#{payload.hex().upper()}"
        return " ".join(f"{identifier}#{bytes(f).hex().upper()}" for f in canboat.fast_packet_fragment(5, payload))

    @staticmethod
    def flat(message: Any) -> dict[str, Any]:
        """Fields by canboat's name, the first of repeated ones among them."""
        found: dict[str, Any] = {}
        for field in message.fields:
            if isinstance(field.value, list) and field.value:
                found |= field.value[0]
            found[field.id] = field
        return found

    def compare(self, what: str, field: list[str], ours: str, peer: Any, theirs: Any) -> None:
        self.assertIsNotNone(peer, what)
        if theirs.field_type in ("LOOKUP", "INDIRECT_LOOKUP"):
            if ours not in ("na", "bad"):
                self.assertEqual(int(ours), peer.raw_value, what)
            return
        value = peer.raw_value
        if ours in ("na", "bad"):
            # Beyond what the standard allows canboat may still show a number; "not available" it never does.
            if ours == "bad" and isinstance(value, (int, float)):
                lowest, highest = (int(end) * float(field[3]) / float(field[4]) for end in field[5:7])
                room = 1e-12 * abs(value)  # 64 bits are more than a double holds
                self.assertFalse(lowest + room <= value <= highest - room, what)
            if ours == "na" and theirs.field_type != "PGN":  # canboat shows a group's number whatever it is
                self.assertIsNone(value, what)
            return
        self.assertIsNotNone(value, what)
        AgreesWithCanboat.compared += 1
        expected = int(ours) * float(field[3]) / float(field[4])
        if theirs.field_type == "PGN" and (int(ours) >> 8) & 0xFF < 240:
            expected = int(ours) & ~0xFF  # canboat takes a destination out of an addressed group's number
        if isinstance(value, (int, float)):
            self.assertAlmostEqual(value, expected, delta=1e-12 * abs(expected) + 1e-15, msg=what)

    def test_the_stations_behind_a_position_read_the_same(self):
        generator = random.Random(129029)
        for _ in range(PAYLOADS):
            count = generator.randrange(6)
            stations = b"".join(any_bits(generator, 32).to_bytes(4, "little") for _ in range(count))
            payload = bytes(42) + bytes([count]) + stations
            ours = [station.split(":") for station in self.bridge.ask(f"stations 129029 {payload.hex()}").split()]
            message = decoded(self.as_frames(129029, "Fast", payload))
            peers = next((f.value for f in message.fields if isinstance(f.value, list)), [])
            self.assertEqual(len(ours), count)
            self.assertEqual(len(peers), count)
            for station, peer in zip(ours, peers, strict=True):
                values = [peer[k] for k in ("referenceStationType", "referenceStationId", "ageOfDgnssCorrections")]
                for said, value in zip(station, values, strict=True):
                    if said != "na":  # beyond what the standard allows canboat may still show a number
                        self.assertAlmostEqual(float(said), float(value.raw_value), delta=1e-6, msg=payload.hex())

    def test_canboat_reads_what_we_write(self):
        generator = random.Random(2026)
        for pgn, name, framing, ours in self.rows:
            pairs = [(field, theirs) for field, theirs in self.pairs(pgn, ours) if theirs.field_type != "STRING_FIX"]
            if framing == "ISO" or not pairs:
                continue
            for _ in range(100):
                raws = {field[0]: any_bits(generator, int(field[2])) for field, _ in pairs}
                read = {
                    k: v
                    for k, v in self.bridge.decode(
                        pgn, self.payload(pgn, pairs, {t.id: raws[f[0]] for f, t in pairs})
                    ).items()
                }
                numbers = {k: v for k, v in read.items() if v not in ("na", "bad") and k in raws}
                frames = self.bridge.ask(f"encode {pgn} " + " ".join(f"{k}={v}" for k, v in numbers.items()))
                self.assertNotEqual(frames, "refused", f"{name} {numbers}")
                peer = self.flat(decoded(frames))
                for field, theirs in pairs:
                    said = numbers.get(field[0], "na")
                    self.compare(f"{name} {field[0]} of {frames}", field, said, peer.get(theirs.id), theirs)

    def test_every_choice_has_canboats_name(self):
        compared = 0
        for pgn, name, framing, ours in self.rows:
            for field, theirs in self.pairs(pgn, ours):
                if theirs.field_type != "LOOKUP" or framing == "ISO" or theirs.id == "manufacturerCode":
                    continue
                choices = self.bridge.ask(f"choices {pgn} {field[0]}")
                for raw, label in (choice.split("=", 1) for choice in choices.split("|") if choice):
                    payload = self.payload(pgn, [(field, theirs)], {theirs.id: int(raw)})
                    message = decoded(
                        self.as_frames(pgn, framing, payload.ljust(8 if framing == "Single" else 1, b"\xff"))
                    )
                    self.assertEqual(self.flat(message)[theirs.id].value, label, f"{name} {field[0]}")
                    compared += 1
        self.assertGreater(compared, 80)

    def test_canboat_reads_what_a_device_says_of_itself(self):
        frames = self.bridge.ask("node").split()
        decoder = NMEA2000Decoder()
        messages = [m for m in (decoder.decode(line) for line in frames_as_lines(" ".join(frames))) if m]
        by_id: dict[str, list[Any]] = {}
        for message in messages:
            by_id.setdefault(message.id, []).append(message)
        claim = self.flat(by_id["isoAddressClaim"][0])
        self.assertEqual(
            [claim[k].raw_value for k in ("uniqueNumber", "manufacturerCode", "deviceClass", "deviceFunction")],
            [4711, 2044, 40, 150],
        )
        product = self.flat(by_id["productInformation"][0])
        texts = ("modelId", "softwareVersionCode", "modelVersion", "modelSerialCode")
        self.assertEqual([product[k].value for k in texts], ["Earshot", "1.2", "A", "4711"])
        self.assertEqual(product["productCode"].value, 7)
        configuration = self.flat(by_id["configurationInformation"][0])
        places = ("installationDescription1", "installationDescription2", "manufacturerInformation")
        self.assertEqual([configuration[k].value for k in places], ["stern", "port side", "us"])
        self.assertEqual(self.flat(by_id["heartbeat"][0])["equipmentStatus"].value, "Operational")
        refusal = self.flat(by_id["isoAcknowledgement"][0])
        self.assertEqual((refusal["control"].value, refusal["pgn"].value), ("NAK", 126992))
        refusal = self.flat(by_id["nmeaAcknowledgeGroupFunction"][0])
        self.assertEqual((refusal["pgn"].value, refusal["pgnErrorCode"].value), (126993, "Not supported"))
        self.assertEqual(refusal["numberOfParameters"].value, 0)
        lists = by_id["pgnListTransmitAndReceive"]
        self.assertEqual(len(lists), 2)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
