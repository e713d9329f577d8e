"""The log of what happened: search, kinds, and moments."""

from page_rig import PageTest
from playwright.sync_api import Page
from sample_flight import big, small


class Events(PageTest):
    def shown(self, page: Page) -> list[str]:
        return [" ".join(text.split()) for text in page.locator("#events li").all_inner_texts()]

    def test_lists_all_and_finds_words(self) -> None:
        page = self.open(small())
        self.assertEqual(len(self.shown(page)), 8)
        self.assertEqual(page.inner_text("#event-count"), "8 of 8 events")
        page.fill("#event-search", "ORDER 7")
        self.assertEqual(self.shown(page), ["0:00:00 order 7: start", "0:00:01 order 7 is accepted"])
        self.assertEqual(page.inner_text("#event-count"), "2 of 8 events")
        page.keyboard.press("ArrowLeft")  # moves in the words, not in the flight
        self.drawn(page)
        self.assertEqual(self.moment_s(page), 300)
        page.fill("#event-search", "")
        self.assertEqual(len(self.shown(page)), 8)

    def test_leaves_out_kinds(self) -> None:
        page = self.open(small())
        kinds = page.locator("#event-kinds label")
        self.assertEqual(len(kinds.all_inner_texts()), 8)
        page.uncheck("#event-kinds label:has-text('rules') input")
        page.uncheck("#event-kinds label:has-text('orders') input")
        self.assertEqual(page.inner_text("#event-count"), "6 of 8 events")
        self.assertNotIn("rule 12 fired", " ".join(self.shown(page)))
        page.check("#event-kinds label:has-text('rules') input")
        self.assertIn("0:10:00 rule 12 fired: depth below 108 m", self.shown(page))

    def test_marks_the_newest_and_goes_to_one_that_is_clicked(self) -> None:
        page = self.open(small())
        self.assertIn("SEARCHING", page.inner_text("#events [aria-current]"))
        page.click("#events button:has-text('rule 12 fired')")
        self.drawn(page)
        self.assertEqual(self.moment_s(page), 600)
        self.assertIn("rule 12 fired", page.inner_text("#events [aria-current]"))
        self.assertEqual(page.inner_text("#decision-title"), "Step 2: goes E")

    def test_says_that_it_shows_the_last_of_many(self) -> None:
        page = self.open(big(rows=100, decisions=4))
        self.assertEqual(page.inner_text("#event-count"), "1000 of 1000 events; the last 500 stand here")
        self.assertEqual(len(self.shown(page)), 500)
