"""The DBC file as a user of cantools meets it.

Expected values are worked out by hand from the frames' bytes (NMEA 2000: little-endian).
"""

import subprocess
import sys
import unittest
from pathlib import Path

DBC = Path(__file__).resolve().parents[3] / "hil" / "bus" / "earshot.dbc"
LINES = {
    "heading of the simulated vehicle": "  vcan0  09F11223   [8]  FF 70 5A FF 7F FF 7F FD",
    "set-point of Earshot": "  vcan0  0CFF0A40   [8]  FC 9F C8 00 30 75 00 00",
    "heading of a device at 0xCC": "  can0  09F112CC   [8]  FF 70 5A FF 7F FF 7F FD",
    "speed without numbers": "  vcan0  09F50323   [8]  FF FF FF FE FF FD FF FF",
    "position without a latitude": "  vcan0  09F80123   [8]  FF FF FF 7F 00 00 00 80",
}


def decode(*options: str) -> dict[str, str]:
    """What `candump vcan0 | cantools decode earshot.dbc` prints of each of candump's lines."""
    command = [sys.executable, "-m", "cantools", "decode", "--single-line", *options, str(DBC)]
    done = subprocess.run(command, input="\n".join(LINES.values()) + "\n", capture_output=True, text=True, check=True)
    return dict(zip(LINES, done.stdout.splitlines(), strict=True))


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
        # Speed 0x00C8 = 200 x 0.01 m/s; depth 0x00007530 = 30000 x 0.01 m.
        text = self.plain["set-point of Earshot"]
        self.assertIn("EarshotSpeedDepth(", text)
        self.assertIn("CommandedSpeed: 2.0 m/s", text)
        self.assertIn("CommandedDepth: 300.0 m", text)

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
