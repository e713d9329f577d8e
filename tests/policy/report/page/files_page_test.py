"""The files that a page of a flight is, and those that it saves."""

import csv
import io
import json
import os
from xml.etree import ElementTree

from page_rig import PAGE, PageTest
from playwright.sync_api import Page
from sample_flight import NASTY_NAME, at_sea, big, page_with, small

# The sample's track has 121 places, due north from 2 km north and 1.5 km east of 45 N, 30 W, and four decisions.
TRACK, DECISIONS = 121, 4
# A degree of latitude at 45 degrees, and one of longitude (WGS-84, printed tables).
LATITUDE_M, LONGITUDE_M = 111_132.0, 78_847.0


class Files(PageTest):
    def save(self, page: Page, name: str) -> tuple[str, str]:
        with page.expect_download() as waiting:
            page.click(f"#exports button:text-is('{name}')")
        file = waiting.value.path()
        return waiting.value.suggested_filename, file.read_text() if name != "PNG of the map" else file.read_bytes().hex()

    def assert_begins_right(self, longitude: float, latitude: float) -> None:
        self.assertAlmostEqual(latitude, 45.0 + 2000.0 / LATITUDE_M, delta=2.0 / LATITUDE_M)  # of the tables' digits
        self.assertAlmostEqual(longitude, -30.0 + 1500.0 / LONGITUDE_M, delta=2.0 / LONGITUDE_M)

    def test_saves_geojson(self) -> None:
        name, text = self.save(self.open(small()), "GeoJSON")
        self.assertRegex(name, r"^[\w.-]+\.geojson$")
        features = json.loads(text)["features"]
        tracks = [f for f in features if f["properties"]["kind"] == "track"]
        decisions = [f for f in features if f["properties"]["kind"] == "decision"]
        self.assertEqual([(t["geometry"]["type"], len(t["geometry"]["coordinates"])) for t in tracks], [("LineString", TRACK)])
        longitude, latitude, altitude_m = tracks[0]["geometry"]["coordinates"][0]
        self.assert_begins_right(longitude, latitude)
        self.assertEqual(altitude_m, -100.0)
        self.assertEqual(tracks[0]["properties"]["times"][-1], "2026-11-22T15:24:00.000Z")
        self.assertEqual([d["properties"]["name"] for d in decisions], ["step 0", "step 1", "step 2", "step 3"])
        # Names are those of `earshot journal --geojson` (tests/firmware/desk/journal_view/export/maps/maps_test.py).
        third = {"step": 2, "snr_db": 12.25, "detected": True, "too_faint": False, "mission_s": 600, "direction_deg": 0}
        self.assertEqual({name: decisions[2]["properties"][name] for name in third}, third)
        self.assertEqual(decisions[2]["properties"]["utc"], "2026-11-22T15:14:00.000Z")
        self.assertIn("Reason 2", decisions[2]["properties"]["words"])
        declared = [f["properties"] for f in features if f["properties"]["kind"] == "declared_place"]
        self.assertEqual(declared, [{"kind": "declared_place", "name": "source, declared at step 3", "step": 3}])

    def test_counts_seconds_where_the_flight_has_no_date(self) -> None:
        page = self.open(small() | {"began_utc": None})
        features = json.loads(self.save(page, "GeoJSON")[1])["features"]
        self.assertEqual(features[-1]["properties"]["mission_s"][-2:], [1190, 1200])
        self.assertNotIn("utc", features[0]["properties"])
        space = "{http://www.opengis.net/kml/2.2}"
        line = ElementTree.fromstring(self.save(page, "KML")[1]).find(f".//{space}LineString/{space}coordinates")
        self.assertEqual(len((line.text or "").split()) if line is not None else 0, TRACK)
        gpx = self.save(page, "GPX")[1]
        self.assertNotIn("<time>", gpx)

    def test_saves_gpx(self) -> None:
        _, text = self.save(self.open(small()), "GPX")
        space = "{http://www.topografix.com/GPX/1/1}"
        root = ElementTree.fromstring(text)
        self.assertEqual(root.tag, f"{space}gpx")
        waypoints, track = root.findall(f"{space}wpt"), root.findall(f".//{space}trkpt")
        self.assertEqual((len(waypoints), len(track)), (DECISIONS + 1, TRACK))  # and the place declared
        self.assert_begins_right(float(track[0].get("lon", "")), float(track[0].get("lat", "")))
        self.assertEqual(track[1].findtext(f"{space}time"), "2026-11-22T15:04:10.000Z")
        self.assertEqual(track[0].findtext(f"{space}ele"), "-100.000")

    def test_saves_kml(self) -> None:
        _, text = self.save(self.open(small()), "KML")
        space = "{http://www.opengis.net/kml/2.2}"
        root = ElementTree.fromstring(text)
        self.assertEqual(len(root.findall(f".//{space}Point")), DECISIONS + 1)
        track = [mark for mark in root.iter(f"{space}Placemark") if mark.findtext(f"{space}name") == "track"]
        google = "{http://www.google.com/kml/ext/2.2}"
        places = track[0].findall(f"{google}Track/{google}coord")
        self.assertEqual((len(places), len(track[0].findall(f"{google}Track/{space}when"))), (TRACK, TRACK))
        self.assert_begins_right(*(float(number) for number in (places[0].text or "").split()[:2]))

    def test_saves_a_table_of_the_strips(self) -> None:
        _, text = self.save(self.open(small()), "CSV")
        rows = list(csv.DictReader(io.StringIO(text)))
        self.assertEqual(len(rows), TRACK)
        self.assertEqual((rows[70]["time_s"], rows[70]["depth_m"], rows[70]["snr_db"]), ("700", "107", "12.25"))

    def test_saves_a_picture_of_the_map(self) -> None:
        page = self.open(small())
        name, content = self.save(page, "PNG of the map")
        self.assertTrue(name.endswith(".png"))
        self.assertTrue(content.startswith(b"\x89PNG\r\n\x1a\n".hex()))
        width, height = int(content[32:40], 16), int(content[40:48], 16)
        frame = page.evaluate("[document.getElementById('map').clientWidth, document.getElementById('map').clientHeight]")
        self.assertEqual([width, height], frame)

    def test_saves_no_latitudes_that_it_does_not_know(self) -> None:
        page = self.open(at_sea())
        for name in ("GeoJSON", "GPX", "KML"):
            self.assertTrue(page.is_disabled(f"#exports button:text-is('{name}')"), name)
        self.assertEqual(len(list(csv.DictReader(io.StringIO(self.save(page, "CSV")[1])))), TRACK)

    def test_prints_at_a_click(self) -> None:
        page = self.open(small())
        page.evaluate("window.printed = 0; window.print = () => { window.printed += 1; }; 0")
        page.click("#exports button:text-is('Print')")
        self.assertEqual(page.evaluate("window.printed"), 1)

    def test_is_light_and_without_controls_on_paper(self) -> None:
        page = self.open(small(), scheme="dark")
        page.emulate_media(media="print", color_scheme="dark")
        self.drawn(page)
        self.assertFalse(page.is_visible("#controls"))
        self.assertFalse(page.is_visible("#exports"))
        self.assertEqual(page.evaluate("getComputedStyle(document.body).backgroundColor"), "rgb(255, 255, 255)")
        self.assertEqual(self.belief_cell(page, 4, 3)[:2], [0, 32])  # dark blue, as on white ground
        self.assertLess(page.locator(".map").bounding_box()["y"], page.locator("section.decision").bounding_box()["y"])

    def test_opens_a_compressed_flight(self) -> None:
        page = self.open(small(), is_compressed=True)
        self.assertEqual(page.inner_text("#decision-title"), "Step 1: goes NE")
        self.assertIn(NASTY_NAME, page.title())

    def test_refuses_a_flight_of_another_format_and_one_that_is_broken(self) -> None:
        file = self.folder / "report.html"
        for flight, words in (
            (small() | {"format": 2}, "This page shows format 1, and what is in it has format 2."),
            (small() | {"strips": None}, "This page cannot be shown: "),
        ):
            file.write_text(page_with(PAGE, flight))
            page = self.new_page()
            page.goto(file.as_uri())
            page.wait_for_selector("#connection:not([hidden])")
            self.assertIn(words, page.inner_text("#connection"))

    def test_is_a_file_that_mail_takes(self) -> None:
        self.assertLess(len(page_with(PAGE, big(), is_compressed=True)), 5_000_000)
        self.assertLess(os.path.getsize(os.environ["FLIGHT_PAGE"]), 500_000)
