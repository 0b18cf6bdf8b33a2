// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
//
// write_ros2_mcap.mjs CARMEN_LOG FOLDER
// Writes the readings of a CARMEN log as messages of ROS 2, serialized by @foxglove/rosmsg2-serialization from the
// definitions of common_interfaces, with @mcap/core: none.mcap and, where the commands zstd and lz4 are, zstd.mcap and
// lz4.mcap; and messages.tsv (topic, type, time in ns, bytes in hexadecimal) for write_rosbag2_database.py.
import { execFileSync, spawnSync } from "node:child_process";
import { closeSync, openSync, readFileSync, writeFileSync, writeSync } from "node:fs";
import { createRequire } from "node:module";

// The packages of tests/live/export.
const require = createRequire(new URL("../export/package.json", import.meta.url));
const { McapWriter } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const { MessageWriter } = require("@foxglove/rosmsg2-serialization");

const kSeparator = "=".repeat(80);
const kHeader = `${kSeparator}
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
`;
const kVectors = `${kSeparator}
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
${kSeparator}
MSG: geometry_msgs/Quaternion
float64 x 0
float64 y 0
float64 z 0
float64 w 1
`;
const kDefinitions = {
  "sensor_msgs/msg/LaserScan": `std_msgs/Header header # timestamp in the header is the acquisition time of
float32 angle_min            # start angle of the scan [rad]
float32 angle_max            # end angle of the scan [rad]
float32 angle_increment      # angular distance between measurements [rad]
float32 time_increment       # time between measurements [seconds]
float32 scan_time            # time between scans [seconds]
float32 range_min            # minimum range value [m]
float32 range_max            # maximum range value [m]
float32[] ranges             # range data [m]
float32[] intensities        # intensity data [device-specific units].
${kHeader}`,
  "nav_msgs/msg/Odometry": `std_msgs/Header header
string child_frame_id
geometry_msgs/PoseWithCovariance pose
geometry_msgs/TwistWithCovariance twist
${kHeader}${kSeparator}
MSG: geometry_msgs/PoseWithCovariance
Pose pose
float64[36] covariance
${kSeparator}
MSG: geometry_msgs/Pose
Point position
Quaternion orientation
${kSeparator}
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
${kSeparator}
MSG: geometry_msgs/TwistWithCovariance
Twist twist
float64[36] covariance
${kSeparator}
MSG: geometry_msgs/Twist
Vector3  linear
Vector3  angular
${kVectors}`,
  "tf2_msgs/msg/TFMessage": `geometry_msgs/TransformStamped[] transforms
${kSeparator}
MSG: geometry_msgs/TransformStamped
std_msgs/Header header
string child_frame_id
geometry_msgs/Transform transform
${kSeparator}
MSG: geometry_msgs/Transform
Vector3 translation
Quaternion rotation
${kHeader}${kVectors}`,
};
const writers = Object.fromEntries(
  Object.entries(kDefinitions).map(([type, text]) => [type, new MessageWriter(parse(text, { ros2: true }))]),
);

function stampOf(text) {
  const [sec, fraction = ""] = text.split(".");
  return { sec: Number(sec), nanosec: Number(fraction.padEnd(9, "0").slice(0, 9)) };
}

function* readings(path) {
  let first = true;
  for (const line of readFileSync(path, "ascii").split("\n")) {
    const fields = line.split(" ");
    if (fields[0] !== "FLASER") continue;
    const beams = Number(fields[1]);
    const [x, y, theta] = fields.slice(beams + 5, beams + 8).map(Number);
    const stamp = stampOf(fields[beams + 8]);
    const header = (frame_id) => ({ stamp, frame_id });
    const none = { x: 0, y: 0, z: 0 };
    if (first) {
      const transform = { translation: none, rotation: { ...none, w: 1 } };
      const transforms = [{ header: header("base_link"), child_frame_id: "laser", transform }];
      yield { topic: "/tf_static", type: "tf2_msgs/msg/TFMessage", stamp, message: { transforms } };
    }
    first = false;
    const orientation = { x: 0, y: 0, z: Math.sin(0.5 * theta), w: Math.cos(0.5 * theta) };
    const covariance = new Float64Array(36);
    const pose = { pose: { position: { x, y, z: 0 }, orientation }, covariance };
    const twist = { twist: { linear: none, angular: none }, covariance };
    const odometry = { header: header("odom"), child_frame_id: "base_link", pose, twist };
    yield { topic: "/odom", type: "nav_msgs/msg/Odometry", stamp, message: odometry };
    const scan = {
      header: header("laser"),
      angle_min: -0.5 * Math.PI,
      angle_max: 0.5 * Math.PI,
      angle_increment: Math.PI / (beams - (beams % 2)),
      time_increment: 0,
      scan_time: 0,
      range_min: 0.1,
      range_max: 50,
      ranges: new Float32Array(fields.slice(2, beams + 2).map(Number)),
      intensities: new Float32Array(0),
    };
    yield { topic: "/scan", type: "sensor_msgs/msg/LaserScan", stamp, message: scan };
  }
}

async function writeMcap(path, all, compression) {
  const file = openSync(path, "w");
  let position = 0n;
  const writable = {
    position: () => position,
    write: async (bytes) => {
      writeSync(file, bytes);
      position += BigInt(bytes.byteLength);
    },
  };
  const pack = (bytes) => ({
    compression,
    compressedData: new Uint8Array(execFileSync(compression, ["-q", "-c"], { input: bytes, maxBuffer: 1 << 28 })),
  });
  const writer = new McapWriter({ writable, chunkSize: 60_000, compressChunk: compression ? pack : undefined });
  await writer.start({ profile: "ros2", library: "" });
  const channels = new Map();
  for (const { topic, type, time, bytes } of all) {
    if (!channels.has(topic)) {
      const data = new TextEncoder().encode(kDefinitions[type]);
      const schemaId = await writer.registerSchema({ name: type, encoding: "ros2msg", data });
      channels.set(topic, await writer.registerChannel({ topic, schemaId, messageEncoding: "cdr", metadata: new Map() }));
    }
    await writer.addMessage({ channelId: channels.get(topic), sequence: 0, logTime: time, publishTime: time, data: bytes });
  }
  await writer.end();
  closeSync(file);
}

const [log, folder] = process.argv.slice(2);
const all = [...readings(log)].map(({ topic, type, stamp, message }) => ({
  topic,
  type,
  time: BigInt(stamp.sec) * 1_000_000_000n + BigInt(stamp.nanosec),
  bytes: writers[type].writeMessage(message),
}));
await writeMcap(`${folder}/none.mcap`, all, "");
for (const compression of ["zstd", "lz4"]) {
  if (spawnSync(compression, ["--version"]).status === 0) await writeMcap(`${folder}/${compression}.mcap`, all, compression);
}
writeFileSync(
  `${folder}/messages.tsv`,
  all.map(({ topic, type, time, bytes }) => `${topic}\t${type}\t${time}\t${Buffer.from(bytes).toString("hex")}\n`).join(""),
);
