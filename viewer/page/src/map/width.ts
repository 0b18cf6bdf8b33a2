// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Free width of a tunnel: the shortest chord through a point between occupied cells. */
import { cellOf, kOccupied, kUnknown, occupancyAt, type Grid } from "../state/grid";

export interface Width {
  width_m: number;
  a: [number, number];
  b: [number, number];
}

const kStep_rad = Math.PI / 180;
const kReach_m = 30;

/** Metres from a point along a direction to the first occupied cell; null if none, or unknown ground, comes first. */
function distanceToWall(grid: Grid, x: number, y: number, angle: number): number | null {
  const [u, v] = cellOf(grid, x, y);
  const c = Math.cos(angle), s = Math.sin(angle);
  const du = grid.cos * c + grid.sin * s;
  const dv = -grid.sin * c + grid.cos * s;
  let column = Math.floor(u), row = Math.floor(v);
  // Amanatides and Woo 1987: from edge to edge of cells.
  const stepU = du < 0 ? -1 : 1, stepV = dv < 0 ? -1 : 1;
  let nextU = du === 0 ? Infinity : ((du > 0 ? column + 1 : column) - u) / du;
  let nextV = dv === 0 ? Infinity : ((dv > 0 ? row + 1 : row) - v) / dv;
  let t = 0;
  while (t * grid.cell_m < kReach_m) {
    const value = occupancyAt(grid, column, row);
    if (value === kUnknown) return null;
    if (value >= kOccupied) return t * grid.cell_m;
    if (nextU < nextV) { t = nextU; nextU += Math.abs(1 / du); column += stepU; }
    else { t = nextV; nextV += Math.abs(1 / dv); row += stepV; }
  }
  return null;
}

/** Null where the point is not free, or no direction ends at walls on both sides. */
export function widthAt(grid: Grid, x: number, y: number): Width | null {
  const [u, v] = cellOf(grid, x, y);
  const value = occupancyAt(grid, Math.floor(u), Math.floor(v));
  if (value === kUnknown || value >= kOccupied) return null;
  let best: Width | null = null;
  for (let angle = 0; angle < Math.PI; angle += kStep_rad) {
    const a = distanceToWall(grid, x, y, angle);
    const b = distanceToWall(grid, x, y, angle + Math.PI);
    if (a === null || b === null || (best && a + b >= best.width_m)) continue;
    best = { width_m: a + b, a: [x + a * Math.cos(angle), y + a * Math.sin(angle)], b: [x - b * Math.cos(angle), y - b * Math.sin(angle)] };
  }
  return best;
}
