"""GeoJSON, GPX and KML of earshot journal, read by others: Python's parsers, gpxpy, fastkml and its schemas of KML.

usage: maps_test.py EARSHOT_JOURNAL WRITE_MAP_JOURNAL
"""

import json
import subprocess
import sys
import tempfile
import unittest
from datetime import UTC, datetime, timedelta
from math import cos, hypot, radians, sin
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import fastkml
import gpxpy
from geographiclib.geodesic import Geodesic
from lxml import etree

PROGRAM, WRITER = sys.argv[1:3]
BEGAN_S = 1_795_359_840  # 2026-11-22 15:04:00 UTC
BEGAN = datetime(2026, 11, 22, 15, 4, tzinfo=UTC)
ORIGIN = (38.5, -20.1)
PLANE_ERROR_M = 0.1  # 0.08 at the area's far corner, 32 km away
KML = "{http://www.opengis.net/kml/2.2}"
# What write_map_journal.cpp writes, metres north and east.
PLACES = [(1000, 2000), (1003, 2004)]
DEPTHS = [299.5, 300.0]
LIKELIEST = (4003, 6004)
SAFE_POINT = (500, 600)


class Maps(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, kind: str, *, origin: tuple[float, float] = ORIGIN, began_s: int = BEGAN_S) -> str:
        journal, path = self.folder / "a.lcmlog", self.folder / f"flight.{kind}"
        subprocess.run([WRITER, journal, str(began_s)], check=True)
        place = f"--origin={origin[0]},{origin[1]}"
        subprocess.run([PROGRAM, journal, f"--{kind}", path, place, "--quiet", "--force"], check=True)
        return path.read_text()

    def features(self, **options: Any) -> dict[str, list[dict[str, Any]]]:
        """By their kind."""
        collection = json.loads(self.write("geojson", **options))
        self.assertEqual(collection["type"], "FeatureCollection")
        found: dict[str, list[dict[str, Any]]] = {}
        for feature in collection["features"]:
            self.assertEqual(sorted(feature), ["geometry", "properties", "type"])
            found.setdefault(feature["properties"]["kind"], []).append(feature)
        return found

    def assert_at(self, lon_lat: Any, north_east: tuple[float, float], origin: tuple[float, float] = ORIGIN) -> None:
        """By GeographicLib's geodesic to the origin, whose direction half-way is the plane's."""
        longitude, latitude = lon_lat[:2]
        line = Geodesic.WGS84.Inverse(*origin, latitude, longitude)
        half = Geodesic.WGS84.Direct(*origin, line["azi1"], line["s12"] / 2)
        self.assertAlmostEqual(line["s12"], hypot(*north_east), delta=PLANE_ERROR_M)
        self.assertAlmostEqual(line["s12"] * cos(radians(half["azi2"])), north_east[0], delta=PLANE_ERROR_M)
        self.assertAlmostEqual(line["s12"] * sin(radians(half["azi2"])), north_east[1], delta=PLANE_ERROR_M)


