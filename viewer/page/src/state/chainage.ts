// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Chainage: distance from the start by which places underground are named, along the way that the robot took outbound. Where it
 * comes back to a place, the shorter way counts, as known when it first was there: a place keeps its name while the robot drives on. */
import { memoized } from "./memoized";
import type { Model } from "./model";
import type { Entity } from "./scene";

const kNear_m = 1;
/** Between points of one place: less than the robot is wide, so that no wall is between them. */
const kSamePlace_m = 1;
const kStep_m = 0.5;
/** Between marks of one chainage. */
const kApart_m = 3;

type Point = [x: number, y: number];

export class Chainage {
  #xyz: number[] = [];
  #along: number[] = [];
  #travelled: number[] = [];
  #cells = new Map<string, number[]>();

  /** Of a trajectory from the start on: x, y, z of its points. */
  constructor(xyz: ArrayLike<number>) {
    this.#add(xyz[0]!, xyz[1]!, xyz[2]!);
    for (let i = 3; i < xyz.length; i += 3) {
      const from = [xyz[i - 3]!, xyz[i - 2]!, xyz[i - 1]!], to = [xyz[i]!, xyz[i + 1]!, xyz[i + 2]!];
      const parts = Math.max(1, Math.ceil(Math.hypot(to[0]! - from[0]!, to[1]! - from[1]!) / kStep_m));
      for (let part = 1; part <= parts; ++part) {
        const at = (k: number) => from[k]! + (part / parts) * (to[k]! - from[k]!);
        this.#add(at(0), at(1), at(2));
      }
    }
  }
  static readonly of = memoized((trajectory: Entity[]): Chainage | null => {
    const line = trajectory.find((entity) => entity.id === "outbound")?.lines[0];
    return line && line.xyz.length >= 6 ? new Chainage(line.xyz) : null;
  });
  /** Along the trajectory known at a time. */
  static at(model: Model, time_s: number): Chainage | null {
    const found = model.trajectory.at(time_s);
    return found && Chainage.of(found.value);
  }
  /** The largest. */
  get length_m(): number { return this.#along.reduce((most, along) => Math.max(most, along), 0); }

  /** The place first reached of those so far from the start. */
  pointAt(distance_m: number): Point | null { return this.pointsAt(distance_m)[0] ?? null; }

  /** The places so far from the start, one in each branch. */
  pointsAt(distance_m: number): Point[] {
    const points: Point[] = [];
    for (let i = 0; i < this.#along.length; ++i) {
      const before_m = this.#along[Math.max(0, i - 1)]!, along_m = this.#along[i]!;
      if (i === 0 ? distance_m !== 0 : !(before_m < distance_m && distance_m <= along_m)) continue;
      const share = i === 0 ? 1 : (distance_m - before_m) / (along_m - before_m);
      const at = (k: number) => this.#coordinate(Math.max(0, i - 1), k) + share * (this.#coordinate(i, k) - this.#coordinate(Math.max(0, i - 1), k));
      const point: Point = [at(0), at(1)];
      if (points.every(([x, y]) => Math.hypot(x - point[0], y - point[1]) > kApart_m)) points.push(point);
    }
    return points;
  }

  /** Where the robot first was as near to a place as it ever came, within kNear_m: it may have come there again. */
  nearest(x: number, y: number): { distance_m: number; offset_m: number } {
    const segments = this.#segments(x, y);
    const least_m = segments.reduce((least, { offset_m }) => Math.min(least, offset_m), Infinity);
    let first = segments.findIndex(({ offset_m }) => offset_m <= least_m + kNear_m);
    while (first >= 0 && first + 1 < segments.length && segments[first + 1]!.offset_m < segments[first]!.offset_m) ++first;
    return segments[first] ?? { distance_m: 0, offset_m: Infinity };
  }

  #coordinate(i: number, k: number): number { return this.#xyz[3 * i + k]!; }

  #add(x: number, y: number, z: number): void {
    const i = this.#along.length;
    const distanceTo = (j: number) => Math.hypot(x - this.#coordinate(j, 0), y - this.#coordinate(j, 1));
    const step_m = i === 0 ? 0 : distanceTo(i - 1);
    const travelled_m = i === 0 ? 0 : this.#travelled[i - 1]! + step_m;
    let along_m = i === 0 ? 0 : this.#along[i - 1]! + step_m;
    const column = Math.floor(x / kSamePlace_m), row = Math.floor(y / kSamePlace_m);
    for (let cell = 0; cell < 9; ++cell) {
      for (const j of this.#cells.get(`${column + (cell % 3) - 1},${row + Math.floor(cell / 3) - 1}`) ?? []) {
        const there_m = distanceTo(j);
        const isReturn = travelled_m - this.#travelled[j]! > 2 * there_m + kStep_m;  // not a corner that is cut
        const isPlace = there_m <= kSamePlace_m && Math.abs(z - this.#coordinate(j, 2)) <= kSamePlace_m;
        if (isReturn && isPlace) along_m = Math.min(along_m, this.#along[j]! + there_m);
      }
    }
    this.#xyz.push(x, y, z);
    this.#along.push(along_m);
    this.#travelled.push(travelled_m);
    const key = `${column},${row}`;
    const cell = this.#cells.get(key);
    if (cell) cell.push(i);
    else this.#cells.set(key, [i]);
  }

  /** Of each segment its point nearest to a place. */
  #segments(x: number, y: number): { distance_m: number; offset_m: number }[] {
    const found: { distance_m: number; offset_m: number }[] = [];
    for (let i = 1; i < this.#along.length; ++i) {
      const ax = this.#coordinate(i - 1, 0), ay = this.#coordinate(i - 1, 1);
      const dx = this.#coordinate(i, 0) - ax, dy = this.#coordinate(i, 1) - ay;
      const length2 = dx * dx + dy * dy;
      const share = length2 > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / length2)) : 0;
      const along_m = this.#along[i - 1]! + share * (this.#along[i]! - this.#along[i - 1]!);
      found.push({ distance_m: along_m, offset_m: Math.hypot(x - ax - share * dx, y - ay - share * dy) });
    }
    return found;
  }
}
