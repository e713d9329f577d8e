"""Whether everybody can read a page of a flight: on a telephone, in the dark, with a screen reader; and in time."""

import time

from page_rig import PageTest
from playwright.sync_api import Page
from sample_flight import big, small

MOVES = 60


class Readable(PageTest):
    def test_has_no_serious_finding_of_axe_in_light_and_dark(self) -> None:
        for scheme in ("light", "dark"):
            for width in (390, 1280, 2560):
                page = self.open(small(), scheme=scheme, width=width)
                self.assertEqual(self.findings(page), [], (scheme, width))
                page.keyboard.press("?")
                self.assertEqual(self.findings(page), [], (scheme, width, "help"))
                page.close()

    def test_fits_every_screen(self) -> None:
        for width in (390, 1280, 2560):
            page = self.open(small(), width=width)
            self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), width)
            frame = page.locator("#map").bounding_box()
            assert frame
            self.assertGreater(frame["width"], min(width, 1000) * 0.45)
            page.close()

    def test_keeps_its_controls_in_sight_and_in_reach_on_a_telephone(self) -> None:
        page = self.open(small(), width=390, height=844)
        page.evaluate("window.scrollTo(0, 1500)")
        self.drawn(page)
        for control in ("#play", "#speed", "#time", "#show-help", "#moment"):
            box = page.locator(control).bounding_box()
            assert box
            self.assertGreaterEqual(box["x"], 0, control)
            self.assertLessEqual(box["x"] + box["width"], 390, control)
            self.assertLess(box["y"] + box["height"], 200, control)
        page.click("#show-help")
        self.assertTrue(page.is_visible("#help"))

    def test_shows_strips_beside_the_map_on_a_wide_screen(self) -> None:
        page = self.open(small(), width=2560, height=1300)
        bottom = page.locator(".strip").last.bounding_box()
        frame = page.locator("#map").bounding_box()
        assert bottom and frame
        self.assertGreater(bottom["x"], frame["x"] + frame["width"])
        self.assertLess(bottom["y"] + bottom["height"], 1300)

    def test_cuts_no_number_of_the_map_off(self) -> None:
        for width in (390, 1280):
            page = self.open(small(), width=width)
            frame = page.locator("#map").bounding_box()
            assert frame
            labels = page.locator("#map .grid-label")
            self.assertEqual(labels.count(), 12)  # 0, 2, ... 10 north and east
            for label in labels.all():
                text = label.evaluate(
                    """(label) => {
                      const text = document.createRange();
                      text.selectNodeContents(label);
                      return text.getBoundingClientRect().toJSON();
                    }"""
                )
                self.assertGreaterEqual(text["left"], frame["x"])
                self.assertLessEqual(text["right"], frame["x"] + frame["width"])
                self.assertLessEqual(text["bottom"], frame["y"] + frame["height"])

    def test_puts_the_sound_under_its_moments_in_the_strips(self) -> None:
        page = self.open(small())
        page.locator("#spectrogram").scroll_into_view_if_needed()
        picture = page.locator("#spectrogram canvas").bounding_box()
        in_strips = page.locator("#strips .cursor").bounding_box()
        in_sound = page.locator("#spectrogram .cursor").bounding_box()
        assert picture and in_strips and in_sound
        self.assertAlmostEqual(in_strips["x"], in_sound["x"], delta=1.5)  # pixels
        # Six rows of 200 s, the first about 100 s: they fill the twenty minutes, and 300 s lie a quarter in.
        self.assertAlmostEqual((in_sound["x"] - picture["x"]) / picture["width"], 0.25, delta=0.005)
        page.mouse.click(picture["x"] + picture["width"] / 2, picture["y"] + 10)
        self.drawn(page)
        self.assertAlmostEqual(self.moment_s(page), 600, delta=3)  # seconds of a pixel or two

    def test_opens_twelve_hours_and_draws_every_move_of_the_slider(self) -> None:
        begin_s = time.monotonic()
        page = self.open(big(), is_compressed=True)
        page.wait_for_selector("canvas.belief")
        opened_s = time.monotonic() - begin_s
        titles, passed_s = self.scrub(page, "document.getElementById('decision-title').textContent")
        self.assertEqual(len(set(titles)), MOVES)  # 60 moments of 100 decisions: no two have the same
        beliefs, _ = self.scrub(
            page, "document.querySelector('canvas.belief').getContext('2d').getImageData(0, 25, 50, 1).data.join()"
        )
        self.assertEqual(len(set(beliefs)), MOVES)
        print(f"8,000 rows and 100 decisions: opened in {opened_s:.2f} s, {MOVES / passed_s:.0f} pictures a second")
        # The bars of 2 s and 30 a second are for a machine that does nothing else; these hold beside a dozen tests.
        self.assertLess(opened_s, 30.0)
        self.assertGreater(MOVES / passed_s, 2.0)

    def scrub(self, page: Page, expression: str) -> tuple[list[str], float]:
        """What an expression gives for each of the moves, and how long they took."""
        seen, passed_ms = page.evaluate(
            f"""async (moves) => {{
              const slider = document.getElementById('time');
              const seen = [];
              const begin_ms = performance.now();
              for (let i = 0; i < moves; ++i) {{
                slider.value = String((Number(slider.max) * i) / moves);
                slider.dispatchEvent(new Event('input'));
                await new Promise((done) => requestAnimationFrame(done));
                seen.push({expression});
              }}
              return [seen, performance.now() - begin_ms];
            }}""",
            MOVES,
        )
        return seen, passed_ms / 1000
