// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Rigid transforms: x, y, z in metres and a unit quaternion. */
import { num, raw } from "./values";

export interface Pose {
  x: number;
  y: number;
  z: number;
  q: [number, number, number, number];
}

export const kIdentity: Pose = { x: 0, y: 0, z: 0, q: [0, 0, 0, 1] };

/** Of foxglove.Pose or the two halves of foxglove.FrameTransform; no rotation where it is zero. */
export function poseOf(position: unknown, orientation: unknown): Pose {
  const p = raw(position);
  const o = raw(orientation);
  const q: Pose["q"] = [num(o.x, 0), num(o.y, 0), num(o.z, 0), num(o.w, 0)];
  const norm = Math.hypot(...q);
  const unit: Pose["q"] = norm < 1e-9 ? [0, 0, 0, 1] : [q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm];
  return { x: num(p.x, 0), y: num(p.y, 0), z: num(p.z, 0), q: unit };
}

/** Point of the child in the parent. */
export function apply(pose: Pose, x: number, y: number, z: number): [number, number, number] {
  const [a, b, c, w] = pose.q;
  const tx = 2 * (b * z - c * y);
  const ty = 2 * (c * x - a * z);
  const tz = 2 * (a * y - b * x);
  return [
    pose.x + x + w * tx + (b * tz - c * ty),
    pose.y + y + w * ty + (c * tx - a * tz),
    pose.z + z + w * tz + (a * ty - b * tx),
  ];
}

export function compose(first: Pose, second: Pose): Pose {
  const [x, y, z] = apply(first, second.x, second.y, second.z);
  const [a1, b1, c1, w1] = first.q;
  const [a2, b2, c2, w2] = second.q;
  return {
    x, y, z,
    q: [
      w1 * a2 + a1 * w2 + b1 * c2 - c1 * b2,
      w1 * b2 - a1 * c2 + b1 * w2 + c1 * a2,
      w1 * c2 + a1 * b2 - b1 * a2 + c1 * w2,
      w1 * w2 - a1 * a2 - b1 * b2 - c1 * c2,
    ],
  };
}

/** Rotation about z, in radians. */
export function yawOf(pose: Pose): number {
  const [a, b, c, w] = pose.q;
  return Math.atan2(2 * (w * c + a * b), 1 - 2 * (b * b + c * c));
}

export function poseOfYaw(x: number, y: number, z: number, yaw: number): Pose {
  return { x, y, z, q: [0, 0, Math.sin(yaw / 2), Math.cos(yaw / 2)] };
}

export type Transforms = Map<string, { parent: string; pose: Pose }>;

/** T_map_frame; null where the chain does not end at the map. */
export function poseInMap(transforms: Transforms, frame: string): Pose | null {
  let pose = kIdentity;
  let at = frame;
  for (let depth = 0; depth < 16; ++depth) {
    if (at === "map") return pose;
    const step = transforms.get(at);
    if (!step) return null;
    pose = compose(step.pose, pose);
    at = step.parent;
  }
  return null;
}
