"""Kilometres of the plane as points of a picture."""

import unittest

import bench_example

from bench_results import Place
from plane import Panel, Window, tick_step_km, window_around

assert bench_example


class WindowAround(unittest.TestCase):
    def test_is_square_around_the_middle_with_a_margin(self):
        window = window_around([Place(1000.0, 2000.0), Place(2000.0, 6000.0)], margin=0.25)
        # 4 km and a quarter of them on both sides; the middle is at (1.5 km, 4 km).
        self.assertEqual(window, Window(south_m=-1500.0, west_m=1000.0, side_m=6000.0))

    def test_of_one_place_is_not_empty(self):
        window = window_around([Place(50.0, 70.0)], margin=0.5, smallest_m=100.0)
        self.assertEqual(window, Window(south_m=-50.0, west_m=-30.0, side_m=200.0))


class TickStep(unittest.TestCase):
    def test_is_one_two_or_five_times_a_power_of_ten(self):
        steps = [tick_step_km(side) for side in (0.5, 1.0, 3.0, 6.0, 12.0, 13.0, 30.0, 31.6, 100.0)]
        for step, expected in zip(steps, [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 5.0, 10.0, 20.0], strict=True):
            self.assertAlmostEqual(step, expected, places=12)


class PanelOfAWindow(unittest.TestCase):
    panel = Panel(Window(south_m=1000.0, west_m=5000.0, side_m=2000.0), left=50.0, top=20.0, side=400.0, name="p")

    def test_has_north_above_and_east_to_the_right(self):
        self.assertEqual(self.panel.points([Place(1000.0, 5000.0), Place(3000.0, 5000.0)]), "50.0,420.0 50.0,20.0")
        self.assertEqual(self.panel.points([Place(1000.0, 7000.0), Place(1500.0, 5500.0)]), "450.0,420.0 150.0,320.0")

    def test_names_its_kilometres(self):
        frame = self.panel.frame("a title")
        for words in ("a title", "east (km)", "north (km)", ">1.5</text>", ">5.5</text>", ">7</text>"):
            self.assertIn(words, frame)


if __name__ == "__main__":
    unittest.main()
