// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * orders.mjs MODULES URL TOKEN
 * Orders by the services of the viewer to a mission of processes: without the token and with another one nothing changes; with it
 * the mission pauses and resumes, a process restarts, and a name that no process has is rejected. Exits with 1 and the differences.
 */
import { createRequire } from "node:module";

const [modules, url, token] = process.argv.slice(2);
const require = createRequire(`${modules}/`);
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const WebSocket = require("ws");
const kDeadlineMs = 60000;

const newest = {};  // message by topic
const waiting = new Set();
const client = new FoxgloveClient({ ws: new WebSocket(url, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]) });
const services = new Promise((resolve) => client.on("advertiseServices", resolve));
const topics = new Map();
client.on("error", (error) => { throw new Error(`error of the client: ${error}`); });
client.on("advertise", (channels) => {
  for (const { id, topic } of channels) if (topic === "/mission" || topic === "/processes") topics.set(client.subscribe(id), topic);
});
client.on("message", ({ subscriptionId, data }) => {
  newest[topics.get(subscriptionId)] = JSON.parse(Buffer.from(data.buffer, data.byteOffset, data.byteLength).toString());
  for (const check of waiting) check();
});

/** Resolves when a condition on the newest messages holds; throws after a minute, with its name. */
function until(name, condition) {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => { waiting.delete(check); reject(new Error(`${name}: not within a minute`)); }, kDeadlineMs);
    const check = () => {
      if (!condition()) return;
      waiting.delete(check);
      clearTimeout(timer);
      resolve();
    };
    waiting.add(check);
    check();
  });
}

const answers = new Map();
client.on("serviceCallResponse", ({ callId }) => answers.get(callId)?.(""));
client.on("serviceCallFailure", ({ callId, message }) => answers.get(callId)?.(message));
/** The reason of the rejection, empty if there is none. */
async function call(name, request) {
  const serviceId = (await services).find((service) => service.name === name).id;
  const callId = answers.size + 1;
  const data = new Uint8Array(Buffer.from(JSON.stringify(request)));
  return new Promise((resolve) => {
    answers.set(callId, resolve);
    client.sendServiceCallRequest({ serviceId, callId, encoding: "json", data });
  });
}
function expect(what, isRight) {
  if (isRight) return;
  console.error(`FAILED: ${what}; mission ${JSON.stringify(newest["/mission"])}`);
  process.exit(1);
}

const phase = () => newest["/mission"]?.phase;
const isUnderWay = () => phase() !== undefined && !["waiting", "paused"].includes(phase());
const pidOf = (name) => newest["/processes"]?.computers?.flatMap((computer) => computer.processes).find((p) => p.name === name)?.pid ?? 0;

await until("the mission is under way", isUnderWay);
expect("an order without a token is not rejected", /token/.test(await call("adit/order", { order: "pause" })));
expect("an order with another token is not rejected", /token/.test(await call("adit/order", { order: "pause", token: `${token}0` })));
expect("an unknown order is not rejected", /return_home/.test(await call("adit/order", { order: "fly", token })));
expect("an order that was rejected has paused the mission", isUnderWay());
expect("pause is rejected", await call("adit/order", { order: "pause", token }) === "");
await until("the mission pauses", () => phase() === "paused");
expect("resume is rejected", await call("adit/order", { order: "resume", token }) === "");
await until("the mission resumes", isUnderWay);

await until("the processes are known", () => pidOf("volume_map") > 0);
const before = pidOf("volume_map");
expect("a restart without a token is not rejected", /token/.test(await call("adit/process", { action: "restart", process: "volume_map" })));
expect("a process that does not exist is not rejected", await call("adit/process", { action: "restart", process: "nobody", token }) !== "");
expect("a restart is rejected", await call("adit/process", { action: "restart", process: "volume_map", token }) === "");
await until("the process restarts", () => pidOf("volume_map") > 0 && pidOf("volume_map") !== before);
expect("stop is rejected", await call("adit/order", { order: "stop", token }) === "");
process.exit(0);
