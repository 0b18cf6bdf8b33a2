// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A mission in a mine of known geometry: a tunnel of 4.0 m by 110 m along x from the portal at x = 0, and from x = 60 m a drift of
 * 3.0 m by 40 m to the north. The robot drives in along the axis at 1 m/s to x = 100 m, and back.
 */
import { fileURLToPath } from "node:url";
import protobuf from "protobufjs";
import "protobufjs/ext/descriptor";

export const kTunnelWidth_m = 4.0;
export const kDriftWidth_m = 3.0;
export const kStart_s = 1_790_000_000;
export const kDuration_s = 200;
const kCell_m = 0.1;
const kOrigin = { x: -5, y: -6 };
const kColumns = 1250;
const kRows = 540;

const root = new protobuf.Root();
const folder = fileURLToPath(new URL("../../../schemas/", import.meta.url));
root.resolvePath = (_origin, target) => (target.startsWith("google/") ? target : folder + target);
root.loadSync("foxglove.proto", { keepCase: true });
root.resolveAll();
const set = (root as unknown as { toDescriptor(syntax: string): { constructor: { encode(m: unknown): protobuf.Writer } } }).toDescriptor("proto3");
const schema = Buffer.from(set.constructor.encode(set).finish()).toString("base64");

const kTopics: [topic: string, type: string][] = [
  ["/tf", "foxglove.FrameTransforms"], ["/pose", "foxglove.PoseInFrame"], ["/laser/front", "foxglove.LaserScan"], ["/map", "foxglove.Grid"],
  ["/cloud", "foxglove.PointCloud"], ["/volume", "foxglove.PointCloud"], ["/trajectory", "foxglove.SceneUpdate"], ["/path", "foxglove.SceneUpdate"],
  ["/graph", "foxglove.SceneUpdate"], ["/frontiers", "foxglove.SceneUpdate"], ["/hazards", "foxglove.SceneUpdate"], ["/uncertainty", "foxglove.SceneUpdate"],
  ["/mission", "adit.Mission"], ["/processes", "adit.Processes"], ["/events", "foxglove.Log"], ["/scans", "adit.Scan"], ["/history", "adit.History"], ["/summary", "adit.Summary"],
];
export const channels = kTopics.map(([topic, schemaName], i) => ({
  id: i + 1, topic, schemaName, encoding: schemaName.startsWith("adit.") ? "json" : "protobuf",
  schema: schemaName.startsWith("adit.") ? "{}" : schema, schemaEncoding: schemaName.startsWith("adit.") ? "jsonschema" : "protobuf",
}));

export interface Message { topic: string; time_s: number; data: Uint8Array }

function message(topic: string, time_s: number, value: object): Message {
  const channel = channels.find((c) => c.topic === topic)!;
  const data = channel.encoding === "json" ? new TextEncoder().encode(JSON.stringify(value))
    : root.lookupType(channel.schemaName).encode(root.lookupType(channel.schemaName).fromObject(value)).finish();
  return { topic, time_s, data };
}

export function robotAt(t: number): { x: number; y: number; heading: number } {
  return t <= 100 ? { x: t, y: 0, heading: 0 } : { x: 200 - t, y: 0, heading: Math.PI };
}
const yaw = (a: number) => ({ x: 0, y: 0, z: Math.sin(a / 2), w: Math.cos(a / 2) });
/** Timber posts of 0.2 m beside the axis, each 2 m from x = 40 m to 50 m. */
export const isPost = (x: number, y: number) => x > 39.95 && x < 50.15 && ((x + 0.05) % 2) < 0.2 && y > 0.8 && y < 1.0;
const isFree = (x: number, y: number) => (x > 0 && x < 110 && Math.abs(y) < kTunnelWidth_m / 2) || (Math.abs(x - 60) < kDriftWidth_m / 2 && y >= 0 && y < 42);

function grid(t: number): object {
  const reach = Math.min(110, (t <= 100 ? t : 100) + 12);
  const data = Buffer.alloc(kColumns * kRows * 6);
  for (let row = 0, at = 0; row < kRows; ++row) {
    for (let column = 0; column < kColumns; ++column, at += 6) {
      const x = kOrigin.x + (column + 0.5) * kCell_m, y = kOrigin.y + (row + 0.5) * kCell_m;
      const free = isFree(x, y) && !isPost(x, y);
      const edge = 0.3;
      const wall = !free && (isFree(x + edge, y) || isFree(x - edge, y) || isFree(x, y + edge) || isFree(x, y - edge));
      const known = (free || wall) && x < reach && !(y > 30) && (y < 3 || reach > 62);
      data[at + 3] = 255;
      data[at + 4] = !known ? 255 : free ? 0 : 100;
      data[at + 5] = !known ? 0 : Math.abs(y) < 0.5 && x < reach - 12 ? 3 : y < 10 ? 2 : 1;
    }
  }
  const fields = ["red", "green", "blue", "alpha", "occupancy", "coverage"].map((name, offset) => ({ name, offset, type: 1 }));
  return { frame_id: "map", pose: { position: { ...kOrigin, z: 0 }, orientation: { w: 1 } }, column_count: kColumns, cell_size: { x: kCell_m, y: kCell_m },
    row_stride: kColumns * 6, cell_stride: 6, fields, data };
}

