"""Which interfaces are a bus that is up."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "hil/command_line"))
from bad_input import BadInput
from bus import command_on_bus, require_bus


class RequireBus(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.interfaces = Path(folder.name)
        # As the kernel writes them: ARPHRD_CAN is 280; 0x40080 is an interface that is down.
        for name, kind, flags in (("can0", 280, 0x40081), ("can1", 280, 0x40080), ("eth0", 1, 0x1003)):
            (self.interfaces / name).mkdir()
            (self.interfaces / name / "type").write_text(f"{kind}\n")
            (self.interfaces / name / "flags").write_text(f"{flags:#x}\n")

    def test_takes_a_can_interface_that_is_up(self):
        require_bus("can0", self.interfaces)

    def test_says_how_one_that_is_down_comes_up(self):
        with self.assertRaisesRegex(BadInput, "can1: is down.*ip link set can1 up type can bitrate 250000"):
            require_bus("can1", self.interfaces)

    def test_refuses_what_is_no_bus(self):
        for name, words in {"eth0": "is no CAN interface", "can2": "there is no such interface"}.items():
            with self.assertRaisesRegex(BadInput, words):
                require_bus(name, self.interfaces)


class CommandOnBus(unittest.TestCase):
    def test_boots_one_virtual_bus_for_all_unless_there_is_a_real_one(self):
        self.assertEqual(command_on_bus(Path("/r"), "can0", ["a", "b"], needs_can=True), ["a", "b"])
        self.assertEqual(
            command_on_bus(Path("/r"), None, ["a", "b"], needs_can=True), ["/r/hil/bus/with-can", "a", "b"]
        )

    def test_boots_none_for_cases_over_lcm(self):
        self.assertEqual(command_on_bus(Path("/r"), None, ["a", "b"], needs_can=False), ["a", "b"])


if __name__ == "__main__":
    unittest.main()
