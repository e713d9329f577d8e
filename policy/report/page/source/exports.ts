// The flight as files for other programs.

import {utc} from "./dom";
import type {Flight, Place, Strips} from "./flight";
import {geographic} from "./flight_data";

type Writer = (flight: Flight) => string;
const round = (value: number) => Math.round(value * 1e7) / 1e7;
const escaped = (text: string) => text.replace(/[<>&"]/g, (letter) => `&#${letter.charCodeAt(0)};`);

interface Point {
  latitude: number;
  longitude: number;
  depth_m: number;
  time: string|null;
}

function pointOf(flight: Flight, place: Place, time_s: number, depth_m: number): Point {
  const [latitude, longitude] = geographic(flight.mission!.origin!, place);
  const time = flight.began_utc ? utc(flight.began_utc, time_s).replace(" ", "T").replace(" UTC", "Z") : null;
  return {latitude: round(latitude), longitude: round(longitude), depth_m, time};
}

function trackOf(flight: Flight): Point[] {
  const {strips} = flight;
  return strips.time_s.flatMap((time_s, row) => {
    const [north_m, east_m] = [strips.north_m[row], strips.east_m[row]];
    return north_m == null || east_m == null ? [] : [pointOf(flight, {north_m, east_m}, time_s, strips.depth_m[row] ?? 0)];
  });
}

const decisionsOf = (flight: Flight) =>
    flight.decisions.map((decision) => ({decision, point: pointOf(flight, decision.at, decision.time_s, flight.mission!.search_depth_m)}));

const geojson: Writer = (flight) => {
  const track = trackOf(flight);
  const at = (point: Point) => [point.longitude, point.latitude, -point.depth_m];
  const features = [
    {
      type: "Feature",
      properties: {name: flight.name, times: track.map((point) => point.time)},
      geometry: {type: "LineString", coordinates: track.map(at)}
    },
    ...decisionsOf(flight).map(({decision, point}) => ({
                                 type: "Feature",
                                 properties: {
                                   step: decision.step,
                                   time_s: decision.time_s,
                                   snr_db: decision.snr_db,
                                   detected: decision.detected,
                                   direction: decision.direction,
                                   reasons: decision.reasons
                                 },
                                 geometry: {type: "Point", coordinates: at(point)},
                               })),
  ];
  return JSON.stringify({type: "FeatureCollection", features}, null, 1);
};

const gpx: Writer = (flight) => {
  const point = (name: string, p: Point, more = "") => `<${name} lat="${p.latitude}" lon="${p.longitude}"><ele>${- p.depth_m}</ele>${
      p.time ? `<time>${p.time}</time>` : ""}${more}</${name}>`;
  const waypoints = decisionsOf(flight).map(
      ({decision, point: p}) => point("wpt", p, `<name>step ${decision.step}</name><desc>${escaped(decision.reasons.join(" "))}</desc>`));
  return `<?xml version="1.0" encoding="UTF-8"?>\n<gpx version="1.1" creator="Earshot" xmlns="http://www.topografix.com/GPX/1/1">\n${
             waypoints.join("\n")}\n` +
      `<trk><name>${escaped(flight.name)}</name><trkseg>\n${
             trackOf(flight).map((p) => point("trkpt", p)).join("\n")}\n</trkseg></trk>\n</gpx>\n`;
};

const kml: Writer = (flight) => {
  const at = (p: Point) => `${p.longitude},${p.latitude},${- p.depth_m}`;
  const placemark = (name: string, description: string, geometry: string) =>
      `<Placemark><name>${escaped(name)}</name><description>${escaped(description)}</description>${geometry}</Placemark>`;
  const decisions = decisionsOf(flight).map(
      ({decision, point}) =>
          placemark(`step ${decision.step}`, decision.reasons.join(" "), `<Point><coordinates>${at(point)}</coordinates></Point>`));
  const line = `<LineString><coordinates>${trackOf(flight).map(at).join(" ")}</coordinates></LineString>`;
  return `<?xml version="1.0" encoding="UTF-8"?>\n<kml xmlns="http://www.opengis.net/kml/2.2"><Document><name>${
             escaped(flight.name)}</name>\n` +
      `${placemark("track", flight.verdict.text, line)}\n${decisions.join("\n")}\n</Document></kml>\n`;
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