function cloud(count: number, x0: number, x1: number): object {
  const data = Buffer.alloc(count * 15);
  for (let i = 0; i < count; ++i) {
    const x = x0 + (x1 - x0) * ((i * 0.618034) % 1);
    const a = 2 * Math.PI * ((i * 0.754878) % 1);
    const at = 15 * i;
    data.writeFloatLE(x, at);
    data.writeFloatLE(Math.max(-2, Math.min(2, 3 * Math.cos(a))), at + 4);
    data.writeFloatLE(Math.max(0, Math.min(2.6, 1.3 + 2 * Math.sin(a))), at + 8);
    data.writeUInt16LE(1 + Math.floor(x / 20), at + 12);
    data[at + 14] = 52;  // 2.6 m
  }
  const fields = [["x", 0, 7], ["y", 4, 7], ["z", 8, 7], ["scan", 12, 3], ["clearance", 14, 1]].map(([name, offset, type]) => ({ name, offset, type }));
  return { frame_id: "map", point_stride: 15, fields, data };
}

const strip = (id: string, points: [number, number][], type = 0) => ({ id, frame_id: "map", lines: [{ type, points: points.map(([x, y]) => ({ x, y, z: 0 })) }] });
const metadata = (values: Record<string, string>) => Object.entries(values).map(([key, value]) => ({ key, value }));

function trajectory(t: number): object {
  const entities = [strip("outbound", Array.from({ length: Math.min(100, Math.floor(t)) + 1 }, (_, x) => [x, 0]))];
  if (t > 100) entities.push(strip("return", Array.from({ length: Math.floor(t) - 99 }, (_, i) => [100 - i, 0.2])));
  return { entities };
}

function frontiers(t: number): object {
  const states: [string, number, number, number, string][] = [
    ["open", 60, 29.5, Math.PI / 2, "unknown ground behind 3.0 m of free width"], ["explored", 12, 0, 0, "driven through"], ["blocked", 109, 1, 0, "water 0.45 m deep"],
    ["too narrow", 109, -1, 0, "0.62 m free, 0.80 m needed"], ["beyond budget", 58.7, 20, Math.PI, "battery"], ["unobservable", 61.4, 25, 0, "no view in 3 scans"],
    ["outside mine", 0, 0, Math.PI, "portal"], ["unconfirmed", 61.4, 10, 0, "one observation"]];
  return { entities: states.filter((s) => s[1] < t + 12 || t > 100).map(([state, x, y, a, evidence], i) => ({
    id: `frontier ${i + 1}`, frame_id: "map", metadata: metadata({ kind: "frontier", id: String(i + 1), state, evidence, width_m: "3.0", time_s: String(kStart_s + 60) }),
    arrows: [{ pose: { position: { x, y, z: 0 }, orientation: yaw(a) }, shaft_length: 1, head_length: 0.4 }],
    texts: [{ pose: { position: { x, y, z: 0 } }, text: `${i + 1}` }] })) };
}

function hazards(): object {
  const places: [string, string, string, number, number, number][] = [["water", "0.45", "m", 106, 0, 4], ["low roof", "1.35", "m", 60, 15, 2], ["gas", "1.2", "% CH4", 80, 0.5, 3], ["drop", "", "", 60, 27, 1.5]];
  return { entities: places.map(([kind, value, unit, x, y, size]) => ({
    id: `${kind} ${x}`, frame_id: "map", metadata: metadata({ kind, value, unit, evidence: "3D scan 5, 212 points", time_s: String(kStart_s + 95) }),
    cubes: [{ pose: { position: { x, y, z: 0 }, orientation: { w: 1 } }, size: { x: size, y: size, z: 0.5 } }], texts: [{ pose: { position: { x, y, z: 0 } }, text: kind }] })) };
}

function ellipses(t: number): object {
  const loop = (id: string, x: number, r: number, distance: string) => ({ ...strip(id, Array.from({ length: 24 }, (_, i) => [x + r * Math.cos(i * Math.PI / 12), r * Math.sin(i * Math.PI / 12)]), 1),
    metadata: metadata({ semi_axis_m: r.toFixed(3), height_95_m: "0.1", distance_m: distance }) });
  return { entities: [loop("robot", robotAt(t).x, 0.3, ""), ...[0, 20, 40, 60, 80, 100].filter((d) => d <= t).map((d) => loop(`at ${d} m`, d, 0.05 + d / 250, String(d)))] };
}

const phaseAt = (t: number) => (t < 4 ? "waiting" : t >= 199 ? "ended" : t % 20 < 3 ? "scan" : t % 20 < 5 ? "plan" : "execute");

