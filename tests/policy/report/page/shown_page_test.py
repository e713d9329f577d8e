"""What the page of a flight shows, and what it keeps to itself."""

from page_rig import PageTest
from playwright.sync_api import Page
from sample_flight import NASTY_NAME, at_sea, small


class Shown(PageTest):
    def test_says_first_how_the_flight_ended_and_what_is_missing(self) -> None:
        page = self.open(small())
        self.assertEqual(page.inner_text("#verdict"), "Source found: declared at step 3, 707 m from it")
        self.assertEqual(page.get_attribute("#verdict", "class"), "found")
        self.assertEqual(page.inner_text("#kind"), "simulation")
        self.assertEqual(page.inner_text("#shortcomings"), "The sound was not recorded after step 2.")
        self.assertIn("The vehicle went north.", page.inner_text("#sentences"))
        self.assertIn("Times count from 2026-11-22 15:04:00 UTC.", page.inner_text("#sentences"))

    def test_has_facts_with_what_they_mean(self) -> None:
        facts = self.open(small()).inner_text("#facts")
        self.assertEqual(facts.split("\n"), ["frequency of the source", "20.0 Hz", "A fin whale calls so low."])

    def test_never_makes_a_text_of_the_flight_part_of_itself(self) -> None:
        page = self.open(small())
        self.assertEqual(page.title(), f"Earshot: {NASTY_NAME}")
        self.assertEqual(page.locator("main script, main img").count(), 0)
        self.assertEqual(page.locator("#events b").count(), 0)
        self.assertIn("currents <b>grow</b>", page.inner_text("#events"))

    def test_marks_a_port_that_is_down(self) -> None:
        page = self.open(small())
        self.assertEqual(page.locator("#health tr.wrong").all_inner_texts(), ["2\tDOWN\t17\t4\t1\t2"])
        self.assertIn("fixes refused: 3", page.inner_text("#health"))
        self.assertNotIn("orders refused", page.inner_text("#health"))

    def test_gives_the_reasons_of_the_decision_and_the_second_best(self) -> None:
        page = self.open(small())
        self.assertEqual(page.inner_text("#decision-title"), "Step 1: goes NE")
        self.assertEqual(
            page.locator("#decision .reasons li").all_inner_texts(),
            ["Reason 1: the sound grows to the NE.", "East was second best: it costs 0.5 steps."],
        )
        self.assertIn("NE ◀ taken", page.inner_text("tr.taken"))
        self.assertEqual(
            page.locator("#decision tr", has_text="second best").locator("td").first.inner_text(), "E second best"
        )
        taken = page.locator("tr.taken td").all_inner_texts()
        self.assertEqual(taken[1:], ["4.00", "12.0 ± 3.5 dB", "25 %", "5.0 %", "−120 m", "0.00"])

    def test_gives_what_would_explain_the_sound_and_what_the_policy_saw(self) -> None:
        page = self.open(small())
        rows = page.locator("#decision details").first.locator("tbody tr").all_inner_texts()
        self.assertEqual(rows[0], "75 %\tMunk profile\t3 dB\t4 dB\t10 %\tno")
        self.assertEqual(rows[1], "25 %\tArctic duct\t−3 dB\t6 dB\t0 %\tyes")
        page.click("text=What the policy saw (2 numbers)")
        first = page.locator("#decision details").nth(1).locator("tbody tr").first
        self.assertEqual(first.inner_text(), "likeliest distance\t5.5 km\t−0.700")  # it moved the choice most

    def test_says_what_was_special_about_a_decision(self) -> None:
        page = self.open(small())
        self.move(page, 0)
        self.assertEqual(page.inner_text("#decision p.soft"), "decided at 0:00:00 · sweeps")
        self.move(page, 700)
        self.assertIn("a rule moved the way-point", page.inner_text("#decision p.soft"))
        self.move(page, 900)
        self.assertIn("declares the source found", page.inner_text("#decision p.soft"))

    def test_hides_the_source_until_it_is_asked_for(self) -> None:
        page = self.open(small())
        switch = page.locator("input[name=truth]")
        self.assertFalse(switch.is_checked())
        self.assertIn("known to the simulation alone", page.inner_text("label.truth"))
        red = "rgb(163, 45, 18)"  # --truth of style.css, which nothing else on the map has
        hidden = self.pixels_of(page, red)
        switch.check()
        self.drawn(page)
        self.assertEqual(hidden, 0)
        self.assertGreater(self.pixels_of(page, red), 20)
        switch.uncheck()
        self.drawn(page)
        self.assertEqual(self.pixels_of(page, red), 0)

    def test_has_no_switch_for_the_source_at_sea(self) -> None:
        page = self.open(at_sea())
        self.assertEqual(page.locator("input[name=truth]").count(), 0)
        self.assertEqual(page.inner_text("#kind"), "at sea")
        self.assertEqual(page.get_attribute("#verdict", "class"), "")
        self.assertNotIn("UTC", page.inner_text("#moment"))
        self.assertFalse(page.is_visible("#sound"))

    def test_draws_the_spectrogram_with_its_scale(self) -> None:
        page = self.open(small())
        canvas = "document.querySelector('#spectrogram canvas').getContext('2d')"
        pixel = f"([x, y]) => [...{canvas}.getImageData(x, y, 1, 1).data]"
        # The ends of cividis; frequency goes up, time to the right: the loud cell stands bottom left.
        self.assertEqual(page.evaluate(pixel, [0, 3]), [255, 234, 70, 255])
        self.assertEqual(page.evaluate(pixel, [0, 2]), [0, 32, 77, 255])
        self.assertEqual(page.evaluate(pixel, [1, 3]), [0, 32, 77, 255])
        self.assertEqual(page.locator("#spectrogram .axis").inner_text().split(), ["40", "Hz", "10", "Hz"])
        self.assertIn("dark: 60, yellow: 90 dB re 1 µPa²/Hz", page.inner_text("#spectrogram"))

    def pixels_of(self, page: Page, colour: str) -> int:
        """Of the map, that have just this colour."""
        return page.evaluate(
            """(colour) => {
              const wanted = colour.match(/\\d+/g).map(Number);
              let count = 0;
              for (const canvas of document.querySelectorAll('#map canvas:not(.belief)')) {
                const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
                for (let i = 0; i < data.length; i += 4)
                  if (data[i + 3] === 255 && wanted.every((part, k) => Math.abs(data[i + k] - part) <= 2)) ++count;
              }
              return count;
            }""",
            colour,
        )
