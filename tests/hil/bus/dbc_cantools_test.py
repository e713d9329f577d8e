"""The DBC file as a user of cantools meets it.

Expected values are worked out by hand from the frames' bytes (NMEA 2000: little-endian).
"""

import re
import subprocess
import sys
import unittest
from pathlib import Path

import cantools
from cantools.database.namedsignalvalue import NamedSignalValue

DBC = Path(__file__).resolve().parents[3] / "hil" / "bus" / "earshot.dbc"
LINES = {
    "heading of the simulated vehicle": "  vcan0  09F11223   [8]  FF 70 5A FF 7F FF 7F FD",
    "set-point of Earshot": "  vcan0  0CFF0A40   [8]  FC 9F C8 00 30 75 00 10",
    "heading of a device at 0xCC": "  can0  09F112CC   [8]  FF 70 5A FF 7F FF 7F FD",
    "speed without numbers": "  vcan0  09F50323   [8]  FF FF FF FE FF FD FF FF",
    "SNR of the simulated vehicle": "  vcan0  14FF0B23   [8]  FC 9F BB FE 27 42 F2 FF",
    "leak of a sensor": "  vcan0  04FF0D23   [8]  FC 9F 02 FD FF FF FF FF",
    "position without a latitude": "  vcan0  09F80123   [8]  FF FF FF 7F 00 00 00 80",
}


def decode(*options: str) -> dict[str, str]:
    """What `candump vcan0 | cantools decode earshot.dbc` prints of each of candump's lines."""
    command = [sys.executable, "-m", "cantools", "decode", "--single-line", *options, str(DBC)]
    done = subprocess.run(command, input="\n".join(LINES.values()) + "\n", capture_output=True, text=True, check=True)
    return dict(zip(LINES, done.stdout.splitlines(), strict=True))


def values_of(enum: str) -> list[int]:
    """The values of an enum of the firmware, by its declaration."""
    for header in (DBC.parents[2] / "firmware").glob("[cm]*/*.hpp"):
        found = re.search(rf"enum class {enum} : [^{{]*{{(.*?)}};", header.read_text(encoding="utf-8"), re.DOTALL)
        if found:
            return [int(value) for value in re.findall(r"\bk[A-Z]\w* = (\d+)", found[1])]
    raise AssertionError(f"there is no enum {enum}")


