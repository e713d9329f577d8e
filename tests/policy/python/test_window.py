"""render_mode="human": a window that shows each step, and what is said where there can be none.

Run by ctest (run in this folder).
"""

import copy
import importlib.util
import itertools
import os
import pickle
import subprocess
import sys
import unittest
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np

import earshot.gym

HAS_MATPLOTLIB = importlib.util.find_spec("matplotlib") is not None
EAST = 2
OPEN = "import gymnasium, earshot.gym; gymnasium.make(earshot.gym.ID, render_mode='human')"


def said(program, **variables):
    """The last line of what a Python of its own says of an error."""
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "MPLBACKEND")}
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment | variables, capture_output=True, text=True, check=False
    )
    return (done.stderr.strip().splitlines() or [""])[-1]


@unittest.skipUnless(HAS_MATPLOTLIB, "no matplotlib")
class AWindow(unittest.TestCase):
    window: Any  # counted_window

    @classmethod
    def setUpClass(cls):
        sys.path.insert(0, str(Path(__file__).parent))
        import counted_window
        import matplotlib

        matplotlib.use("module://counted_window")
        cls.window = counted_window

    def setUp(self):
        self.window.shown.clear()
        self.window.paused_s.clear()
        self.window.titles.clear()
        self.window.opened.clear()

    def make(self, **options):
        env = gymnasium.make(earshot.gym.ID, render_mode="human", **options)
        self.addCleanup(env.close)
        return env

    def test_shows_each_reset_and_each_step_once_and_waits(self):
        env = self.make()
        self.assertEqual((len(self.window.opened), self.window.titles[-1]), (1, "Earshot"))
        env.reset(seed=1, options={"position_m": (20_000.0, 5_000.0)})
        for _ in range(3):
            env.step(EAST)
        self.assertEqual(len(self.window.shown), 4)
        self.assertEqual(self.window.paused_s, [0.25] * 4)  # render_fps
        for before, after in itertools.pairwise(self.window.shown):
            self.assertFalse(np.array_equal(before, after))
        self.assertIsNone(env.render())
        self.assertEqual(len(self.window.opened), 1)

    def test_shows_the_picture_of_the_search(self):
        env = self.make()
        env.reset(seed=1)
        height, width = self.window.shown[-1].shape[:2]
        # The source, 10 of 25 km north and east, in the lower 92 % of the figure.
        row, column = (
            round(height * (1.0 - 0.92 * 10 / 25)),
            round((width - 0.92 * height) / 2 + 0.92 * height * 10 / 25),
        )
        np.testing.assert_array_equal(self.window.shown[-1][row, column], (235, 80, 60, 255))

    def test_that_is_closed_stays_closed(self):
        from matplotlib import pyplot

        env = self.make()
        env.reset(seed=1)
        pyplot.close(pyplot.get_fignums()[-1])
        env.step(EAST)
        self.assertEqual((len(self.window.shown), len(self.window.opened)), (1, 1))
        env.close()
        self.assertEqual(pyplot.get_fignums(), [])

    def test_is_not_shared_with_copies(self):
        env = self.make().unwrapped
        env.reset(seed=1)
        for other in (copy.deepcopy(env), pickle.loads(pickle.dumps(env))):
            with self.subTest():
                before = len(self.window.shown)
                other.step(EAST)
                self.assertEqual(len(self.window.shown), before + 1)
                other.close()
        self.assertEqual(len(self.window.opened), 3)
        env.step(EAST)
        self.assertEqual(len(self.window.shown), 4)


class NoWindow(unittest.TestCase):
    @unittest.skipUnless(HAS_MATPLOTLIB, "no matplotlib")
    def test_without_a_display_is_said_at_once(self):
        for variables in (
            {},
            {"MPLBACKEND": "agg"},
            {"MPLBACKEND": "tkagg"},
            {"DISPLAY": ":77", "MPLBACKEND": "tkagg"},
            {"MPLBACKEND": "pdf"},
            {"MPLBACKEND": "module://matplotlib.backends.backend_agg"},  # as a notebook's: it shows no windows
            {"MPLBACKEND": "no_such_backend"},
        ):
            with self.subTest(**variables):
                self.assertRegex(
                    said(OPEN, **variables),
                    "BadInput: render_mode = 'human': matplotlib can open no window here: .*'rgb_array'",
                )

    def test_without_matplotlib_is_said_at_once(self):
        self.assertRegex(
            said("import sys; sys.modules['matplotlib'] = None; " + OPEN),
            "DependencyNotInstalled: render_mode = 'human' draws with matplotlib: pip install matplotlib",
        )


if __name__ == "__main__":
    unittest.main()
