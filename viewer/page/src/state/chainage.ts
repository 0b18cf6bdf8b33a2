// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Distance along the outbound trajectory, by which places underground are named. */
import { memoized } from "./memoized";
import type { Model } from "./model";
import type { Entity } from "./scene";
import { countWhile } from "./search";

const kNear_m = 1;

export class Chainage {
  #along: number[] = [];
  constructor(private readonly xyz: Float64Array) {
    let sum = 0;
    for (let i = 0; i < xyz.length; i += 3) {
      if (i > 0) sum += Math.hypot(xyz[i]! - xyz[i - 3]!, xyz[i + 1]! - xyz[i - 2]!);
      this.#along.push(sum);
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
  get length_m(): number { return this.#along[this.#along.length - 1] ?? 0; }

  pointAt(distance_m: number): [number, number] | null {
    if (!(distance_m >= 0) || distance_m > this.length_m) return null;
    const i = countWhile(this.#along.length, (k) => this.#along[k]! < distance_m);
    if (i === 0) return [this.xyz[0]!, this.xyz[1]!];
    const share = (distance_m - this.#along[i - 1]!) / (this.#along[i]! - this.#along[i - 1]!);
    const at = (k: number) => this.xyz[3 * (i - 1) + k]! + share * (this.xyz[3 * i + k]! - this.xyz[3 * (i - 1) + k]!);
    return [at(0), at(1)];
  }

  /** Where the robot first was as near to a place as it ever came, within kNear_m: it may have come there again. */
  nearest(x: number, y: number): { distance_m: number; offset_m: number } {
    const segments = this.#segments(x, y);
    const least_m = segments.reduce((least, { offset_m }) => Math.min(least, offset_m), Infinity);
    let first = segments.findIndex(({ offset_m }) => offset_m <= least_m + kNear_m);
    while (first >= 0 && first + 1 < segments.length && segments[first + 1]!.offset_m < segments[first]!.offset_m) ++first;
    return segments[first] ?? { distance_m: 0, offset_m: Infinity };
  }

  /** Of each segment its point nearest to a place. */
  #segments(x: number, y: number): { distance_m: number; offset_m: number }[] {
    const found: { distance_m: number; offset_m: number }[] = [];
    for (let i = 3; i < this.xyz.length; i += 3) {
      const ax = this.xyz[i - 3]!, ay = this.xyz[i - 2]!;
      const dx = this.xyz[i]! - ax, dy = this.xyz[i + 1]! - ay;
      const length2 = dx * dx + dy * dy;
      const share = length2 > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / length2)) : 0;
      found.push({ distance_m: this.#along[i / 3 - 1]! + share * Math.sqrt(length2), offset_m: Math.hypot(x - ax - share * dx, y - ay - share * dy) });
    }
    return found;
  }
}
