// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * clients.mjs MODULES URL CLIENTS STOPPED
 * Load for the viewer: CLIENTS connections that subscribe to all topics and read them, STOPPED further ones that subscribe and
 * stop reading. Prints a line with the messages and bytes received when the last of the reading ones is disconnected, or on
 * SIGTERM. MODULES is the folder node_modules of the page.
 */
import { createRequire } from "node:module";

const [modules, url, clients, stopped] = process.argv.slice(2);
const require = createRequire(`${modules}/`);
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const WebSocket = require("ws");

const total = { messages: 0, bytes: 0, connected: 0, lost: 0 };
function report() {
  console.log(JSON.stringify(total));
  process.exit(0);
}

for (let i = 0; i < Number(clients) + Number(stopped); ++i) {
  const isStopped = i >= Number(clients);
  const socket = new WebSocket(url, [FoxgloveClient.SUPPORTED_SUBPROTOCOL], { perMessageDeflate: false });
  const client = new FoxgloveClient({ ws: socket });
  client.on("open", () => ++total.connected);
  client.on("error", () => {});  // followed by "close"
  client.on("advertise", (channels) => {
    for (const { id } of channels) client.subscribe(id);
    if (isStopped) socket.pause();
  });
  client.on("message", ({ data }) => {
    ++total.messages;
    total.bytes += data.byteLength;
  });
  client.on("close", () => {
    if (!isStopped && ++total.lost === Number(clients)) report();
  });
}
process.on("SIGTERM", report);
