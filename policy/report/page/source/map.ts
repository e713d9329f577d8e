// The map: where the vehicle was and goes, what it heard, what it believes, and, if asked, what only the simulation knows.

import * as L from "leaflet/leaflet.esm.js";
import type {LatLng, LayerGroup, Map as LeafletMap, Path} from "leaflet/leaflet.esm.js";

import {BeliefPicture, outline} from "./belief_picture";
import type {Clock} from "./clock";
import {colour, onScheme} from "./colours";
import {byId, degrees, element, kilometres, number, percent, position, replace, words} from "./dom";
import type {Bearing, Decision, Flight, Place} from "./flight";
import {areaAt, decisionAt, geographic, lastBefore, placeAt} from "./flight_data";

const MOST_TRACK_POINTS = 3000;
const MANY_DECISIONS = 40;  // from here on their marks are small

/** What may be switched on and off, in the order of the switches. Truth is off until somebody asks for it. */
const SWITCHES = [
  {
    name: "belief",
    label: "belief",
    isOn: true,
    help: "Where the source is believed to be at the moment shown: the stronger the colour, the likelier."
  },
  {
    name: "outlines",
    label: "50 and 90 % areas",
    isOn: true,
    help: "The smallest areas that hold the source with 50 % (thick) and 90 %, by the belief."
  },
  {name: "spread", label: "mean and spread", isOn: false, help: "The mean of the belief and one standard deviation about it."},
  {name: "decisions", label: "decisions", isOn: true, help: "Places where a decision was taken; filled: the source was detected there."},
  {
    name: "bearings",
    label: "bearings",
    isOn: true,
    help: "Bearings of the sound with one standard deviation; dashed: the mirror image that cannot be told apart."
  },
  {
    name: "fences",
    label: "fences",
    isOn: true,
    help: "Operating area, fences, halt polygon, zones without surfacing and the safe point of the mission."
  },
] as const;
type Name = (typeof SWITCHES)[number]["name"]|"truth";

const at = (place: Place): LatLng => [place.north_m, place.east_m];
const ahead = (from: Place, bearing_deg: number, distance_m: number): LatLng => {
  const angle = (bearing_deg * Math.PI) / 180;
  return [from.north_m + distance_m * Math.cos(angle), from.east_m + distance_m * Math.sin(angle)];
};

export class FlightMap {
  private readonly map: LeafletMap;
  private readonly groups: Record<string, LayerGroup> = {};
  private readonly isOn: Record<Name, boolean>;
  private readonly belief = new BeliefPicture();
  private readonly track: Path;
  private readonly future: Path;
  private readonly course: Path;
  private readonly vehicle = element("div", {class: "vehicle"});
  private readonly vehicleMark: Path;
  private shown: Decision|null = null;
  private decisionsDrawn = -1;
  private isFitted = false;

  constructor(private readonly flight: Flight, private readonly clock: Clock) {
    this.isOn = {...Object.fromEntries(SWITCHES.map((one) => [one.name, one.isOn])), truth: false} as Record<Name, boolean>;
    const place = byId("map");
    this.map = L.map(place, {
      crs: L.CRS.Simple,
      preferCanvas: true,
      zoomSnap: 0,
      zoomDelta: 0.5,
      wheelPxPerZoomLevel: 120,
      minZoom: -12,
      maxZoom: 2,
      attributionControl: false,
      zoomControl: false,
      zoomAnimation: false,
      fadeAnimation: false
    });
    L.control.zoom({position: "topright"}).addTo(this.map);
    L.control.scale({imperial: false, maxWidth: 120, position: "bottomright"}).addTo(this.map);
    for (const name of ["grid", "fences", "belief", "spread", "bearings", "decisions", "truth", "now"])
      this.groups[name] = L.layerGroup().addTo(this.map);
    this.future = L.polyline([], {weight: 1, opacity: 0.5, interactive: false}).addTo(this.map);
    this.track = L.polyline([], {weight: 2.5, interactive: false}).addTo(this.map);
    this.course = L.polyline([], {weight: 1.5, dashArray: "4 4", interactive: false}).addTo(this.map);
    this.vehicleMark =
        L.marker([0, 0], {icon: L.divIcon({html: this.vehicle, className: "", iconSize: [24, 24]}), keyboard: false, interactive: false}) as
        unknown as Path;
    this.addSwitches();
    this.map.on("mousemove", (event) => this.tell({north_m: event.latlng.lat, east_m: event.latlng.lng}));
    this.map.on("mouseout", () => replace(byId("map-place")));
    new ResizeObserver(() => this.map.invalidateSize()).observe(place);
    onScheme(() => this.redraw());
    this.redraw();
  }

