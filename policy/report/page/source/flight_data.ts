// Questions to a flight, and what comes to one under way.

import type {Belief, Decision, Flight, FlightNews, Place, Strips} from "./flight";

/** Appends rows of strips, decisions and events; everything else replaces what was there. */
export function merge(flight: Flight, news: FlightNews): void {
  const {strips, decisions, events, ...replaced} = news;
  Object.assign(flight, replaced);
  if (decisions) flight.decisions.push(...decisions);
  if (events) flight.events.push(...events);
  if (!strips) return;
  for (const name of Object.keys(strips) as (keyof Strips)[]) (flight.strips[name] as unknown[]).push(...(strips[name] as unknown[]));
}

/** Index of the last element whose time is not after this one; -1: none. */
export function lastBefore(times: readonly number[], time_s: number): number {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= time_s)
      low = middle + 1;
    else
      high = middle;
  }
  return low - 1;
}

export function end_s(flight: Flight): number {
  const last = (times: readonly number[]) => times[times.length - 1] ?? 0;
  return Math.max(last(flight.strips.time_s), last(flight.decisions.map((d) => d.time_s)), last(flight.events.map((e) => e.time_s)));
}

/** The decision that the vehicle follows at a time. */
export function decisionAt(flight: Flight, time_s: number): Decision|null {
  const index = lastBefore(flight.decisions.map((decision) => decision.time_s), time_s);
  return flight.decisions[index] ?? null;
}

/** Where the vehicle was; null: not known then. */
export function placeAt(flight: Flight, time_s: number): Place|null {
  const row = lastBefore(flight.strips.time_s, time_s);
  const north_m = flight.strips.north_m[row];
  const east_m = flight.strips.east_m[row];
  return north_m == null || east_m == null ? null : {north_m, east_m};
}

export function bytesOf(base64: string): Uint8Array {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
}

/** Bytes for each cell of a belief, decoded once. */
const decoded = new WeakMap<Belief, Uint8Array>();
export function areaOfCell(belief: Belief): Uint8Array {
  const known = decoded.get(belief);
  if (known) return known;
  const bytes = bytesOf(belief.area_of_cell);
  decoded.set(belief, bytes);
  return bytes;
}

/** Share of the smallest area that holds this place and all likelier ones, 0 to 1; null: outside the grid. */
export function areaAt(belief: Belief, place: Place): number|null {
  const row = Math.floor(((place.north_m - belief.south_west.north_m) / belief.size.north_m) * belief.cells_north);
  const column = Math.floor(((place.east_m - belief.south_west.east_m) / belief.size.east_m) * belief.cells_east);
  if (row < 0 || row >= belief.cells_north || column < 0 || column >= belief.cells_east) return null;
  return areaOfCell(belief)[row * belief.cells_east + column]! / 255;
}

/**
 * Latitude and longitude of a place in the plane about an origin: mid-latitude sailing on WGS-84.
 * Source: Torge, Geodesy, 3rd ed., Eqs. 4.19 and 4.20 (radii); n2k::LocalPlane is the same in C++.
 */
export function geographic(origin: {latitude_deg: number; longitude_deg: number}, place: Place): [number, number] {
  const semiMajor_m = 6378137;
  const eccentricity2 = 0.00669437999014;
  const radians = Math.PI / 180;
  let latitude_deg = origin.latitude_deg;
  let prime_m = semiMajor_m;
  let middle = 0;
  for (let i = 0; i < 4; ++i) {
    middle = ((latitude_deg + origin.latitude_deg) / 2) * radians;
    const w = 1 - eccentricity2 * Math.sin(middle) ** 2;
    prime_m = semiMajor_m / Math.sqrt(w);
    const meridian_m = (semiMajor_m * (1 - eccentricity2)) / w ** 1.5;
    latitude_deg = origin.latitude_deg + place.north_m / meridian_m / radians;
  }
  return [latitude_deg, origin.longitude_deg + place.east_m / (prime_m * Math.cos(middle)) / radians];
}
