// A flight under way, from `earshot watch`.

import {byId, duration, replace} from "./dom";
import type {Flight, FlightNews} from "./flight";

interface Receiver {
  whole: (flight: Flight) => void;
  news: (news: FlightNews) => void;
}

/** Listens until the page is closed. The browser connects again by itself; the server then sends the whole flight. */
export function listen(receiver: Receiver): void {
  const events = new EventSource("events");
  let lost_ms: number|null = null;
  const tell = () => {
    byId("connection").hidden = lost_ms === null;
    if (lost_ms !== null)
      replace(
          byId("connection"),
          `No connection to earshot watch for ${duration((performance.now() - lost_ms) / 1000)}. The page shows what it was sent before.`);
  };
  events.addEventListener("open", () => {
    lost_ms = null;
    tell();
  });
  events.addEventListener("error", () => {
    lost_ms ??= performance.now();
    tell();
  });
  setInterval(tell, 1000);
  events.addEventListener("flight", (event) => receiver.whole(JSON.parse((event as MessageEvent<string>).data) as Flight));
  events.addEventListener("news", (event) => receiver.news(JSON.parse((event as MessageEvent<string>).data) as FlightNews));
}
