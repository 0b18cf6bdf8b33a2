// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** All that the page knows, by time; a source fills it, the views read it each frame. */
import { decoderOf, type Decoder } from "../protocol/schema";
import type { Channel, Connection, PlaybackState, ServerInfo, Service, Sink } from "../protocol/source";
import { cloudOf } from "./cloud";
import { gridOf } from "./grid";
import { poseOf, type Pose, type Transforms, poseOfYaw } from "./pose";
import { entitiesOf } from "./scene";
import { countWhile } from "./search";
import { Series } from "./series";
import { Timeline } from "./timeline";
import { list, num, raw, str, type Raw } from "./values";

const MB = 1 << 20;

export interface Laser {
  frame: string;
  start_rad: number;
  end_rad: number;
  ranges: number[];
}

export interface HistoryRow {
  time_s: number;
  x: number;
  y: number;
  z: number;
  heading_rad: number;
  speed_m_s: number;
  battery_share: number;
  position_sd_m: number;
  methane_share: number;
  phase: string;
}

export interface EventRow {
  time_s: number;
  level: number;
  name: string;
  message: string;
}

export interface ScanCard {
  number: number;
  time_s: number;
  x: number;
  y: number;
  z: number;
  raw: Raw;
}

/** Level of foxglove.Log from which an event is a warning. */
export const kWarning = 3;

const kHistoryLimit = 40_000;
const kEventLimit = 20_000;
const kScanLimit = 5_000;
const kBudgets_MB: Record<string, number> = { "/map": 64, "/volume": 96, "/cloud": 16, "/mission": 16, "/processes": 16, "/trajectory": 12 };
export const kQueues = ["/events", "/scans", "/history"];
const kLatest = ["/tf", "/pose", "/laser/front", "/laser/rear", "/map", "/cloud", "/volume", "/trajectory", "/path", "/graph",
  "/frontiers", "/hazards", "/uncertainty", "/mission", "/processes", "/summary"];

export function isKnown(channel: Channel): boolean {
  return kLatest.includes(channel.topic) || kQueues.includes(channel.topic);
}

function laserOf(message: Raw): Laser {
  return { frame: str(message.frame_id), start_rad: num(message.start_angle, 0), end_rad: num(message.end_angle, 0),
    ranges: list(message.ranges).map((range) => num(range, 0)) };
}

function transformsOf(message: Raw): Transforms {
  const transforms: Transforms = new Map();
  for (const entry of list(message.transforms)) {
    const t = raw(entry);
    transforms.set(str(t.child_frame_id), { parent: str(t.parent_frame_id), pose: poseOf(t.translation, t.rotation) });
  }
  return transforms;
}

function robotOf(message: Raw): Pose {
  return poseOf(raw(message.pose).position, raw(message.pose).orientation);
}

function insertByTime<T extends { time_s: number }>(rows: T[], row: T, same: (other: T) => boolean): void {
  let at = rows.length;
  while (at > 0 && rows[at - 1]!.time_s > row.time_s) --at;
  for (let i = at - 1; i >= 0 && rows[i]!.time_s === row.time_s; --i) {
    if (same(rows[i]!)) { rows[i] = row; return; }
  }
  rows.splice(at, 0, row);
}

export class Model implements Sink {
  connection: Connection = { kind: "connecting" };
  info: ServerInfo | null = null;
  services: Service[] = [];
  playback: PlaybackState | null = null;
  faults = new Map<string, number>();
  history: HistoryRow[] = [];
  events: EventRow[] = [];
  scans = new Map<number, ScanCard>();
  series = new Map<string, Series>();
  end_s = NaN;
  start_s = NaN;
  revision = 0;
  lastMessage_ms = 0;
  #channels = new Map<number, { topic: string; decode: Decoder }>();
  #decoders = new Map<string, Decoder>();

