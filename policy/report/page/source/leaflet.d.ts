// What the page uses of Leaflet 1.7, for which Debian has no types.
declare module "leaflet/leaflet.esm.js" {
  export type LatLng = [number, number];  // here: north, east in metres
  export type Bounds = [LatLng, LatLng];
  export interface Layer {
    addTo(target: Map|LayerGroup): this;
    remove(): this;
    bindTooltip(content: HTMLElement, options?: object): this;
    on(event: string, listener: (event: {latlng: {lat: number; lng: number}}) => void): this;
  }
  export interface LayerGroup extends Layer {
    clearLayers(): this;
  }
  export interface Path extends Layer {
    setStyle(style: object): this;
    setLatLngs(places: LatLng[]): this;
    setLatLng(place: LatLng): this;
  }
  export interface Map {
    fitBounds(bounds: Bounds, options?: object): this;
    invalidateSize(): this;
    on(event: string, listener: (event: {latlng: {lat: number; lng: number}}) => void): this;
    getContainer(): HTMLElement;
    getSize(): {x: number; y: number};
    latLngToContainerPoint(place: LatLng): {x: number; y: number};
  }
  export const CRS: {Simple: object};
  export function map(element: HTMLElement, options: object): Map;
  export function layerGroup(layers?: Layer[]): LayerGroup;
  export function polyline(places: LatLng[]|LatLng[][], options?: object): Path;
  export function polygon(places: LatLng[], options?: object): Path;
  export function rectangle(bounds: Bounds, options?: object): Path;
  export function circle(place: LatLng, options?: object): Path;
  export function circleMarker(place: LatLng, options?: object): Path;
  export function marker(place: LatLng, options?: object): Path;
  export function divIcon(options: object): object;
  export function svgOverlay(element: Element, bounds: Bounds, options?: object): Layer;
  export const control: Record<"scale"|"zoom", (options: object) => {
    addTo(map: Map): void
  }>;
}
