"""The moment that the page shows: slider, keys, pointer and play, and what changes with it."""

from page_rig import PageTest
from playwright.sync_api import Page
from sample_flight import END_S, small

# The ends of cividis: the likeliest cell is dark blue on white and yellow on black.
DARK_BLUE, YELLOW = [0, 32, 77], [255, 234, 70]


class Moment(PageTest):
    def test_opens_at_the_decision_that_is_asked_for_or_at_the_end(self) -> None:
        page = self.open(small())
        self.assertEqual(self.moment_s(page), 300)
        self.assertEqual(page.inner_text("#moment"), "0:05:00 · 2026-11-22 15:09:00 UTC of 0:20:00")
        self.assertEqual(page.get_attribute("#time", "aria-valuetext"), "0:05:00 · 2026-11-22 15:09:00 UTC")
        page = self.open(small() | {"open_at_step": None})
        self.assertEqual(self.moment_s(page), END_S)

    def test_moves_belief_and_decision_with_the_slider(self) -> None:
        page = self.open(small())
        self.assert_cell(page, 4, 3, DARK_BLUE)
        self.assertNotEqual(self.belief_cell(page, 6, 5)[:3], DARK_BLUE)
        self.move(page, 899)
        self.assertEqual(page.inner_text("#decision-title"), "Step 2: goes E")
        self.assert_cell(page, 5, 4, DARK_BLUE)
        self.move(page, 900)
        self.assertEqual(page.inner_text("#decision-title"), "Step 3: goes SE")
        self.assert_cell(page, 6, 5, DARK_BLUE)
        self.assertNotEqual(self.belief_cell(page, 4, 3)[:3], DARK_BLUE)

    def test_draws_the_belief_for_black_ground_too(self) -> None:
        page = self.open(small(), scheme="dark")
        self.assert_cell(page, 4, 3, YELLOW)
        page.emulate_media(color_scheme="light")
        self.drawn(page)
        self.assert_cell(page, 4, 3, DARK_BLUE)

    def test_colours_no_cell_beyond_the_area_of_98_percent(self) -> None:
        page = self.open(small())
        self.move(page, 0)  # the likeliest cell is (3, 2); the byte grows by 36 a ring, and 250 is 98 %
        self.assertGreater(self.belief_cell(page, 9, 2)[3], 0)
        self.assertEqual(self.belief_cell(page, 3, 9)[3], 0)
        page.uncheck("input[name=belief]")
        self.drawn(page)
        self.assertEqual(page.locator("canvas.belief").count(), 0)

    def test_shows_the_values_under_the_pointer(self) -> None:
        page = self.open(small())
        x = self.point_at(page, 700)
        minutes, seconds = page.inner_text("#values b >> nth=0").split(":")[1:]
        self.assertAlmostEqual(60 * int(minutes) + int(seconds), 700, delta=3)  # seconds of a pixel or two
        # By the rules of the sample: 100 m + 7 m, 90 % - 7 %.
        self.assertEqual(self.value(page, "SNR"), "SNR 12.3 dB (expected 9.0 dB)")
        self.assertEqual(self.value(page, "depth"), "depth 107.0 m (ordered 110.0 m)")
        self.assertEqual(self.value(page, "battery"), "battery 83.0 %")
        self.assertEqual(self.value(page, "mismatch"), "mismatch −2.0 bits")
        self.assertEqual(self.value(page, "heading"), "heading 0° (ordered 5°)")
        self.assertEqual(self.value(page, "turn time"), "turn time 0.125 ms")
        self.assertEqual(self.moment_s(page), 300)  # the pointer alone moves nothing
        page.mouse.click(x, page.locator(".strip").first.bounding_box()["y"] + 20)
        self.drawn(page)
        self.assertAlmostEqual(self.moment_s(page), 700, delta=3)
        self.assertEqual(page.inner_text("#decision-title"), "Step 2: goes E")

    def test_says_of_what_was_too_faint_that_it_lies_below(self) -> None:
        page = self.open(small())
        self.point_at(page, 100)
        self.assertEqual(self.value(page, "SNR"), "SNR below −3.0 dB (expected 9.0 dB)")
        page.mouse.move(5, 5)
        self.drawn(page)
        self.assertEqual(self.value(page, "SNR"), "SNR 6.5 dB (expected 9.0 dB)")  # of the moment shown

    def test_obeys_keys(self) -> None:
        page = self.open(small())
        for key, expected_s in (
            ("ArrowRight", 310),
            ("ArrowLeft", 300),
            ("ArrowDown", 600),
            ("ArrowUp", 300),
            ("Home", 0),
            ("ArrowLeft", 0),
            ("End", END_S),
            ("ArrowRight", END_S),
        ):
            page.keyboard.press(key)
            self.drawn(page)
            self.assertEqual(self.moment_s(page), expected_s, key)
        page.keyboard.press("?")
        self.assertTrue(page.is_visible("#help"))
        page.keyboard.press("ArrowLeft")  # is the dialog's now
        page.keyboard.press("Escape")
        self.assertFalse(page.is_visible("#help"))
        self.assertEqual(self.moment_s(page), END_S)

    def test_plays_as_fast_as_it_is_told(self) -> None:
        page = self.open(small())
        page.select_option("#speed", "300")
        page.locator("#speed").blur()
        page.keyboard.press(" ")
        self.drawn(page)
        self.assertEqual(page.inner_text("#play"), "Pause")
        begin = page.evaluate("[Number(document.getElementById('time').value), performance.now()]")
        page.wait_for_timeout(500)
        page.keyboard.press(" ")
        end = page.evaluate("[Number(document.getElementById('time').value), performance.now()]")
        self.drawn(page)
        self.assertEqual(page.inner_text("#play"), "Play")
        played_s, passed_s = end[0] - begin[0], (end[1] - begin[1]) / 1000
        self.assertAlmostEqual(played_s / passed_s, 300, delta=90)  # of two moments that are a picture apart
        held_s = self.moment_s(page)
        page.wait_for_timeout(100)
        self.assertEqual(self.moment_s(page), held_s)

    def test_plays_from_the_beginning_once_it_is_at_the_end(self) -> None:
        page = self.open(small())
        page.keyboard.press("End")
        page.select_option("#speed", "1200")
        page.click("#play")
        page.locator("#play", has_text="Pause").wait_for()
        page.locator("#play", has_text="Play").wait_for()  # a second later it is over
        self.assertEqual(self.moment_s(page), END_S)

    def test_goes_from_decision_to_decision_by_buttons(self) -> None:
        page = self.open(small())
        page.click("#decision-after")
        self.drawn(page)
        self.assertEqual(page.inner_text("#decision-title"), "Step 2: goes E")
        page.click("#decision-before")
        page.click("#decision-before")
        page.click("#decision-before")
        self.drawn(page)
        self.assertEqual(page.inner_text("#decision-title"), "Step 0: goes N")

    def test_goes_to_a_decision_that_is_clicked_on_the_map(self) -> None:
        page = self.open(small() | {"open_at_step": 3})
        x, y = self.on_map(page, 2600.0, 1500.0)
        page.mouse.move(x, y)
        self.assertEqual(page.inner_text(".leaflet-tooltip"), "step 1: 6.5 dB, went NE")
        page.mouse.click(x, y)
        self.drawn(page)
        self.assertEqual(self.moment_s(page), 300)

    def test_tells_the_place_under_the_pointer(self) -> None:
        page = self.open(small())
        page.mouse.move(*self.on_map(page, 4500.0, 3500.0))
        north, east, position, area = self.told(page)
        self.assertAlmostEqual(north, 4.5, delta=0.05)  # kilometres of a pixel or two
        self.assertAlmostEqual(east, 3.5, delta=0.05)
        # A degree of latitude at 45 degrees is 111.13 km, one of longitude 78.85 km (WGS-84, printed tables).
        self.assertEqual(position.split("° ")[1:], ["N, 29.95" + position.split("29.95")[1][:2], "W"])
        self.assertAlmostEqual(float(position.split("°")[0]), 45.0 + 4.5 / 111.13, delta=0.0006)
        self.assertEqual(area, "at the edge of the 0 % area")  # the likeliest cell

    def assert_cell(self, page: Page, row: int, column: int, colour: list[int]) -> None:
        for found, expected in zip(self.belief_cell(page, row, column)[:3], colour, strict=True):
            self.assertAlmostEqual(found, expected, delta=2)  # canvases hold colours multiplied by their opacity

    def told(self, page: Page) -> tuple[float, float, str, str]:
        plane, position, area = page.inner_text("#map-place").split(" · ")
        north, east = (float(part.split()[0]) for part in plane.split(", "))
        return north, east, position, area

    def on_map(self, page: Page, north_m: float, east_m: float) -> tuple[float, float]:
        """Where a place of the sample is on the screen, by the frame that the belief's picture fills: 10 km square."""
        page.locator("#map").scroll_into_view_if_needed()
        box = page.evaluate(
            "(({left, bottom, width}) => [left, bottom, width])(document.querySelector('canvas.belief').getBoundingClientRect())"
        )
        return box[0] + box[2] * east_m / 10_000, box[1] - box[2] * north_m / 10_000

    def point_at(self, page: Page, time_s: float) -> float:
        """The pointer over the strips at a time; its place on the screen. The axis at their left is 52 pixels wide."""
        page.locator("#strips").scroll_into_view_if_needed()
        box = page.locator(".strip").first.bounding_box()
        assert box
        cursor = page.evaluate("document.querySelector('.cursor').getBoundingClientRect().left")
        left = box["x"] + 52
        per_s = (cursor + 0.75 - left) / self.moment_s(page)  # half the cursor's width
        x = left + time_s * per_s
        page.mouse.move(x, box["y"] + 20)
        self.drawn(page)
        return x

    def value(self, page: Page, strip: str) -> str:
        return page.inner_text(f"#values [data-strip='{strip}']")
