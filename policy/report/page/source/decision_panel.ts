// The decision that the vehicle follows at the moment shown: why this direction, and what was second best.

import {bar, byId, duration, element, number, percent, replace, table} from "./dom";
import type {Action, Decision, Flight} from "./flight";
import {decisionAt} from "./flight_data";
import type {Clock} from "./clock";

const MOST_HYPOTHESES = 8;

function actions(decision: Decision): HTMLElement|null {
  if (decision.actions.length === 0) return null;
  const mark = (index: number) => (index === decision.taken ? " ◀ taken" : index === decision.second_best ? " second best" : "");
  const nameOf = (action: Action) => {
    const index = decision.actions.indexOf(action);
    return element("span", {}, action.name, element("small", {}, mark(index)));
  };
  return table(
      "What each direction would bring",
      [
        {name: "direction", isText: true, cell: nameOf},
        {
          name: "score",
          help: "What the policy ranks the directions by: it takes the highest, or draws by the probabilities made of it.",
          cell: (a) => number(a.score, 2)
        },
        {
          name: "expected SNR",
          help: "Mean at the end of the step, and one standard deviation over the places believed possible.",
          cell: (a) => `${number(a.expected_snr_db, 1)} ± ${number(a.expected_snr_spread_db, 1, "dB")}`
        },
        {name: "detects", help: "Probability of a detection at the end of the step.", cell: (a) => bar(a.detected)},
        {name: "finds", help: "Probability that the step ends within a step length of the source.", cell: (a) => bar(a.found, 1)},
        {name: "nearer", help: "By how much the distance to the source is expected to shrink.", cell: (a) => number(a.approach_m, 0, "m")},
        {
          name: "costs",
          help: "How much more the rest of the search is expected to cost than after the best direction, in steps without a detection.",
          cell: (a) => number(a.regret_steps, 2)
        },
      ],
      decision.actions, (action) => (decision.actions.indexOf(action) === decision.taken ? "taken" : ""));
}

function hypotheses(decision: Decision): HTMLElement|null {
  if (decision.hypotheses.length === 0) return null;
  return element(
      "details", {open: true},
      element(
          "summary", {title: "The oceans, levels and motions that would explain what was heard, the likeliest first."},
          "Which ocean, how loud, does it move"),
      table(
          "Hypotheses",
          [
            {name: "likely", cell: (h) => bar(h.share)},
            {name: "ocean", isText: true, cell: (h) => h.ocean},
            {
              name: "level",
              help: "The source is so much louder than the tables take for granted.",
              cell: (h) => number(h.level_db, 0, "dB")
            },
            {
              name: "spread",
              help: "Standard deviation of what is measured about what is expected.",
              cell: (h) => number(h.spread_db, 0, "dB")
            },
            {name: "silent", help: "Share of the measurements that meet a pause of the call.", cell: (h) => percent(h.silence_share)},
            {
              name: "moves",
              help: "The source moves, or a current that navigation does not see.",
              cell: (h) => (h.is_moving ? "yes" : "no")
            },
          ],
          decision.hypotheses.slice(0, MOST_HYPOTHESES)));
}

function observed(decision: Decision): HTMLElement|null {
  if (decision.observed.length === 0) return null;
  const rows = [...decision.observed].sort((a, b) => Math.abs(b.part ?? 0) - Math.abs(a.part ?? 0));
  return element(
      "details", {},
      element(
          "summary", {title: "Every number that the policy received, those that moved the choice most first."},
          `What the policy saw (${rows.length} numbers)`),
      table(
          "Observation",
          [
            {name: "number", isText: true, cell: (o) => o.name},
            {name: "value", isText: true, cell: (o) => o.value},
            {
              name: "moved the choice",
              help: "By integrated gradients of the logarithm of the probability of the direction taken: 0.69 doubles it, −0.69 halves it.",
              cell: (o) => number(o.part, 3)
            },
          ],
          rows));
}

export class DecisionPanel {
  private shown: Decision|null|undefined = undefined;

  constructor(private readonly flight: Flight, private readonly clock: Clock) {
    byId("decision-before").addEventListener("click", () => this.go(-1));
    byId("decision-after").addEventListener("click", () => this.go(1));
  }

  /** To the decision before or after the one that is shown. */
  go(by: number): void {
    const {decisions} = this.flight;
    const current = decisionAt(this.flight, this.clock.time_s);
    const index = (current ? decisions.indexOf(current) : -1) + by;
    const wanted = decisions[Math.min(Math.max(index, 0), decisions.length - 1)];
    if (wanted) this.clock.set(wanted.time_s);
  }

  update(): void {
    const decision = decisionAt(this.flight, this.clock.time_s);
    if (decision === this.shown) return;
    this.shown = decision;
    if (!decision) {
      replace(byId("decision-title"), "No decision yet");
      replace(byId("decision"), element("p", {}, "The vehicle has not decided anything at this moment."));
      return;
    }
    const isOpen = [...byId("decision").querySelectorAll("details")].map((details) => details.open);
    const words = [
      decision.sweeping ? "sweeps" : "", decision.overridden ? "a rule moved the way-point" : "",
      decision.declared ? "declares the source found" : ""
    ];
    replace(byId("decision-title"), `Step ${decision.step}: goes ${decision.direction}`);
    replace(
        byId("decision"),
        element("p", {class: "soft"}, [`decided at ${duration(decision.time_s)}`, ...words.filter((word) => word)].join(" · ")),
        element("ul", {class: "reasons"}, ...decision.reasons.map((reason) => element("li", {}, reason))), actions(decision),
        hypotheses(decision), observed(decision));
    byId("decision").querySelectorAll("details").forEach((details, i) => (details.open = isOpen[i] ?? details.open));
  }
}
