// The belief as a picture: the likelier a cell, the stronger its colour; outlines around the smallest areas of 50 and 90 %.

import {cividis, colour, isDark} from "./colours";
import type {Belief} from "./flight";
import {areaOfCell} from "./flight_data";

const PIXELS = 8;      // of a cell
const FAINTEST = 250;  // cells beyond this area (of 255) have no colour

/** Where an outline runs: the sides between a cell of the smallest area with this share and one outside it. */
export function outline(belief: Belief, share: number): {x: number; y: number; isAcross: boolean}[] {
  const bytes = areaOfCell(belief);
  const {cells_north: rows, cells_east: columns} = belief;
  const isIn = (row: number, column: number) =>
      row >= 0 && row < rows && column >= 0 && column < columns && bytes[row * columns + column]! < share * 255;
  const sides = [];
  for (let row = 0; row <= rows; ++row)
    for (let column = 0; column <= columns; ++column) {
      if (isIn(row, column) !== isIn(row - 1, column)) sides.push({x: column, y: row, isAcross: true});
      if (isIn(row, column) !== isIn(row, column - 1)) sides.push({x: column, y: row, isAcross: false});
    }
  return sides;
}

export class BeliefPicture {
  readonly canvas = document.createElement("canvas");
  private drawn: unknown[] = [];

  /** Draws it, unless it is there already. */
  draw(belief: Belief, withColours: boolean, withOutlines: boolean): void {
    const wanted = [belief, withColours, withOutlines, isDark()];
    if (wanted.every((part, i) => part === this.drawn[i])) return;
    this.drawn = wanted;
    this.canvas.width = belief.cells_east * PIXELS;
    this.canvas.height = belief.cells_north * PIXELS;
    const context = this.canvas.getContext("2d")!;
    if (withColours) this.paint(context, belief);
    if (withOutlines) {
      this.trace(context, belief, 0.9, 1.5);
      this.trace(context, belief, 0.5, 3);
    }
  }

  private paint(context: CanvasRenderingContext2D, belief: Belief): void {
    const bytes = areaOfCell(belief);
    const cells = new ImageData(belief.cells_east, belief.cells_north);
    const strongestIsYellow = isDark();
    for (let row = 0; row < belief.cells_north; ++row)
      for (let column = 0; column < belief.cells_east; ++column) {
        const area = bytes[row * belief.cells_east + column]!;
        if (area >= FAINTEST) continue;
        const share = 1 - area / FAINTEST;
        const at = 4 * ((belief.cells_north - 1 - row) * belief.cells_east + column);  // a picture begins in the north
        cells.data.set([...cividis(strongestIsYellow ? share : 1 - share), 80 + 150 * share], at);
      }
    const small = document.createElement("canvas");
    small.width = belief.cells_east;
    small.height = belief.cells_north;
    small.getContext("2d")!.putImageData(cells, 0, 0);
    context.imageSmoothingEnabled = false;
    context.drawImage(small, 0, 0, this.canvas.width, this.canvas.height);
  }

  private trace(context: CanvasRenderingContext2D, belief: Belief, share: number, width: number): void {
    context.strokeStyle = colour("outline");
    context.lineWidth = width;
    context.beginPath();
    for (const {x, y, isAcross} of outline(belief, share)) {
      context.moveTo(x * PIXELS, this.canvas.height - y * PIXELS);
      context.lineTo((x + (isAcross ? 1 : 0)) * PIXELS, this.canvas.height - (y + (isAcross ? 0 : 1)) * PIXELS);
    }
    context.stroke();
  }
}
