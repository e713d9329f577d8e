"""The page as a whole: it tells every case, needs nothing else, and shows no text as markup."""

import re
import unittest
from html.parser import HTMLParser

from bench_example import calm, deaf, results_of

from bench_page import STYLE, page

# Elements that HTML ends by themselves.
_VOID = {"meta", "br", "img", "link", "input", "hr", "wbr"}


class Tags(HTMLParser):
    """Every element, and whether each is closed where it must be."""

    def __init__(self, html: str):
        super().__init__()
        self.names: list[str] = []
        self.ids: list[str] = []
        self.targets: list[str] = []
        self.open: list[str] = []
        self.text = ""
        self.feed(html)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.names.append(tag)
        said = dict(attrs)
        self.ids += [said["id"]] if "id" in said else []
        self.targets += [said[key] for key in ("href", "src") if key in said]
        if tag not in _VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.names.append(tag)

    def handle_endtag(self, tag):
        if self.open.pop() != tag:
            raise AssertionError(f"</{tag}> closes another element")

    def handle_data(self, data):
        self.text += data


def channel(value: int) -> float:
    share = value / 255.0
    return share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4


def luminance(colour: str) -> float:
    digits = "".join(2 * digit for digit in colour[1:]) if len(colour) == 4 else colour[1:]
    red, green, blue = (channel(int(digits[i : i + 2], 16)) for i in (0, 2, 4))
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