  /** All of the operating area and its fences, or what there is of a track, with room for the kilometres and the scale. */
  fit(): void {
    const {mission, strips} = this.flight;
    const known = (values: (number|null)[]) => values.filter((value): value is number => value !== null);
    const corners = mission ? [...mission.fence_inside, ...mission.fence_save, ...mission.fence_halt] : [];
    const north = mission ? [mission.area.south_m, mission.area.north_m, ...corners.map((c) => c.north_m)] : known(strips.north_m);
    const east = mission ? [mission.area.west_m, mission.area.east_m, ...corners.map((c) => c.east_m)] : known(strips.east_m);
    this.isFitted = mission !== null;
    if (north.length > 0 && east.length > 0)
      this.map.fitBounds(
          [[Math.min(...north), Math.min(...east)], [Math.max(...north) + 1, Math.max(...east) + 1]],
          {paddingTopLeft: [36, 12], paddingBottomRight: [18, 44]});
  }

  /** After news, or in other colours. */
  redraw(): void {
    if (!this.isFitted) this.fit();
    this.shown = null;
    this.decisionsDrawn = -1;
    this.drawFences();
    this.drawTruth();
    this.update();
  }

  /** What changes with the moment. */
  update(): void {
    this.drawTrack();
    this.drawDecisions();
    const decision = decisionAt(this.flight, this.clock.time_s);
    if (decision !== this.shown) this.drawDecision(decision);
    this.shown = decision;
  }

  /** The map as a picture: everything that stands on canvases. */
  picture(): HTMLCanvasElement {
    const size = this.map.getSize();
    const picture = element("canvas", {width: size.x * devicePixelRatio, height: size.y * devicePixelRatio});
    const context = picture.getContext("2d")!;
    context.scale(devicePixelRatio, devicePixelRatio);
    context.fillStyle = colour("ground");
    context.fillRect(0, 0, size.x, size.y);
    const frame = this.map.getContainer().getBoundingClientRect();
    const canvases = [...this.map.getContainer().querySelectorAll("canvas")].sort(
        (a, b) => Number(a !== this.belief.canvas) - Number(b !== this.belief.canvas));
    for (const canvas of canvases) {
      const box = canvas.getBoundingClientRect();
      context.imageSmoothingEnabled = false;
      context.drawImage(canvas, box.left - frame.left, box.top - frame.top, box.width, box.height);
    }
    const place = placeAt(this.flight, this.clock.time_s);
    if (place) {
      const {x, y} = this.map.latLngToContainerPoint(at(place));
      context.fillStyle = colour("track");
      context.beginPath();
      context.arc(x, y, 6, 0, 2 * Math.PI);
      context.fill();
    }
    return picture;
  }

  private group(name: string): LayerGroup {
    return this.groups[name]!.clearLayers();
  }

  private addSwitches(): void {
    const one = (name: Name, label: string, isOn: boolean, help: string) => element(
        "label", {title: help, class: name === "truth" ? "truth" : null}, element("input", {
          type: "checkbox",
          name,
          checked: isOn,
          onchange: (event) => {
            this.isOn[name] = (event.target as HTMLInputElement).checked;
            this.redraw();
          }
        }),
        ` ${label}`);
    const truth = this.flight.truth ? one("truth", "the source (known to the simulation alone)", false,
                                          "Where the simulator put the source, and how far it can be detected. The vehicle never knew.") :
                                      null;
    replace(byId("map-switches"), ...SWITCHES.map((s) => one(s.name, s.label, s.isOn, s.help)), truth);
  }

  private tell(place: Place): void {
    const decision = decisionAt(this.flight, this.clock.time_s);
    const area = decision?.belief ? areaAt(decision.belief, place) : null;
    const origin = this.flight.mission?.origin;
    replace(byId("map-place"), [
      kilometres(place), origin ? position(geographic(origin, place)) : "", area === null ? "" : `at the edge of the ${percent(area)} area`
    ].filter((text) => text).join(" · "));
  }

