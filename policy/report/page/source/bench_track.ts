// Where the vehicle of a case went, on a map of its own.

import * as L from "leaflet/leaflet.esm.js";
import type {Bounds, LatLng} from "leaflet/leaflet.esm.js";

import {type Case, firstFiring} from "./bench";
import {element, kilometres, replace} from "./dom";

// Of the way in what is seen of the plane.
const SMALLEST_SHARE = 0.25;

const at = ([, north_m, east_m]: Case["track"][number]): LatLng => [north_m, east_m];

/** Where the vehicle was then, on a straight line between two points of the track; at its ends, these. */
function placeAt(track: Case["track"], time_s: number): LatLng {
  const next = track.findIndex(([time]) => time > time_s);
  const after = track[next] ?? track[track.length - 1]!;
  const before = track[next - 1];
  if (!before) return at(after);
  const share = (time_s - before[0]) / (after[0] - before[0]);
  return [before[1] + share * (after[1] - before[1]), before[2] + share * (after[2] - before[2])];
}

/** The track cut where faults begin and end to act; each piece says whether one acts on it. */
function pieces({track, faults}: Case): {acts: boolean; places: LatLng[]}[] {
  if (track.length === 0) return [];
  const [first, last] = [track[0]![0], track[track.length - 1]![0]];
  const edges = faults.flatMap((fault) => [fault.from_s, fault.until_s ?? last]).filter((time) => first < time && time < last);
  const cuts = [first, ...[...new Set(edges)].sort((a, b) => a - b), last];
  const found: {acts: boolean; places: LatLng[]}[] = [];
  cuts.slice(1).forEach((end, i) => {
    const begin = cuts[i]!;
    const middle = (begin + end) / 2;
    const acts = faults.some((fault) => fault.from_s <= middle && middle < (fault.until_s ?? Infinity));
    const places = [placeAt(track, begin), ...track.filter(([time]) => begin < time && time < end).map(at), placeAt(track, end)];
    const before = found[found.length - 1];
    if (before?.acts === acts)
      before.places.push(...places.slice(1));
    else
      found.push({acts, places});
  });
  return found;
}

function boundsOf(places: LatLng[]): Bounds {
  const [norths, easts] = [places.map(([north]) => north), places.map(([, east]) => east)];
  return [[Math.min(...norths), Math.min(...easts)], [Math.max(...norths), Math.max(...easts)]];
}

const extent = ([[south, west], [north, east]]: Bounds) => Math.max(north - south, east - west);

/** Of the way and the source; of the way alone where that would be too small to see beside the source. */
function surroundings({start_m, source_m, track}: Case): Bounds {
  const way = boundsOf([start_m, ...track.map(at)]);
  const seen = boundsOf([start_m, source_m, ...track.map(at)]);
  return extent(way) >= SMALLEST_SHARE * extent(seen) ? seen : way;
}

/** @param parent  on the screen, so that it has a width */
export function drawTrack(parent: HTMLElement, one: Case): void {
  const place = element("div", {class: "bench-map", role: "application", tabindex: 0, "aria-label": `Where the vehicle went: ${one.name}`});
  const pointed = element("span");
  const legend: HTMLElement[] = [];
  const show = (words: string, bounds: () => Bounds) =>
      element("button", {type: "button", onclick: () => map.fitBounds(bounds(), {padding: [24, 24]})}, words);
  const whole = () => boundsOf([...one.halt_polygon_m, one.start_m, one.source_m, ...one.track.map(at)]);
  const buttons = element(
      "p", {class: "soft"}, show("The vehicle's way", () => surroundings(one)), " ", show("The whole halt polygon", whole), " ", pointed);
  replace(parent, place, element("p", {class: "switches"}), buttons);
  const still = {zoomAnimation: false, scrollWheelZoom: false, attributionControl: false};  // the wheel scrolls the page
  const map = L.map(place, {crs: L.CRS.Simple, zoomSnap: 0, minZoom: -12, maxZoom: 1, ...still});
  map.fitBounds(surroundings(one), {padding: [24, 24]});
  map.on("mousemove", ({latlng}) => replace(pointed, kilometres({north_m: latlng.lat, east_m: latlng.lng})));
  L.control.scale({imperial: false, maxWidth: 120}).addTo(map);
  const line = (className: string, words: string) => legend.push(element("span", {class: `key ${className}`}, words));
  const mark = (sign: string, words: string, there: LatLng) => {
    L.marker(there, {icon: L.divIcon({html: sign, className: "bench-mark", iconSize: [20, 20]}), title: words, keyboard: false}).addTo(map);
    legend.push(element("span", {}, `${sign} ${words}`));
  };
  L.polygon(one.halt_polygon_m, {className: "halt", fill: false, interactive: false}).addTo(map);
  const ways = pieces(one);
  for (const {acts, places} of ways) L.polyline(places, {className: acts ? "fault" : "way", interactive: false}).addTo(map);
  mark("★", "source", one.source_m);
  mark("○", "start", one.start_m);
  const fired = firstFiring(one);
  if (ways.length > 0 && fired) mark("△", `first rule fires (${fired.rule})`, placeAt(one.track, fired.time_s));
  if (ways.length > 0) mark("□", "end", placeAt(one.track, Infinity));
  if (ways.some(({acts}) => !acts)) line("way", "way of the vehicle");
  if (ways.some(({acts}) => acts)) line("fault", "way while a fault acts");
  line("halt", "halt polygon");
  replace(parent.querySelector<HTMLElement>(".switches")!, ...legend);
}
