// A flight under way, from `earshot watch`.

import {byId, duration, replace} from "./dom";
import type {Flight, FlightNews} from "./flight";

const AGAIN_MS = 2000;  // where the browser does not try again by itself

interface Receiver {
  whole: (flight: Flight) => void;
  news: (news: FlightNews) => void;
}

/** Listens until the page is closed. After a break the server sends the whole flight anew. */
export function listen(receiver: Receiver): void {
  let lost: Date|null = null;
  let hasFlight = false;
  const report = () => {
    const place = byId("connection");
    place.hidden = lost === null && hasFlight;
    if (lost)
      replace(
          place,
          `No connection to earshot watch since ${lost.toLocaleTimeString()}, for ${duration((Date.now() - lost.getTime()) / 1000)}. ` +
              (hasFlight ? "The page shows what it was sent before, and tries again." : "The page tries again."));
    else
      replace(place, "Connected. Waiting for the flight.");
  };
  const connect = () => {
    const events = new EventSource("events");
    const data = (event: Event) => JSON.parse((event as MessageEvent<string>).data) as unknown;
    events.addEventListener("open", () => {
      lost = null;
      report();
    });
    events.addEventListener("error", () => {
      lost ??= new Date();
      report();
      if (events.readyState === EventSource.CLOSED) setTimeout(connect, AGAIN_MS);
    });
    events.addEventListener("flight", (event) => {
      receiver.whole(data(event) as Flight);
      hasFlight = true;
      report();
    });
    events.addEventListener("news", (event) => receiver.news(data(event) as FlightNews));
  };
  connect();
  setInterval(report, 1000);
}
