// The frames on the bus around the first rule that fired, or before the end of a case in which none did.

import {type Bench, type Case, firstFiring, type RuleEvent, type TracedFrame} from "./bench";
import {element, short, table} from "./dom";

const BEFORE_S = 3;
const AFTER_S = 1;
// Of one case, so that a page of many can still be scrolled.
const MOST_FRAMES = 200;

/** What the frames are, in words, and these: those nearest to the moment, in their order. */
function framesAround(one: Case): [string, TracedFrame[]] {
  const {trace} = one;
  if (trace.length === 0) return ["There is no trace of the bus.", []];
  const begin_s = trace[0]!.time_s;
  const fired = firstFiring(one);
  const isMissed = fired !== undefined && fired.time_s < begin_s;
  const moment_s = fired && !isMissed ? fired.time_s : trace[trace.length - 1]!.time_s;
  const away_s = (i: number) => Math.abs(trace[i]!.time_s - moment_s);
  const all = [...trace.keys()];
  const inside = all.filter((i) => moment_s - BEFORE_S <= trace[i]!.time_s && trace[i]!.time_s <= moment_s + AFTER_S);
  const nearest = (inside.length > 0 ? inside : all).sort((a, b) => away_s(a) - away_s(b) || b - a).slice(0, MOST_FRAMES);
  const shown = nearest.sort((a, b) => a - b).map((i) => trace[i]!);
  const what = fired && !isMissed ? `around the first rule that fired (${fired.rule})` : "at the end";
  const span = `${short(shown[0]!.time_s)} s to ${short(shown[shown.length - 1]!.time_s)} s`;
  const missed = isMissed ? ` The trace begins at ${short(begin_s)} s, after that: these are the last before the end.` : "";
  const kind = one.bus === "LCM" ? "messages" : "frames";
  return [`${shown.length} of ${trace.length} ${kind} that were kept, ${what}: ${span}.${missed}`, shown];
}

interface Row {
  time_s: number;
  order: 0|1|2;  // within a second: faults, frames, rules
  cells: [string, string, string];
}

function frameRow(frame: TracedFrame, names: Bench["group_names"]): Row {
  const sender = frame.from_earshot ? "Earshot" : "vehicle";
  const data = frame.data.replace(/..(?=.)/g, "$& ");
  const cells: Row["cells"] =
      frame.channel ? [sender, frame.channel, data] : [`${sender} ${frame.source}`, `${frame.pgn} ${names[frame.pgn] ?? ""}`, data];
  return {time_s: frame.time_s, order: 1, cells};
}

/** What else happened: a fault before the frames of its second, a rule behind them. */
function remarks({faults, events}: Case): Row[] {
  const row = (time_s: number, order: 0|2, what: string, words: string): Row => ({time_s, order, cells: [what, words, ""]});
  const measured = (event: RuleEvent) => `${short(event.measure, 2)} (limit ${short(event.limit, 2)}): ${event.response}`;
  return [
    ...faults.map((fault) => row(fault.from_s, 0, "fault begins", fault.words)),
    ...faults.map((fault) => row(fault.until_s ?? Infinity, 0, "fault ends", fault.words)),
    ...events.map((event) => row(event.time_s, 2, event.begins ? "rule fires" : "rule ends", `${event.rule}, ${measured(event)}`)),
  ];
}

export function busTrace(one: Case, names: Bench["group_names"]): HTMLElement {
  const [words, frames] = framesAround(one);
  if (frames.length === 0) return element("p", {}, words);
  const [first_s, last_s] = [frames[0]!.time_s, frames[frames.length - 1]!.time_s];
  const around = remarks(one).filter(({time_s}) => first_s <= time_s && time_s <= last_s);
  const rows = [...frames.map((frame) => frameRow(frame, names)), ...around].sort((a, b) => a.time_s - b.time_s || a.order - b.order);
  const [group, data] = one.bus === "LCM" ? ["channel", "first 64 bytes"] : ["parameter group", "data"];
  const columns = [
    {name: "time (s)", cell: (row: Row) => short(row.time_s)},
    {name: one.bus === "LCM" ? "sender" : "sender, address", isText: true, cell: (row: Row) => row.cells[0]},
    {name: group!, isText: true, cell: (row: Row) => row.cells[1]},
    {name: data!, isText: true, cell: (row: Row) => element("code", {}, row.cells[2])},
  ];
  return element(
      "details", {class: "trace"}, element("summary", {}, words),
      table(`On the bus: ${one.name}`, columns, rows, (row) => row.order === 1 ? "" : "taken"));
}
