// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The grid as an image in the colours of the theme, and smaller ones in which walls stay visible. */
import { isWall, kUnknown, occupancyAt, type Grid } from "../state/grid";
import { rgb, themeGeneration } from "../theme";

export type Shading = "occupancy" | "coverage";

export class Raster {
  #key: [Grid, Shading, number] | null = null;
  #levels: HTMLCanvasElement[] = [];

  /** The image whose cells are nearest to a pixel; level n has cells of 2^n. */
  at(grid: Grid, shading: Shading, cell_px: number): { image: HTMLCanvasElement; factor: number } {
    const key = this.#key;
    if (!key || key[0] !== grid || key[1] !== shading || key[2] !== themeGeneration()) {
      this.#key = [grid, shading, themeGeneration()];
      this.#levels = build(grid, shading);
    }
    const level = Math.min(this.#levels.length - 1, Math.max(0, Math.floor(-Math.log2(cell_px))));
    return { image: this.#levels[level]!, factor: 2 ** level };
  }
}

/** Class of a cell: what is more important has the greater number. */
function classOf(grid: Grid, column: number, row: number, shading: Shading): number {
  if (isWall(grid, column, row)) return 5;
  const isUnknown = occupancyAt(grid, column, row) === kUnknown;
  const coverage = grid.coverage[row * grid.width + column]!;
  if (shading === "coverage") return coverage > 0 ? coverage : isUnknown ? 0 : 1;
  return isUnknown ? 0 : 4;
}

function build(grid: Grid, shading: Shading): HTMLCanvasElement[] {
  const names = ["unknown", "seen", "scanned", "driven", "free", "wall"];
  const colours = names.map((name) => rgb(name));
  let { width, height } = grid;
  let classes = new Uint8Array(width * height);
  for (let row = 0, i = 0; row < height; ++row) {
    for (let column = 0; column < width; ++column, ++i) classes[i] = classOf(grid, column, row, shading);
  }
  const levels: HTMLCanvasElement[] = [];
  for (let level = 0; level < 5; ++level) {
    const canvas = document.createElement("canvas");
    canvas.width = width;
    canvas.height = height;
    const context = canvas.getContext("2d")!;
    const image = context.createImageData(width, height);
    for (let row = 0; row < height; ++row) {
      for (let column = 0; column < width; ++column) {
        const value = classes[row * width + column]!;
        const at = 4 * ((height - 1 - row) * width + column);
        const [r, g, b] = colours[value]!;
        image.data[at] = r;
        image.data[at + 1] = g;
        image.data[at + 2] = b;
        image.data[at + 3] = value === 0 ? 0 : 255;
      }
    }
    context.putImageData(image, 0, 0);
    levels.push(canvas);
    const w = Math.ceil(width / 2), h = Math.ceil(height / 2);
    const half = new Uint8Array(w * h);
    for (let row = 0; row < height; ++row) {
      for (let column = 0; column < width; ++column) {
        const at = (row >> 1) * w + (column >> 1);
        half[at] = Math.max(half[at]!, classes[row * width + column]!);
      }
    }
    [classes, width, height] = [half, w, h];
  }
  return levels;
}
