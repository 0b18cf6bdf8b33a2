// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * pose_times.mjs lcm FILE | viewer FILE MODULES URL
 * Writes a line "UTIME TIME_MS" to FILE for each pose that arrives: POSE by LCM's multicast, in whose network it must run,
 * or /pose of the viewer. UTIME is the time of measurement in microseconds, TIME_MS the clock of this computer.
 */
import { createSocket } from "node:dgram";
import { openSync, writeSync } from "node:fs";
import { createRequire } from "node:module";

const [source, path, modules, url] = process.argv.slice(2);
const file = openSync(path, "w");
const write = (utime) => writeSync(file, `${utime} ${(performance.timeOrigin + performance.now()).toFixed(3)}\n`);

if (source === "lcm") {
  const kSmallMessage = 0x4c433032;  // "LC02": magic, sequence number, channel, 0, message
  const socket = createSocket({ type: "udp4", reuseAddr: true });
  socket.on("message", (datagram) => {
    if (datagram.readUInt32BE(0) !== kSmallMessage) return;
    const end = datagram.indexOf(0, 8);
    if (datagram.toString("latin1", 8, end) === "POSE") write(datagram.readBigInt64BE(end + 1 + 8));
  });
  socket.bind(7667, () => socket.addMembership("239.255.76.67", "127.0.0.1"));
} else {
  const require = createRequire(`${modules}/`);
  const { FoxgloveClient } = require("@foxglove/ws-protocol");
  const protobuf = require("protobufjs");
  const descriptor = require("protobufjs/ext/descriptor");
  const client = new FoxgloveClient({ ws: new (require("ws"))(url, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]) });
  let type;
  client.on("error", () => {});
  client.on("advertise", (channels) => {
    const channel = channels.find(({ topic }) => topic === "/pose");
    if (!channel) return;
    const schemas = descriptor.FileDescriptorSet.decode(Buffer.from(channel.schema, "base64"));
    type = protobuf.Root.fromDescriptor(schemas).lookupType(channel.schemaName);
    client.subscribe(channel.id);
  });
  client.on("message", ({ data }) => {
    const { seconds, nanos } = type.decode(new Uint8Array(data.buffer, data.byteOffset, data.byteLength)).timestamp;
    write(BigInt(seconds.toString()) * 1000000n + BigInt(Math.round((nanos ?? 0) / 1000)));
  });
  client.on("close", () => process.exit(0));
}
