// What happened, with a search and a filter by kind.

import type {Clock} from "./clock";
import {byId, duration, element, replace} from "./dom";
import type {EventKind, Flight, FlightEvent} from "./flight";
import {lastBefore} from "./flight_data";

const MOST_SHOWN = 500;
const KINDS: Record<EventKind, string> = {
  order: "orders",
  answer: "answers",
  state: "states",
  rule: "rules",
  link: "links",
  decision: "decisions",
  journal: "journal",
  other: "others",
};

export class EventLog {
  private readonly off = new Set<EventKind>();
  private rows: {event: FlightEvent; row: HTMLElement}[] = [];
  private newest: HTMLElement|null = null;

  constructor(private readonly flight: Flight, private readonly clock: Clock) {
    byId("event-search").addEventListener("input", () => this.redraw());
    this.redraw();
  }

  redraw(): void {
    const {events} = this.flight;
    const wanted = (byId("event-search") as HTMLInputElement).value.trim().toLowerCase();
    const kinds = (Object.keys(KINDS) as EventKind[]).filter((kind) => events.some((event) => event.kind === kind));
    replace(
        byId("event-kinds"),
        ...kinds.map(
            (kind) => element(
                "label", {}, element("input", {
                  type: "checkbox",
                  checked: !this.off.has(kind),
                  onchange: () => {
                    if (!this.off.delete(kind)) this.off.add(kind);
                    this.redraw();
                  }
                }),
                ` ${KINDS[kind]}`)));
    const found = events.filter((event) => !this.off.has(event.kind) && event.text.toLowerCase().includes(wanted));
    this.rows = found.slice(-MOST_SHOWN).map((event) => ({
                                               event,
                                               row: element(
                                                   "li", {class: event.kind},
                                                   element(
                                                       "button", {type: "button", onclick: () => this.clock.set(event.time_s)},
                                                       element("time", {}, duration(event.time_s)), ` ${event.text}`)),
                                             }));
    const left = found.length - this.rows.length;
    replace(byId("events"), ...this.rows.map(({row}) => row));
    replace(byId("event-count"), `${found.length} of ${events.length} events${left > 0 ? `; the last ${MOST_SHOWN} stand here` : ""}`);
    this.newest = null;
    this.update();
  }

  /** Marks the last that is not after the moment shown. */
  update(): void {
    const newest = this.rows[lastBefore(this.rows.map(({event}) => event.time_s), this.clock.time_s)]?.row ?? null;
    if (newest === this.newest) return;
    this.newest?.removeAttribute("aria-current");
    newest?.setAttribute("aria-current", "true");
    const list = byId("events");
    if (newest) list.scrollTop = newest.offsetTop - list.offsetTop - list.clientHeight / 2;
    this.newest = newest;
  }
}
