// The page of a run of the bench: which cases failed, and of each what was done, what had to happen and what did.

import "../bench.css";

import type {Bench, Case, RuleEvent} from "./bench";
import {busTrace} from "./bench_bus";
import {drawTrack} from "./bench_track";
import {byId, element, replace, short, table} from "./dom";

const bullets = (items: string[], className = "") =>
    element("ul", {class: className || null}, ...items.map((item) => element("li", {}, item)));

/** In a word and a sign, so that the colour is not needed. */
function verdict(one: Case): HTMLElement {
  return one.passed ? element("span", {class: "passed"}, "✓ passed") : element("span", {class: "failed"}, "✕ failed");
}

function headline({cases, not_flown}: Bench): HTMLElement {
  const failed = cases.filter((one) => !one.passed).length;
  const bad = (text: string) => element("span", {class: "failed"}, `✕ ${text}`);
  if (cases.length === 0) return bad("No case was flown");
  const sentences = [
    failed > 0 ? `${failed} of ${cases.length} cases failed` : "",
    not_flown.length > 0 ? `${not_flown.length} of ${cases.length + not_flown.length} cases were not flown` : ""
  ].filter((text) => text);
  return sentences.length > 0 ? bad(sentences.join(", ")) : element("span", {class: "passed"}, `✓ All ${cases.length} cases passed`);
}

function story(one: Case): HTMLElement {
  const rules = one.expected_rules.join(", ");
  const rows = [["given", one.given], ["when", one.when], ["then", one.then], ["by", one.defence || (rules ? `the rules: ${rules}` : "")]];
  return element(
      "dl", {}, ...rows.filter(([, text]) => text).flatMap(([name, text]) => [element("dt", {}, name!), element("dd", {}, text!)]));
}

function hadToHappen(one: Case): string[] {
  const rules = one.expected_rules.join(", ");
  const ofRules = one.others_may_fire ? `Rules fire: ${rules || "none has to"}; others may.` :
      rules ? `Rules fire: ${rules}; no other may.` :
              "No rule fires.";
  const refused = (what: string, wish: boolean|null) => wish === null ? "" : `${wish ? "At least one" : "No"} ${what} is refused.`;
  return [
    `End of the mission: ${one.expected_end}.`,
    ofRules,
    refused("fix", one.refuses_navigation),
    refused("order", one.refuses_commands),
    one.loses_nothing ? "Nothing is lost on its way in." : "",
    one.least_decisions > 0 ? `Decisions after the first fault: at least ${one.least_decisions}.` : "",
    one.comes_up ? "The vehicle is at the surface at the end." : "",
    one.releases_weight ? "The drop weight is released." : "",
    one.refuses_frames ? "The kernel has no room for at least one frame." : "",
    one.refuses_to_fly ? "Earshot refuses to fly." : "",
  ].filter((sentence) => sentence);
}

function places({track, source_m}: Case): string {
  const last = track[track.length - 1];
  if (!last) return "The vehicle has no track.";
  const deepest_m = Math.max(...track.map(([, , , depth_m]) => depth_m));
  const away_m = Math.hypot(source_m[0] - last[1], source_m[1] - last[2]);
  return `The vehicle was at most ${short(deepest_m)} m deep, and ${short(last[3])} m at the end, ${short(away_m, 0)} m from the source.`;
}

function happened(one: Case): string[] {
  return [
    `End of the mission: ${one.end}, after ${short(one.at_sea_s)} s at sea (${short(one.wall_s)} s here).`,
    places(one),
    `${one.setpoints} set-points; ${one.navigation_refused} fixes and ${one.commands_refused} orders were refused.`,
    `${one.bus === "LCM" ? "Datagrams" : "Frames"}: ${one.frames_sent} sent by the vehicle, ${one.frames_received} by Earshot; ` +
        `${one.frames_lost_by_kernel} lost by the kernel, ${one.frames_afflicted} befallen by a fault.`,
  ];
}

function rules(one: Case): HTMLElement {
  if (one.events.length === 0) return element("p", {}, "No rule fired.");
  return table(
      `Rules: ${one.name}`,
      [
        {name: "time (s)", cell: (event: RuleEvent) => short(event.time_s)},
        {name: "rule", isText: true, cell: (event) => element("code", {}, event.rule)},
        {name: "what it does", isText: true, cell: (event) => event.begins ? "fires" : "ends"},
        {name: "measured", cell: (event) => short(event.measure, 2)},
        {name: "limit", cell: (event) => short(event.limit, 2)},
        {name: "response", isText: true, cell: (event) => event.response},
      ],
      one.events);
}

