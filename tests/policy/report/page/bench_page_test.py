"""The page of a run of the bench, with results made by hand: what had to happen, what happened, where and when."""

import json
import re
import sys
from pathlib import Path
from typing import Any

from page_rig import PAGE, PageTest
from playwright.sync_api import Page

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "hil/page"))
from bench_example import calm, deaf

Case = dict[str, Any]
MOST_FRAMES = 200


class BenchTest(PageTest):
    def open_bench(
        self,
        *cases: Case,
        not_flown: tuple[str, ...] = (),
        names: dict[str, str] | None = None,
        at: str = "",
        **view: Any,
    ) -> Page:
        """As hil/run has it made."""
        bench = {"format": 1, "made": "by hand", "not_flown": not_flown, "group_names": names or {}, "cases": cases}
        text = json.dumps(bench).replace("<", "\\u003c")
        file = self.folder / "bench.html"
        file.write_text(PAGE.replace("<!--flight-->", f'<script id="bench" type="application/json">{text}</script>', 1))
        page = self.new_page(**view)
        page.goto(file.as_uri() + at)
        page.wait_for_selector("#bench-page:not([hidden])")
        self.drawn(page)
        return page

    def opened(self, case: Case, **more: Any) -> Page:
        """A page of one case, which is open."""
        return self.open_bench(case, at="#case-1", **more)

    def told(self, page: Page, selector: str = "#bench-page") -> str:
        return " ".join(page.inner_text(selector).split())


class Said(BenchTest):
    def test_of_every_case_is_what_was_done_had_to_happen_and_happened(self) -> None:
        told = self.told(self.open_bench(calm(), deaf()), "#case-2")
        for words in (
            "deaf ✕ failed",
            "the hydrophone is open for a while",
            "deaf from 500 s for 500 s",
            "Rules fire: hydrophone_deaf; no other may.",
            "End of the mission: completed, the source is reached, after 1750 s at sea (12.5 s here).",
            "at most 310 m deep, and 12.5 m at the end, 500 m from the source",
            "the rule hydrophone_deaf did not fire",
            "the rule leak fired at 600 s",
            "1749 set-points; 0 fixes and 0 orders were refused.",
            "Frames: 31000 sent by the vehicle, 41000 by Earshot; 0 lost by the kernel, 0 befallen by a fault.",
        ):
            self.assertIn(words, told)

    def test_is_what_makes_a_case_come_so_and_of_one_that_names_nothing_its_rules(self) -> None:
        page = self.open_bench(calm(), deaf(), at="#case-1")
        self.assertIn("by that it is steered there", self.told(page, "#case-1 dl"))
        self.assertIn("by the rules: hydrophone_deaf", self.told(page, "#case-2 dl"))

    def test_is_to_a_stranger_what_a_case_a_rule_and_a_source_that_is_reached_are(self) -> None:
        told = self.told(self.open_bench(calm()), "#bench-page header")
        for words in (
            "Each case is a search",
            "A rule is a limit",
            "The source is reached where the operator sends COMPLETE",
        ):
            self.assertIn(words, told)

    def test_first_is_how_many_failed_or_were_not_flown(self) -> None:
        for cases, not_flown, words in (
            ((calm(), deaf()), (), "✕ 1 of 2 cases failed"),
            ((calm(),), (), "✓ All 1 cases passed"),
            ((), (), "✕ No case was flown"),
            ((calm(),), ("leak", "frozen"), "✕ 2 of 3 cases were not flown"),
            ((deaf(),), ("leak",), "✕ 1 of 1 cases failed, 1 of 2 cases were not flown"),
        ):
            page = self.open_bench(*cases, not_flown=not_flown)
            self.assertEqual(page.inner_text("#bench-title"), words)
            page.close()

    def test_first_is_what_is_wrong(self) -> None:
        page = self.open_bench(calm(), deaf(), not_flown=("leak", "frozen"))
        told = page.locator("#bench-wrong li").all_inner_texts()
        self.assertEqual(told, ["deaf: the rule hydrophone_deaf did not fire", "Not flown: leak, frozen"])

    def test_is_all_that_had_to_happen(self) -> None:
        def said(**of_case: object) -> str:
            page = self.opened(calm() | of_case)
            told = self.told(page, "#case-1")
            page.close()
            return told

        plain = said()
        self.assertIn("No rule fires.", plain)
        self.assertNotIn("At least one", plain)
        for words, wish in (
            ("Rules fire: none has to; others may.", {"others_may_fire": True}),
            ("Rules fire: leak; others may.", {"others_may_fire": True, "expected_rules": ["leak"]}),
            ("At least one fix is refused.", {"refuses_navigation": True}),
            ("At least one order is refused.", {"refuses_commands": True}),
            ("No fix is refused.", {"refuses_navigation": False}),
            ("Nothing is lost on its way in.", {"loses_nothing": True}),
            ("Decisions after the first fault: at least 2.", {"least_decisions": 2}),
            ("The vehicle is at the surface at the end.", {"comes_up": True}),
            ("The drop weight is released.", {"releases_weight": True}),
            ("The kernel has no room for at least one frame.", {"refuses_frames": True}),
            ("Earshot refuses to fly.", {"refuses_to_fly": True}),
            ("Datagrams: 31000 sent", {"bus": "LCM"}),
        ):
            self.assertNotIn(words, plain)
            self.assertIn(words, said(**wish))

    def test_of_rules_is_when_they_fired_and_what_was_measured(self) -> None:
        rows = self.opened(deaf()).get_by_label("Rules: deaf").locator("tbody tr").all_inner_texts()
        self.assertEqual(rows, ["600\tleak\tfires\t1\t–\trelease", "610\tleak\tends\t0\t–\trelease"])

    def test_is_no_text_of_a_case_as_markup(self) -> None:
        hostile = '</style></script><img src=x onerror="document.title=1"><b>'
        case = deaf() | {key: hostile for key in ("name", "given", "when", "then", "defence", "end", "expected_end")}
        case |= {"wrong": [hostile], "expected_rules": [hostile], "faults": [deaf()["faults"][0] | {"words": hostile}]}
        case["events"] = [event | {"rule": hostile, "response": hostile} for event in case["events"]]
        case["trace"] = [frame | {"channel": hostile, "data": hostile} for frame in case["trace"]]
        page = self.open_bench(case, names={"65291": hostile}, not_flown=(hostile,))
        self.assertEqual(page.title(), "Earshot: bench")
        self.assertEqual(page.locator("main img, main b:not(header b)").count(), 0)
        self.assertIn('onerror="document.title=1"><b> ✕ failed', self.told(page, "#case-1 h2"))


