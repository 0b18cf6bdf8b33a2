// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Width of a tunnel between its walls. Across is the direction of the shortest chord through the point; the width is the median of
 * parallel chords within 1 m along the tunnel. A chord passes through what is small and has free ground behind: posts, stones, timber.
 */
import { cellOf, isWall, kUnknown, occupancyAt, type Grid } from "../state/grid";

export interface Width {
  width_m: number;
  /** Shortest and longest of the chords. */
  least_m: number;
  most_m: number;
  /** Ends of the chord at the point. */
  a: [number, number];
  b: [number, number];
}

const kStep_rad = Math.PI / 180;
const kReach_m = 30;
const kAlong_m = 0.5;
/** Larger objects count as wall. */
const kObject_m = 1.0;

/** The occupied cells that are connected (8 neighbours) and fit into a box of kObject_m. */
class Objects {
  #small = new Map<number, boolean>();

  constructor(private readonly grid: Grid) {}

  has(column: number, row: number): boolean {
    const key = row * this.grid.width + column;
    if (!this.#small.has(key)) this.#visit(column, row);
    return this.#small.get(key)!;
  }

  #visit(column: number, row: number): void {
    const { grid } = this;
    const limit = Math.max(1, Math.round(kObject_m / grid.cell_m));
    const cells = new Set([row * grid.width + column]);
    let [c0, c1, r0, r1] = [column, column, row, row];
    for (const key of cells) {  // grows while it is visited
      const c = key % grid.width, r = Math.floor(key / grid.width);
      [c0, c1, r0, r1] = [Math.min(c0, c), Math.max(c1, c), Math.min(r0, r), Math.max(r1, r)];
      if (c1 - c0 >= limit || r1 - r0 >= limit) break;
      for (let dr = -1; dr <= 1; ++dr) {
        for (let dc = -1; dc <= 1; ++dc) {
          if (isWall(grid, c + dc, r + dr)) cells.add((r + dr) * grid.width + c + dc);
        }
      }
    }
    const isSmall = c1 - c0 < limit && r1 - r0 < limit;
    for (const key of cells) this.#small.set(key, isSmall);
  }
}

/** Metres from a point along a direction to the wall; null if unknown ground comes first or none is within reach. */
function distanceToWall(grid: Grid, objects: Objects, x: number, y: number, angle_rad: number): number | null {
  const [u, v] = cellOf(grid, x, y);
  const c = Math.cos(angle_rad), s = Math.sin(angle_rad);
  const du = grid.cos * c + grid.sin * s;
  const dv = -grid.sin * c + grid.cos * s;
  let column = Math.floor(u), row = Math.floor(v);
  // Amanatides and Woo 1987: from edge to edge of cells.
  const stepU = du < 0 ? -1 : 1, stepV = dv < 0 ? -1 : 1;
  let nextU = du === 0 ? Infinity : ((du > 0 ? column + 1 : column) - u) / du;
  let nextV = dv === 0 ? Infinity : ((dv > 0 ? row + 1 : row) - v) / dv;
  let t = 0;
  let object_m: number | null = null;  // where the chord entered an object behind which no free cell was met yet
  while (t * grid.cell_m < kReach_m) {
    const isOccupied = isWall(grid, column, row);
    const isUnknown = occupancyAt(grid, column, row) === kUnknown;
    if (isOccupied && !objects.has(column, row)) return object_m ?? t * grid.cell_m;
    if (isOccupied) object_m ??= t * grid.cell_m;
    // Cells inside of an object and in its shadow are unknown.
    else if (isUnknown && (object_m === null || t * grid.cell_m - object_m > kObject_m)) return object_m;
    else if (!isUnknown) object_m = null;
    if (nextU < nextV) { t = nextU; nextU += Math.abs(1 / du); column += stepU; }
    else { t = nextV; nextV += Math.abs(1 / dv); row += stepV; }
  }
  return null;
}

function isFree(grid: Grid, x: number, y: number): boolean {
  const [u, v] = cellOf(grid, x, y);
  const [column, row] = [Math.floor(u), Math.floor(v)];
  return occupancyAt(grid, column, row) !== kUnknown && !isWall(grid, column, row);
}

/** Null where the point is not free, or no direction ends at walls on both sides. */
export function widthAt(grid: Grid, x: number, y: number): Width | null {
  if (!isFree(grid, x, y)) return null;
  const objects = new Objects(grid);
  const chordAt = (px: number, py: number, angle_rad: number) => {
    const a = distanceToWall(grid, objects, px, py, angle_rad);
    const b = distanceToWall(grid, objects, px, py, angle_rad + Math.PI);
    return a === null || b === null ? null : { a, b, length_m: a + b, angle_rad };
  };
  let across: NonNullable<ReturnType<typeof chordAt>> | null = null;
  for (let angle_rad = 0; angle_rad < Math.PI; angle_rad += kStep_rad) {
    const chord = chordAt(x, y, angle_rad);
    if (chord && (!across || chord.length_m < across.length_m)) across = chord;
  }
  if (!across) return null;
  const c = Math.cos(across.angle_rad), s = Math.sin(across.angle_rad);
  const lengths_m = [across.length_m];
  for (let along_m = -kAlong_m; along_m <= kAlong_m + 1e-9; along_m += grid.cell_m) {
    const [px, py] = [x - s * along_m, y + c * along_m];
    const chord = isFree(grid, px, py) ? chordAt(px, py, across.angle_rad) : null;
    if (chord) lengths_m.push(chord.length_m);
  }
  lengths_m.sort((p, q) => p - q);
  return {
    width_m: lengths_m[Math.floor(lengths_m.length / 2)]!, least_m: lengths_m[0]!, most_m: lengths_m[lengths_m.length - 1]!,
    a: [x + across.a * c, y + across.a * s], b: [x - across.b * c, y - across.b * s],
  };
}
