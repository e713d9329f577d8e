// Time strips: what was heard, done and believed, over the flight. A line over all of them marks the moment shown.

import {CategoryScale, Chart, Decimation, LinearScale, LineController, LineElement, PointElement} from "chart.js";

import type {Clock} from "./clock";
import {colour, onScheme} from "./colours";
import {byId, duration, element, number, replace} from "./dom";
import type {Flight, Strips} from "./flight";
import {lastBefore} from "./flight_data";

Chart.register(CategoryScale, Decimation, LinearScale, LineController, LineElement, PointElement);

const AXIS_WIDTH = 52;  // left of every strip, and of the spectrogram
const RIGHT_PADDING = 26;
const STEPS_S = [10, 30, 60, 120, 300, 600, 1200, 1800, 3600, 7200, 14400, 28800, 86400];  // of the marks of time

interface Line {
  column: keyof Strips;
  label: string;
  tint: string;
  isDashed?: boolean;
}
interface Strip {
  title: string;
  unit: string;
  digits: number;
  help: string;
  lines: Line[];
  isReversed?: boolean;
  range?: [number, number?];
  step?: number;                              // of the marks
  level?: (flight: Flight) => number | null;  // a line across, its name
  levelName?: string;
}

const STRIPS: Strip[] = [
  {
    title: "SNR",
    unit: "dB",
    digits: 1,
    levelName: "threshold",
    level: (flight) => flight.mission?.detection_threshold_db ?? null,
    help:
        "Signal-to-noise ratio at the hydrophone. From the threshold on it is a detection; where the sound was too faint to measure, the floor stands that it lies below.",
    lines: [
      {column: "snr_db", label: "heard", tint: "heard"},
      {column: "expected_snr_db", label: "expected by the belief", tint: "expected", isDashed: true}
    ]
  },
  {
    title: "mismatch",
    unit: "bits",
    digits: 1,
    help:
        "How many bits better a guess without an ocean explains what was heard than all oceans of the tables do. High: the belief is not trusted.",
    lines: [{column: "mismatch_bits", label: "model-mismatch score", tint: "heard"}]
  },
  {
    title: "depth",
    unit: "m",
    digits: 1,
    isReversed: true,
    help: "Depth below the surface, as navigation measured it and as it was ordered.",
    lines:
        [{column: "depth_m", label: "measured", tint: "heard"}, {column: "depth_set_m", label: "ordered", tint: "expected", isDashed: true}]
  },
  {
    title: "speed",
    unit: "m/s",
    digits: 2,
    help: "Speed through the water, measured and ordered.",
    lines: [
      {column: "speed_mps", label: "measured", tint: "heard"}, {column: "speed_set_mps", label: "ordered", tint: "expected", isDashed: true}
    ]
  },
  {
    title: "heading",
    unit: "°",
    digits: 0,
    range: [0, 360],
    step: 90,
    help: "Heading clockwise from north, measured and ordered.",
    lines: [
      {column: "heading_deg", label: "measured", tint: "heard"},
      {column: "heading_set_deg", label: "ordered", tint: "expected", isDashed: true}
    ]
  },
  {
    title: "battery",
    unit: "%",
    digits: 1,
    help: "Charge that the vehicle reported.",
    lines: [{column: "battery_percent", label: "charge", tint: "heard"}]
  },
  {
    title: "turn time",
    unit: "ms",
    range: [0],
    digits: 3,
    help: "How long the runtime took for a turn.",
    lines: [{column: "turn_time_ms", label: "turn time", tint: "heard"}]
  },
];

const column = (flight: Flight, name: keyof Strips) => flight.strips[name] as (number | null)[];
const isKnown = (flight: Flight) => (strip: Strip) =>
    strip.lines.some((line) => column(flight, line.column).some((value) => value !== null));

export class StripCharts {
  private charts: {strip: Strip; chart: Chart; rows: {x: number; y: number}[][]}[] = [];  // rows: of each line
  private readonly cursor = element("div", {class: "cursor", "aria-hidden": "true"});
  private pointed_s: number|null = null;

  constructor(private readonly flight: Flight, private readonly clock: Clock) {
    const place = byId("strips");
    const time = (event: Event) => this.timeAt((event as PointerEvent).clientX);
    place.addEventListener("pointermove", (event) => this.point(time(event)));
    place.addEventListener("pointerleave", () => this.point(null));
    place.addEventListener("click", (event) => {
      const time_s = time(event);
      if (time_s !== null) this.clock.set(time_s);
    });
    onScheme(() => this.build());
    this.build();
  }

  /** After news. */
  extend(): void {
    if (STRIPS.filter(isKnown(this.flight)).length !== this.charts.length) {
      this.build();
      return;
    }
    for (const {strip, chart, rows} of this.charts) {
      const {time_s} = this.flight.strips;
      chart.data.datasets.forEach((dataset, i) => {
        const line = strip.lines[i];
        const data = line ? rows[i]! : this.level(strip);
        if (line)
          for (let row = data.length; row < time_s.length; ++row) data.push(this.point_of(line, row));
        dataset.data = data;  // what stood there may be thinned
      });
      chart.options.scales!["x"] = this.time_axis();
      chart.update("none");
    }
    this.update();
  }

