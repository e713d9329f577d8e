// What the page is given of a flight: the one description of it. `flight_document` in C++ writes it; tsc holds what it writes against this.
// Times are seconds since the journal's first record. Directions are degrees clockwise from north, 0 to 360. Places are metres north and
// east in the mission's plane. null: not known.

export const FORMAT = 1;

export interface Place {
  north_m: number;
  east_m: number;
}

/** A name, its value with the unit, and what they mean ("" where the name says it). */
export interface Fact {
  name: string;
  value: string;
  meaning: string;
}

export interface Flight {
  format: typeof FORMAT;
  name: string;            // of the folder or the journal
  began_utc: string|null;  // ISO 8601; null: the mission's clock has no date
  is_simulated: boolean;
  is_over: boolean;  // false: more may come
  verdict: {text: string; found: boolean | null};
  sentences: string[];     // what a reader should know first
  shortcomings: string[];  // what the files of the flight lack
  facts: Fact[];
  mission: Mission|null;  // null: the journal has lost it
  health: Health|null;    // the last
  strips: Strips;
  decisions: Decision[];
  events: FlightEvent[];
  sound: Sound|null;
  truth: Truth|null;          // null: at sea
  open_at_step: number|null;  // the decision that is shown first
}

/** What a page under way is sent: rows to append in strips, decisions, events and bearings; everything else replaces what was there. */
export type FlightNews = Partial<Omit<Flight, "strips">>&{strips?: Strips};

export interface Mission {
  area: {south_m: number; west_m: number; north_m: number; east_m: number};
  origin: {latitude_deg: number; longitude_deg: number}|null;
  fence_inside: Place[];  // a polygon, empty: none
  fence_save: Place[];
  fence_halt: Place[];
  no_surface_zones: Place[][];
  safe_point: Place|null;
  detection_threshold_db: number;
  source_frequency_hz: number;
  search_depth_m: number;
  max_depth_m: number;
  search_speed_mps: number;
  step_length_m: number;
  max_steps: number;
}

/** Columns of one length; rows in the order of their times, thinned to 8,000 in a report. */
export interface Strips {
  time_s: number[];
  north_m: (number|null)[];
  east_m: (number|null)[];
  depth_m: (number|null)[];
  heading_deg: (number|null)[];
  speed_mps: (number|null)[];
  depth_set_m: (number|null)[];
  heading_set_deg: (number|null)[];
  speed_set_mps: (number|null)[];
  waypoint_north_m: (number|null)[];
  waypoint_east_m: (number|null)[];
  snr_db: (number|null)[];
  snr_too_faint: (boolean|null)[];   // then snr_db is the floor that it lies below
  expected_snr_db: (number|null)[];  // by the belief of the last decision
  mismatch_bits: (number|null)[];    // how badly every ocean of the tables fits; from 6.75 on the belief is not trusted
  battery_percent: (number|null)[];
  turn_time_ms: (number|null)[];  // how long the runtime's turn took
}

export interface Bearing {
  toward_deg: number;
  deviation_deg: number;    // one standard deviation
  mirror_deg: number|null;  // where left and right cannot be told apart
}

export interface Decision {
  step: number;
  time_s: number;
  at: Place;
  snr_db: number|null;
  too_faint: boolean;
  detected: boolean;
  bearing: Bearing|null;
  waypoint: Place;
  direction: string;  // "NE"
  sweeping: boolean;
  overridden: boolean;   // a safety rule moved the way-point
  declared: Place|null;  // the source is declared found here
  reasons: string[];     // in physical words: measured, believed, why this and not the second best
  actions: Action[];     // every direction, in the policy's order; empty where nothing explains it
  taken: number;         // index among the actions
  second_best: number|null;
  hypotheses: Hypothesis[];                                        // the likeliest first
  observed: {name: string; value: string; part: number | null}[];  // what the policy saw, and how much it moved the choice, nats
  belief: Belief|null;
}

export interface Action {
  name: string;
  score: number|null;        // the policy's logit, by which it ranks
  probability: number|null;  // the softmax of the scores
  expected_snr_db: number;
  expected_snr_spread_db: number;
  detected: number;    // probability of a detection at its end
  found: number;       // probability that the source is found at its end
  approach_m: number;  // expected decrease of the distance to the source
  regret_steps: number|null;
}

export interface Hypothesis {
  ocean: string;
  level_db: number;  // the source is that much louder than expected
  spread_db: number;
  silence_share: number;
  is_moving: boolean;
  share: number;  // its probability
}

export interface Belief {
  is_the_policys: boolean;  // false: an observer's who knows the ocean
  cells_north: number;
  cells_east: number;
  south_west: Place;
  size: Place;  // of the whole grid
  /**
   * Base64 of a byte for each cell, rows from south to north, each from west to east: 255 times the probability of all cells that are
   * likelier. The likeliest has 0; the smallest area that holds the source with 50 % is that of the cells below 127.5.
   */
  area_of_cell: string;
  likeliest: Place;
  likeliest_share: number;
  mean: Place;
  ellipse: {semi_major_m: number; semi_minor_m: number; bearing_deg: number};  // one standard deviation about the mean
  spread_m: number;
  area_50_km2: number;
  area_90_km2: number;
}

export type EventKind = "order"|"answer"|"state"|"rule"|"link"|"decision"|"journal"|"other";

export interface FlightEvent {
  time_s: number;
  kind: EventKind;
  text: string;
}

export interface Health {
  state: string;
  end_reason: string;
  response: string;  // the strongest response of a rule that holds
  authority: string;
  steps_taken: number;
  counters: {name: string; value: number}[];  // of what was refused
  ports: {port: number; link_up: boolean; received: number; lost: number; malformed: number; unsent: number}[];
}

export interface Sound {
  frequency_hz: number[];
  time_s: number[];                                                        // the middle of each row
  level_db_re_1upa2_per_hz: {least: number; most: number; cells: string};  // base64 of a byte for each cell, [time x frequency]
  /** The SNR that the simulator computes where the vehicle measured; null: too faint. */
  modelled: {time_s: number[]; snr_db: (number | null)[]};
}

/** What a simulator knows and the vehicle does not. */
export interface Truth {
  source: Place;
  source_moves: boolean;
  snr_of_range: {range_m: number[]; snr_db: number[]};  // in the direction of the vehicle's search
}