  private drawFences(): void {
    const mission = this.flight.mission;
    const grid = this.group("grid");
    const fences = this.group("fences");
    if (!mission) return;
    const {south_m, west_m, north_m, east_m} = mission.area;
    const step_m = [1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5].find((step) => Math.max(north_m - south_m, east_m - west_m) / step <= 8) ?? 2e5;
    const line = (places: LatLng[]) => L.polyline(places, {color: colour("grid"), weight: 1, interactive: false}).addTo(grid);
    const label = (place: LatLng, text: string, side: "north"|"east") =>
        L.marker(place, {
           icon: L.divIcon(
               {html: text, className: `grid-label ${side}`, iconSize: [30, 14], iconAnchor: side === "east" ? [15, -3] : [34, 7]}),
           keyboard: false,
           interactive: false
         }).addTo(grid);
    for (let north = Math.ceil(south_m / step_m) * step_m; north <= north_m; north += step_m) {
      line([[north, west_m], [north, east_m]]);
      label([north, west_m], `${north / 1000}`, "north");
    }
    for (let east = Math.ceil(west_m / step_m) * step_m; east <= east_m; east += step_m) {
      line([[south_m, east], [north_m, east]]);
      label([south_m, east], east === 0 ? "km" : `${east / 1000}`, "east");
    }
    if (!this.isOn.fences) return;
    const fence = (places: Place[], name: string, tint: string, dashArray: string) => {
      if (places.length > 0)
        L.polyline(
             [...places, places[0]!].map(at), {color: colour(tint), weight: 1.5, dashArray})  // a polygon would be named everywhere inside
            .bindTooltip(words(name), {sticky: true})
            .addTo(fences);
    };
    L.rectangle([[south_m, west_m], [north_m, east_m]], {color: colour("ink"), weight: 1.5, fill: false, interactive: false}).addTo(fences);
    fence(mission.fence_inside, "fence: the vehicle stays inside", "fence", "6 3");
    fence(mission.fence_save, "fence: beyond it the vehicle turns back", "fence", "2 4");
    fence(mission.fence_halt, "halt polygon: beyond it the mission is aborted", "halt", "9 3 2 3");
    for (const zone of mission.no_surface_zones) fence(zone, "zone without surfacing", "halt", "1 3");
    if (mission.safe_point)
      L.circleMarker(at(mission.safe_point), {radius: 5, color: colour("fence"), weight: 2}).bindTooltip(words("safe point")).addTo(fences);
  }

  private drawTruth(): void {
    const group = this.group("truth");
    const {truth, mission} = this.flight;
    if (!truth || !this.isOn.truth) return;
    const {range_m, snr_db} = truth.snr_of_range;
    const heard = range_m.filter((_, i) => mission && snr_db[i]! >= mission.detection_threshold_db);
    const style = {color: colour("truth"), weight: 2, fill: false};
    L.circleMarker(at(truth.source), {...style, radius: 8}).bindTooltip(words("source, known to the simulation alone")).addTo(group);
    L.circleMarker(at(truth.source), {...style, radius: 2}).addTo(group);
    if (heard.length > 0)
      L.circle(at(truth.source), {...style, radius: Math.max(...heard), weight: 1, dashArray: "3 5", interactive: false}).addTo(group);
  }

  private drawTrack(): void {
    const {strips} = this.flight;
    const now = lastBefore(strips.time_s, this.clock.time_s);
    const step = Math.max(1, Math.ceil(strips.time_s.length / MOST_TRACK_POINTS));
    const places = (from: number, to: number) => {
      const found: LatLng[] = [];
      for (let i = from; i <= to; i = i < to ? Math.min(i + step, to) : to + 1)
        if (strips.north_m[i] != null && strips.east_m[i] != null) found.push([strips.north_m[i]!, strips.east_m[i]!]);
      return found;
    };
    this.track.setStyle({color: colour("track")}).setLatLngs(places(0, now));
    this.future.setStyle({color: colour("track")}).setLatLngs(places(Math.max(now, 0), strips.time_s.length - 1));
    const place = placeAt(this.flight, this.clock.time_s);
    const waypoint = {north_m: strips.waypoint_north_m[now], east_m: strips.waypoint_east_m[now]};
    if (!place) {
      this.vehicleMark.remove();
      this.course.setLatLngs([]);
      return;
    }
    this.vehicleMark.setLatLng(at(place)).addTo(this.map);
    this.vehicle.style.transform = `rotate(${strips.heading_deg[now] ?? 0}deg)`;
    this.course.setStyle({color: colour("ink")});
    this.course.setLatLngs(waypoint.north_m == null || waypoint.east_m == null ? [] : [at(place), [waypoint.north_m, waypoint.east_m]]);
  }