  /** What changes with the moment. */
  update(): void {
    const x = this.charts[0]?.chart.scales["x"];
    this.cursor.hidden = !x;
    if (x) this.cursor.style.transform = `translateX(${x.getPixelForValue(this.clock.time_s)}px)`;
    this.showValues(this.pointed_s ?? this.clock.time_s);
  }

  /** Of all rows. */
  build(): void {
    for (const {chart} of this.charts) chart.destroy();
    const place = byId("strips");
    replace(place, this.cursor);
    this.charts = STRIPS.filter(isKnown(this.flight)).map((strip) => {
      const canvas = element("canvas", {role: "img", "aria-label": `${strip.title} over time; its values stand above the strips`});
      const legend = [...strip.lines, ...(strip.level ? [{label: strip.levelName!, tint: "threshold", isDashed: true}] : [])].map(
          (line) => element("span", {class: line.isDashed ? "key dashed" : "key", style: `--tint:var(--${line.tint})`}, line.label));
      place.append(element("div", {class: "strip-head", title: strip.help}, element("b", {}, `${strip.title} (${strip.unit})`), ...legend));
      place.append(element("div", {class: "strip"}, canvas));
      const rows = strip.lines.map((line) => this.flight.strips.time_s.map((_, row) => this.point_of(line, row)));
      return {strip, rows, chart: this.chartOf(strip, rows, canvas)};
    });
    this.update();
  }

  private point_of(line: Line, row: number): {x: number; y: number} {
    return {x: this.flight.strips.time_s[row]!, y: column(this.flight, line.column)[row] ?? NaN};
  }

  private level(strip: Strip): {x: number; y: number}[] {
    const y = strip.level?.(this.flight) ?? NaN;
    return [{x: 0, y}, {x: this.clock.end_s, y}];
  }

  private time_axis(): object {
    const end_s = this.clock.end_s;
    return {
      type: "linear",
      min: 0,
      max: end_s,
      grid: {color: colour("grid"), borderColor: colour("grid")},
      ticks: {color: colour("soft"), font: {size: 11}, autoSkipPadding: 14, maxRotation: 0, callback: (value: number) => duration(value)},
      afterBuildTicks: (axis: {ticks: {value: number}[]}) => {
        const step_s = STEPS_S.find((step) => end_s / step <= 8) ?? end_s;
        axis.ticks = Array.from({length: Math.floor(end_s / step_s) + 1}, (_, i) => ({value: i * step_s}));
      },
      afterFit: (axis: {paddingRight: number}) => {
        axis.paddingRight = RIGHT_PADDING;
      }
    };
  }

  private chartOf(strip: Strip, rows: {x: number; y: number}[][], canvas: HTMLCanvasElement): Chart {
    const line = (tint: string, isDashed?: boolean) =>
        ({borderColor: colour(tint), borderWidth: 1.3, borderDash: isDashed ? [4, 3] : [], pointRadius: 0, spanGaps: false});
    const datasets = strip.lines.map((one, i) => ({...line(one.tint, one.isDashed), label: one.label, data: rows[i]!}));
    if (strip.level) datasets.push({...line("threshold", true), label: strip.levelName!, data: this.level(strip)});
    return new Chart(canvas, {
      type: "line",
      data: {datasets},
      options: {
        animation: false,
        parsing: false,
        normalized: true,
        maintainAspectRatio: false,
        events: [],
        plugins: {decimation: {enabled: true, algorithm: "min-max", threshold: 1000}},
        scales: {
          x: this.time_axis(),
          y: {
            type: "linear",
            reverse: strip.isReversed ?? false,
            min: strip.range?.[0],
            max: strip.range?.[1],
            grid: {color: colour("grid"), borderColor: colour("grid")},
            ticks: {color: colour("soft"), font: {size: 11}, maxTicksLimit: 5, stepSize: strip.step},
            afterFit: (axis) => {
              axis.width = AXIS_WIDTH;
            }
          },
        },
      },
    });
  }

  private timeAt(client_x: number): number|null {
    const first = this.charts[0]?.chart;
    if (!first) return null;
    const time_s = first.scales["x"]!.getValueForPixel(client_x - first.canvas.getBoundingClientRect().left) ?? 0;
    return Math.min(Math.max(time_s, 0), this.clock.end_s);
  }

  private point(time_s: number|null): void {
    this.pointed_s = time_s;
    this.showValues(time_s ?? this.clock.time_s);
  }

  /** Of the last row that is not after this time. */
  private showValues(time_s: number): void {
    const row = lastBefore(this.flight.strips.time_s, time_s);
    const value = (strip: Strip, line: Line) => {
      const text = number(column(this.flight, line.column)[row], strip.digits, strip.unit);
      return line.column === "snr_db" && this.flight.strips.snr_too_faint[row] ? `below ${text}` : text;
    };
    replace(
        byId("values"), element("b", {}, duration(time_s)),
        ...this.charts.map(
            ({strip}) => element(
                "span", {"data-strip": strip.title}, `${strip.title} `, element("b", {}, value(strip, strip.lines[0]!)),
                strip.lines[1] ? ` (${strip.lines[1].label.split(" ")[0]} ${value(strip, strip.lines[1])})` : null)));
  }
}
