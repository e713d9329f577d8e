"""The picture of a case's way."""

import re
import unittest
import xml.etree.ElementTree as ET

from bench_example import calm, deaf, results_of

from bench_results import Place
from plane import Window
from track_picture import STYLE, pieces, place_at, surroundings, track_svg

SVG = "{http://www.w3.org/2000/svg}"


def classes(svg: str, tag: str) -> list[str]:
    return [element.get("class", "") for element in ET.fromstring(svg).iter(SVG + tag)]


class PlaceAt(unittest.TestCase):
    def test_lies_between_two_points_of_the_track(self):
        (case,) = results_of(calm())
        places = [place_at(case.track, time) for time in (-1.0, 500.0, 1625.0, 9999.0)]
        expected = [Place(1000.0, 2000.0), Place(2000.0, 2000.0), Place(4000.0, 2250.0), Place(4000.0, 2500.0)]
        self.assertEqual(places, expected)


class Pieces(unittest.TestCase):
    def test_without_a_fault_are_one(self):
        (case,) = results_of(calm())
        corners = [Place(1000.0, 2000.0), Place(4000.0, 2000.0), Place(4000.0, 2500.0)]
        self.assertEqual(pieces(case), [(False, corners)])

    def test_are_cut_where_a_fault_begins_and_ends(self):
        (case,) = results_of(deaf())
        begun, ended = Place(2000.0, 2000.0), Place(3000.0, 2000.0)
        self.assertEqual(
            pieces(case),
            [
                (False, [Place(1000.0, 2000.0), begun]),
                (True, [begun, ended]),
                (False, [ended, Place(4000.0, 2000.0), Place(4000.0, 2500.0)]),
            ],
        )

    def test_are_one_while_faults_overlap(self):
        faults = [
            {"words": "a", "from_s": 0.0, "until_s": 900.0},
            {"words": "b", "from_s": 800.0, "until_s": None},
        ]
        (case,) = results_of(calm() | {"faults": faults})
        self.assertEqual([acts for acts, _ in pieces(case)], [True])

    def test_of_no_track_are_none(self):
        (case,) = results_of(calm() | {"track": []})
        self.assertEqual(pieces(case), [])


class Surroundings(unittest.TestCase):
    def expect(self, window: Window, expected: Window) -> None:
        for side in ("south_m", "west_m", "side_m"):
            self.assertAlmostEqual(getattr(window, side), getattr(expected, side), places=6)  # of rounding

    def test_hold_the_source_beside_the_way(self):
        (case,) = results_of(calm())
        # North 1 to 4 km, east 2 to 3 km; a margin of 8 % of 3 km.
        self.expect(surroundings(case), Window(south_m=760.0, west_m=760.0, side_m=3480.0))

    def test_leave_out_a_source_beside_which_the_way_could_not_be_seen(self):
        (case,) = results_of(calm() | {"source_m": [14000.0, 2000.0]})
        self.expect(surroundings(case), Window(south_m=760.0, west_m=510.0, side_m=3480.0))


class Picture(unittest.TestCase):
    def test_shows_faults_by_another_colour_and_another_dash(self):
        rules = dict(re.findall(r"\.track \.(\w+){(.*?)}", STYLE))
        way, fault = rules["way"], rules["fault"]
        self.assertNotEqual(re.findall(r"stroke:[^;]+", way), re.findall(r"stroke:[^;]+", fault))
        self.assertIn("stroke-dasharray", fault)
        self.assertNotIn("stroke-dasharray", way)
        (case,) = results_of(deaf())
        # In the surroundings and in the whole.
        self.assertEqual(classes(track_svg(case, "a"), "polyline"), ["way", "fault", "way"] * 2)

    def test_names_in_its_legend_what_it_shows_and_nothing_else(self):
        of_deaf, of_calm = (track_svg(case, "a") for case in results_of(deaf(), calm()))
        for words in ("source", "start", "end", "way of the vehicle", "halt polygon"):
            self.assertIn(f">{words}</text>", of_deaf)
            self.assertIn(f">{words}</text>", of_calm)
        for words in ("way while a fault acts", "first rule fires (leak)"):
            self.assertIn(f">{words}</text>", of_deaf)
            self.assertNotIn(words, of_calm)

    def test_of_a_flight_that_never_began_is_a_picture_all_the_same(self):
        (case,) = results_of(calm() | {"track": [], "trace": []})
        self.assertEqual(classes(track_svg(case, "a"), "polyline"), [])

    def test_holds_no_markup_of_a_name(self):
        (case,) = results_of(calm() | {"name": "<script>&\x1b"})
        self.assertIn("&lt;script&gt;&amp;\\u001b", track_svg(case, "a"))


if __name__ == "__main__":
    unittest.main()
