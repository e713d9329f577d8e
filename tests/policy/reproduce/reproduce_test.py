"""The whole of policy/reproduce with tiny budgets. usage: reproduce_test.py FOLDER_OF_PROGRAMS"""

import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "policy/reproduce"))
import claims
import experiments
import figures
import page

REPRODUCE = Path(__file__).resolve().parents[3] / "policy/reproduce"
FIGURES = ["figure2", "figure3", "figure4", "figure5", "figure6", "figure7", "figure8", "figure8b", "figure9", "sweep"]
PROGRAMS = Path(sys.argv.pop())


class WholeRun(unittest.TestCase):
    folder: tempfile.TemporaryDirectory
    out: Path
    done: subprocess.CompletedProcess

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name) / "out"
        words = ["--quick", "--out", cls.out, "--work", Path(cls.folder.name) / "work", "--bin", PROGRAMS]
        command = [sys.executable, "-B", str(REPRODUCE / "reproduce.py"), *map(str, words)]
        cls.done = subprocess.run(command, capture_output=True, text=True, check=False)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_ends_well(self):
        self.assertEqual(self.done.returncode, 0, self.done.stdout + self.done.stderr)

    def test_clears_only_a_folder_of_its_own(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "letter.txt").write_text("mine")
            with self.assertRaisesRegex(SystemExit, "was not made by an earlier run"):
                experiments.clear(folder)
            self.assertTrue((Path(folder) / "letter.txt").exists())
            experiments.Workshop(folder, PROGRAMS, 1)
            experiments.clear(folder)
            self.assertFalse(Path(folder).exists())
            Path(folder).mkdir()

    def test_draws_every_figure_once(self):
        for name in FIGURES:
            self.assertEqual((self.out / f"{name}.png").read_bytes()[:4], b"\x89PNG", name)
        self.assertEqual(list(self.out.glob("*.svg")), [])

    def test_both_pages_show_every_figure_and_claim(self):
        markdown, html = ((self.out / f"reproduction.{kind}").read_text() for kind in ("md", "html"))
        for name in FIGURES:
            self.assertIn(f"]({name}.png)", markdown)
            self.assertIn(f'src="{name}.png"', html)
        claimed = markdown.split("## Claims")[1].split("## Figures")[0]
        numbers = {n for row in re.findall(r"^\| ([\d, ]+) \|", claimed, re.M) for n in re.findall(r"\d+", row)}
        self.assertEqual(numbers, {str(n) for n in range(2, 10)})

    def test_says_what_made_it(self):
        made = json.loads((self.out / "measurements.json").read_text())["made"]
        self.assertTrue(made["command"].startswith("policy/reproduce/run --quick"))
        self.assertRegex(made["commit"], r"^[0-9a-f]{12}(-dirty)?$|^unknown$")

    def test_measures_each_state_with_as_many_searches_as_it_says(self):
        evaluations = json.loads((self.out / "measurements.json").read_text())["evaluations"]
        self.assertEqual(len(evaluations), 9)
        for name, seeds in evaluations.items():
            self.assertEqual([e["episodes"] for e in seeds], [10, 10], name)


class Drawing(unittest.TestCase):
    def test_curves_differ_by_more_than_their_colours(self):
        rewards = np.linspace(-100.0, -2.0, 60)
        seed = experiments.Seed(np.column_stack([rewards, rewards, rewards]), {}, rewards, [])
        runs = {name: [seed, seed] for name in figures.LABELS}
        figure = figures.training_reward([("as long as in the paper", runs), ("longer", runs)], 60)
        for axes in figure.axes:
            drawn = {(line.get_linestyle(), line.get_marker()) for line in axes.lines}
            self.assertEqual(len(drawn), len(figures.LABELS))
            self.assertEqual(len({line.get_marker() for line in axes.lines} - {"None"}), len(figures.LABELS))

    def test_snr_is_drawn_on_the_scale_of_every_map_and_field(self):
        scale = (REPRODUCE.parents[1] / "sim/plot/snr_scale.cpp").read_text()
        palette = re.search(r"set palette defined \((.*?)\)", scale)
        assert palette
        colours = [(int(db), colour) for db, colour in re.findall(r"(\d+) '(#\w+)'", palette.group(1))]
        self.assertEqual(figures.SNR_COLOURS, colours)

    def test_the_page_can_be_read_on_a_telephone_and_printed_whole(self):
        html = page.as_html([], {"command": "", "commit": "", "rest": ""}, [["1", "2", "3", "4"]], [], "")
        self.assertIn('<meta name="viewport" content="width=device-width, initial-scale=1">', html)
        self.assertEqual(html.count('<div class="table"><table>'), 2)
        self.assertIn("@media print{", html)
        self.assertIn(".table{overflow:visible}", html.split("@media print{")[1])


class Arithmetic(unittest.TestCase):
    def test_the_running_median_looks_back_over_the_window_only(self):
        np.testing.assert_array_equal(figures.running_median(np.array([5.0, 1.0, 9.0, 9.0, 2.0]), 3), [5, 3, 5, 9, 9])

    def test_training_has_converged_when_the_running_median_stays_up(self):
        rewards = np.concatenate([np.full(100, -50.0), np.full(200, -2.0)])
        seed = experiments.Seed(np.column_stack([rewards, rewards, rewards]), {}, rewards, [])
        # The 26th good one outweighs the 24 bad ones still in the window.
        self.assertEqual(claims.first_episode_at(seed, -3.0), 126)
        self.assertTrue(np.isnan(claims.first_episode_at(seed, -1.0)))

    def test_detection_rings_begin_and_end_at_the_threshold(self):
        rings = figures.detection_rings((np.arange(6.0), np.array([30.0, 10.0, 9.9, 10.0, 12.0, 0.0])))
        self.assertEqual(rings, [(0.0, 1.0), (3.0, 4.0)])

    def test_seeds_are_summarised_by_median_and_quartiles(self):
        self.assertEqual(claims.over_seeds([1.0, 2.0, 3.0, 4.0, 100.0]), "3.0 (2.0 to 4.0)")


if __name__ == "__main__":
    unittest.main()
