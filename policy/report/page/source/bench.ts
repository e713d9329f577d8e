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

/** One case: what it does, what had to come of it, and what did. */
export interface Case {
  name: string;
  given: string;
  when: string;
  then: string;
  bus: "CAN"|"LCM";
  defence: string;  // what makes it come so; empty: the rules that must fire
  passed: boolean;
  wrong: string[];
  faults: Fault[];
  expected_end: string;
  expected_rules: string[];
  others_may_fire: boolean;
  refuses_navigation: boolean|null;  // at least one fix has to be refused, or none; null: as it comes
  refuses_commands: boolean|null;
  loses_nothing: boolean;
  least_decisions: number;  // that are taken after the first fault
  comes_up: boolean;
  releases_weight: boolean;
  refuses_frames: boolean;
  refuses_to_fly: boolean;
  end: string;
  events: RuleEvent[];
  setpoints: number;
  navigation_refused: number;
  commands_refused: number;
  at_sea_s: number;
  wall_s: number;
  frames_sent: number;
  frames_received: number;
  frames_lost_by_kernel: number;
  frames_afflicted: number;
  start_m: [number, number];
  source_m: [number, number];
  halt_polygon_m: [number, number][];
  track: [number, number, number, number][];  // time, north, east, depth: where the vehicle truly was
  trace: TracedFrame[];
}

export function firstFiring(one: Case): RuleEvent|undefined {
  return one.events.find((event) => event.begins);
}