class DecodesWithCantools(unittest.TestCase):
    plain: dict[str, str]
    masked: dict[str, str]

    @classmethod
    def setUpClass(cls):
        cls.plain, cls.masked = decode(), decode("--frame-id-mask", "0x1ffff00")

    def test_the_plain_call_names_what_the_simulated_vehicle_sends(self):
        # 0x5A70 = 23152 x 1e-4 rad; the reference's two bits are 1.
        text = self.plain["heading of the simulated vehicle"]
        self.assertIn("VesselHeading(", text)
        self.assertIn("Heading: 2.3152 rad", text)
        self.assertIn("Reference: Magnetic", text)

    def test_the_plain_call_names_what_earshot_sends(self):
        # Speed 0x00C8 = 200 x 0.01 m/s; depth 0x00007530 = 30000 x 0.01 m; sequence 0, release 1.
        text = self.plain["set-point of Earshot"]
        self.assertIn("EarshotSpeedDepth(", text)
        self.assertIn("CommandedSpeed: 2.0 m/s", text)
        self.assertIn("CommandedDepth: 300.0 m", text)
        self.assertIn("ReleaseWeight: Yes", text)

    def test_the_plain_call_names_what_no_standard_group_carries(self):
        # Behind two bytes of maker and industry: SNR -325 in 18 bits, too faint 1 in 2, level 9250 in 16, SID 255.
        text = self.plain["SNR of the simulated vehicle"]
        for said in (
            "EarshotSNR(",
            "SNR: -3.25 dB",
            "TooFaint: Yes",
            "BandLevel: 92.5 dB re 1 uPa",
            "SID: not available",
        ):
            self.assertIn(said, text)
        self.assertIn("State: wet", self.plain["leak of a sensor"])

    def test_health_says_why_a_mission_ended_and_what_its_search_found(self):
        recorded = (DBC.parents[2] / "tests/reference/messages/can.txt").read_text(encoding="utf-8")
        frames = next(line for line in recorded.splitlines() if line.startswith("health.all: ")).split()[1:]
        data = b"".join(bytes.fromhex(frame.partition("#")[2])[1:] for frame in frames)
        size, data = data[0], data[1:]
        said = cantools.database.load_file(DBC).decode_message(0x19FF8640, data[:size])
        self.assertEqual(
            [str(said[name]) for name in ("State", "EndReason", "Authority")], ["ABORT", "declared found", "ABORT"]
        )
        self.assertEqual([str(said[name]) for name in ("Found", "Sweeping", "Response")], ["Yes", "Yes", "release"])
        self.assertEqual(said["ModelMismatch"], 13.5)

    def test_every_value_of_every_enum_that_earshot_sends_has_its_name(self):
        database = cantools.database.load_file(DBC)
        enums = {
            ("EarshotHealth", "State"): "MissionState",
            ("EarshotHealth", "EndReason"): "EndReason",
            ("EarshotHealth", "Authority"): "Authority",
            ("EarshotHealth", "Response"): "Response",
            ("EarshotCommandAcknowledgement", "Order"): "Order",
            ("EarshotCommandAcknowledgement", "Outcome"): "CommandOutcome",
        }
        # The kind of an acknowledgement is 2.
        for (message, signal), enum in enums.items():
            described = database.get_message_by_name(message)
            values = values_of(enum)
            self.assertGreater(len(values), 3, enum)
            for value in values:
                raw = {one.name: 2 if one.is_multiplexer else 0 for one in described.signals} | {signal: value}
                data = described.encode(raw, scaling=False, strict=False)
                name = described.decode(data)[signal]
                self.assertIsInstance(name, NamedSignalValue, f"{enum} {value} has no name")
                self.assertEqual((name.value, name.name in ("", "reserved")), (value, False))

    def test_messages_that_share_a_group_are_told_apart_by_their_kind(self):
        database = cantools.database.load_file(DBC)
        abort = bytes.fromhex("FC9F0334129A7856")
        said = database.decode_message(0x0DEFFF23, abort, allow_truncated=True)
        self.assertEqual((str(said["Kind"]), said["AbortIssuer"], said["AbortNumber"]), ("abort", 0x1234, 0x56789A))
        self.assertNotIn("Expiry", said)
        # Order 1, issuer 5, number 6, given at 1 s, not to be obeyed after 2 s.
        command = bytes.fromhex("FC9F0101050000000600000040420F000000000080841E0000000000" + 9 * "FF" + 16 * "00")
        said = database.decode_message(0x0DEFFF23, command)
        self.assertEqual(
            [str(said["Kind"]), str(said["Order"]), said["Issuer"], said["Number"]], ["command", "START", 5, 6]
        )
        self.assertEqual((said["Time"], said["Expiry"]), (1.0, 2.0))

    def test_a_mask_of_the_parameter_group_names_frames_from_any_address(self):
        self.assertIn("Unknown frame id", self.plain["heading of a device at 0xCC"])
        self.assertIn("Heading: 2.3152 rad", self.masked["heading of a device at 0xCC"])

    def test_values_that_are_no_numbers_have_names(self):
        # Speed through the water 0xFFFF, over ground 0xFFFE; type of speed 0xFD; the four bits of direction 0xF.
        text = self.plain["speed without numbers"]
        for said in (
            "SID: not available",
            "SpeedWaterReferenced: not available",
            "SpeedGroundReferenced: out of range",
            "SpeedWaterReferencedType: reserved",
            "SpeedDirection: not available",
        ):
            self.assertIn(said, text)

    def test_a_signed_value_that_is_not_available_has_a_name(self):
        # Latitude 0x7FFFFFFF; longitude -0x80000000 x 1e-7 degree is a number, if a strange one.
        text = self.plain["position without a latitude"]
        self.assertIn("Latitude: not available", text)
        self.assertIn("Longitude: -214.7483648 deg", text)


if __name__ == "__main__":
    unittest.main()
