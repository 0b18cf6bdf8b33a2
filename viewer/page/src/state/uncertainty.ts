// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** How sure the map is at a distance along the trajectory. */
import { ellipsesOf, type Entity } from "./scene";

/** Major semi-axis (m) of the 95 % ellipse, interpolated between its two neighbours; null beyond the last. */
export function uncertaintyAlong(entities: Entity[], distance_m: number): number | null {
  const along = ellipsesOf(entities).filter((e) => Number.isFinite(e.distance_m)).sort((a, b) => a.distance_m - b.distance_m);
  const after = along.findIndex((e) => e.distance_m >= distance_m);
  const b = along[after];
  const a = along[after - 1] ?? b;
  if (!a || !b) return null;
  const share = b.distance_m > a.distance_m ? (distance_m - a.distance_m) / (b.distance_m - a.distance_m) : 0;
  return a.semiAxis_m + share * (b.semiAxis_m - a.semiAxis_m);
}
