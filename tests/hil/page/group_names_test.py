"""Names of parameter groups."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "hil/page"))
from group_names import pgn_of, read_group_names

ROOT = Path(__file__).resolve().parents[3]


class GroupNames(unittest.TestCase):
    def test_are_those_of_the_dbc_file(self):
        names = read_group_names(ROOT / "hil/bus/earshot.dbc")
        for pgn, name in {127250: "VesselHeading", 65290: "EarshotSpeedDepth", 60928: "ISOAddressClaim"}.items():
            self.assertEqual(names[pgn], name)

    def test_leave_a_receivers_address_out(self):
        # Of NMEA 2000's printed examples: 127250 with priority 2 of address 0x23; 59904 with priority 6 to all.
        self.assertEqual(pgn_of(0x89F11223), 127250)
        self.assertEqual(pgn_of(0x98EAFF23), 59904)

    def test_are_none_without_a_file(self):
        self.assertEqual(read_group_names(ROOT / "no.dbc"), {})


if __name__ == "__main__":
    unittest.main()
