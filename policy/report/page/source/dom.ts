// Small parts of the page, and numbers as people read them.

type Child = Node|string|null;
type Attributes = Record<string, string|number|boolean|null|((event: Event) => void)>;

/** An element with attributes (functions are listeners: `onclick`) and children. */
export function element<Name extends keyof HTMLElementTagNameMap>(
    name: Name, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[Name] {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === "function")
      made.addEventListener(key.slice(2), value);
    else if (typeof value === "boolean")
      made.toggleAttribute(key, value);
    else if (value !== null)
      made.setAttribute(key, String(value));
  }
  made.append(...children.filter((child): child is Node|string => child !== null));
  return made;
}

/** Text where a library would take a string for HTML. */
export function words(text: string): HTMLElement {
  return element("span", {}, text);
}

export interface Column<Row> {
  name: string;
  help?: string;
  isText?: boolean;
  cell: (row: Row) => Child;
}

/** A table in a frame that scrolls where it is too wide. */
export function table<Row>(
    label: string, columns: Column<Row>[], rows: readonly Row[], classOf: (row: Row) => string = () => ""): HTMLElement {
  const head = columns.map((c) => element("th", {scope: "col", title: c.help ?? null, class: c.isText ? "text" : null}, c.name));
  const body = rows.map(
      (row) => element(
          "tr", {class: classOf(row) || null}, ...columns.map((c) => element("td", {class: c.isText ? "text" : null}, c.cell(row)))));
  return element(
      "div", {class: "scroll", tabindex: 0, role: "region", "aria-label": label},
      element("table", {}, element("thead", {}, element("tr", {}, ...head)), element("tbody", {}, ...body)));
}

/** A share as a bar with its percentage. */
export function bar(share: number, digits = 0): HTMLElement {
  const width = `${Math.round(Math.min(Math.max(share, 0), 1) * 100)}%`;
  return element("span", {class: "bar", style: `--share:${width}`}, percent(share, digits));
}

export function byId(id: string): HTMLElement {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found;
}

export function replace(parent: HTMLElement, ...children: Child[]): void {
  parent.replaceChildren(...children.filter((child): child is Node|string => child !== null));
}

export function number(value: number|null|undefined, digits: number, unit = ""): string {
  if (value == null || !Number.isFinite(value)) return "–";
  return value.toFixed(digits).replace("-", "−") + (unit === "°" || !unit ? unit : ` ${unit}`);
}

/** Without needless zeros: "1750", "12.5". */
export function short(value: number|null|undefined, mostDigits = 1): string {
  const text = number(value, mostDigits);
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

/** "1 step", "4 steps" */
export function counted(count: number, noun: string): string {
  return `${count} ${noun}${count === 1 ? "" : "s"}`;
}

export function percent(share: number|null|undefined, digits = 0): string {
  return share == null ? "–" : `${(100 * share).toFixed(digits)} %`;
}

/** "1:02:03" */
export function duration(time_s: number): string {
  const seconds = Math.round(time_s);
  const two = (value: number) => String(value).padStart(2, "0");
  return `${Math.floor(seconds / 3600)}:${two(Math.floor(seconds / 60) % 60)}:${two(seconds % 60)}`;
}

/** "2026-11-22 15:04:07 UTC" behind so many seconds */
export function utc(began: string, time_s: number): string {
  return new Date(Date.parse(began) + 1000 * time_s).toISOString().replace("T", " ").replace(/\.\d+Z/, " UTC");
}

/** "047°" */
export function degrees(value: number|null|undefined): string {
  return value == null ? "–" : `${String(Math.round(value) % 360).padStart(3, "0")}°`;
}

/** "12.35 km north, 3.20 km east" */
export function kilometres(place: {north_m: number; east_m: number}, digits = 2): string {
  return `${number(place.north_m / 1000, digits)} km north, ${number(place.east_m / 1000, digits)} km east`;
}

/** "38.5123° N, 28.0000° W" */
export function position([latitude_deg, longitude_deg]: [number, number]): string {
  const side = (value: number, positive: string, negative: string) => `${Math.abs(value).toFixed(4)}° ${value < 0 ? negative : positive}`;
  return `${side(latitude_deg, "N", "S")}, ${side(longitude_deg, "E", "W")}`;
}