class Cases(BenchTest):
    def test_are_summed_up_in_a_row_each(self) -> None:
        rows = self.open_bench(calm(), deaf()).locator("#bench-summary tbody tr").all_inner_texts()
        end = "completed, the source is reached\t1750"
        self.assertEqual(rows[0], f"calm\t✓ passed\tnothing is wrong\t–\t{end}")
        self.assertEqual(rows[1], f"deaf\t✕ failed\tthe hydrophone is open for a while\tleak\t{end}")

    def test_are_open_where_they_failed_and_by_a_click(self) -> None:
        page = self.open_bench(calm(), deaf())
        is_open = "[...document.querySelectorAll('.case')].map((one) => one.open)"
        self.assertEqual(page.evaluate(is_open), [False, True])
        page.locator("#bench-summary a").first.click()
        self.drawn(page)
        self.assertEqual(page.evaluate(is_open), [True, True])
        self.assertTrue(page.is_visible("#case-1 .bench-map"))
        self.assertEqual(page.evaluate("location.hash"), "#case-1")
        page.click("#case-1 > summary")
        page.locator("#bench-summary a").first.click()  # the second time its address is there already
        self.assertEqual(page.evaluate(is_open), [True, True])

    def test_are_open_where_the_address_names_them(self) -> None:
        page = self.open_bench(calm(), calm(), at="#case-2")
        self.assertEqual(page.evaluate("[...document.querySelectorAll('.case')].map((one) => one.open)"), [False, True])

    def test_are_all_on_paper_with_their_maps(self) -> None:
        page = self.open_bench(calm(), deaf())
        page.evaluate("dispatchEvent(new Event('beforeprint'))")
        self.assertEqual(page.locator(".case[open] .bench-map path.halt").count(), 2)
        self.drawn(page)
        page.evaluate("dispatchEvent(new Event('afterprint'))")
        self.assertEqual(page.evaluate("[...document.querySelectorAll('.case')].map((one) => one.open)"), [False, True])

    def test_can_be_read_by_everybody_and_on_every_screen(self) -> None:
        for scheme in ("light", "dark"):
            for width in (390, 1280, 2560):
                page = self.open_bench(calm(), deaf(), scheme=scheme, width=width, at="#case-1")
                page.evaluate("document.querySelectorAll('.trace').forEach((one) => { one.open = true; })")
                self.assertEqual(self.findings(page), [], (scheme, width))
                self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), width)
                page.close()


