// The page of an evaluation: worlds by policies, and from each figure to the searches that it is made of.

import * as L from "leaflet/leaflet.esm.js";
import type {LatLng} from "leaflet/leaflet.esm.js";

import {colour, onScheme} from "./colours";
import {byId, counted, element, kilometres, number, percent, replace, table, words} from "./dom";
import type {Result, Search, Suite} from "./suite";

interface Measure {
  name: string;
  help: string;
  value: (result: Result) => number | null;
  interval: (result: Result) => [number | null, number|null];
  text: (value: number|null) => string;
  isBetterHigh: boolean;
}

const MEASURES: Measure[] = [
  {
    name: "found",
    help: "Share of the searches that found the source, with its exact 95 % interval.",
    isBetterHigh: true,
    value: (r) => r.found_fraction,
    interval: (r) => r.found_fraction_95,
    text: (v) => percent(v, 1)
  },
  {
    name: "mean hours to find",
    help: "A search that did not find counts as its limit of steps. Bootstrap interval of 95 %.",
    isBetterHigh: false,
    value: (r) => r.restricted_mean_hours_to_find,
    interval: (r) => r.restricted_mean_hours_to_find_95,
    text: (v) => number(v, 2, "h")
  },
  {
    name: "reward",
    help: "The paper's reward in the mean: 0 for each step that ends with a detection, −1 for each other, less near the edge.",
    isBetterHigh: true,
    value: (r) => r.mean_reward,
    interval: (r) => r.mean_reward_95,
    text: (v) => number(v, 1)
  },
];
const ENDS: Record<Search["end"], string> = {
  running: "under way",
  found: "found",
  left_domain: "left the area",
  time_limit: "ran out of steps"
};
const TINTS = ["heard", "expected", "likeliest", "good", "threshold", "bad", "soft"];  // of the policies on the map

const unique = (values: string[]) => [...new Set(values)];

export class SuitePage {
  private measure = MEASURES[0]!;
  private readonly worlds: string[];
  private readonly policies: string[];
  private chosen: {world: string; policy: string};
  private number = 0;  // of the search that the map shows
  private readonly map =
      L.map(byId("suite-map"), {crs: L.CRS.Simple, preferCanvas: true, zoomSnap: 0, minZoom: -12, attributionControl: false});
  private readonly paths = L.layerGroup().addTo(this.map);

  constructor(private readonly suite: Suite) {
    byId("suite-page").hidden = false;
    document.title = `Earshot: ${suite.title}`;
    this.worlds = unique(suite.figures.results.map((result) => result.world));
    this.policies = unique(suite.figures.results.map((result) => result.policy));
    this.chosen = {world: this.worlds[0] ?? "", policy: this.policies[0] ?? ""};
    const {figures} = suite;
    replace(byId("suite-title"), suite.title);
    replace(
        byId("suite-conditions"),
        `Source ${figures.source}; at most ${figures.max_steps} steps; hears the ${figures.listening}; found as the ${
            figures.found_by} says. ` +
            "For the same number every policy meets the same start, source, noise and currents.");
    replace(byId("suite-warnings"), ...figures.warnings.map((warning) => element("p", {}, warning)));
    const select = byId("suite-measure") as HTMLSelectElement;
    replace(select, ...MEASURES.map((measure) => element("option", {}, measure.name)));
    select.addEventListener("change", () => {
      this.measure = MEASURES[select.selectedIndex]!;
      this.drawFigures();
    });
    L.control.scale({imperial: false, maxWidth: 120}).addTo(this.map);
    const {south_m, west_m, north_m, east_m} = suite.area;
    this.map.fitBounds([[south_m, west_m], [north_m, east_m]], {padding: [14, 14]});
    onScheme(() => this.drawPaths());
    this.drawFigures();
    this.choose(this.chosen.world, this.chosen.policy);
  }

  private result(world: string, policy: string): Result|undefined {
    return this.suite.figures.results.find((result) => result.world === world && result.policy === policy);
  }

  private searches(world: string, policy: string): Search[] {
    return this.suite.searches.filter((search) => search.world === world && search.policy === policy);
  }

  /** A figure with its interval on the scale of all figures of the table. */
  private cell(world: string, policy: string, scale: [number, number]): HTMLElement|string {
    const result = this.result(world, policy);
    if (!result) return "–";
    const {measure} = this;
    const at = (value: number|null) => `${(100 * ((value ?? scale[1]) - scale[0])) / Math.max(scale[1] - scale[0], 1e-9)}%`;
    const [low, high] = measure.interval(result);
    const isChosen = world === this.chosen.world && policy === this.chosen.policy;
    const words =
        `${policy} in ${world}: ${measure.text(measure.value(result))}, 95 % interval ${measure.text(low)} to ${measure.text(high)}`;
    return element(
        "button", {
          type: "button",
          class: "figure",
          title: words,
          "aria-label": words,
          "aria-pressed": String(isChosen),
          onclick: () => this.open(world, policy)
        },
        measure.text(measure.value(result)),
        element("span", {class: "whisker", style: `--low:${at(low)};--high:${at(high)};--value:${at(measure.value(result))}`}));
  }

