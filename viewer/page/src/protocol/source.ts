// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** What a source of messages (server or embedded file) reports to whoever keeps the state. */

export interface Channel {
  id: number;
  topic: string;
  encoding: string;
  schemaName: string;
  schema: string;
  schemaEncoding?: string;
}

/** Times in seconds since the epoch. */
export interface ServerInfo {
  name: string;
  source: "live" | "log" | "file";
  title: string;
  orders: boolean;
  sessionId: string;
  canPlay: boolean;
  dataStart_s: number | null;
  dataEnd_s: number | null;
}

export type Connection =
  | { kind: "connecting" }
  | { kind: "open" }
  | { kind: "lost"; retry_s: number }
  | { kind: "file" }
  | { kind: "failed"; reason: string };

export interface PlaybackState {
  status: "playing" | "paused" | "buffering" | "ended";
  current_s: number;
  speed: number;
}

export interface Service {
  id: number;
  name: string;
}

export interface Sink {
  setConnection(connection: Connection): void;
  setInfo(info: ServerInfo): void;
  addChannels(channels: Channel[]): void;
  setServices(services: Service[]): void;
  /** Time in seconds since the epoch; the bytes stay valid. */
  addMessage(channelId: number, time_s: number, data: Uint8Array): void;
  setTime(time_s: number): void;
  setPlayback(state: PlaybackState): void;
  /** A message that is none: counted, never an exception. */
  countFault(what: string): void;
}

/** Nanoseconds as number of seconds; the resolution of a double is about 0.3 us for present dates. */
export function secondsOf(time_ns: bigint): number {
  return Number(time_ns / 1000n) / 1e6;
}

function time(value: unknown): number | null {
  if (typeof value === "object" && value !== null && "sec" in value) {
    const { sec, nsec } = value as { sec: unknown; nsec?: unknown };
    return typeof sec === "number" ? sec + (typeof nsec === "number" ? nsec / 1e9 : 0) : null;
  }
  if (typeof value === "number" || typeof value === "string") {
    const number = Number(value);
    if (!Number.isFinite(number) || value === "") return null;
    return number > 1e15 ? number / 1e9 : number;  // ns, unless it is in seconds
  }
  return null;
}

/** Reads serverInfo as received; what is missing or of a wrong type gets a default. */
export function serverInfoOf(value: unknown): ServerInfo {
  const raw = (typeof value === "object" && value !== null ? value : {}) as Record<string, unknown>;
  const metadata = (typeof raw.metadata === "object" && raw.metadata !== null ? raw.metadata : {}) as Record<string, unknown>;
  const capabilities = Array.isArray(raw.capabilities) ? raw.capabilities : [];
  const source = metadata.source === "log" || metadata.source === "file" ? metadata.source : "live";
  return {
    name: typeof raw.name === "string" ? raw.name : "",
    source,
    title: typeof metadata.title === "string" ? metadata.title : "",
    orders: metadata.orders === "true" || metadata.orders === true,
    sessionId: typeof raw.sessionId === "string" ? raw.sessionId : "",
    canPlay: capabilities.includes("playbackControl"),
    dataStart_s: time(raw.dataStartTime),
    dataEnd_s: time(raw.dataEndTime),
  };
}
