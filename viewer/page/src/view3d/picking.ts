// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The point of a cloud below the pointer. */
import * as THREE from "three";
import type { Cloud } from "../state/cloud";

const kPick_px = 8;

/** Of the first `count` points up to a height those within 8 pixels of the pointer, the nearest to the eye; null without any. */
export function pick(cloud: Cloud, count: number, top_m: number, camera: THREE.Camera, size: { width: number; height: number }, px: number, py: number): THREE.Vector3 | null {
  const point = new THREE.Vector3();
  let best: THREE.Vector3 | null = null;
  let bestCost = Infinity;
  for (let i = 0; i < count; ++i) {
    const z = cloud.xyz[3 * i + 2]!;
    if (z > top_m) continue;
    point.set(cloud.xyz[3 * i]!, cloud.xyz[3 * i + 1]!, z).project(camera);
    if (point.z > 1) continue;
    const distance_px = Math.hypot((point.x + 1) * size.width / 2 - px, (1 - point.y) * size.height / 2 - py);
    const cost = distance_px + 1e3 * point.z;
    if (distance_px > kPick_px || cost >= bestCost) continue;
    bestCost = cost;
    best = new THREE.Vector3(cloud.xyz[3 * i]!, cloud.xyz[3 * i + 1]!, z);
  }
  return best;
}