  private drawFigures(): void {
    const {measure} = this;
    const ends = this.suite.figures.results.flatMap((result) => [measure.value(result), ...measure.interval(result)])
                     .filter((v): v is number => v !== null && Number.isFinite(v));
    const scale: [number, number] = [Math.min(...ends), Math.max(...ends)];
    const what = (world: string) => this.suite.figures.worlds.find((one) => one.name === world);
    byId("suite-measure").title = measure.help;
    replace(
        byId("suite-figures"),
        table(
            "Figures of each policy in each world",
            [
              {name: "world", isText: true, cell: (world: string) => element("span", {title: what(world)?.what ?? null}, world)},
              ...this.policies.map((policy) => ({name: policy, cell: (world: string) => this.cell(world, policy, scale)})),
            ],
            this.worlds));
    byId("suite-figures").querySelectorAll("tbody tr").forEach((row, i) => this.markBest(row, this.worlds[i]!));
  }

  private markBest(row: Element, world: string): void {
    const values = this.policies.map((policy) => this.result(world, policy)).map((result) => (result ? this.measure.value(result) : null));
    const known = values.filter((value): value is number => value !== null);
    const best = this.measure.isBetterHigh ? Math.max(...known) : Math.min(...known);
    values.forEach((value, i) => row.children[i + 1]?.classList.toggle("best", value === best && known.length > 1));
  }

  /** What was clicked on a small screen stands further down. */
  private open(world: string, policy: string): void {
    this.choose(world, policy);
    const title = byId("suite-path-title");
    if (title.getBoundingClientRect().top > innerHeight) title.scrollIntoView();
  }

  private choose(world: string, policy: string): void {
    this.chosen = {world, policy};
    this.drawFigures();
    const searches = this.searches(world, policy);
    const result = this.result(world, policy);
    replace(byId("suite-chosen"), `${policy} in ${world}`);
    replace(
        byId("suite-count"),
        searches.length === 0 ? "No paths were kept." : `The first ${searches.length} of ${result?.episodes ?? 0} searches.`);
    replace(
        byId("suite-searches"),
        table(
            "Searches",
            [
              {
                name: "search",
                cell: (s: Search) => element(
                    "button", {type: "button", "aria-pressed": String(s.number === this.number), onclick: () => this.show(s.number)},
                    String(s.number))
              },
              {name: "end", isText: true, cell: (s) => ENDS[s.end]},
              {name: "steps", cell: (s) => String(s.north_m.length - 1)},
              {
                name: "detections",
                help: "Steps that ended at the threshold or above.",
                cell: (s) => String(s.snr_db.slice(1).filter((snr) => snr >= this.suite.detection_threshold_db).length)
              },
              {name: "reward", cell: (s) => number(s.reward, 1)},
            ],
            searches,
            (s) =>
                (s.number === this.number ? "taken" :
                     s.end === "found"    ? "" :
                                            "missed")));
    this.drawPaths();
  }

  private show(search: number): void {
    this.number = search;
    this.choose(this.chosen.world, this.chosen.policy);
  }

  /** Every policy's path in the search of the chosen number; that of the chosen policy is the widest. */
  private drawPaths(): void {
    this.paths.clearLayers();
    const {south_m, west_m, north_m, east_m} = this.suite.area;
    L.rectangle([[south_m, west_m], [north_m, east_m]], {color: colour("ink"), weight: 1.5, fill: false, interactive: false})
        .addTo(this.paths);
    const found = this.policies.map((policy) => this.searches(this.chosen.world, policy).find((search) => search.number === this.number));
    const keys: HTMLElement[] = [];
    found.forEach((search, i) => {
      if (!search) return;
      const isChosen = search.policy === this.chosen.policy;
      const tint = TINTS[i % TINTS.length]!;
      const places = search.north_m.map((north, step): LatLng => [north, search.east_m[step]!]);
      L.polyline(places, {color: colour(tint), weight: isChosen ? 3.5 : 1.5, opacity: isChosen ? 1 : 0.7})
          .bindTooltip(words(`${search.policy}: ${ENDS[search.end]}`), {sticky: true})
          .addTo(this.paths);
      if (isChosen)
        places.forEach((place, step) => {
          const isHeard = search.snr_db[step]! >= this.suite.detection_threshold_db;
          L.circleMarker(place, {radius: 3, weight: 1.5, color: colour(tint), fillColor: colour(isHeard ? tint : "ground"), fillOpacity: 1})
              .bindTooltip(
                  words(`step ${step}: ${number(search.snr_db[step], 1, "dB")}, ${kilometres({north_m: place[0], east_m: place[1]})}`))
              .addTo(this.paths);
        });
      keys.push(element(
          "span", {class: "key", style: `--tint:var(--${tint})`},
          `${search.policy}: ${ENDS[search.end]}, ${counted(search.north_m.length - 1, "step")}`));
    });
    const any = found.find((search) => search?.policy === this.chosen.policy) ?? found.find((search) => search);
    if (any)
      L.circleMarker([any.source.north_m, any.source.east_m], {radius: 7, weight: 2.5, color: colour("truth"), fill: false})
          .bindTooltip(words("source, known to the simulation alone"))
          .addTo(this.paths);
    replace(byId("suite-path-title"), `Search ${this.number} in ${this.chosen.world}`);
    replace(byId("suite-keys"), ...keys);
  }
}
