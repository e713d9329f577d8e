"""The page of an evaluation, with figures made by hand: what stands where, and where the searches went."""

import json
import unittest
from typing import Any

from page_rig import PAGE, PageTest
from playwright.sync_api import Page

HOSTILE = "<img src=x onerror=alert(1)>"
# Found and its interval, hours and theirs, reward and its interval.
FIGURES: dict[tuple[str, str], tuple[float, list[float], float, list[float], float, list[float]]] = {
    ("calm", "oracle"): (1.0, [0.7, 1.0], 1.5, [1.0, 2.0], -2.0, [-3.0, -1.0]),
    ("calm", HOSTILE): (0.5, [0.2, 0.8], 9.0, [7.0, 11.0], -40.0, [-60.0, -20.0]),
    ("rough", "oracle"): (0.75, [0.4, 0.9], 3.0, [2.0, 4.0], -9.0, [-12.0, -6.0]),
    ("rough", HOSTILE): (0.75, [0.4, 0.9], 2.5, [2.0, 3.0], -5.0, [-7.0, -3.0]),
}


def result(world: str, policy: str) -> dict[str, Any]:
    found, found_95, hours, hours_95, reward, reward_95 = FIGURES[world, policy]
    return {
        "world": world,
        "policy": policy,
        "episodes": 300,
        "found_fraction": found,
        "found_fraction_95": found_95,
        "restricted_mean_hours_to_find": hours,
        "restricted_mean_hours_to_find_95": hours_95,
        "mean_reward": reward,
        "mean_reward_95": reward_95,
    }


def search(world: str, policy: str, number: int, end: str, north_m: list[int]) -> dict[str, Any]:
    """Straight to the north; every other step is heard."""
    return {
        "world": world,
        "policy": policy,
        "number": number,
        "end": end,
        "reward": -1.25,
        "source": {"north_m": 9000, "east_m": 5000},
        "north_m": north_m,
        "east_m": [5000] * len(north_m),
        "snr_db": [12.0 if step % 2 else 3.0 for step in range(len(north_m))],
    }


def suite(**changed: Any) -> dict[str, Any]:
    figures = {
        "episodes": 300,
        "source": "changing",
        "max_steps": 100,
        "found_by": "simulator",
        "listening": "mean",
        "warnings": [],
        "worlds": [{"name": name, "what": f"a {name} sea"} for name in ("calm", "rough")],
        "results": [result(world, policy) for world, policy in FIGURES],
    }
    searches = [
        search("calm", "oracle", 0, "found", [1000, 2000, 3000, 4000, 5000]),
        search("calm", "oracle", 1, "left_domain", [9000, 10000]),
        search("calm", HOSTILE, 0, "time_limit", [1000, 2000]),
    ]
    area = {"south_m": 0, "west_m": 0, "north_m": 10000, "east_m": 10000}
    return {
        "format": 1,
        "title": "300 searches each in 2 worlds, source changing",
        "area": area,
        "detection_threshold_db": 10.0,
        "figures": figures | changed,
        "searches": searches,
    }


class Suite(PageTest):
    def open_suite(self, content: dict[str, Any], **view: Any) -> Page:
        text = json.dumps(content).replace("<", "\\u003c")
        file = self.folder / "worlds.html"
        file.write_text(PAGE.replace("<!--flight-->", f'<script id="suite" type="application/json">{text}</script>', 1))
        page = self.new_page(**view)
        page.goto(file.as_uri())
        page.wait_for_selector("#suite-page:not([hidden])")
        self.drawn(page)
        return page

    def figures(self, page: Page) -> list[str]:
        return [text.strip() for text in page.locator("#suite-figures .figure").all_inner_texts()]

    def test_shows_every_policy_in_every_world_and_the_best_of_a_world_bold(self) -> None:
        page = self.open_suite(suite())
        self.assertEqual(page.inner_text("#suite-title"), "300 searches each in 2 worlds, source changing")
        self.assertEqual(self.figures(page), ["100.0 %", "50.0 %", "75.0 %", "75.0 %"])
        best = page.locator("#suite-figures .best .figure").all_inner_texts()
        self.assertEqual(best, ["100.0 %", "75.0 %", "75.0 %"])
        self.assertTrue(page.is_hidden("#page"))

    def test_compares_what_the_reader_chooses(self) -> None:
        page = self.open_suite(suite())
        page.select_option("#suite-measure", "mean hours to find")
        self.assertEqual(self.figures(page), ["1.50 h", "9.00 h", "3.00 h", "2.50 h"])
        self.assertEqual(page.locator("#suite-figures .best .figure").all_inner_texts(), ["1.50 h", "2.50 h"])
        page.select_option("#suite-measure", "reward")
        self.assertEqual(self.figures(page), ["−2.0", "−40.0", "−9.0", "−5.0"])

    def test_draws_intervals_on_one_scale(self) -> None:
        """Found: the scale runs from 0.2 to 1, so that 0.7 lies at 62.5 % of it."""
        whisker = self.open_suite(suite()).locator("#suite-figures .whisker").first.get_attribute("style") or ""
        parts = dict(part.split(":") for part in whisker.split(";"))
        self.assertAlmostEqual(float(parts["--low"].rstrip("%")), 62.5)
        self.assertAlmostEqual(float(parts["--high"].rstrip("%")), 100.0)

    def test_a_figure_opens_its_searches_and_a_search_its_paths(self) -> None:
        page = self.open_suite(suite())
        rows = page.locator("#suite-searches tbody tr")
        self.assertEqual(rows.count(), 2)
        self.assertEqual(rows.nth(0).inner_text().split(), ["0", "found", "4", "2", "−1.3"])  # heard at steps 1 and 3
        self.assertEqual(rows.nth(1).inner_text().split(), ["1", "left", "the", "area", "1", "1", "−1.3"])
        self.assertIn("oracle: found, 4 steps", page.inner_text("#suite-keys"))
        self.assertIn("ran out of steps, 1 step", page.inner_text("#suite-keys"))
        rows.nth(1).locator("button").click()
        self.assertEqual(page.inner_text("#suite-path-title"), "Search 1 in calm")
        self.assertNotIn("ran out of steps", page.inner_text("#suite-keys"))
        page.locator("#suite-figures .figure").nth(2).click()
        self.assertEqual(page.inner_text("#suite-chosen"), "oracle in rough")
        self.assertEqual(page.inner_text("#suite-count"), "No paths were kept.")

    def test_warnings_stand_first_and_no_name_becomes_markup(self) -> None:
        page = self.open_suite(suite(warnings=[HOSTILE]))
        self.assertEqual(page.inner_text("#suite-warnings"), HOSTILE)
        page.locator("#suite-figures .figure").nth(1).click()
        self.drawn(page)
        box = page.locator("#suite-map").bounding_box()
        assert box
        found = ""
        for share in range(20, 100):  # up the middle of the map, where the path lies
            page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] * share / 100)
            tips = page.locator(".leaflet-tooltip")
            found += tips.first.inner_text() if tips.count() else ""
        self.assertIn(HOSTILE, found)
        self.assertEqual(page.locator("img").count(), 0)

    def test_is_readable_by_everybody_at_every_width(self) -> None:
        for scheme in ("light", "dark"):
            for width in (390, 1280, 2560):
                with self.subTest(scheme=scheme, width=width):
                    page = self.open_suite(suite(), width=width, scheme=scheme)
                    self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), width)
                    self.assertEqual(self.findings(page), [])


if __name__ == "__main__":
    unittest.main()