class GeoJson(Maps):
    def test_has_each_thing_as_a_feature_of_its_kind(self) -> None:
        counts = {kind: [f["geometry"]["type"] for f in features] for kind, features in self.features().items()}
        area = ["Polygon"]
        expected = {"operating_area": area, "fence_inside": area, "fence_save": area, "fence_halt": area}
        expected |= {"no_surface_zone": area, "safe_point": ["Point"], "decision": ["Point"] * 2}
        expected |= {"declared_place": ["Point"], "bearing": ["LineString"] * 2, "track": ["LineString"]}
        self.assertEqual(counts, expected)

    def test_has_places_where_the_vehicle_was(self) -> None:
        features = self.features()
        (track,) = features["track"]
        coordinates = track["geometry"]["coordinates"]
        self.assertEqual(len(coordinates), 2)  # the late fix is none of them
        for place, north_east, depth in zip(coordinates, PLACES, DEPTHS, strict=True):
            self.assert_at(place, north_east)
            self.assertEqual(place[2], -depth)
        self.assertEqual(track["properties"]["times"], ["2026-11-22T15:04:01.000Z", "2026-11-22T15:04:02.500Z"])
        self.assert_at(features["safe_point"][0]["geometry"]["coordinates"], SAFE_POINT)
        self.assert_at(features["declared_place"][0]["geometry"]["coordinates"], LIKELIEST)

    def test_has_seconds_of_the_mission_where_its_clock_has_no_date(self) -> None:
        features = self.features(began_s=0)
        properties = features["track"][0]["properties"]
        self.assertEqual(properties, {"kind": "track", "mission_s": [1.0, 2.5]})
        self.assertNotIn("utc", features["decision"][0]["properties"])

    def test_has_of_a_decision_what_was_measured_and_believed(self) -> None:
        first, second = self.features()["decision"]
        self.assert_at(first["geometry"]["coordinates"], PLACES[1])
        self.assertEqual(first["geometry"]["coordinates"][2], -300.0)  # of the newest fix
        told = first["properties"]
        expected: dict[str, Any] = {"step": 0, "snr_db": 12.25, "detected": True, "too_faint": False, "mission_s": 2.6}
        expected |= {"utc": "2026-11-22T15:04:02.600Z", "direction_deg": 270.0, "likeliest_distance_m": 5000.0}
        self.assertEqual({key: told[key] for key in expected}, expected)
        self.assert_at((told["waypoint_longitude_deg"], told["waypoint_latitude_deg"]), (1003, 1004))
        self.assert_at((told["likeliest_longitude_deg"], told["likeliest_latitude_deg"]), LIKELIEST)
        self.assertIn("step 0: SNR 12.2 dB, detection", told["words"])
        self.assertEqual((second["properties"]["found"], second["properties"]["too_faint"]), (True, True))

    def test_winds_rings_counterclockwise_and_closes_them(self) -> None:
        features = self.features()
        for kind in ("operating_area", "fence_inside", "fence_save", "fence_halt", "no_surface_zone"):
            (ring,) = features[kind][0]["geometry"]["coordinates"]
            self.assertEqual(ring[0], ring[-1])
            doubled = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:], strict=False))
            self.assertGreater(doubled, 0, kind)
        corners = features["fence_halt"][0]["geometry"]["coordinates"][0][:3]
        for corner, north_east in zip(sorted(corners), [(100, 0), (1200, 0), (1200, 1100)], strict=True):
            self.assert_at(corner, north_east)

    def test_draws_a_bearing_and_its_mirror_to_the_edge_of_the_area(self) -> None:
        # From 1003 m north, 2004 m east: east to 20 km, and about the axis of 45 degrees north to 25 km.
        bearing, mirror = self.features()["bearing"]
        self.assertEqual((bearing["properties"]["mirror"], mirror["properties"]["mirror"]), (False, True))
        self.assert_at(bearing["geometry"]["coordinates"][0], PLACES[1])
        self.assert_at(bearing["geometry"]["coordinates"][1], (1003, 20_000))
        self.assert_at(mirror["geometry"]["coordinates"][1], (25_000, 2004))

    def test_cuts_at_the_meridian_of_180_degrees(self) -> None:
        # 1000 m east of 0 N are 0.0089832 degrees: all lies beyond the meridian that lies 2002 m east of the origin.
        origin = (0.0, 180.0 - 2002 / 111_319.49)
        features = self.features(origin=origin)
        (track,) = features["track"]
        self.assertEqual(track["geometry"]["type"], "MultiLineString")
        west, east = track["geometry"]["coordinates"]
        self.assertEqual((west[1][0], east[0][0]), (180.0, -180.0))
        self.assertAlmostEqual(west[1][1], 1001.5 / 110_574.27, places=6)  # half-way
        self.assertEqual([len(times) for times in track["properties"]["times"]], [2, 2])
        self.assertEqual(track["properties"]["times"][0][1][:22], "2026-11-22T15:04:01.75")
        (area,) = features["operating_area"]
        self.assertEqual(area["geometry"]["type"], "MultiPolygon")
        longitudes = [[corner[0] for corner in ring] for (ring,) in area["geometry"]["coordinates"]]
        self.assertEqual((max(longitudes[0]), min(longitudes[1])), (180.0, -180.0))
        self.assertGreater(min(longitudes[0]), 179.9)
        self.assertLess(max(longitudes[1]), -179.8)