/** Behind each underscore a line may end. */
function breakable(words: string): HTMLElement {
  return element("span", {}, ...words.split(/(?<=_)/).flatMap((part) => [part, element("wbr")]));
}

export class BenchPage {
  private readonly sections: HTMLDetailsElement[];

  constructor(private readonly bench: Bench) {
    byId("bench-page").hidden = false;
    document.title = "Earshot: bench";
    replace(byId("bench-title"), headline(bench));
    replace(byId("bench-made"), bench.made);
    const wrong =
        bench.cases.flatMap((one, index) => one.passed ? [] : [element("li", {}, this.link(index, one.name), `: ${one.wrong[0] ?? ""}`)]);
    const missing = bench.not_flown.length > 0 ? [element("li", {}, `Not flown: ${bench.not_flown.join(", ")}`)] : [];
    replace(byId("bench-wrong"), ...wrong, ...missing);
    replace(byId("bench-summary"), this.summary());
    this.sections = bench.cases.map((one, index) => this.section(one, index));
    replace(byId("bench-cases"), ...this.sections);
    bench.cases.forEach((one, index) => one.passed || this.open(index));
    this.follow(location.hash);
    addEventListener("hashchange", () => this.follow(location.hash));
    let closed: HTMLDetailsElement[] = [];
    addEventListener("beforeprint", () => {  // paper holds every case
      closed = this.sections.filter((section) => !section.open);
      this.sections.forEach((_, index) => this.open(index));
    });
    addEventListener("afterprint", () => closed.forEach((section) => section.removeAttribute("open")));
  }

  private link(index: number, name: string): HTMLElement {
    const target = `#case-${index + 1}`;
    return element("a", {href: target, onclick: () => this.follow(target)}, breakable(name));
  }

  private follow(target: string): void {
    const index = this.sections.findIndex(({id}) => `#${id}` === target);
    if (index < 0) return;
    this.open(index);
    this.sections[index]!.scrollIntoView();
  }

  private summary(): HTMLElement {
    const fired = (one: Case) => [...new Set(one.events.filter((event) => event.begins).map((event) => event.rule))].join(", ");
    return table(
        "Cases",
        [
          {name: "case", isText: true, cell: ([index, one]: [number, Case]) => this.link(index, one.name)},
          {name: "verdict", isText: true, cell: ([, one]) => verdict(one)},
          {name: "when", isText: true, cell: ([, one]) => one.when},
          {name: "rules that fired", isText: true, cell: ([, one]) => breakable(fired(one) || "–")},
          {name: "how it ended", isText: true, cell: ([, one]) => one.end},
          {name: "at sea (s)", cell: ([, one]) => short(one.at_sea_s, 0)},
        ],
        [...this.bench.cases.entries()]);
  }

  private section(one: Case, index: number): HTMLDetailsElement {
    const title = element("summary", {}, element("h2", {}, breakable(one.name), " ", verdict(one)));
    const made = element("details", {id: `case-${index + 1}`, class: "case"}, title);
    made.addEventListener("toggle", () => made.open && this.open(index));
    return made;
  }

  /** A section is filled when it is opened first: a run has more than a hundred of them. */
  private open(index: number): void {
    const one = this.bench.cases[index]!;
    const section = this.sections[index]!;
    section.open = true;
    if (section.children.length > 1) return;
    const part = (name: string, ...content: HTMLElement[]) => [element("h3", {}, name), ...content];
    const words = element(
        "div", {}, story(one), ...(one.passed ? [] : part("What is wrong", bullets(one.wrong, "wrong"))),
        ...part("What was done", one.faults.length > 0 ? bullets(one.faults.map((fault) => fault.words)) : element("p", {}, "No fault.")),
        ...part("What had to happen", bullets(hadToHappen(one))), ...part("What happened", bullets(happened(one)), rules(one)));
    const track = element("div");
    section.append(element("div", {class: "columns"}, words, track), ...part("On the bus", busTrace(one, this.bench.group_names)));
    drawTrack(track, one);
  }
}
