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
    "surprised_fraction,declared_falsely_fraction,declared_far_off_fraction,missed_fraction"
)
NUMBERS = "0.945,0.9037,0.9722,5.915,5.5,6.25,-0.82,3.5,{mismatched},0.005,0,{missed}"


def rows(of: list[tuple[str, str, int, str]]) -> str:
    lines = [f"{world},{policy},{episodes},{numbers}" for world, policy, episodes, numbers in of]
    return "\n".join([COLUMNS, *lines]) + "\n"


class PageTest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="earshot-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        shipped = NUMBERS.format(mismatched="0.02", missed="0.125")
        blind = NUMBERS.format(mismatched="", missed="").replace("0.945", "0.31")
        self.write(
            "worlds",
            [("rock", "shipped", 200, shipped), ("rock", "sweep", 200, blind), ("rock", "oracle", 200, shipped)],
        )
        self.write("infotaxis", [("rock", "infotaxis", 40, shipped)])
        self.write("noticed", [("rock", "shipped", 200, NUMBERS.format(mismatched="0.955", missed="1"))])
        self.write("bearing", [("rock", "shipped", 100, shipped)])
        self.write(
            "test",
            [
                ("a", "shipped", 100, shipped.replace("0.945", "0.9")),
                ("a", "sweep", 100, blind),
                ("a", "oracle", 100, shipped),
            ]
            + [
                ("b", "shipped", 100, NUMBERS.format(mismatched="0.05", missed="").replace("0.945", "0.97")),
                ("b", "sweep", 100, blind),
                ("b", "oracle", 100, shipped),
            ],
        )
        self.write(
            "told",
            [
                ("a", "shipped", 100, shipped.replace("0.945", "0.95")),
                ("b", "shipped", 100, shipped.replace("0.945", "0.99")),
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
        shipped, infotaxis = f"{found} | {hours} | -0.8 | 2 % | 0.5, 0 % | 12.5 %", f"{found} | {hours}"
        expected = f"| `rock` | {shipped} | {infotaxis} | 31 % | 94.5 % |"
        self.assertIn(expected, self.page())

    def test_adds_up_the_test_worlds(self) -> None:
        self.assertRegex(" ".join(self.page().split()), "187 of 200 .*93.5 %, from 90.0 .*to 97.0 ")

    def test_says_what_is_found_where_the_ocean_is_told(self) -> None:
        self.assertRegex(" ".join(self.page().split()), "97.0 %, and 95 % or more in 2 of 2 worlds .*of 1")

    def test_says_what_is_noticed_with_the_papers_table_alone(self) -> None:
        section = self.page().split("## With the paper's table only")[1].split("\n## ")[0]
        self.assertIn("200 searches of 15 steps", " ".join(section.split()))
        self.assertIn("| `rock` | 95.5 % |\n", section)

    def test_says_what_was_declared_and_missed_in_the_test_split_and_with_a_bearing(self) -> None:
        page = self.page()
        found, hours = "(90.4 to 97.2)", "5.92 (5.50 to 6.25)"
        self.assertIn(f"| `a` | 90 % {found} | {hours} | -0.8 | 2 % | 0.5, 0 % | 12.5 % | 95 % | 31 % | 94.5 % |", page)
        # In b no search came within a step length: of nothing there is no share.
        self.assertIn(f"| `b` | 97 % {found} | {hours} | -0.8 | 5 % | 0.5, 0 % | - | 99 % | 31 % | 94.5 % |", page)
        self.assertIn(f"| `rock` | 94.5 % {found} | {hours} | 3.50 | 0.5, 0 % | 12.5 % |\n", page)

    def test_says_how_many_were_surprised_over_the_test_worlds(self) -> None:
        self.assertIn("Mismatch: 3.5 % of the searches", " ".join(self.page().split()))  # of 2 and 5 %

    def test_names_the_commit_that_was_measured(self) -> None:
        self.assertIn("at commit 0123abc", self.page())


if __name__ == "__main__":
    unittest.main()
