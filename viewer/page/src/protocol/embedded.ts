// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Messages of a finished mission, kept in the page itself (base64 of gzip). */
import { secondsOf, serverInfoOf, type Channel, type Sink } from "./source";

/** Bytes of base64, in steps so that no huge intermediate text arises. */
export function bytesOfBase64(text: string): Uint8Array {
  const clean = /\s/.test(text) ? text.replace(/\s+/g, "") : text;
  const padding = clean.endsWith("==") ? 2 : clean.endsWith("=") ? 1 : 0;
  const bytes = new Uint8Array(Math.floor(clean.length / 4) * 3 - padding);
  const kStep = 1 << 16;  // a multiple of 4
  let written = 0;
  for (let i = 0; i < clean.length; i += kStep) {
    const part = atob(clean.slice(i, i + kStep));
    for (let k = 0; k < part.length; ++k) bytes[written++] = part.charCodeAt(k);
  }
  return bytes;
}

export async function gunzip(bytes: Uint8Array): Promise<Uint8Array> {
  const stream = new Blob([bytes as BlobPart]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Reports what the decompressed bytes hold; a damaged end is counted, what precedes it is used. */
export function readRecords(bytes: Uint8Array, sink: Sink): void {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const headerLength = view.getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + headerLength))) as {
    serverInfo?: unknown; channels?: Channel[];
  };
  const info = serverInfoOf(header.serverInfo);
  sink.setInfo({ ...info, source: "file", orders: false, canPlay: false });
  sink.addChannels(Array.isArray(header.channels) ? header.channels : []);
  let offset = 4 + headerLength;
  while (offset < bytes.length) {
    if (offset + 16 > bytes.length) return sink.countFault("end of the file");
    const channel = view.getUint32(offset, true);
    const time_s = secondsOf(view.getBigUint64(offset + 4, true));
    const length = view.getUint32(offset + 12, true);
    offset += 16;
    if (offset + length > bytes.length) return sink.countFault("end of the file");
    sink.addMessage(channel, time_s, bytes.subarray(offset, offset + length));
    offset += length;
  }
}

/** False if the page has no mission inside. */
export async function loadEmbedded(sink: Sink): Promise<boolean> {
  const element = document.getElementById("mission-data");
  if (!element) return false;
  try {
    const bytes = bytesOfBase64(element.textContent ?? "");
    element.remove();  // the text is not needed twice
    readRecords(await gunzip(bytes), sink);
    sink.setConnection({ kind: "file" });
  } catch (error) {
    sink.setConnection({ kind: "failed", reason: `the mission in this file cannot be read (${String(error)})` });
  }
  return true;
}