class Track(BenchTest):
    def lines(self, page: Page) -> list[tuple[str, list[tuple[float, float]]]]:
        """What lines are on the map, with their corners in pixels to the right and upwards."""
        found = page.evaluate(
            """[...document.querySelectorAll('.bench-map path:is(.way, .fault)')].map(
                 (path) => [path.classList[0], path.getAttribute('d')])"""
        )
        number = r"(-?[\d.]+)"
        return [(name, [(float(x), -float(y)) for x, y in re.findall(f"{number} {number}", d)]) for name, d in found]

    def place(self, page: Page, title: str) -> tuple[float, float]:
        box = page.locator(f".bench-mark[title='{title}']").bounding_box()
        assert box
        return box["x"] + box["width"] / 2, -(box["y"] + box["height"] / 2)

    def below_the_edge(self, page: Page, title: str) -> float:
        """How many pixels a mark is below the upper edge of the map; negative: it is not seen."""
        frame = page.locator(".bench-map").bounding_box()
        assert frame
        return -self.place(page, title)[1] - frame["y"]

    def test_without_a_fault_is_one_line(self) -> None:
        ((name, corners),) = self.lines(self.opened(calm()))
        self.assertEqual((name, len(corners)), ("way", 3))
        (north_x, south_y), (_, north_y), (east_x, _) = corners
        # Three kilometres to the north, then a half to the east; pixels are whole.
        self.assertAlmostEqual((east_x - north_x) / (north_y - south_y), 0.5 / 3, delta=0.01)

    def test_is_cut_where_a_fault_begins_and_ends(self) -> None:
        page = self.opened(deaf())
        lines = self.lines(page)
        self.assertEqual([name for name, _ in lines], ["way", "fault", "way"])
        # From 500 s to 1000 s of the 1500 s to the north: the middle one of three kilometres.
        (_, first), (_, second), (_, third) = lines
        south, north = first[0][1], third[1][1]
        self.assertAlmostEqual((second[0][1] - south) / (north - south), 1 / 3, delta=0.01)
        self.assertAlmostEqual((second[1][1] - south) / (north - south), 2 / 3, delta=0.01)
        self.assertEqual([len(corners) for _, corners in lines], [2, 2, 3])
        dashes = page.evaluate(
            "[...document.querySelectorAll('.bench-map path')].map((path) => getComputedStyle(path).strokeDasharray)"
        )
        self.assertEqual(dashes[1], "none")
        self.assertNotEqual(dashes[2], "none")
        colours = page.evaluate(
            "[...document.querySelectorAll('.bench-map path')].map((p) => getComputedStyle(p).stroke)"
        )
        self.assertEqual(len(set(colours)), 3)

    def test_is_one_line_while_faults_overlap(self) -> None:
        faults = [{"words": "a", "from_s": 0.0, "until_s": 900.0}, {"words": "b", "from_s": 800.0, "until_s": None}]
        self.assertEqual([name for name, _ in self.lines(self.opened(calm() | {"faults": faults}))], ["fault"])

    def test_has_its_marks_where_they_belong(self) -> None:
        page = self.opened(deaf())
        start, end, source = (self.place(page, name) for name in ("start", "end", "source"))
        fired = self.place(page, "first rule fires (leak)")
        km = (end[1] - start[1]) / 3
        self.assertAlmostEqual((fired[1] - start[1]) / km, 1.2, delta=0.03)  # at 600 s of 500 s a kilometre
        self.assertAlmostEqual((fired[0] - start[0]) / km, 0, delta=0.03)
        self.assertAlmostEqual((end[0] - start[0]) / km, 0.5, delta=0.03)
        self.assertAlmostEqual((source[0] - start[0]) / km, 1, delta=0.03)
        self.assertAlmostEqual((source[1] - end[1]) / km, 0, delta=0.03)

    def test_names_what_it_shows_and_nothing_else(self) -> None:
        named = self.told(self.opened(deaf()), "#case-1 .switches")
        for words in ("source", "start", "end", "way of the vehicle", "way while a fault acts", "halt polygon"):
            self.assertIn(words, named)
        self.assertIn("first rule fires (leak)", named)
        named = self.told(self.opened(calm()), "#case-1 .switches")
        for words in ("fault", "rule"):
            self.assertNotIn(words, named)

    def test_leaves_out_a_source_beside_which_it_could_not_be_seen_until_asked(self) -> None:
        # The way is 3 km long: a quarter of 12 km, but less than that of 13.
        for north_m, is_seen in ((13_000.0, True), (14_000.0, False)):
            page = self.opened(
                calm() | {"source_m": [north_m, 2000.0], "halt_polygon_m": [[0, 0], [20e3, 0], [20e3, 9e3]]}
            )
            self.assertEqual(self.below_the_edge(page, "source") > 0, is_seen)
            page.get_by_text("The whole halt polygon").click()
            self.assertGreater(self.below_the_edge(page, "source"), 0)
            page.close()

    def test_of_a_flight_that_never_began_is_a_map_all_the_same(self) -> None:
        page = self.opened(calm() | {"track": [], "trace": []})
        self.assertEqual(self.lines(page), [])
        self.assertIn("The vehicle has no track.", self.told(page))
        self.assertEqual(page.locator(".bench-map path.halt").count(), 1)


