// What a reader wants first: how it ended, the facts, what is missing, and how the vehicle is.

import {byId, element, replace, table, utc} from "./dom";
import type {Flight} from "./flight";

function health(flight: Flight): (Node|null)[] {
  if (!flight.health) return [element("p", {}, "The journal holds no report of the runtime's health.")];
  const {state, end_reason, response, authority, steps_taken, counters, ports} = flight.health;
  const refused = counters.filter((counter) => counter.value > 0);
  const fact = (name: string, value: string, help: string) =>
      element("div", {title: help}, element("dt", {}, name), element("dd", {}, value));
  return [
    element(
        "dl", {class: "facts"}, fact("state", state, "Of the mission, as the runtime reported it last."),
        fact("ended because", end_reason, "Why the mission is over, or that it is under way."),
        fact("strongest response", response, "Of the safety rules that hold: warn, return, surface or abort."),
        fact("authority", authority, "Whether Earshot may steer."),
        fact("steps", String(steps_taken), "Steps of the search that are over."),
        fact(
            "refused", refused.length === 0 ? "nothing" : refused.map((c) => `${c.name}: ${c.value}`).join(", "),
            "Messages that came in and were not believed.")),
    ports.length === 0 ? null :
                         table(
                             "Ports",
                             [
                               {name: "port", cell: (p) => String(p.port)},
                               {name: "link", isText: true, cell: (p) => (p.link_up ? "up" : "DOWN")},
                               {name: "received", cell: (p) => String(p.received)},
                               {name: "lost", help: "Arrived faster than they were read.", cell: (p) => String(p.lost)},
                               {name: "malformed", cell: (p) => String(p.malformed)},
                               {name: "unsent", cell: (p) => String(p.unsent)},
                             ],
                             ports, (port) => (port.link_up ? "" : "wrong")),
  ];
}

export function showSummary(flight: Flight): void {
  document.title = `Earshot: ${flight.name}`;
  const verdict = byId("verdict");
  verdict.className = flight.verdict.found === null ? "" : flight.verdict.found ? "found" : "missed";
  replace(verdict, flight.verdict.text);
  replace(
      byId("sentences"), ...flight.sentences.map((sentence) => element("p", {}, sentence)),
      flight.began_utc ? element("p", {}, `Times count from ${utc(flight.began_utc, 0)}.`) : null);
  replace(byId("shortcomings"), ...flight.shortcomings.map((lack) => element("p", {}, lack)));
  byId("kind").textContent = `${flight.is_simulated ? "simulation" : "at sea"}${flight.is_over ? "" : " · under way"}`;
  replace(
      byId("facts"),
      ...flight.facts.map(
          ({name, value, meaning}) => element(
              "div", {title: meaning || null}, element("dt", {}, name), element("dd", {}, value),
              meaning ? element("dd", {class: "meaning"}, meaning) : null)));
  replace(byId("health"), ...health(flight));
}
