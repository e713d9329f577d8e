// The page: a flight, an evaluation or a run of the bench that stands in the file, or a flight under way.

import "leaflet/leaflet.css";
import "../style.css";

import type {Bench} from "./bench";
import {BenchPage} from "./bench_page";
import {Clock} from "./clock";
import {DecisionPanel} from "./decision_panel";
import {byId, duration, element, replace, utc} from "./dom";
import {EventLog} from "./event_log";
import {EXPORTS, save} from "./exports";
import type {Flight, FlightNews} from "./flight";
import {FORMAT} from "./flight";
import {bytesOf, end_s, merge} from "./flight_data";
import {listen} from "./live";
import {FlightMap} from "./map";
import {showSpectrogram} from "./spectrogram";
import {StripCharts} from "./strips";
import type {Suite} from "./suite";
import {SuitePage} from "./suite_page";
import {showSummary} from "./summary";

declare const DecompressionStream: new (format: "gzip") => ReadableWritablePair<Uint8Array, Uint8Array>;  // TypeScript 4.8 does not know it

const REFRESH_MS = 50;
const STEP_S = 10;  // of an arrow key

/** Everything about one flight. */
class Page {
  private readonly clock = new Clock();
  private readonly map: FlightMap;
  private readonly strips: StripCharts;
  private readonly decision: DecisionPanel;
  private readonly events: EventLog;
  private readonly changed = new Set<keyof FlightNews>();
  private isAsked = false;

  constructor(private flight: Flight) {
    byId("page").hidden = false;
    this.clock.end_s = end_s(flight);
    this.clock.isFollowing = !flight.is_over;
    const first = flight.decisions.find((decision) => decision.step === flight.open_at_step);
    this.clock.time_s = first ? first.time_s : this.clock.end_s;
    showSummary(flight);
    this.map = new FlightMap(flight, this.clock);
    this.strips = new StripCharts(flight, this.clock);
    this.decision = new DecisionPanel(flight, this.clock);
    this.events = new EventLog(flight, this.clock);
    showSpectrogram(flight, this.clock);
    this.clock.onChange(() => this.update());
    this.addControls();
    this.addExports();
    this.update();
  }

  /** The same flight, or another, sent anew. */
  renew(whole: Flight): void {
    Object.assign(this.flight, whole);
    for (const part of Object.keys(whole) as (keyof FlightNews)[]) this.changed.add(part);
    this.take({});
    this.strips.build();
  }

  /** News may come faster than a picture can be drawn: what came since the last one is drawn together. */
  take(news: FlightNews): void {
    merge(this.flight, news);
    for (const part of Object.keys(news) as (keyof FlightNews)[]) this.changed.add(part);
    if (this.isAsked) return;
    this.isAsked = true;
    setTimeout(() => this.refresh(), REFRESH_MS);
  }

  private refresh(): void {
    this.isAsked = false;
    const has = (...parts: (keyof FlightNews)[]) => parts.some((part) => this.changed.has(part));
    this.clock.extend(end_s(this.flight));
    if (has("verdict", "sentences", "shortcomings", "facts", "health")) showSummary(this.flight);
    if (has("strips")) this.strips.extend();
    if (has("decisions", "mission", "truth")) this.map.redraw();
    if (has("events")) this.events.redraw();
    if (has("sound")) showSpectrogram(this.flight, this.clock);
    this.changed.clear();
    if (this.flight.is_over && this.clock.isFollowing) this.clock.follow(false);
    byId("follow").hidden = this.flight.is_over;
  }

  private update(): void {
    const {time_s, isPlaying, isFollowing} = this.clock;
    const slider = byId("time") as HTMLInputElement;
    slider.max = String(this.clock.end_s);
    slider.value = String(time_s);
    const text = this.flight.began_utc ? `${duration(time_s)} · ${utc(this.flight.began_utc, time_s)}` : duration(time_s);
    slider.setAttribute("aria-valuetext", text);
    replace(byId("moment"), `${text} of ${duration(this.clock.end_s)}`);
    const play = byId("play");
    replace(play, isPlaying ? "Pause" : "Play");
    play.setAttribute("aria-pressed", String(isPlaying));
    byId("follow").setAttribute("aria-pressed", String(isFollowing));
    this.map.update();
    this.strips.update();
    this.decision.update();
    this.events.update();
  }

