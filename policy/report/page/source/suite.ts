// What the page is given of an evaluation: its figures, as `earshot evaluate --json` writes them, and where its searches went.
// `searches_json` in C++ writes the searches. Places are metres north and east, null where a number is not known or never comes.

import type {Place} from "./flight";

export interface Suite {
  format: 1;
  title: string;  // "300 searches each in 12 worlds, source changing"
  area: {south_m: number; west_m: number; north_m: number; east_m: number};
  detection_threshold_db: number;
  figures: Figures;
  searches: Search[];  // the first 50 of each policy in each world
}

export interface Figures {
  episodes: number;  // in each world
  source: string;
  max_steps: number;
  found_by: string;
  listening: string;
  warnings: string[];
  worlds: World[];
  results: Result[];
}

export interface World {
  name: string;
  what: string;
  seed: number;
  vehicle_depth_m: number;
}

type Interval = [number | null, number | null];

/** One policy in one world. Fractions are 0 to 1, intervals 95 %. */
export interface Result {
  world: string;
  policy: string;
  episodes: number;
  found_fraction: number;
  found_fraction_95: Interval;
  lower_quartile_hours_to_find: number|null;
  median_hours_to_find: number|null;
  upper_quartile_hours_to_find: number|null;
  restricted_mean_hours_to_find: number;
  restricted_mean_hours_to_find_95: Interval;
  mean_reward: number;
  mean_reward_95: Interval;
  left_domain_fraction: number;
  path_over_straight: number|null;
  mean_steps: number;
  mean_detections: number;
  declared_falsely_fraction?: number|null;
  missed_fraction?: number|null;
}

export interface Search {
  world: string;
  policy: string;
  number: number;  // the same number: the same start, source, noise and currents
  end: "running"|"found"|"left_domain"|"time_limit";
  reward: number;
  source: Place;      // at the end
  north_m: number[];  // at the start and at the end of every step
  east_m: number[];
  snr_db: number[];
}
