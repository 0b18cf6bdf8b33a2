// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Scenes (foxglove.SceneUpdate) as lines, places and texts in frame map. */
import { memoized } from "./memoized";
import { apply, poseOf, yawOf, type Pose } from "./pose";
import { list, num, raw, str, type Raw } from "./values";

export interface Polyline {
  /** x, y, z of each point. */
  xyz: Float64Array;
  /** Each two points are a segment of their own. */
  isList: boolean;
  closed: boolean;
}

export interface Entity {
  id: string;
  metadata: Map<string, string>;
  lines: Polyline[];
  arrows: { pose: Pose; length_m: number }[];
  cubes: { pose: Pose; size: [number, number, number] }[];
  texts: { x: number; y: number; z: number; text: string }[];
}

const kPointLimit = 2_000_000;

function poseIn(message: unknown): Pose {
  const pose = raw(raw(message).pose);
  return poseOf(pose.position, pose.orientation);
}

function polylineOf(message: Raw): Polyline {
  const pose = poseIn(message);
  const points = list(message.points);
  const indices = list(message.indices);
  const count = Math.min(kPointLimit, indices.length > 0 ? indices.length : points.length);
  const xyz = new Float64Array(3 * count);
  let used = 0;
  for (let i = 0; i < count; ++i) {
    const point = raw(indices.length > 0 ? points[num(indices[i], -1)] : points[i]);
    const [x, y, z] = apply(pose, num(point.x, 0), num(point.y, 0), num(point.z, 0));
    xyz.set([x, y, z], 3 * used++);
  }
  const type = num(message.type, 0);
  return { xyz: xyz.subarray(0, 3 * used), isList: type === 2, closed: type === 1 };
}

export function entitiesOf(message: Raw): Entity[] {
  return list(message.entities).map((entry) => {
    const entity = raw(entry);
    const metadata = new Map<string, string>();
    for (const pair of list(entity.metadata)) metadata.set(str(raw(pair).key), str(raw(pair).value));
    return {
      id: str(entity.id),
      metadata,
      lines: list(entity.lines).map((line) => polylineOf(raw(line))),
      arrows: list(entity.arrows).map((arrow) => ({
        pose: poseIn(arrow), length_m: num(raw(arrow).shaft_length, 0) + num(raw(arrow).head_length, 0),
      })),
      cubes: list(entity.cubes).map((cube) => {
        const size = raw(raw(cube).size);
        return { pose: poseIn(cube), size: [num(size.x, 0), num(size.y, 0), num(size.z, 0)] };
      }),
      texts: list(entity.texts).map((text) => {
        const { x, y, z } = poseIn(text);
        return { x, y, z, text: str(raw(text).text) };
      }),
    };
  });
}

export interface Frontier {
  key: string;
  id: string;
  state: string;
  evidence: string;
  width_m: number;
  time_s: number;
  x: number;
  y: number;
  z: number;
  heading_rad: number;
}

export const kFrontierStates = ["open", "explored", "blocked", "too narrow", "beyond budget", "unobservable", "outside mine", "unconfirmed"];

export const frontiersOf = memoized((entities: Entity[]): Frontier[] => entities.flatMap((entity) => {
  const arrow = entity.arrows[0];
  const at = arrow?.pose ?? entity.cubes[0]?.pose;
  if (!at) return [];
  const get = (key: string) => entity.metadata.get(key) ?? "";
  return [{
    key: entity.id, id: get("id") || entity.id.replace(/^frontier\s*/, ""), state: get("state") || "unknown", evidence: get("evidence"),
    width_m: parseFloat(get("width_m")), time_s: parseFloat(get("time_s")),
    x: at.x, y: at.y, z: at.z, heading_rad: yawOf(at),
  }];
}));

export interface Hazard {
  key: string;
  kind: string;
  value: string;
  unit: string;
  evidence: string;
  time_s: number;
  x: number;
  y: number;
  z: number;
  yaw_rad: number;
  size: [number, number, number];
}

export const hazardsOf = memoized((entities: Entity[]): Hazard[] => entities.flatMap((entity) => {
  const cube = entity.cubes[0];
  if (!cube) return [];
  const get = (key: string) => entity.metadata.get(key) ?? "";
  return [{
    key: entity.id, kind: get("kind") || "hazard", value: get("value"), unit: get("unit"), evidence: get("evidence"),
    time_s: parseFloat(get("time_s")), x: cube.pose.x, y: cube.pose.y, z: cube.pose.z,
    yaw_rad: yawOf(cube.pose), size: cube.size,
  }];
}));

/** "0.45 m"; empty where nothing was measured. */
export function valueText({ value, unit }: Hazard): string {
  return value === "" || Number(value) === 0 ? "" : `${value} ${unit}`.trim();
}

export interface Ellipse {
  id: string;
  line: Polyline;
  semiAxis_m: number;
  height95_m: number;
  /** Along the outbound trajectory; NaN for the robot itself. */
  distance_m: number;
}

export const ellipsesOf = memoized((entities: Entity[]): Ellipse[] => entities.flatMap((entity) => {
  const line = entity.lines[0];
  if (!line) return [];
  const get = (key: string) => parseFloat(entity.metadata.get(key) ?? "");
  return [{ id: entity.id, line, semiAxis_m: get("semi_axis_m"), height95_m: get("height_95_m"), distance_m: get("distance_m") }];
}));
