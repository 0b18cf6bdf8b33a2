// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** A point cloud in frame map, metres. */
import { memoized } from "./memoized";
import { fieldOf, readerOf } from "./packed";
import { apply, poseOf } from "./pose";
import { countWhile } from "./search";
import { bytes, num, raw, type Raw } from "./values";

export const kClearanceUnit_m = 0.05;
export const kPointLimit = 4_000_000;

export interface Cloud {
  count: number;
  /** x, y, z of each point. */
  xyz: Float32Array;
  /** Number of the 3D scan of each point. */
  scan: Uint16Array | null;
  /** Height of the roof above the floor there, in units of 0.05 m; 255 unknown. */
  clearance: Uint8Array | null;
  /** Points in the message; more than `count` if thinned to the limit of the page or not finite. */
  received: number;
}

/** Throws an Error where fields or sizes disagree. */
export function cloudOf(message: Raw): Cloud {
  const data = bytes(message.data);
  const stride = num(message.point_stride, 0);
  const fields = ["x", "y", "z"].map((name) => fieldOf(message, name));
  const [fx, fy, fz] = fields;
  if (!fx || !fy || !fz || stride < 1) throw new Error("cloud without x, y, z");
  const received = Math.floor(data.length / stride);
  const step = Math.max(1, Math.ceil(received / kPointLimit));
  const size = Math.ceil(received / step);
  const [xAt, yAt, zAt] = [readerOf(data, fx, stride), readerOf(data, fy, stride), readerOf(data, fz, stride)];
  const scanField = fieldOf(message, "scan");
  const clearanceField = fieldOf(message, "clearance");
  const scanAt = scanField && readerOf(data, scanField, stride);
  const clearanceAt = clearanceField && readerOf(data, clearanceField, stride);
  const xyz = new Float32Array(3 * size);
  const scan = scanAt ? new Uint16Array(size) : null;
  const clearance = clearanceAt ? new Uint8Array(size) : null;
  const pose = message.pose ? poseOf(raw(message.pose).position, raw(message.pose).orientation) : null;
  const moved = pose !== null && (pose.x !== 0 || pose.y !== 0 || pose.z !== 0 || pose.q[3] !== 1);
  let count = 0;
  for (let i = 0; i < received; i += step) {
    const at = i * stride;
    let x = xAt(at), y = yAt(at), z = zAt(at);
    if (!Number.isFinite(x + y + z)) continue;
    if (moved) [x, y, z] = apply(pose, x, y, z);
    xyz[3 * count] = x;
    xyz[3 * count + 1] = y;
    xyz[3 * count + 2] = z;
    if (scan && scanAt) scan[count] = scanAt(at);
    if (clearance && clearanceAt) clearance[count] = clearanceAt(at);
    ++count;
  }
  return {
    count, received, xyz: xyz.subarray(0, 3 * count),
    scan: scan && scan.subarray(0, count), clearance: clearance && clearance.subarray(0, count),
  };
}

/** The points in the order of their scans, so that those up to a scan come first; unchanged without numbers of scans. */
export const sortedByScan = memoized((cloud: Cloud): Cloud => {
  const { scan, count } = cloud;
  if (!scan || scan.every((number, i) => i === 0 || scan[i - 1]! <= number)) return cloud;
  const starts = new Uint32Array(65537);
  for (const number of scan) ++starts[number + 1]!;
  for (let i = 1; i < starts.length; ++i) starts[i]! += starts[i - 1]!;
  const sorted = { ...cloud, xyz: new Float32Array(3 * count), scan: new Uint16Array(count), clearance: cloud.clearance && new Uint8Array(count) };
  for (let i = 0; i < count; ++i) {
    const at = starts[scan[i]!]!++;
    sorted.xyz.set(cloud.xyz.subarray(3 * i, 3 * i + 3), 3 * at);
    sorted.scan[at] = scan[i]!;
    if (sorted.clearance) sorted.clearance[at] = cloud.clearance![i]!;
  }
  return sorted;
});

/** Number of points of a sorted cloud whose scan has at most a number. */
export function countUpTo(cloud: Cloud, scan: number): number {
  if (!cloud.scan) return cloud.count;
  const { scan: numbers } = cloud;
  return countWhile(cloud.count, (i) => numbers[i]! <= scan);
}
