// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
//
// read_ros2_mcap.mjs FILE
// Decodes every message of an MCAP file of ROS 2 by the definition in it, with @mcap/core and @foxglove/rosmsg2-serialization, and
// prints one line for each topic: name, type, number of messages, and what the last message says.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";

const require = createRequire(new URL("../export/package.json", import.meta.url));
const { McapStreamReader } = require("@mcap/core");
const { decompress } = require("fzstd");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");

function fail(text) {
  console.error(text);
  process.exit(1);
}

/** What tells whether a message was understood. */
function summary(type, message) {
  if (type.endsWith("LaserScan")) return `${message.ranges.length} beams in ${message.header.frame_id}`;
  if (type.endsWith("PointCloud2")) return `${message.width} points, ${message.data.length / message.point_step} by bytes`;
  if (type.endsWith("OccupancyGrid")) {
    const { width, height } = message.info;
    if (message.data.length !== width * height) fail(`${message.data.length} cells of ${width} x ${height}`);
    return `${width} x ${height}, ${message.data.filter((cell) => cell > 65).length > 0 ? "with" : "without"} walls`;
  }
  if (type.endsWith("TFMessage")) {
    for (const { transform } of message.transforms) {
      const { x, y, z, w } = transform.rotation;
      if (Math.abs(Math.hypot(x, y, z, w) - 1) > 1e-6) fail("a rotation that is none");
    }
    return message.transforms.map((each) => `${each.header.frame_id}>${each.child_frame_id}`).join(" ");
  }
  return message.header.frame_id;
}

const handlers = { zstd: (buffer, size) => decompress(buffer, new Uint8Array(Number(size))) };
const reader = new McapStreamReader({ decompressHandlers: handlers, validateCrcs: true });
reader.append(readFileSync(process.argv[2]));
const schemas = new Map();
const topics = new Map();
for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
  if (record.type === "Header" && record.profile !== "ros2") fail(`profile ${record.profile}`);
  if (record.type === "Schema") schemas.set(record.id, record);
  if (record.type === "Channel" && !topics.has(record.id)) {
    const schema = schemas.get(record.schemaId);
    if (record.messageEncoding !== "cdr" || schema.encoding !== "ros2msg") fail(`${record.topic}: ${schema.encoding}`);
    const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
    topics.set(record.id, { topic: record.topic, type: schema.name, reader: new MessageReader(definition), count: 0, last: "" });
  }
  if (record.type !== "Message") continue;
  const topic = topics.get(record.channelId);
  const message = topic.reader.readMessage(record.data);
  topic.last = summary(topic.type, message);
  topic.count += 1;
}
if (!reader.done()) fail("the file has no end");
for (const { topic, type, count, last } of topics.values()) console.log(`${topic} ${type} ${count} ${last}`);