class Gpx(Maps):
    def test_is_read_by_gpxpy(self) -> None:
        gpx = gpxpy.parse(self.write("gpx"))
        self.assertEqual(gpx.version, "1.1")
        points = gpx.tracks[0].segments[0].points
        for point, north_east, depth in zip(points, PLACES, DEPTHS, strict=True):
            self.assert_at((point.longitude, point.latitude), north_east)
            self.assertEqual(point.elevation, -depth)
        self.assertEqual([p.time - BEGAN for p in points], [timedelta(seconds=1), timedelta(seconds=2.5)])
        names = [(w.name, w.type) for w in gpx.waypoints]
        self.assertEqual(names[0], ("safe point", "safe_point"))
        self.assertEqual(names[1:3], [("step 0", "decision"), ("step 1", "decision")])
        self.assertEqual(names[3], ("source, declared at step 1", "declared_place"))
        self.assert_at((gpx.waypoints[3].longitude, gpx.waypoints[3].latitude), LIKELIEST)
        self.assertEqual(gpx.waypoints[1].time - BEGAN, timedelta(seconds=2.6))
        self.assertIn("step 0: SNR 12.2 dB, detection", gpx.waypoints[1].description)

    def test_has_its_elements_in_the_order_of_the_schema(self) -> None:
        # GPX 1.1: gpx = metadata?, wpt*, rte*, trk*; wptType = ele?, time?, ..., name?, cmt?, desc?, ..., type?
        root = ElementTree.fromstring(self.write("gpx"))
        self.assertEqual(root.tag, "{http://www.topografix.com/GPX/1/1}gpx")
        names = [child.tag.partition("}")[2] for child in root]
        self.assertEqual(names, ["wpt"] * 4 + ["trk"])
        order = ["ele", "time", "name", "desc", "type"]
        for place in [*root.findall("{*}wpt"), *root.iter("{http://www.topografix.com/GPX/1/1}trkpt")]:
            told = [child.tag.partition("}")[2] for child in place]
            self.assertEqual(told, [name for name in order if name in told])
            self.assertEqual(sorted(place.attrib), ["lat", "lon"])

    def test_has_no_times_where_the_clock_has_no_date(self) -> None:
        self.assertNotIn("<time>", self.write("gpx", began_s=0))

    def test_has_longitudes_below_180_degrees(self) -> None:
        # The way-points of GPX lie in [-180, 180): 2004 m east of this origin are 2 mm west of 180 degrees.
        gpx = gpxpy.parse(self.write("gpx", origin=(0.0, 180.0 - 2004.002 / 111_319.4908)))
        self.assertEqual(gpx.waypoints[1].longitude, -180.0)


class Kml(Maps):
    def places(self, element: Any) -> list[list[float]]:
        return [[float(n) for n in place.split(",")] for place in element.text.split()]

    def test_is_valid(self) -> None:
        folder = Path(fastkml.__file__).parent / "schema"
        schema = etree.XMLSchema(etree.parse(folder / "kml22gx.xsd"))
        for began_s, origin in ((BEGAN_S, ORIGIN), (0, ORIGIN), (0, (0.0, 179.99))):
            self.write("kml", began_s=began_s, origin=origin)
            schema.assertValid(etree.parse(self.folder / "flight.kml"))

    def test_is_read_by_fastkml(self) -> None:
        self.write("kml")
        document = fastkml.KML.parse(self.folder / "flight.kml").features[0]
        self.assertEqual(document.name, "Earshot, 2026-11-22 15:04:00 UTC")
        names = [placemark.name for placemark in document.features]
        areas = ["operating area", "fence inside", "fence save", "fence halt", "no surface zone"]
        points = ["safe point", "step 0", "step 1", "source, declared at step 1"]
        self.assertEqual(names, [*areas, *points, "bearing at step 0", "bearing at step 0, its mirror", "track"])
        step = document.features[6]
        self.assert_at(step.geometry.coords[0], PLACES[1])
        self.assertIn("step 0: SNR 12.2 dB, detection", step.description)
        self.assertEqual(step.times.timestamp.dt - BEGAN, timedelta(seconds=2.6))
        for corner, north_east in zip(
            document.features[0].geometry.exterior.coords[:3], [(0, 0), (0, 20_000), (25_000, 20_000)], strict=True
        ):
            self.assert_at(corner, north_east)

    def test_has_the_track_in_time(self) -> None:
        root = ElementTree.fromstring(self.write("kml"))
        gx = "{http://www.google.com/kml/ext/2.2}"
        (track,) = root.iter(f"{gx}Track")
        self.assertEqual(
            [w.text for w in track.findall(f"{KML}when")], ["2026-11-22T15:04:01.000Z", "2026-11-22T15:04:02.500Z"]
        )
        for coordinate, north_east, depth in zip(track.findall(f"{gx}coord"), PLACES, DEPTHS, strict=True):
            place = [float(n) for n in str(coordinate.text).split()]
            self.assert_at(place, north_east)
            self.assertEqual(place[2], -depth)

    def test_has_the_track_as_a_line_where_the_clock_has_no_date(self) -> None:
        root = ElementTree.fromstring(self.write("kml", began_s=0))
        self.assertEqual(list(root.iter(f"{KML}when")), [])
        *_, line = root.iter(f"{KML}LineString")
        places = self.places(line.find(f"{KML}coordinates"))
        for place, north_east in zip(places, PLACES, strict=True):
            self.assert_at(place, north_east)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
