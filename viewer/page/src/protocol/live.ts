// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Messages of a server, by its WebSocket; connects again after a loss with growing delay. */
import { FoxgloveClient, type IWebSocket } from "@foxglove/ws-protocol";
import { decodePlaybackState, encodePlaybackRequest, kPlaybackStateOpcode, type PlaybackRequest } from "./playback";
import { secondsOf, serverInfoOf, type Channel, type Service, type Sink } from "./source";

const kProtocols = ["foxglove.sdk.v1", "foxglove.websocket.v1"];
const kFirstRetry_s = 0.5;
const kLastRetry_s = 10;
const kCallTimeout_ms = 8000;

/** Hands playback states, which the client of npm does not know, to a handler of their own. */
class FilteredSocket implements IWebSocket {
  binaryType = "arraybuffer";
  onerror: IWebSocket["onerror"] = null;
  onopen: IWebSocket["onopen"] = null;
  onclose: IWebSocket["onclose"] = null;
  onmessage: IWebSocket["onmessage"] = null;
  readonly #socket: WebSocket;

  constructor(socket: WebSocket, onPlayback: (bytes: Uint8Array) => void) {
    this.#socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onopen = (event) => this.onopen?.(event);
    socket.onerror = (event) => this.onerror?.(event);
    socket.onclose = (event) => this.onclose?.(event);
    socket.onmessage = (event) => {
      if (event.data instanceof ArrayBuffer && event.data.byteLength > 0) {
        const bytes = new Uint8Array(event.data);
        if (bytes[0] === kPlaybackStateOpcode) return onPlayback(bytes);
      }
      this.onmessage?.(event);
    };
  }
  get protocol(): string { return this.#socket.protocol; }
  close(): void { this.#socket.close(); }
  send(data: string | ArrayBuffer | ArrayBufferView): void {
    if (this.#socket.readyState === WebSocket.OPEN) this.#socket.send(data as string);
  }
}

interface Call {
  resolve: (answer: unknown) => void;
  reject: (error: Error) => void;
  timer: ReturnType<typeof setTimeout>;
}

export class LiveSource {
  #client: FoxgloveClient | null = null;
  #socket: FilteredSocket | null = null;
  #retry_s = kFirstRetry_s;
  #channelOf = new Map<number, number>();
  #services = new Map<string, Service>();
  #calls = new Map<number, Call>();
  #nextCall = 1;

  /** Subscribes to the channels for which `wanted` holds. */
  constructor(private readonly url: string, private readonly sink: Sink,
              private readonly wanted: (channel: Channel) => boolean) {}

  connect(): void {
    this.sink.setConnection({ kind: "connecting" });
    let socket: FilteredSocket;
    try {
      socket = new FilteredSocket(new WebSocket(this.url, kProtocols), (bytes) => {
        try { this.sink.setPlayback(decodePlaybackState(bytes)); } catch { this.sink.countFault("playback state"); }
      });
    } catch (error) {
      this.sink.setConnection({ kind: "failed", reason: `${this.url}: ${String(error)}` });
      return;
    }
    const client = new FoxgloveClient({ ws: socket });
    this.#socket = socket;
    this.#client = client;
    this.#channelOf.clear();
    this.#services.clear();
    client.on("open", () => this.sink.setConnection({ kind: "open" }));
    client.on("serverInfo", (info) => {
      this.#retry_s = kFirstRetry_s;
      this.sink.setInfo(serverInfoOf(info));
    });
    client.on("advertise", (channels) => this.#advertise(channels));
    client.on("advertiseServices", (services) => {
      if (!Array.isArray(services)) return this.sink.countFault("advertiseServices");
      for (const { id, name } of services) this.#services.set(name, { id, name });
      this.sink.setServices([...this.#services.values()]);
    });
    client.on("unadvertiseServices", (ids) => {
      for (const [name, { id }] of this.#services) if (Array.isArray(ids) && ids.includes(id)) this.#services.delete(name);
      this.sink.setServices([...this.#services.values()]);
    });
    client.on("message", ({ subscriptionId, timestamp, data }) => {
      const channel = this.#channelOf.get(subscriptionId);
      if (channel === undefined) return this.sink.countFault("message without subscription");
      this.sink.addMessage(channel, secondsOf(timestamp), new Uint8Array(data.buffer, data.byteOffset, data.byteLength));
    });
    client.on("time", ({ timestamp }) => this.sink.setTime(secondsOf(timestamp)));
    client.on("serviceCallResponse", ({ callId, data }) => {
      try {
        const text = new TextDecoder().decode(data as ArrayBufferView);
        this.#settle(callId, (call) => call.resolve(text === "" ? {} : JSON.parse(text)));
      } catch {
        this.#settle(callId, (call) => call.reject(new Error("the answer cannot be read")));
      }
    });
    client.on("serviceCallFailure", ({ callId, message }) => {
      this.#settle(callId, (call) => call.reject(new Error(String(message))));
    });
    client.on("error", (error) => {
      // An error of the socket is followed by its close event, which starts the next attempt.
      if (!/WebSocket error/.test(String(error?.message))) this.sink.countFault("frame of the protocol");
    });
    client.on("close", () => this.#lost(client));
  }

  /** Calls a service with a JSON request; rejects with the server's reason. */
  call(service: string, request: unknown): Promise<unknown> {
    const found = this.#services.get(service);
    if (!found || !this.#client) return Promise.reject(new Error("the server takes no orders"));
    const callId = this.#nextCall++;
    const data = new TextEncoder().encode(JSON.stringify(request));
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => {
        this.#settle(callId, (call) => call.reject(new Error("no answer within 8 s; the order may have been executed")));
      }, kCallTimeout_ms);
      this.#calls.set(callId, { resolve, reject, timer });
      this.#client?.sendServiceCallRequest({ serviceId: found.id, callId, encoding: "json", data });
    });
  }

  play(request: PlaybackRequest): void {
    this.#socket?.send(encodePlaybackRequest(request));
  }

  #advertise(channels: unknown): void {
    if (!Array.isArray(channels)) return this.sink.countFault("advertise");
    const usable = (channels as Channel[]).filter((c) => typeof c?.id === "number" && typeof c.topic === "string");
    if (usable.length < channels.length) this.sink.countFault("advertise");
    this.sink.addChannels(usable);
    for (const channel of usable) {
      if (!this.wanted(channel) || !this.#client) continue;
      this.#channelOf.set(this.#client.subscribe(channel.id), channel.id);
    }
  }

  #settle(callId: number, action: (call: Call) => void): void {
    const call = this.#calls.get(callId);
    if (!call) return;
    clearTimeout(call.timer);
    this.#calls.delete(callId);
    action(call);
  }

  #lost(client: FoxgloveClient): void {
    if (client !== this.#client) return;
    this.#client = null;
    for (const id of [...this.#calls.keys()]) this.#settle(id, (call) => call.reject(new Error("connection lost")));
    const retry_s = this.#retry_s;
    this.#retry_s = Math.min(kLastRetry_s, retry_s * 1.7);
    this.sink.setServices([]);
    this.sink.setConnection({ kind: "lost", retry_s });
    setTimeout(() => this.connect(), retry_s * 1000);
  }
}