  readonly tf = this.#timeline("/tf", transformsOf);
  readonly pose = this.#timeline("/pose", robotOf);
  readonly laserFront = this.#timeline("/laser/front", laserOf);
  readonly laserRear = this.#timeline("/laser/rear", laserOf);
  readonly map = this.#timeline("/map", gridOf);
  readonly cloud = this.#timeline("/cloud", cloudOf);
  readonly volume = this.#timeline("/volume", cloudOf);
  readonly trajectory = this.#timeline("/trajectory", entitiesOf);
  readonly path = this.#timeline("/path", entitiesOf);
  readonly graph = this.#timeline("/graph", entitiesOf);
  readonly frontiers = this.#timeline("/frontiers", entitiesOf);
  readonly hazards = this.#timeline("/hazards", entitiesOf);
  readonly uncertainty = this.#timeline("/uncertainty", entitiesOf);
  readonly mission = this.#timeline("/mission", raw);
  readonly processes = this.#timeline("/processes", raw);
  readonly summary = this.#timeline("/summary", raw);
  readonly #byTopic = new Map<string, Timeline<unknown>>([
    ["/tf", this.tf], ["/pose", this.pose], ["/laser/front", this.laserFront], ["/laser/rear", this.laserRear], ["/map", this.map],
    ["/cloud", this.cloud], ["/volume", this.volume], ["/trajectory", this.trajectory], ["/path", this.path], ["/graph", this.graph],
    ["/frontiers", this.frontiers], ["/hazards", this.hazards], ["/uncertainty", this.uncertainty], ["/mission", this.mission],
    ["/processes", this.processes], ["/summary", this.summary],
  ]);

  #timeline<T>(topic: string, convert: (message: Raw) => T): Timeline<T> {
    const decode = (data: Uint8Array) => convert(this.#decoders.get(topic)!(data));
    return new Timeline(decode, (kBudgets_MB[topic] ?? 4) * MB, () => this.countFault(topic));
  }

  get faultCount(): number {
    let count = 0;
    for (const n of this.faults.values()) count += n;
    return count;
  }

  setConnection(connection: Connection): void { this.connection = connection; ++this.revision; }
  setServices(services: Service[]): void { this.services = services; ++this.revision; }
  setPlayback(state: PlaybackState): void {
    if (this.info?.source === "log" && state.current_s < this.end_s - 0.5) {
      for (const timeline of this.#byTopic.values()) timeline.truncate(state.current_s);
    }
    this.playback = state;
    this.end_s = state.current_s;
    ++this.revision;
  }

  /** Another session is another mission: what the last one left is forgotten. */
  setInfo(info: ServerInfo): void {
    if (this.info && this.info.sessionId !== info.sessionId) {
      for (const timeline of this.#byTopic.values()) timeline.truncate(-Infinity);
      this.history = [];
      this.events = [];
      this.scans.clear();
      this.series.clear();
      this.start_s = this.end_s = NaN;
    }
    this.info = info;
    if (info.dataStart_s !== null) this.start_s = info.dataStart_s;
    ++this.revision;
  }

  addChannels(channels: Channel[]): void {
    for (const channel of channels) {
      if (!isKnown(channel)) continue;
      try {
        const decode = decoderOf(channel);
        this.#channels.set(channel.id, { topic: channel.topic, decode });
        this.#decoders.set(channel.topic, decode);
      } catch {
        this.countFault(`schema of ${channel.topic}`);
      }
    }
  }

  addMessage(channelId: number, time_s: number, data: Uint8Array): void {
    const channel = this.#channels.get(channelId);
    if (!channel) return this.countFault("unknown channel");
    if (!(time_s >= 0) || time_s > 1e11) return this.countFault(channel.topic);
    this.lastMessage_ms = Date.now();
    ++this.revision;
    const timeline = this.#byTopic.get(channel.topic);
    if (timeline) {
      timeline.add(time_s, data);
      if (channel.topic === "/mission" || channel.topic === "/processes") this.#sample(channel, time_s, data);
      // Small ones are decoded at once, so that a malformed one is counted even if no view shows it.
      if (data.length < 64 * 1024 && this.info?.source !== "file") timeline.at(time_s);
      if (channel.topic !== "/summary") this.#reach(time_s);
      return;
    }
    try {
      this.#append(channel.topic, channel.decode(data), time_s);
    } catch {
      this.countFault(channel.topic);
    }
  }

  setTime(time_s: number): void { this.lastMessage_ms = Date.now(); this.#reach(time_s); }

  countFault(what: string): void {
    if (this.faults.size < 64 || this.faults.has(what)) this.faults.set(what, (this.faults.get(what) ?? 0) + 1);
    ++this.revision;
  }

  /** The robot at a time: its pose if received then, else between the rows of the history. */
  robotAt(time_s: number): Pose | null {
    const pose = this.pose.at(time_s);
    if (pose && time_s - pose.time_s < 0.6) return pose.value;
    const rows = this.history;
    const after = countWhile(rows.length, (i) => rows[i]!.time_s <= time_s);
    const before = rows[after - 1];
    const next = rows[after];
    if (!before || (pose && pose.time_s > before.time_s && !next)) return pose?.value ?? null;
    const share = next && next.time_s - before.time_s < 5 ? (time_s - before.time_s) / (next.time_s - before.time_s) : 0;
    const mix = (a: number, b: number) => a + share * (b - a);
    const turn = next ? Math.atan2(Math.sin(next.heading_rad - before.heading_rad), Math.cos(next.heading_rad - before.heading_rad)) : 0;
    const to = next ?? before;
    return poseOfYaw(mix(before.x, to.x), mix(before.y, to.y), mix(before.z, to.z), before.heading_rad + share * turn);
  }

  /** The 3D scans up to a time, by number. */
  scansUntil(time_s: number): ScanCard[] {
    return [...this.scans.values()].filter((scan) => scan.time_s <= time_s).sort((a, b) => a.number - b.number);
  }

  #reach(time_s: number): void {
    if (!(this.start_s <= time_s)) this.start_s = time_s;
    if (!(this.end_s >= time_s)) this.end_s = time_s;
  }

  /** Samples for the plots; what cannot be decoded is counted by its timeline. */
  #sample(channel: { topic: string; decode: Decoder }, time_s: number, data: Uint8Array): void {
    let message: Raw;
    try { message = channel.decode(data); } catch { return; }
    if (channel.topic === "/mission") {
      this.#add("speed", time_s, num(message.speed_m_s));
      this.#add("battery", time_s, 100 * num(message.battery_share));
      this.#add("methane", time_s, 100 * num(message.methane_share));
      this.#add("oxygen", time_s, 100 * num(message.oxygen_share));
      this.#add("carbon monoxide", time_s, 1e6 * num(message.carbon_monoxide_share));
      this.#add("match quality", time_s, num(message.match_quality));
      this.#add("position sd", time_s, num(message.position_sd_m));
      return;
    }
    for (const computer of list(message.computers)) {
      for (const entry of list(raw(computer).processes)) {
        const process = raw(entry);
        this.#add(`cpu ${str(process.name)}`, time_s, 100 * num(process.cpu_share));
        this.#add(`memory ${str(process.name)}`, time_s, num(process.memory_bytes) / 1048576);
      }
    }
  }

  #add(key: string, time_s: number, value: number): void {
    if (!Number.isFinite(value)) return;
    let series = this.series.get(key);
    if (!series && this.series.size < 200) this.series.set(key, (series = new Series()));
    series?.add(time_s, value);
  }

  #append(topic: string, message: Raw, time_s: number): void {
    if (topic === "/history") {
      const rows = Array.isArray(message) ? message : list(message.rows);
      for (const entry of rows) {
        const row = list(entry);
        const time = num(row[0]);
        if (Number.isNaN(time + num(row[1]) + num(row[2]))) { this.countFault(topic); continue; }
        insertByTime(this.history, {
          time_s: time, x: num(row[1]), y: num(row[2]), z: num(row[3], 0), heading_rad: num(row[4], 0), speed_m_s: num(row[5]),
          battery_share: num(row[6]), position_sd_m: num(row[7]), methane_share: num(row[8]), phase: str(row[9]),
        }, () => true);
        this.#add("speed", time, num(row[5]));
        this.#add("battery", time, 100 * num(row[6]));
        this.#add("position sd", time, num(row[7]));
        this.#add("methane", time, 100 * num(row[8]));
        this.#reach(time);
      }
      if (this.history.length > kHistoryLimit) this.history = this.history.filter((_, i) => i % 2 === 0 || i > kHistoryLimit / 2);
    } else if (topic === "/events") {
      const stamp = raw(message.timestamp);
      const own = num(stamp.seconds) + num(stamp.nanos, 0) / 1e9;
      const event = { time_s: own > 0 ? own : time_s, level: num(message.level, 0), name: str(message.name), message: str(message.message) };
      insertByTime(this.events, event, (other) => other.message === event.message && other.name === event.name);
      if (this.events.length > kEventLimit) this.events.shift();
    } else {
      const number = num(message.number);
      if (Number.isNaN(number)) throw new Error("scan without number");
      this.scans.set(number, { number, time_s: num(message.time_s, time_s), x: num(message.x), y: num(message.y), z: num(message.z, 0), raw: message });
      if (this.scans.size > kScanLimit) this.scans.delete(this.scans.keys().next().value!);
    }
  }
}