class Page(unittest.TestCase):
    def setUp(self):
        self.html = page(results_of(calm(), deaf()), {}, "by hand", [])
        self.tags = Tags(self.html)

    def test_tells_of_every_case_what_was_done_had_to_happen_and_happened(self):
        told = " ".join(self.tags.text.split("deaf \N{MULTIPLICATION X} failed")[-1].split())
        for words in (
            "the hydrophone is open for a while",
            "deaf from 500 s for 500 s",
            "Rules fire: hydrophone_deaf; no other may.",
            "End of the mission: completed, the source is reached, after 1750 s at sea",
            "at most 310 m deep, and 12.5 m at the end, 500 m from the source",
            "the rule hydrophone_deaf did not fire",
            "the rule leak fired at 600 s",
            "31000 sent by the vehicle, 41000 by Earshot",
        ):
            self.assertIn(words, told)

    def test_says_what_makes_a_case_come_so_and_of_one_that_names_nothing_its_rules(self):
        calm_shown, deaf_shown = self.tags.text.split("deaf \N{MULTIPLICATION X} failed")[-2:]
        self.assertIn("bythat it is steered there", calm_shown)
        self.assertIn("bythe rules: hydrophone_deaf", deaf_shown)

    def test_says_to_a_stranger_what_a_case_a_rule_and_a_source_that_is_reached_are(self):
        before_the_cases = " ".join(self.tags.text.split("at sea (s)")[0].split())
        for words in (
            "Each case is a search",
            "A rule is a limit",
            "The source is reached where the operator sends COMPLETE",
        ):
            self.assertIn(words, before_the_cases)

    def test_says_first_how_many_failed(self):
        self.assertIn("1 of 2 cases failed", self.tags.text)
        self.assertIn("All 1 cases passed", Tags(page(results_of(calm()), {}, "", [])).text)
        self.assertIn("\N{MULTIPLICATION X} No case was flown", Tags(page([], {}, "", [])).text)

    def test_says_first_what_was_not_flown(self):
        text = Tags(page(results_of(calm()), {}, "", ["leak", "frozen"])).text
        self.assertIn("\N{MULTIPLICATION X} 2 of 3 cases were not flown", text)
        self.assertIn("Not flown: leak, frozen", text)
        self.assertNotIn("All 1", text)

    def test_says_all_that_had_to_happen(self):
        def said(**of_case: object) -> str:
            return Tags(page(results_of(calm() | of_case), {}, "", [])).text

        self.assertIn("No rule fires.", said())
        self.assertIn("Rules fire: none has to; others may.", said(others_may_fire=True))
        self.assertIn("Rules fire: leak; others may.", said(others_may_fire=True, expected_rules=["leak"]))
        self.assertNotIn("At least one", said())
        self.assertIn("At least one fix is refused.", said(refuses_navigation=True))
        self.assertIn("At least one order is refused.", said(refuses_commands=True))
        self.assertIn("No fix is refused.", said(refuses_navigation=False))
        for words, wish in (
            ("Nothing is lost on its way in.", {"loses_nothing": True}),
            ("Decisions after the first fault: at least 2.", {"least_decisions": 2}),
            ("The vehicle is at the surface at the end.", {"comes_up": True}),
            ("The drop weight is released.", {"releases_weight": True}),
            ("The kernel has no room for at least one frame.", {"refuses_frames": True}),
            ("Earshot refuses to fly.", {"refuses_to_fly": True}),
        ):
            self.assertNotIn(words, said())
            self.assertIn(words, said(**wish))

    def test_says_datagrams_of_a_case_over_lcm(self):
        self.assertIn("Datagrams: 31000 sent", Tags(page(results_of(calm() | {"bus": "LCM"}), {}, "", [])).text)

    def test_says_a_verdict_in_words_too(self):
        self.assertIn("\N{CHECK MARK} passed", self.tags.text)
        self.assertIn("\N{MULTIPLICATION X} failed", self.tags.text)

    def test_leads_from_its_summary_to_every_case(self):
        self.assertEqual(self.tags.targets, ["#case-2", "#case-1", "#case-2"], "those that failed come first")
        for target in self.tags.targets:
            self.assertIn(target[1:], self.tags.ids)

    def test_needs_no_network_and_no_script(self):
        self.assertNotIn("script", self.tags.names)
        self.assertNotIn("link", self.tags.names)
        self.assertNotIn("@import", self.html)
        addresses = set(re.findall(r"\w+://[^\"' )]+", self.html))
        self.assertEqual(addresses, {"http://www.w3.org/2000/svg"})  # a name, not an address
        self.assertEqual(set(re.findall(r"url\((.)", self.html)), {"#"})

    def test_closes_what_it_opens_and_names_nothing_twice(self):
        self.assertEqual(self.tags.open, [])
        self.assertEqual(len(self.tags.ids), len(set(self.tags.ids)))

    def test_shows_the_text_of_a_case_as_text(self):
        hostile = '</style><script>alert("1")</script>\u202e\x1b[2J'
        entry = deaf() | {key: hostile for key in ("name", "given", "when", "then", "defence", "end", "expected_end")}
        entry |= {"wrong": [hostile], "expected_rules": [hostile]}
        entry["faults"] = [deaf()["faults"][0] | {"words": hostile}]
        entry["events"] = [event | {"rule": hostile, "response": hostile} for event in entry["events"]]
        entry["trace"] = [frame | {"data": hostile} for frame in entry["trace"]]
        html = page(results_of(entry), {65291: hostile}, hostile, [hostile])
        tags = Tags(html)
        self.assertNotIn("script", tags.names)
        self.assertEqual(tags.open, [])
        self.assertNotIn("\x1b", html)
        self.assertNotIn("\u202e", html)
        self.assertIn("\\u202e\\u001b[2J", tags.text)

    def test_has_letters_that_can_be_told_from_what_is_behind_them(self):
        light, dark = (dict(re.findall(r"--(\w+):(#\w+)", part)) for part in STYLE.split("@media", 2)[:2])
        for colours in (light, dark):
            for ink in ("ink", "soft", "good", "bad"):
                for ground in ("paper", "card"):
                    brighter, darker = sorted((luminance(colours[ink]), luminance(colours[ground])), reverse=True)
                    # Source: WCAG 2.1, success criterion 1.4.3.
                    self.assertGreaterEqual((brighter + 0.05) / (darker + 0.05), 4.5, f"{ink} on {ground}")


if __name__ == "__main__":
    unittest.main()