/** The messages of the second t of the mission; the volume has `volumePoints` points. */
export function messagesAt(t: number, volumePoints = 30_000): Message[] {
  const time_s = kStart_s + t;
  const robot = robotAt(t);
  const position = { x: robot.x, y: robot.y, z: 0 };
  const orientation = yaw(robot.heading);
  const out = [
    message("/tf", time_s, { transforms: [["map", "odom", {}, { w: 1 }], ["odom", "body", position, orientation], ["body", "laser_front", { x: 0.5 }, { w: 1 }]]
      .map(([parent_frame_id, child_frame_id, translation, rotation]) => ({ parent_frame_id, child_frame_id, translation, rotation })) }),
    message("/pose", time_s, { frame_id: "map", pose: { position, orientation } }),
    message("/laser/front", time_s, { frame_id: "laser_front", start_angle: -1.5, end_angle: 1.5, ranges: Array.from({ length: 181 }, (_, i) => {
      const s = Math.abs(Math.sin(-1.5 + i / 60));
      return s > 0.08 ? 2 / s : 0;
    }) }),
    message("/mission", time_s, { time_s, phase: phaseAt(t), reason: "next frontier 1", scans: Math.floor(t / 20), distance_travelled_m: t, remaining_m: 400 - t, outcome: t > 198 ? "home" : "in progress",
      stopped: t > 150 && t < 160, stop_reason: "methane 1.3 %, limit 1.25 %", driving: "driving", speed_m_s: 1, battery_share: 1 - t / 500, methane_share: 0.002 + (t > 75 ? 0.01 : 0),
      oxygen_share: 0.208, carbon_monoxide_share: 0.00001, position_sd_m: 0.02 + t / 600, match_quality: 0.9, explored_m: Math.min(t, 100), frontiers: { open: 1 }, decision_reason: "nearest" }),
    message("/history", time_s, { rows: [[time_s, robot.x, robot.y, 0, robot.heading, 1, 1 - t / 500, 0.02 + t / 600, 0.002, phaseAt(t)]] }),
  ];
  if (t % 10 === 0) {
    out.push(message("/map", time_s, grid(t)), message("/trajectory", time_s, trajectory(t)), message("/frontiers", time_s, frontiers(t)), message("/uncertainty", time_s, ellipses(t)),
      message("/path", time_s, { entities: [strip("path", [[robot.x, 0], [robot.x + 8 * Math.cos(robot.heading), 0]])] }),
      message("/graph", time_s, { entities: [strip("sequential", Array.from({ length: Math.min(99, t) }, (_, i) => [[i, 0], [i + 1, 0]] as [number, number][]).flat(), 2), strip("loop closures", [[20, 0], [22, 0.5]], 2), strip("revoked", [[40, 0], [60, 12]], 2)] }),
      message("/processes", time_s, { time_s, computers: [{ name: "robot", cpu_load: 0.4, processes: ["mapping", "mission", "driving"].map((name, i) => ({ name, group: "stages", pid: 400 + i, running: true, end: "", cpu_share: 0.1 * i, memory_bytes: 5e7 * (i + 1), restarts: i })) }],
        stages: [{ name: "mapping", level: "ok", reason: "", handled: t * 10, rejected: 0, dropped: 0, age_s: 0.1 }, { name: "driving", level: "degraded", reason: "late input", handled: t, rejected: 1, dropped: 2, age_s: 0.9 }] }));
  }
  if (t === 20 || t === 0) out.push(message("/hazards", time_s, t === 0 ? { entities: [] } : hazards()));
  if (t % 20 === 0) {
    const number = t / 20 + 1;
    out.push(message("/cloud", time_s, cloud(3000, Math.max(0, robot.x - 10), robot.x + 10)), message("/volume", time_s, cloud(volumePoints, 0, Math.max(10, Math.min(100, t)))),
      message("/scans", time_s, { number, id: number, time_s, x: robot.x, y: robot.y, z: 0, heading_rad: robot.heading, laser: "laser_front", points: 3000, complete: true,
        plans: [{ outcome: "path", reason: "clear", reached_m: 8, length_m: 8.4, clearance_m: 0.7 }],
        pictures: { terrain: "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==" } }));
    out.push(message("/events", time_s, { timestamp: { seconds: time_s }, level: t === 160 ? 3 : 2, name: "mission", message: t === 160 ? "loop closure 40-60 revoked" : `3D scan ${number}` }));
  }
  return out;
}

export function summary(): Message {
  return message("/summary", kStart_s + kDuration_s, { headline: "Home; explored 100 m, 10 m seen beyond water, 1 frontier open", paragraphs: ["The robot turned around at 100 m because of water."],
    metrics: [{ label: "driven", value: "200 m" }, { label: "3D scans", value: "11" }], warnings: ["One loop closure was revoked."], files: [{ name: "map.png", note: "plan" }], configuration: "mapping: {}" });
}
