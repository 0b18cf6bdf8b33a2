// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * play.mjs MODULES URL SPEED
 * Sets the speed of the playback by the protocol (opcode 3 of foxglove.sdk.v1) and expects the state that answers it.
 */
import { createRequire } from "node:module";

const [modules, url, speed] = process.argv.slice(2);
const WebSocket = createRequire(`${modules}/`)("ws");
const socket = new WebSocket(url, ["foxglove.sdk.v1"]);
socket.binaryType = "nodebuffer";
socket.on("open", () => {
  const request = Buffer.alloc(20);
  request.writeUInt8(3, 0);
  request.writeFloatLE(Number(speed), 2);
  request.writeUInt32LE(1, 15);
  request.write("p", 19);
  socket.send(request);
});
socket.on("message", (data, isBinary) => {
  if (!isBinary || data.readUInt8(0) !== 5) return;
  const isAnswer = data.length === 19 && data.toString("latin1", 18) === "p";
  if (isAnswer && data.readFloatLE(10) === Number(speed)) process.exit(0);
});
setTimeout(() => process.exit(1), 5000);
