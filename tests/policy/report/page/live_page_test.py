"""A flight under way: what `earshot watch` sends, sent by a server of the test."""

import http.server
import json
import queue
import threading
from typing import Any

from page_rig import PAGE, PageTest
from playwright.sync_api import Page
from sample_flight import EVENTS, decision, small, strip_row, strips, under_way

BEFORE_S = 600  # the sample under way ends before its third decision


class Server:
    """Sends to every page what it is told to; a page that connects gets the whole flight first."""

    def __init__(self, flight: dict[str, Any], port: int = 0) -> None:
        self.flight = flight
        self.pages: list[queue.Queue[tuple[str, Any] | None]] = []
        outer = self

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                self.send_response(200)
                if self.path == "/":
                    content = PAGE.encode()
                    self.send_header("Content-Type", "text/html; charset=utf-8")
                    self.send_header("Content-Length", str(len(content)))
                    self.end_headers()
                    self.wfile.write(content)
                    return
                self.send_header("Content-Type", "text/event-stream")
                self.end_headers()
                messages: queue.Queue[tuple[str, Any] | None] = queue.Queue()
                messages.put(("flight", outer.flight))
                outer.pages.append(messages)
                self.wfile.write(b"retry: 200\n\n")
                while (one := messages.get()) is not None:
                    self.wfile.write(f"event: {one[0]}\ndata: {json.dumps(one[1])}\n\n".encode())
                    self.wfile.flush()

            def log_message(self, *_: object) -> None:
                pass

        http.server.ThreadingHTTPServer.allow_reuse_address = True
        self.http = http.server.ThreadingHTTPServer(("127.0.0.1", port), Handler)
        self.port = self.http.server_address[1]
        threading.Thread(target=self.http.serve_forever, args=(0.05,), daemon=True).start()

    def send(self, event: str, data: Any) -> None:
        for page in self.pages:
            page.put((event, data))

    def stop(self) -> None:
        for page in self.pages:
            page.put(None)
        self.http.shutdown()
        self.http.server_close()


def sent_until(end_s: int) -> dict[str, Any]:
    """What comes after the sample under way."""
    return {
        "strips": strips(list(range(BEFORE_S, end_s + 1, 10)), strip_row),
        "decisions": [decision(2)],
        "events": [{"time_s": s, "kind": kind, "text": text} for s, kind, text in EVENTS if BEFORE_S <= s <= end_s],
    }


