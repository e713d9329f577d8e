"""Which cases need a CAN bus."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "hil/command_line"))
from case_files import names_over_can


class NeedCan(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        root = Path(folder.name)
        self.cases = root / "cases"
        for name in ("cases", "missions"):
            (root / name).mkdir()
        (root / "missions/search_over_can.toml").write_text('[[port]]\nkind = "can"\n')
        (root / "missions/l.toml").write_text('[[port]]\nkind = "lcm"\n[[port]]\nkind = "lcm"\n')
        (root / "missions/both.toml").write_text('[[port]]\nkind = "lcm"\n[[port]]\nkind = "can"\n')
        self.write("over_lcm", 'mission = "../missions/l.toml"\n')

    def write(self, name: str, text: str) -> None:
        (self.cases / f"{name}.toml").write_text(text)

    def test_those_whose_mission_has_a_can_port(self):
        self.assertEqual(names_over_can(self.cases, []), [])
        self.write("over_both", 'mission = "../missions/both.toml"\n')
        self.assertEqual(names_over_can(self.cases, []), ["over_both"])
        self.assertEqual(names_over_can(self.cases, ["over_both"]), ["over_both"])
        self.assertEqual(names_over_can(self.cases, ["over_lcm"]), [])

    def test_those_that_name_no_mission(self):
        self.write("plain", 'when = "nothing"\n')
        self.assertEqual(names_over_can(self.cases, ["plain"]), ["plain"])

    def test_those_that_nobody_can_read_so_that_the_bench_says_what_is_wrong(self):
        for text in ("mission = 7", "mission = ", 'mission = "none.toml"', 'mission = "over_lcm.toml"'):
            self.write("odd", text)
            self.assertEqual(names_over_can(self.cases, ["odd"]), ["odd"], text)


if __name__ == "__main__":
    unittest.main()
