// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Colours of points by height, by scan or by the clearance of the roof. */
import { kClearanceUnit_m, type Cloud } from "../state/cloud";

export const kColourings = ["height", "scan", "clearance"] as const;
export type Colouring = (typeof kColourings)[number];

const kClearanceMax_m = 3;
const kGolden = 0.381966;  // consecutive scans differ clearly
const kUnknownClearance = 255;

/** Blue over green to yellow; share from 0 to 1. */
function ramp(share: number): [number, number, number] {
  const s = Math.min(1, Math.max(0, share));
  return [0.2 + 0.75 * s * s, 0.25 + 0.6 * s, 0.75 - 0.6 * s];
}

/** Red, green, blue of each point, from 0 to 1; heights from `low_m` to `high_m`. */
export function coloursOf(cloud: Cloud, by: Colouring, low_m: number, high_m: number): Float32Array {
  const colours = new Float32Array(3 * cloud.count);
  for (let i = 0; i < cloud.count; ++i) {
    let colour: [number, number, number];
    if (by === "scan" && cloud.scan) colour = ramp((cloud.scan[i]! * kGolden) % 1);
    else if (by === "clearance" && cloud.clearance) {
      const value = cloud.clearance[i]!;
      colour = value === kUnknownClearance ? [0.5, 0.5, 0.5] : ramp(value * kClearanceUnit_m / kClearanceMax_m);
    } else colour = ramp((cloud.xyz[3 * i + 2]! - low_m) / Math.max(0.1, high_m - low_m));
    colours.set(colour, 3 * i);
  }
  return colours;
}

/** What the colours mean: the ends of the ramp. */
export function legendOf(by: Colouring, low_m: number, high_m: number): string {
  if (by === "scan") return "a colour for each 3D scan";
  if (by === "clearance") return `blue: roof at 0 m, yellow: at ${kClearanceMax_m} m or more above the floor; grey: unknown`;
  return `blue: ${low_m.toFixed(1)} m, yellow: ${high_m.toFixed(1)} m`;
}
