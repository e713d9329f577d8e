"""A browser for the tests of the page, which see a request to another computer and an error on its console."""

import os
import tempfile
import unittest
from pathlib import Path
from typing import Any

import axe_playwright_python
from playwright.sync_api import Browser, ConsoleMessage, Page, sync_playwright
from sample_flight import Flight, page_with

PAGE = Path(os.environ["FLIGHT_PAGE"]).read_text()
AXE = (Path(axe_playwright_python.__file__).parent / "axe.min.js").read_text()
OPEN_S = 60.0  # of a machine that is busy


class PageTest(unittest.TestCase):
    """Each test opens pages of its own, in one browser."""

    browser: Browser

    @classmethod
    def setUpClass(cls) -> None:
        steering = sync_playwright().start()
        cls.addClassCleanup(steering.stop)
        cls.browser = steering.chromium.launch(executable_path=os.environ["CHROMIUM"], args=["--no-sandbox"])
        cls.addClassCleanup(cls.browser.close)

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.errors: list[str] = []
        self.requests: list[str] = []

    def tearDown(self) -> None:
        self.assertEqual(self.errors, [])
        outside = [url for url in self.requests if not url.startswith(("file:", "data:", "blob:", "http://127.0.0.1:"))]
        self.assertEqual(outside, [])

    def new_page(self, width: int = 1280, height: int = 900, scheme: str = "light") -> Page:
        page = self.browser.new_page(
            viewport={"width": width, "height": height}, color_scheme=scheme, accept_downloads=True
        )
        self.addCleanup(page.close)
        page.on("console", self.note)
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("request", lambda request: self.requests.append(request.url))
        page.set_default_timeout(1000 * OPEN_S)
        return page

    def note(self, said: ConsoleMessage) -> None:
        is_ours = said.text.startswith("Canvas2D: Multiple readback")  # the tests read pixels back, the page does not
        if said.type in ("error", "warning") and not is_ours:
            self.errors.append(said.text)

    def open(self, flight: Flight, *, is_compressed: bool = False, **view: Any) -> Page:
        """The flight's page from a file, as a reader opens a report."""
        file = self.folder / "report.html"
        file.write_text(page_with(PAGE, flight, is_compressed))
        page = self.new_page(**view)
        page.goto(file.as_uri())
        page.wait_for_selector("#page:not([hidden])")
        self.drawn(page)
        return page

    def drawn(self, page: Page) -> None:
        """Waits until what was asked for stands on the screen."""
        page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def move(self, page: Page, time_s: float) -> None:
        """The slider, as a reader drags it."""
        page.evaluate(
            """(time_s) => {
              const slider = document.getElementById('time');
              slider.value = time_s;
              slider.dispatchEvent(new Event('input'));
            }""",
            time_s,
        )
        self.drawn(page)

    def moment_s(self, page: Page) -> float:
        return float(page.input_value("#time"))

    def belief_cell(self, page: Page, row: int, column: int) -> list[int]:
        """Red, green, blue and opacity of a cell of the belief's picture; rows count from the south."""
        return page.evaluate(
            """([row, column]) => {
              const canvas = document.querySelector('canvas.belief');
              return [...canvas.getContext('2d').getImageData(column, canvas.height - 1 - row, 1, 1).data];
            }""",
            [row, column],
        )

    def findings(self, page: Page) -> list[str]:
        """What axe-core calls serious or critical. Contrast is judged in the page, not in the pictures."""
        page.evaluate(AXE + "; 0")
        found = page.evaluate("axe.run(document, {resultTypes: ['violations']})")["violations"]
        return [
            f"{one['id']}: {[node['html'] for node in one['nodes']]}"
            for one in found
            if one["impact"] in ("serious", "critical")
        ]
