// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * client.mjs MODULES URL LOG|- [SECONDS]
 * An independent client of the viewer: subscribes to all topics by npm's @foxglove/ws-protocol, decodes each message by the schema
 * that its channel advertises, and compares what it says with the messages of the LCM log, which it reads itself. Without
 * a log (-) it only expects the topics. MODULES is the folder node_modules of the page. Exits with 1 and the differences.
 */
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const [modules, url, logPath, seconds] = process.argv.slice(2);
const require = createRequire(`${modules}/`);
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const WebSocket = require("ws");
const protobuf = require("protobufjs");
const descriptor = require("protobufjs/ext/descriptor");

const failures = [];
const fail = (text) => { if (failures.length < 20) failures.push(text); };
const isNear = (a, b, tolerance) => Math.abs(a - b) <= tolerance;

/** Messages of an LCM log by channel and by time of measurement, which is the first field of each. */
function readLog(path) {
  const wanted = new Set(["POSE", "LASER_FRONT", "LASER_REAR", "VEHICLE_STATE"]);
  const bytes = readFileSync(path);
  const messages = new Map([...wanted].map((channel) => [channel, new Map()]));
  for (let at = 0; at + 28 <= bytes.length;) {
    if (bytes.readUInt32BE(at) !== 0xeda1da01) throw new Error("not an LCM log");
    const nameLength = bytes.readUInt32BE(at + 20);
    const length = bytes.readUInt32BE(at + 24);
    const name = bytes.toString("latin1", at + 28, at + 28 + nameLength);
    const data = bytes.subarray(at + 28 + nameLength, at + 28 + nameLength + length);
    at += 28 + nameLength + length;
    if (wanted.has(name)) messages.get(name).set(data.readBigInt64BE(8), data);
  }
  return messages;
}

const doublesAt = (data, at, count) => Array.from({ length: count }, (_, i) => data.readDoubleBE(at + 8 * i));
const utimeOf = (stamp) => BigInt(stamp.seconds.toString()) * 1000000n + BigInt(Math.round((stamp.nanos ?? 0) / 1000));

const log = logPath === "-" ? null : readLog(logPath);
/** Speed and battery of each VEHICLE_STATE, which /mission has beside the time of whatever message was the newest. */
const vehicleStates = new Set([...(log?.get("VEHICLE_STATE").values() ?? [])].map((data) => {
  const [speed, , battery] = doublesAt(data, 16, 3);
  return `${speed} ${battery}`;
}));
let compared = { pose: 0, laser: 0, vehicle: 0 };
let T_map_odom = null;
let walls = 0;  // cells of the newest /map

function multiply(a, b) {  // quaternions x y z w
  return [a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
    a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]];
}
function rotate(q, p) {
  const r = multiply(multiply(q, [...p, 0]), [-q[0], -q[1], -q[2], q[3]]);
  return r.slice(0, 3);
}
const vector = (v) => [v?.x ?? 0, v?.y ?? 0, v?.z ?? 0];
const quaternion = (q) => [q?.x ?? 0, q?.y ?? 0, q?.z ?? 0, q?.w ?? 0];

