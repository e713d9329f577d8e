"""What the page of the shipped policy's results says of the tables that it is written from. Expected: by hand."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[3]
COLUMNS = (
    "world,policy,episodes,found_fraction,found_fraction_low,found_fraction_high,restricted_mean_hours_to_find,"
    "restricted_mean_hours_to_find_low,restricted_mean_hours_to_find_high,mean_reward,path_over_straight,"
    "surprised_fraction,declared_falsely_fraction,declared_far_off_fraction"
)
NUMBERS = "0.945,0.9037,0.9722,5.915,5.5,6.25,-0.82,3.5,{surprised},0.005,0"


def rows(of: list[tuple[str, str, int, str]]) -> str:
    lines = [f"{world},{policy},{episodes},{numbers}" for world, policy, episodes, numbers in of]
    return "\n".join([COLUMNS, *lines]) + "\n"


class PageTest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="earshot-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        shipped = NUMBERS.format(surprised="0.02")
        blind = NUMBERS.format(surprised="").replace("0.945", "0.31")
        self.write(
            "worlds",
            [("rock", "shipped", 200, shipped), ("rock", "sweep", 200, blind), ("rock", "oracle", 200, shipped)],
        )
        self.write("infotaxis", [("rock", "infotaxis", 40, shipped)])
        self.write("bearing", [("rock", "shipped", 100, shipped)])
        self.write(
            "test",
            [
                ("a", "shipped", 100, shipped.replace("0.945", "0.9")),
                ("a", "sweep", 100, blind),
                ("a", "oracle", 100, shipped),
            ]
            + [
                ("b", "shipped", 100, shipped.replace("0.945", "0.97")),
                ("b", "sweep", 100, blind),
                ("b", "oracle", 100, shipped),
            ],
        )
        (self.folder / "commit").write_text("0123abc\n")

    def write(self, name: str, of: list[tuple[str, str, int, str]]) -> None:
        (self.folder / f"{name}.csv").write_text(rows(of))

    def page(self) -> str:
        subprocess.run([sys.executable, "-B", SOURCE / "policy/frozen/results_page.py", self.folder], check=True)
        return (self.folder / "README.md").read_text()

    def test_says_what_was_found_of_every_world_beside_the_others(self) -> None:
        found, hours = "94.5 % (90.4 to 97.2)", "5.92 (5.50 to 6.25)"
        expected = f"| `rock` | {found} | {hours} | -0.8 | 2 % | 0.5, 0 % | {found} | {hours} | 31 % | 94.5 % |"
        self.assertIn(expected, self.page())

    def test_adds_up_the_test_worlds(self) -> None:
        self.assertIn(
            "187 of 200 searches found, 93.5 %, from 90.0 in one world to 97.0 in another",
            " ".join(self.page().split()),
        )

    def test_names_the_commit_that_was_measured(self) -> None:
        self.assertIn("at commit 0123abc", self.page())


if __name__ == "__main__":
    unittest.main()