class Live(PageTest):
    def watch(self, flight: dict[str, Any]) -> tuple[Server, Page]:
        server = Server(flight)
        self.addCleanup(server.stop)
        page = self.new_page()
        page.goto(f"http://127.0.0.1:{server.port}/")
        page.wait_for_selector("#page:not([hidden])")
        self.drawn(page)
        return server, page

    def wait_for_step(self, page: Page, step: int) -> None:
        page.locator("#decision-title", has_text=f"Step {step}").wait_for()

    def test_shows_the_newest_moment_and_says_that_it_is_under_way(self) -> None:
        _, page = self.watch(under_way())
        self.assertEqual(page.inner_text("#kind"), "simulation · under way")
        self.assertEqual(self.moment_s(page), 590)
        self.assertEqual(page.inner_text("#decision-title"), "Step 1: goes NE")
        self.assertEqual(page.get_attribute("#follow", "aria-pressed"), "true")

    def test_appends_what_is_new_and_follows_it(self) -> None:
        server, page = self.watch(under_way())
        server.send("news", sent_until(800))
        self.wait_for_step(page, 2)
        self.assertEqual(self.moment_s(page), 800)
        self.assertEqual(page.inner_text("#event-count"), "7 of 7 events")
        self.assertIn("rule 12 fired", page.inner_text("#events"))
        self.assertEqual(page.inner_text("#values [data-strip=battery]"), "battery 82.0 %")

    def test_stays_where_the_reader_looks_until_told_to_follow(self) -> None:
        server, page = self.watch(under_way())
        self.move(page, 100)
        self.assertEqual(page.get_attribute("#follow", "aria-pressed"), "false")
        server.send("news", sent_until(800))
        page.locator("#event-count", has_text="7 of 7").wait_for()
        self.drawn(page)
        self.assertEqual(self.moment_s(page), 100)
        self.assertTrue(page.inner_text("#moment").endswith("of 0:13:20"))
        page.click("#follow")
        self.wait_for_step(page, 2)
        self.assertEqual(self.moment_s(page), 800)

    def test_draws_the_same_strips_of_news_as_of_the_whole(self) -> None:
        end_s = 30_000  # three thousand rows are thinned where they are drawn
        whole = under_way() | {
            "strips": strips(list(range(0, end_s + 1, 10)), self.busy_row),
            "decisions": [decision(0)],
        }
        _, at_once = self.watch(whole)
        begin = whole | {"strips": {name: column[:1500] for name, column in whole["strips"].items()}}
        server, page = self.watch(begin)
        for first in (1500, 1501, 2000):
            last = {1500: 1501, 1501: 2000, 2000: 3001}[first]
            server.send("news", {"strips": {name: column[first:last] for name, column in whole["strips"].items()}})
        page.locator("#moment", has_text="of 8:20:00").wait_for()
        self.drawn(page)
        picture = "[...document.querySelectorAll('#strips canvas')].map((canvas) => canvas.toDataURL())"
        self.assertEqual(page.evaluate(picture), at_once.evaluate(picture))

    def busy_row(self, time_s: int) -> dict[str, Any]:
        return strip_row(min(time_s, 1200)) | {"snr_db": float((7 * time_s) % 23), "snr_too_faint": False}

    def test_finds_the_area_once_the_mission_is_known(self) -> None:
        mission = under_way()["mission"]
        server, page = self.watch(under_way() | {"mission": None, "decisions": []})
        server.send("news", {"mission": mission, "decisions": [decision(0)]})
        self.wait_for_step(page, 0)
        self.drawn(page)
        belief, frame = (page.locator(part).bounding_box() for part in ("canvas.belief", "#map"))
        assert belief and frame
        self.assertGreaterEqual(belief["x"], frame["x"])
        self.assertLessEqual(belief["x"] + belief["width"], frame["x"] + frame["width"])
        self.assertGreater(belief["height"], frame["height"] / 2)

    def test_ends_with_the_flight(self) -> None:
        server, page = self.watch(under_way())
        server.send("news", {"is_over": True, "verdict": {"text": "Source found", "found": True}})
        page.locator("#verdict", has_text="Source found").wait_for()
        page.wait_for_selector("#follow", state="hidden")
        self.assertEqual(page.inner_text("#kind"), "simulation")

    def test_takes_a_flight_that_is_sent_again_for_what_was_there(self) -> None:
        server, page = self.watch(under_way())
        server.send("flight", under_way(decisions=3))
        self.wait_for_step(page, 2)
        self.assertEqual(page.inner_text("#event-count"), "7 of 7 events")
        self.assertEqual(page.locator(".strip canvas").count(), 7)
        server.send("flight", under_way(decisions=1) | {"name": "another"})
        self.wait_for_step(page, 0)
        self.assertEqual(page.title(), "Earshot: another")
        self.assertEqual(self.moment_s(page), 290)

    def test_tells_of_a_lost_connection_and_goes_on_when_it_is_back(self) -> None:
        server, page = self.watch(under_way())
        server.stop()
        page.wait_for_selector("#connection:not([hidden])")
        self.assertRegex(page.inner_text("#connection"), "No connection to earshot watch since .*, for 0:00:0")
        self.assertEqual(page.inner_text("#decision-title"), "Step 1: goes NE")
        again = Server(small() | {"is_over": False}, server.port)
        self.addCleanup(again.stop)
        self.wait_for_step(page, 3)
        page.wait_for_selector("#connection", state="hidden")
        self.assertEqual(page.inner_text("#event-count"), f"{len(EVENTS)} of {len(EVENTS)} events")
        self.errors = [error for error in self.errors if "ERR_" not in error]  # the browser's own words about it
