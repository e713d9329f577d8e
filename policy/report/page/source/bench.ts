// What the page is given of a run of the bench: cases as earshot-bench writes them (hil/bench/results.hpp), and what hil/run knows of them.
// Lengths are metres, times seconds since the flight began, places north and east; null where a number is not known.

export interface Bench {
  format: 1;
  made: string;                         // how these results came to be, a sentence
  not_flown: string[];                  // names of cases that were to be flown, too
  group_names: Record<string, string>;  // of parameter groups, by their number
  cases: Case[];
}

export interface Fault {
  words: string;
  from_s: number;
  until_s: number|null;  // null: to the end
}

/** A rule of the mission that fired, or ceased to hold. */
export interface RuleEvent {
  time_s: number;
  rule: string;
  begins: boolean;
  response: string;
  measure: number|null;
  limit: number|null;
}

export interface TracedFrame {
  time_s: number;
  from_earshot: boolean;
  pgn: number;
  source: number;
  data: string;      // hexadecimal; of a message over LCM the first 64 bytes
  channel?: string;  // of a message over LCM, which has neither group nor source
}

type Flag = "passed"|"others_may_fire"|"loses_nothing"|"comes_up"|"releases_weight"|"refuses_frames"|"refuses_to_fly";
type Count = "setpoints"|"navigation_refused"|"commands_refused"|"frames_sent"|"frames_received"|"frames_lost_by_kernel"|"frames_afflicted";
type Duration = "at_sea_s"|"wall_s";

/** One case: what it does, what had to come of it, and what did. */
export interface Case extends Record<Flag, boolean>, Record<Count|Duration, number> {
  name: string;
  given: string;
  when: string;
  then: string;
  bus: "CAN"|"LCM";
  defence: string;  // what makes it come so; empty: the rules that must fire
  wrong: string[];
  faults: Fault[];
  expected_end: string;
  expected_rules: string[];
  refuses_navigation: boolean|null;  // at least one fix has to be refused, or none; null: as it comes
  refuses_commands: boolean|null;
  least_decisions: number;  // that are taken after the first fault
  end: string;
  events: RuleEvent[];
  start_m: [number, number];
  source_m: [number, number];
  halt_polygon_m: [number, number][];
  track: [number, number, number, number][];  // time, north, east, depth: where the vehicle truly was
  trace: TracedFrame[];
}

export const firstFiring = (one: Case): RuleEvent|undefined => one.events.find((event) => event.begins);