const checks = {
  "/tf"(message) {
    const odom = message.transforms.find((t) => t.child_frame_id === "odom");
    const body = message.transforms.find((t) => t.child_frame_id === "body");
    T_map_odom = { utime: utimeOf(body.timestamp), p: vector(odom.translation), q: quaternion(odom.rotation), body };
    const data = log.get("POSE").get(utimeOf(body.timestamp));
    if (!data) return fail(`/tf has a time that POSE has not: ${utimeOf(body.timestamp)}`);
    const p = doublesAt(data, 16, 3);
    const [w, x, y, z] = doublesAt(data, 64, 4);
    vector(body.translation).forEach((value, i) => { if (!isNear(value, p[i], 1e-9)) fail(`/tf position ${value}, POSE ${p[i]}`); });
    const q = quaternion(body.rotation);
    const dot = Math.abs(q[0] * x + q[1] * y + q[2] * z + q[3] * w);
    if (!isNear(dot, 1, 1e-9)) fail(`/tf rotation differs from POSE: ${q} ${[x, y, z, w]}`);
    ++compared.pose;
  },
  "/pose"(message) {
    if (message.frame_id !== "map") fail(`/pose in ${message.frame_id}`);
    if (!T_map_odom || T_map_odom.utime !== utimeOf(message.timestamp)) return;
    const inMap = rotate(T_map_odom.q, vector(T_map_odom.body.translation)).map((value, i) => value + T_map_odom.p[i]);
    vector(message.pose.position).forEach((value, i) => { if (!isNear(value, inMap[i], 1e-9)) fail(`/pose ${value}, by /tf ${inMap[i]}`); });
  },
  "/mission"(message) {
    if (typeof message.speed_m_s !== "number") return;
    if (!vehicleStates.has(`${message.speed_m_s} ${message.battery_share}`)) fail(`/mission: no VEHICLE_STATE has speed ${message.speed_m_s} and battery ${message.battery_share}`);
    ++compared.vehicle;
  },
  "/map"(message) {
    const field = message.fields.find((f) => f.name === "occupancy");
    walls = 0;
    for (let at = field.offset ?? 0; at < message.data.length; at += message.cell_stride) if (message.data[at] >= 65 && message.data[at] <= 100) ++walls;
  },
};
for (const [topic, channel] of [["/laser/front", "LASER_FRONT"], ["/laser/rear", "LASER_REAR"]]) {
  checks[topic] = (message) => {
    const data = log.get(channel).get(utimeOf(message.timestamp));
    if (!data) return fail(`${topic} has a time that ${channel} has not`);
    const count = data.readInt32BE(16);
    if (message.ranges.length !== count) return fail(`${topic} has ${message.ranges.length} beams, ${channel} ${count}`);
    for (let i = 0; i < count; ++i) {
      const range = data.readFloatBE(20 + 4 * i);
      if (message.ranges[i] !== range && message.ranges[i] !== 0) fail(`${topic} beam ${i}: ${message.ranges[i]}, ${channel} ${range}`);
    }
    const first = data.readFloatBE(20 + 4 * count + 4);
    if (!isNear(message.start_angle, first, 1e-6)) fail(`${topic} begins at ${message.start_angle}, ${channel} at ${first}`);
    ++compared.laser;
  };
}

function decoderOf(channel) {
  if (channel.encoding === "json") return (data) => JSON.parse(Buffer.from(data).toString());
  const root = protobuf.Root.fromDescriptor(descriptor.FileDescriptorSet.decode(Buffer.from(channel.schema, "base64")));
  const type = root.lookupType(channel.schemaName);
  return (data) => type.decode(data);
}

const channels = new Map();
const received = new Map();
const client = new FoxgloveClient({ ws: new WebSocket(url, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]) });
client.on("error", (error) => fail(`error of the client: ${error}`));
client.on("advertise", (advertised) => {
  for (const channel of advertised) {
    try {
      channels.set(client.subscribe(channel.id), { topic: channel.topic, decode: decoderOf(channel) });
    } catch (error) {
      fail(`${channel.topic}: its schema cannot be read: ${error}`);
    }
  }
});
client.on("message", ({ subscriptionId, data }) => {
  const { topic, decode } = channels.get(subscriptionId);
  received.set(topic, (received.get(topic) ?? 0) + 1);
  try {
    const message = decode(new Uint8Array(data.buffer, data.byteOffset, data.byteLength));
    if (log) checks[topic]?.(message);
  } catch (error) {
    fail(`${topic} cannot be decoded by its schema: ${error}`);
  }
});
client.on("close", () => fail("the connection was lost"));

setTimeout(() => {
  const expected = log ? [...channels.values()].map((c) => c.topic) : ["/tf", "/pose", "/laser/front", "/laser/rear", "/mission", "/processes"];
  if (channels.size === 0) fail("no channel was advertised");
  for (const topic of expected) if (!received.has(topic)) fail(`no message on ${topic}`);
  if (log && (compared.pose < 20 || compared.laser < 20 || compared.vehicle < 1)) fail(`too few messages were compared: ${JSON.stringify(compared)}`);
  if (log && walls < 100) fail(`the last /map has ${walls} cells of walls`);
  console.log(JSON.stringify({ received: Object.fromEntries(received), compared }));
  for (const failure of failures) console.error(failure);
  process.exit(failures.length > 0 ? 1 : 0);
}, 1000 * Number(seconds ?? 5));
