// The spectrogram of what the hydrophone heard, over the time of the strips.

import type {Clock} from "./clock";
import {cividis, onScheme} from "./colours";
import {byId, element, number, replace} from "./dom";
import type {Flight} from "./flight";
import {bytesOf} from "./flight_data";

export function showSpectrogram(flight: Flight, clock: Clock): void {
  const section = byId("sound");
  section.hidden = !flight.sound;
  if (!flight.sound) return;
  const {frequency_hz, time_s, level_db_re_1upa2_per_hz: level} = flight.sound;
  const cells = bytesOf(level.cells);
  const picture =
      element("canvas", {width: time_s.length, height: frequency_hz.length, role: "img", "aria-label": "spectrogram: frequency over time"});
  const image = new ImageData(Math.max(time_s.length, 1), Math.max(frequency_hz.length, 1));
  for (let t = 0; t < time_s.length; ++t)
    for (let f = 0; f < frequency_hz.length; ++f)
      image.data.set([...cividis(cells[t * frequency_hz.length + f]! / 255), 255], 4 * ((frequency_hz.length - 1 - f) * time_s.length + t));
  picture.getContext("2d")!.putImageData(image, 0, 0);
  const row_s = time_s.length > 1 ? (time_s[time_s.length - 1]! - time_s[0]!) / (time_s.length - 1) : 1;
  const begin_s = (time_s[0] ?? 0) - row_s / 2;
  picture.addEventListener("click", (event) => {
    const box = picture.getBoundingClientRect();
    clock.set(begin_s + ((event.clientX - box.left) / box.width) * row_s * time_s.length);
  });
  const cursor = element("div", {class: "cursor", "aria-hidden": "true"});
  const move = () => {
    const share = (part_s: number) => `${(100 * part_s) / Math.max(clock.end_s, 1)}%`;
    picture.style.marginLeft = share(begin_s);
    picture.style.width = share(row_s * time_s.length);
    cursor.style.left = share(clock.time_s);
  };
  clock.onChange(move);
  onScheme(move);
  move();
  replace(
      byId("spectrogram"),
      element(
          "div", {class: "axis"}, element("span", {}, `${number(frequency_hz[frequency_hz.length - 1], 0)} Hz`),
          element("span", {}, `${number(frequency_hz[0], 0)} Hz`)),
      element("div", {class: "frame"}, picture, cursor),
      element("p", {class: "soft"}, `dark: ${number(level.least, 0)}, yellow: ${number(level.most, 0)} dB re 1 µPa²/Hz`));
}