  private addControls(): void {
    byId("time").addEventListener("input", (event) => this.clock.set(Number((event.target as HTMLInputElement).value)));
    byId("play").addEventListener("click", () => this.clock.play(!this.clock.isPlaying));
    byId("speed").addEventListener("change", (event) => {
      this.clock.speed = Number((event.target as HTMLSelectElement).value);
    });
    byId("follow").addEventListener("click", () => this.clock.follow(!this.clock.isFollowing));
    byId("follow").hidden = this.flight.is_over;
    byId("fit").addEventListener("click", () => this.map.fit());
    const help = byId("help") as HTMLDialogElement;
    byId("show-help").addEventListener("click", () => help.showModal());
    document.addEventListener("keydown", (event) => this.obey(event));
  }

  private obey(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.altKey || event.metaKey || target.closest("input, select, textarea, dialog")) return;
    if (event.key.startsWith("Arrow") && target.closest("#map")) return;  // they move the map
    const keys: Record<string, () => void> = {
      ArrowLeft: () => this.clock.set(this.clock.time_s - STEP_S),
      ArrowRight: () => this.clock.set(this.clock.time_s + STEP_S),
      ArrowUp: () => this.decision.go(-1),
      ArrowDown: () => this.decision.go(1),
      Home: () => this.clock.set(0),
      End: () => this.clock.set(this.clock.end_s),
      " ": () => this.clock.play(!this.clock.isPlaying),
      "?": () => (byId("help") as HTMLDialogElement).showModal(),
    };
    if (event.key === " " && target.closest("button, summary")) return;
    const act = keys[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  private addExports(): void {
    const file = (suffix: string) => `${this.flight.name.replace(/[^\w.-]+/g, "_") || "flight"}.${suffix}`;
    const buttons = Object.entries(EXPORTS).map(([name, {suffix, type, write, needsOrigin}]) => {
      const isOff = needsOrigin && !this.flight.mission?.origin;
      return element(
          "button", {
            type: "button",
            disabled: isOff,
            title: isOff ? "The latitude and longitude of this flight are not known." : null,
            onclick: () => save(file(suffix), new Blob([write(this.flight)], {type}))
          },
          name);
    });
    const picture = element(
        "button", {
          type: "button",
          onclick: () => this.map.picture().toBlob((content) => {
            if (content) save(file("png"), content);
          })
        },
        "PNG of the map");
    replace(byId("exports"), ...buttons, picture, element("button", {type: "button", onclick: () => print()}, "Print"));
  }
}

/** What stands in the file, plain or compressed; null: nothing. */
async function embedded(id: "flight"|"suite"|"bench"): Promise<unknown> {
  const data = document.getElementById(id);
  if (!data?.textContent) return null;
  if (data.getAttribute("type") === "application/json") return JSON.parse(data.textContent);
  const packed = new Blob([bytesOf(data.textContent.trim())]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(packed).json();
}

function refuse(text: string): void {
  byId("connection").hidden = false;
  replace(byId("connection"), text);
}

async function main(): Promise<void> {
  const bench = (await embedded("bench")) as Bench | null;
  const suite = (await embedded("suite")) as Suite | null;
  const flight = (await embedded("flight")) as Flight | null;
  const format = (flight ?? suite ?? bench)?.format ?? FORMAT;
  if (format !== FORMAT) return refuse(`This page shows format ${FORMAT}, and what is in it has format ${format}.`);
  if (bench) {
    new BenchPage(bench);
    return;
  }
  if (suite) {
    new SuitePage(suite);
    return;
  }
  if (flight) {
    new Page(flight);
    return;
  }
  let page: Page|null = null;
  listen({
    whole: (whole) => {
      if (page)
        page.renew(whole);
      else
        page = new Page(whole);
    },
    news: (news) => page?.take(news),
  });
}

main().catch((error: unknown) => refuse(`This page cannot be shown: ${String(error)}`));
