// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Serves the built page and plays the synthetic mission by npm's FoxgloveServer. */
import { FoxgloveServer } from "@foxglove/ws-protocol";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { WebSocketServer, type WebSocket } from "ws";
import { channels, kStart_s, messagesAt, type Message } from "./mine";
import { builtPage } from "./page";

export const kToken = "synthetic";

export class SyntheticServer {
  readonly orders: unknown[] = [];
  #server: FoxgloveServer;
  #ids = new Map<string, number>();
  #kept = new Map<string, Message[]>();
  #http: Server;
  #sockets = new Set<WebSocket>();
  port = 0;

  constructor(withOrders: boolean) {
    this.#server = new FoxgloveServer({ name: "adit-viewer", capabilities: ["time", ...(withOrders ? ["services"] : [])], supportedEncodings: ["json"], sessionId: "one",
      metadata: { source: "live", title: "Synthetic mine", orders: String(withOrders) } });
    for (const { id: _id, ...channel } of channels) this.#ids.set(channel.topic, this.#server.addChannel(channel));
    const definition = { encoding: "json", schemaName: "order", schemaEncoding: "jsonschema", schema: "{}" };
    if (withOrders) for (const name of ["adit/order", "adit/process"]) this.#server.addService({ name, type: name, request: definition, response: definition });
    this.#server.on("serviceCallRequest", (request, connection) => {
      const { serviceId, callId } = request;
      const order = JSON.parse(Buffer.from(request.data.buffer, request.data.byteOffset, request.data.byteLength).toString()) as { token: string };
      if (order.token !== kToken) return this.#server.sendServiceCallFailure({ op: "serviceCallFailure", serviceId, callId, message: "wrong token" } as never, connection);
      this.orders.push(order);
      return this.#server.sendServiceCallResponse({ serviceId, callId, encoding: "json", data: new Uint8Array(Buffer.from("{}")) }, connection);
    });
    this.#http = createServer((request, response) => {
      if (!request.url?.startsWith("/?") && request.url !== "/") { response.writeHead(404).end(); return; }
      response.writeHead(200, { "content-type": "text/html" }).end(builtPage());
    });
    const sockets = new WebSocketServer({ server: this.#http, handleProtocols: (protocols) => this.#server.handleProtocols(protocols) });
    sockets.on("connection", (socket) => {
      this.#sockets.add(socket);
      socket.on("close", () => this.#sockets.delete(socket));
      this.#server.handleConnection(socket as never, "page");
      // What is kept is sent to who connects late.
      socket.on("message", (text: Buffer, isBinary: boolean) => {
        if (isBinary) return;
        const { op, subscriptions } = JSON.parse(text.toString()) as { op: string; subscriptions: { id: number; channelId: number }[] };
        if (op !== "subscribe") return;
        for (const { id, channelId } of subscriptions) {
          for (const { topic, time_s, data } of [...this.#kept.values()].flat()) {
            if (this.#ids.get(topic) !== channelId) continue;
            const head = Buffer.alloc(13);
            head.writeUInt8(1);
            head.writeUInt32LE(id, 1);
            head.writeBigUInt64LE(BigInt(time_s) * 1_000_000_000n, 5);
            socket.send(Buffer.concat([head, data]));
          }
        }
      });
    });
  }
  listen(port = 0): Promise<void> {
    return new Promise((resolve) => this.#http.listen(port, "127.0.0.1", () => { this.port = (this.#http.address() as AddressInfo).port; resolve(); }));
  }
  publish(t: number): void {
    for (const m of messagesAt(t)) {
      const isQueue = ["/events", "/scans", "/history"].includes(m.topic);
      this.#kept.set(m.topic, isQueue ? [...(this.#kept.get(m.topic) ?? []), m] : [m]);
      this.#server.sendMessage(this.#ids.get(m.topic)!, BigInt(m.time_s) * 1_000_000_000n, m.data as Uint8Array<ArrayBuffer>);
    }
    this.#server.broadcastTime(BigInt(kStart_s + t) * 1_000_000_000n);
  }
  sendHostile(topic: string, t: number, data: Uint8Array): void {
    this.#server.sendMessage(this.#ids.get(topic)!, BigInt(kStart_s + t) * 1_000_000_000n, data as Uint8Array<ArrayBuffer>);
  }
  sendFrame(data: string | Uint8Array): void { for (const socket of this.#sockets) socket.send(data); }
  disconnectAll(): void { for (const socket of this.#sockets) socket.terminate(); }
  close(): void { this.disconnectAll(); this.#http.close(); }
}
