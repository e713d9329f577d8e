// The belief as a picture: the likelier a cell, the stronger its colour; outlines around the smallest areas of 50 and 90 %.

import {cividis, isDark} from "./colours";
import type {Belief} from "./flight";
import {areaOfCell} from "./flight_data";

const FAINTEST = 250;  // cells beyond this area (of 255) have no colour

/** Lines around the smallest area with this share, between places north and east. */
export function outline(belief: Belief, share: number): [number, number][][] {
  const bytes = areaOfCell(belief);
  const {cells_north: rows, cells_east: columns, south_west: corner, size} = belief;
  const isIn = (row: number, column: number) =>
      row >= 0 && row < rows && column >= 0 && column < columns && bytes[row * columns + column]! < share * 255;
  const at = (row: number, column: number):
      [number, number] => [corner.north_m + (row / rows) * size.north_m, corner.east_m + (column / columns) * size.east_m];
  const sides: [number, number][][] = [];
  for (let row = 0; row <= rows; ++row)
    for (let column = 0; column <= columns; ++column) {
      if (isIn(row, column) !== isIn(row - 1, column)) sides.push([at(row, column), at(row, column + 1)]);
      if (isIn(row, column) !== isIn(row, column - 1)) sides.push([at(row, column), at(row + 1, column)]);
    }
  return sides;
}

export class BeliefPicture {
  readonly canvas = document.createElement("canvas");
  private drawn: unknown[] = [];

  /** A pixel for each cell, unless it is drawn already. */
  draw(belief: Belief): void {
    const strongestIsYellow = isDark();
    const wanted = [belief, strongestIsYellow];
    if (wanted.every((part, i) => part === this.drawn[i])) return;
    this.drawn = wanted;
    const bytes = areaOfCell(belief);
    const cells = new ImageData(belief.cells_east, belief.cells_north);
    for (let row = 0; row < belief.cells_north; ++row)
      for (let column = 0; column < belief.cells_east; ++column) {
        const area = bytes[row * belief.cells_east + column]!;
        if (area >= FAINTEST) continue;
        const share = 1 - area / FAINTEST;
        const at = 4 * ((belief.cells_north - 1 - row) * belief.cells_east + column);  // a picture begins in the north
        cells.data.set([...cividis(strongestIsYellow ? share : 1 - share), 80 + 150 * share], at);
      }
    this.canvas.width = belief.cells_east;
    this.canvas.height = belief.cells_north;
    this.canvas.getContext("2d")!.putImageData(cells, 0, 0);
  }
}
