// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Writes the synthetic mission into the built page: vite-node test/synthetic/embed.ts OUT.html [POINTS], of the last volume. */
import { writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { channels, kDuration_s, messagesAt, summary } from "./mine";
import { builtPage } from "./page";

export function embeddedBytes(step_s = 10, volumePoints = 30_000): Buffer {
  const header = Buffer.from(JSON.stringify({ serverInfo: { op: "serverInfo", name: "adit", capabilities: [], metadata: { source: "file", title: "Synthetic mine", orders: "false" } }, channels }));
  const length = Buffer.alloc(4);
  length.writeUInt32LE(header.length);
  const parts = [length, header];
  const kEach = ["/history", "/mission", "/events", "/scans", "/hazards"];
  const messages = Array.from({ length: kDuration_s + 1 }, (_, t) => messagesAt(t, t === kDuration_s ? volumePoints : undefined).filter((m) => kEach.includes(m.topic) || t % step_s === 0)).flat();
  for (const { topic, time_s, data } of [...messages, summary()]) {
    const head = Buffer.alloc(16);
    head.writeUInt32LE(channels.find((c) => c.topic === topic)!.id, 0);
    head.writeBigUInt64LE(BigInt(time_s) * 1_000_000_000n, 4);
    head.writeUInt32LE(data.length, 12);
    parts.push(head, Buffer.from(data));
  }
  return Buffer.concat(parts);
}

export function writeEmbedded(path: string, volumePoints?: number): void {
  const data = gzipSync(embeddedBytes(10, volumePoints)).toString("base64");
  writeFileSync(path, builtPage().replace("</body>", () => `<script id="mission-data" type="application/octet-stream">${data}</script>\n</body>`));
}

if (process.argv[2]?.endsWith(".html")) writeEmbedded(process.argv[2], process.argv[3] ? Number(process.argv[3]) : undefined);
