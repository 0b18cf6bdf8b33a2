// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Playback control of foxglove.sdk.v1: client opcode 3, server opcode 5, little-endian. */
import { secondsOf, type PlaybackState } from "./source";

export const kPlaybackStateOpcode = 5;
const kPlaybackControlOpcode = 3;
const kStatus = ["playing", "paused", "buffering", "ended"] as const;

export interface PlaybackRequest {
  play: boolean;
  speed: number;
  /** Seconds since the epoch, or null to stay. */
  seek_s: number | null;
  id: string;
}

export function encodePlaybackRequest(request: PlaybackRequest): Uint8Array {
  const id = new TextEncoder().encode(request.id);
  const bytes = new Uint8Array(19 + id.length);
  const view = new DataView(bytes.buffer);
  view.setUint8(0, kPlaybackControlOpcode);
  view.setUint8(1, request.play ? 0 : 1);
  view.setFloat32(2, request.speed, true);
  view.setUint8(6, request.seek_s === null ? 0 : 1);
  view.setBigUint64(7, BigInt(Math.round((request.seek_s ?? 0) * 1e6)) * 1000n, true);
  view.setUint32(15, id.length, true);
  bytes.set(id, 19);
  return bytes;
}

/** Throws RangeError where bytes are missing, Error at an unknown status. */
export function decodePlaybackState(bytes: Uint8Array): PlaybackState {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const status = kStatus[view.getUint8(1)];
  const current_s = secondsOf(view.getBigUint64(2, true));
  const speed = view.getFloat32(10, true);
  if (status === undefined || !Number.isFinite(speed)) throw new Error("unknown playback status");
  return { status, current_s, speed };
}