class Bus(BenchTest):
    def trace(self, case: Case, names: dict[str, str] | None = None) -> tuple[str, list[str]]:
        """What its frames are, in words, and the rows."""
        page = self.opened(case, names=names)
        page.click("#case-1 .trace > summary")
        words = page.inner_text("#case-1 .trace > summary")
        rows = page.locator("#case-1 .trace tbody tr").all_inner_texts()
        page.close()
        return words, rows

    def times(self, rows: list[str]) -> list[str]:
        """Of frames, which say an address."""
        return [row.split("\t")[0] for row in rows if re.match(r"[^\t]*\t(vehicle|Earshot)", row)]

    def test_around_the_first_rule_is_shown_from_3_s_before_to_1_s_after_it(self) -> None:
        words, rows = self.trace(deaf())
        self.assertEqual(self.times(rows), ["597", "600", "601"])
        self.assertEqual(
            words, "3 of 5 frames that were kept, around the first rule that fired (leak): 597 s to 601 s."
        )

    def test_without_a_rule_is_shown_at_the_end(self) -> None:
        words, rows = self.trace(deaf() | {"events": []})
        self.assertEqual(self.times(rows), ["600", "601", "602"])
        self.assertIn("at the end", words)

    def test_of_a_rule_that_ended_first_is_that_of_the_one_that_fired(self) -> None:
        fires, ends = deaf()["events"]
        words, _ = self.trace(deaf() | {"events": [ends, fires | {"rule": "battery_percent"}]})
        self.assertIn("(battery_percent)", words)

    def test_that_begins_after_the_rule_fired_is_shown_at_the_end_and_this_is_said(self) -> None:
        trace = [frame | {"time_s": 1700.0} for frame in deaf()["trace"]]
        words, rows = self.trace(deaf() | {"trace": trace})
        self.assertEqual(len(self.times(rows)), 5)
        self.assertIn("The trace begins at 1700 s, after that: these are the last before the end.", words)

    def test_that_was_silent_around_the_rule_is_shown_all_the_same(self) -> None:
        trace = [deaf()["trace"][0] | {"time_s": time} for time in (590.0, 595.0)]
        _, rows = self.trace(deaf() | {"trace": trace})
        self.assertEqual(self.times(rows), ["590", "595"])

    def test_shows_the_nearest_frames_where_they_are_too_many(self) -> None:
        frame = deaf()["trace"][0]
        trace = [frame | {"time_s": time} for time in [597.0] * MOST_FRAMES + [600.0] * (MOST_FRAMES - 10)]
        _, rows = self.trace(deaf() | {"trace": trace})
        self.assertEqual(self.times(rows), ["597"] * 10 + ["600"] * (MOST_FRAMES - 10))

    def test_without_a_frame_is_said(self) -> None:
        self.assertIn("There is no trace of the bus.", self.told(self.opened(calm() | {"trace": []})))

    def test_has_faults_before_the_frames_of_their_second_and_rules_behind(self) -> None:
        fault = {"words": "loss of all", "from_s": 600.0, "until_s": 5000.0}
        _, rows = self.trace(deaf() | {"faults": [fault]}, names={"65291": "EarshotSNR"})
        self.assertEqual(
            rows,
            [
                "597\tvehicle 40\t65291 EarshotSNR\t01",
                "600\tfault begins\tloss of all\t",
                "600\tvehicle 40\t65291 EarshotSNR\t02",
                "600\trule fires\tleak, 1 (limit –): release\t",
                "601\tvehicle 40\t65291 EarshotSNR\t03",
            ],
        )

    def test_says_who_sent_a_frame(self) -> None:
        _, rows = self.trace(calm())
        self.assertEqual(rows[0], "1749\tvehicle 36\t127250\tc6 8e 3d ff 7f ff 7f fc")
        self.assertEqual(rows[1], "1749\tEarshot 64\t65290\t01 02 03 04 05 06 07 08")

    def test_names_the_channel_of_a_message_over_lcm(self) -> None:
        message = {"time_s": 600.0, "from_earshot": True, "pgn": 0, "source": 0, "data": "4c43", "channel": "A<B"}
        words, rows = self.trace(deaf() | {"bus": "LCM", "trace": [message]}, names={"0": "ISO"})
        self.assertIn("1 of 1 messages that were kept", words)
        self.assertEqual(rows[0], "600\tEarshot\tA<B\t4c 43")