  /** Those up to the moment; redrawn when there is one more, or fewer. */
  private drawDecisions(): void {
    const {decisions} = this.flight;
    const count = lastBefore(decisions.map((decision) => decision.time_s), this.clock.time_s) + 1;
    if (count === this.decisionsDrawn) return;
    this.decisionsDrawn = count;
    const marks = this.group("decisions");
    const bearings = this.group("bearings");
    const taken = decisions.slice(0, count);
    for (const decision of this.isOn.bearings ? taken : [])
      if (decision.bearing) this.drawBearing(bearings, decision.at, decision.bearing, decision === taken[count - 1]);
    for (const decision of this.isOn.decisions ? taken : []) {  // after the bearings, so that the pointer finds them
      L.circleMarker(at(decision.at), {
         radius: decision === taken[count - 1] ? 6 :
             count < MANY_DECISIONS            ? 4 :
                                                 2.5,
         weight: count < MANY_DECISIONS ? 1.5 : 1,
         color: colour("decision"),
         fillColor: decision.detected ? colour("decision") : colour("ground"),
         fillOpacity: 1
       })
          .bindTooltip(words(`step ${decision.step}: ${decision.too_faint ? "below " : ""}${number(decision.snr_db, 1, "dB")}, went ${
              decision.direction}`))
          .on("click", () => this.clock.set(decision.time_s))
          .addTo(marks);
      if (decision.declared)
        L.circleMarker(at(decision.declared), {radius: 9, weight: 3, color: colour("declared"), fill: false})
            .bindTooltip(words(`declared found at step ${decision.step}`))
            .addTo(marks);
    }
  }

  private drawBearing(group: LayerGroup, from: Place, bearing: Bearing, isNewest: boolean): void {
    const length_m = 2 * (this.flight.mission?.step_length_m ?? 1000) * (isNewest ? 4 : 1);
    const ray = (toward_deg: number, dashArray: string|null) => {
      L.polyline(
           [at(from), ahead(from, toward_deg, length_m)],
           {color: colour("bearing"), weight: isNewest ? 2 : 1, dashArray, opacity: isNewest ? 1 : 0.5})
          .bindTooltip(words(`bearing ${degrees(toward_deg)} ± ${number(bearing.deviation_deg, 0)}°`), {sticky: true})
          .addTo(group);
      if (isNewest)
        L.polygon(
             [
               at(from), ahead(from, toward_deg - bearing.deviation_deg, length_m),
               ahead(from, toward_deg + bearing.deviation_deg, length_m)
             ],
             {stroke: false, fillColor: colour("bearing"), fillOpacity: 0.15, interactive: false})
            .addTo(group);
    };
    ray(bearing.toward_deg, null);
    if (bearing.mirror_deg !== null) ray(bearing.mirror_deg, "4 4");
  }

  private drawDecision(decision: Decision|null): void {
    const group = this.group("belief");
    const spread = this.group("spread");
    const belief = decision?.belief;
    if (!belief) return;
    if (this.isOn.belief) {
      this.belief.draw(belief);
      const {south_west: corner, size} = belief;
      L.svgOverlay(this.belief.canvas, [at(corner), [corner.north_m + size.north_m, corner.east_m + size.east_m]], {
         className: "belief",
         pane: "tilePane",  // under every line and mark
         interactive: false
       }).addTo(group);
    }
    if (this.isOn.outlines)
      for (const [share, weight] of [[0.9, 1], [0.5, 2.5]] as const)
        L.polyline(outline(belief, share), {color: colour("outline"), weight, interactive: false}).addTo(group);
    if (this.isOn.belief || this.isOn.outlines)
      L.circleMarker(
           at(belief.likeliest), {radius: 5, color: colour("likeliest"), weight: 2.5, fillColor: colour("ground"), fillOpacity: 1})
          .bindTooltip(words(`likeliest place, ${percent(belief.likeliest_share, 1)}`))
          .addTo(group);
    if (!this.isOn.spread) return;
    const {semi_major_m, semi_minor_m, bearing_deg} = belief.ellipse;
    const along = (bearing_deg * Math.PI) / 180;
    const ellipse = Array.from({length: 64}, (_, i): LatLng => {
      const a = semi_major_m * Math.cos((i * Math.PI) / 32);
      const b = semi_minor_m * Math.sin((i * Math.PI) / 32);
      return [
        belief.mean.north_m + a * Math.cos(along) - b * Math.sin(along), belief.mean.east_m + a * Math.sin(along) + b * Math.cos(along)
      ];
    });
    L.polygon(ellipse, {color: colour("likeliest"), weight: 1.5, dashArray: "6 4", fill: false, interactive: false}).addTo(spread);
    L.circleMarker(at(belief.mean), {radius: 3, color: colour("likeliest"), weight: 2}).bindTooltip(words("mean place")).addTo(spread);
  }
}
