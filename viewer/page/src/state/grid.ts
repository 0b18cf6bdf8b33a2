// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The occupancy map: cells in rows from the corner at `pose`, metres in frame map. */
import { fieldOf, readerOf } from "./packed";
import { kIdentity, poseOf, yawOf } from "./pose";
import { bytes, num, raw, type Raw } from "./values";

export const kUnknown = 255;
const kOccupied = 65;  // per cent, from which a cell is wall
/** How well ground is known, with the colour of the style sheet. */
export const kCoverage: [colour: string, meaning: string][] = [
  ["unknown", "never seen"], ["seen", "seen by the laser only"], ["scanned", "scanned in 3D"], ["driven", "driven"],
];

const kCellLimit = 64e6;

export interface Grid {
  width: number;
  height: number;
  cell_m: number;
  x: number;
  y: number;
  cos: number;
  sin: number;
  /** 0 to 100, 255 unknown. */
  occupancy: Uint8Array;
  /** Index of kCoverage. */
  coverage: Uint8Array;
}

/** Throws an Error where sizes disagree. */
export function gridOf(message: Raw): Grid {
  const data = bytes(message.data);
  const width = num(message.column_count, 0);
  const cellSize = raw(message.cell_size);
  const cell_m = num(cellSize.x, 0);
  const rowStride = num(message.row_stride, 0);
  const cellStride = num(message.cell_stride, 0);
  if (!(cell_m > 0) || Math.abs(num(cellSize.y, 0) - cell_m) > 1e-9 * cell_m) throw new Error("cells are not square");
  if (width < 1 || cellStride < 1 || rowStride < width * cellStride) throw new Error("strides of the grid");
  const height = Math.floor(data.length / rowStride);
  if (height < 1 || width * height > kCellLimit) throw new Error("size of the grid");
  const pose = message.pose ? poseOf(raw(message.pose).position, raw(message.pose).orientation) : kIdentity;
  const yaw = yawOf(pose);
  const occupancyField = fieldOf(message, "occupancy");
  if (!occupancyField) throw new Error("grid without occupancy");
  const coverageField = fieldOf(message, "coverage");
  const occupancyAt = readerOf(data, occupancyField, cellStride);
  const coverageAt = coverageField ? readerOf(data, coverageField, cellStride) : () => 0;
  const occupancy = new Uint8Array(width * height);
  const coverage = new Uint8Array(width * height);
  for (let row = 0, i = 0; row < height; ++row) {
    for (let column = 0, at = row * rowStride; column < width; ++column, ++i, at += cellStride) {
      const value = occupancyAt(at);
      occupancy[i] = value <= 100 ? value : kUnknown;
      coverage[i] = Math.min(3, coverageAt(at));
    }
  }
  return { width, height, cell_m, x: pose.x, y: pose.y, cos: Math.cos(yaw), sin: Math.sin(yaw), occupancy, coverage };
}

/** Cell coordinates (not rounded) of a point of the map. */
export function cellOf(grid: Grid, x: number, y: number): [number, number] {
  const dx = x - grid.x;
  const dy = y - grid.y;
  return [(grid.cos * dx + grid.sin * dy) / grid.cell_m, (-grid.sin * dx + grid.cos * dy) / grid.cell_m];
}

export function pointOf(grid: Grid, column: number, row: number): [number, number] {
  const u = column * grid.cell_m;
  const v = row * grid.cell_m;
  return [grid.x + grid.cos * u - grid.sin * v, grid.y + grid.sin * u + grid.cos * v];
}

/** 255 outside of the grid. */
export function occupancyAt(grid: Grid, column: number, row: number): number {
  if (column < 0 || row < 0 || column >= grid.width || row >= grid.height) return kUnknown;
  return grid.occupancy[row * grid.width + column]!;
}

/** Outside of the grid there is none. */
export function isWall(grid: Grid, column: number, row: number): boolean {
  const value = occupancyAt(grid, column, row);
  return value !== kUnknown && value >= kOccupied;
}

/** Bounds in metres of the known cells, frame map; null if there is none. */
export function boundsOf(grid: Grid): { x0: number; y0: number; x1: number; y1: number } | null {
  let c0 = Infinity, c1 = -1, r0 = Infinity, r1 = -1;
  for (let row = 0, i = 0; row < grid.height; ++row) {
    for (let column = 0; column < grid.width; ++column, ++i) {
      if (grid.occupancy[i] === kUnknown) continue;
      if (column < c0) c0 = column;
      if (column > c1) c1 = column;
      if (row < r0) r0 = row;
      r1 = row;
    }
  }
  if (c1 < 0) return null;
  const corners = [pointOf(grid, c0, r0), pointOf(grid, c1 + 1, r0), pointOf(grid, c0, r1 + 1), pointOf(grid, c1 + 1, r1 + 1)];
  const xs = corners.map((p) => p[0]);
  const ys = corners.map((p) => p[1]);
  return { x0: Math.min(...xs), y0: Math.min(...ys), x1: Math.max(...xs), y1: Math.max(...ys) };
}

/** Area in square metres of the cells that are not wall, by coverage (index of kCoverage). */
export function coverageAreas(grid: Grid): number[] {
  const areas_m2 = kCoverage.map(() => 0);
  for (let row = 0, i = 0; row < grid.height; ++row) {
    for (let column = 0; column < grid.width; ++column, ++i) {
      if (!isWall(grid, column, row)) areas_m2[grid.coverage[i]!]! += grid.cell_m * grid.cell_m;
    }
  }
  return areas_m2;
}
