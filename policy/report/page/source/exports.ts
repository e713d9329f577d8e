// Track and decisions as files for other programs. Kinds, names and properties are those of `earshot journal --geojson`, which has fences
// and bearings too.

import {utc} from "./dom";
import type {Flight, Place, Strips} from "./flight";
import {geographic, lastBefore} from "./flight_data";

const XML = `<?xml version="1.0" encoding="UTF-8"?>\n`;
const escaped = (words: string) => words.replace(/[<>&"]/g, (letter) => `&#${letter.charCodeAt(0)};`);

type Writer = (flight: Flight) => string;
type Properties = Record<string, unknown>;

interface Mark {
  kind: string;
  name: string;
  words: string;
  point: Point;
  properties: Properties;
}
interface Point {
  latitude: string;
  longitude: string;
  altitude: string|null;
  time: string|null;
  mission_s: number|null;
}

const iso = (flight: Flight, time_s: number) => flight.began_utc && new Date(Date.parse(flight.began_utc) + 1000 * time_s).toISOString();

function pointOf(flight: Flight, place: Place, time_s: number|null = null): Point {
  const [latitude, longitude] = geographic(flight.mission!.origin!, place);
  const depth_m = time_s === null ? null : flight.strips.depth_m[lastBefore(flight.strips.time_s, time_s)];
  return {
    latitude: latitude.toFixed(7),
    longitude: longitude.toFixed(7),
    altitude: depth_m == null ? null : (0 - depth_m).toFixed(3),
    time: time_s === null ? null : iso(flight, time_s),
    mission_s: time_s
  };
}

function trackOf(flight: Flight): Point[] {
  const {north_m, east_m, time_s} = flight.strips;
  return time_s.flatMap(
      (time, row) =>
          north_m[row] == null || east_m[row] == null ? [] : [pointOf(flight, {north_m: north_m[row]!, east_m: east_m[row]!}, time)]);
}

function marksOf(flight: Flight): Mark[] {
  const marks: Mark[] = [];
  for (const {step, time_s, at, snr_db, too_faint, detected, waypoint, declared, reasons, direction} of flight.decisions) {
    const direction_deg = (Math.atan2(waypoint.east_m - at.east_m, waypoint.north_m - at.north_m) * 180 / Math.PI + 360) % 360;
    const utc = iso(flight, time_s);
    const properties = {mission_s: time_s, ...(utc && {utc}), step, snr_db, too_faint, detected, direction, direction_deg};
    marks.push({kind: "decision", name: `step ${step}`, words: reasons.join(" "), point: pointOf(flight, at, time_s), properties});
    if (declared)
      marks.push({
        kind: "declared_place",
        name: `source, declared at step ${step}`,
        words: "",
        point: pointOf(flight, declared),
        properties: {step}
      });
  }
  return marks;
}

const geojson: Writer = (flight) => {
  const at = (p: Point) => [p.longitude, p.latitude, p.altitude].filter((part) => part !== null).map(Number);
  const feature = (type: string, coordinates: unknown, properties: Properties) =>
      ({type: "Feature", geometry: {type, coordinates}, properties});
  const track = trackOf(flight);
  const times = flight.began_utc ? {times: track.map((p) => p.time)} : {mission_s: track.map((p) => p.mission_s)};
  const features = [
    ...marksOf(flight).map(
        ({kind, name, words, point, properties}) => feature("Point", at(point), {kind, name, ...(words && {words}), ...properties})),
    ...(track.length > 1 ? [feature("LineString", track.map(at), {kind: "track", ...times})] : []),
  ];
  return JSON.stringify({type: "FeatureCollection", generator: "Earshot", features}, null, 1);
};

const tag = (name: string, content: string|null, attributes = "") =>
    (content === null ? "" : `<${name}${attributes}>${content}</${name}>\n`);
const text = (name: string, content: string) => tag(name, content ? escaped(content) : null);

const gpx: Writer = (flight) => {
  const point = (name: string, p: Point, more = "") =>
      tag(name, tag("ele", p.altitude) + tag("time", p.time) + more, ` lat="${p.latitude}" lon="${p.longitude}"`);
  const marks = marksOf(flight).map(
      ({kind, name, words, point: p}) => point("wpt", p, text("name", name) + text("desc", words) + text("type", kind)));
  const track = tag("trk", tag("name", "track") + tag("trkseg", trackOf(flight).map((p) => point("trkpt", p)).join("")));
  return XML + tag("gpx", marks.join("") + track, ` version="1.1" creator="Earshot" xmlns="http://www.topografix.com/GPX/1/1"`);
};

const kml: Writer = (flight) => {
  const at = (p: Point, between = ",") => [p.longitude, p.latitude, p.altitude].filter((part) => part !== null).join(between);
  const mark = (name: string, more: string) => tag("Placemark", text("name", name) + more);
  const track = trackOf(flight);
  const line = tag("tessellate", "1") + tag("coordinates", track.map((p) => at(p)).join("\n"));
  const inTime = track.map((p) => tag("when", p.time)).join("") + track.map((p) => tag("gx:coord", at(p, " "))).join("");
  const parts = [
    tag("name", flight.began_utc ? `Earshot, ${utc(flight.began_utc, 0)}` : "Earshot"),
    ...marksOf(flight).map(
        ({name, words, point: p}) => mark(
            name, text("description", words) + tag("TimeStamp", p.time && tag("when", p.time)) + tag("Point", tag("coordinates", at(p))))),
    mark("track", flight.began_utc ? tag("gx:Track", inTime) : tag("LineString", line))
  ];
  return XML +
      tag("kml", tag("Document", parts.join("")), ` xmlns="http://www.opengis.net/kml/2.2" xmlns:gx="http://www.google.com/kml/ext/2.2"`);
};

const csv: Writer = (flight) => {
  const names = Object.keys(flight.strips) as (keyof Strips)[];
  const rows = flight.strips.time_s.map((_, row) => names.map((name) => flight.strips[name][row] ?? "").join(","));
  return `${[names.join(","), ...rows].join("\n")}\n`;
};

interface Export {
  suffix: string;
  type: string;
  write: Writer;
  needsOrigin: boolean;
}

export const EXPORTS: Record<string, Export> = {
  GeoJSON: {suffix: "geojson", type: "application/geo+json", write: geojson, needsOrigin: true},
  GPX: {suffix: "gpx", type: "application/gpx+xml", write: gpx, needsOrigin: true},
  KML: {suffix: "kml", type: "application/vnd.google-earth.kml+xml", write: kml, needsOrigin: true},
  CSV: {suffix: "csv", type: "text/csv", write: csv, needsOrigin: false},
};

/** Hands a file to the reader. */
export function save(name: string, content: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
