// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
//
// read_mcap.mjs FILE
// Reads an MCAP file with npm's @mcap/core, by its index: decodes every message by the schema of its channel, and compares
// order and counts with the statistics, the indexes and a reading from front to back. Prints one line for each topic.
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { decompress } from "fzstd";
import { open, readFile, stat } from "node:fs/promises";
import protobuf from "protobufjs";
import descriptor from "protobufjs/ext/descriptor/index.js";

const kHandlers = { zstd: (buffer, size) => decompress(buffer, new Uint8Array(Number(size))) };

function fail(text) {
  console.error(text);
  process.exit(1);
}

/** Decodes the messages of a channel by its schema; throws for one that does not fit. */
function decoderOf(channel, schema) {
  if (channel.messageEncoding === "json") {
    if (schema.encoding !== "jsonschema") fail(`${channel.topic}: schema encoding ${schema.encoding}`);
    JSON.parse(new TextDecoder().decode(schema.data));
    return (data) => JSON.parse(new TextDecoder().decode(data));
  }
  if (channel.messageEncoding !== "protobuf" || schema.encoding !== "protobuf") {
    fail(`${channel.topic}: encoding ${channel.messageEncoding}, schema ${schema.encoding}`);
  }
  const set = descriptor.FileDescriptorSet.decode(schema.data);
  const type = protobuf.Root.fromDescriptor(set).lookupType(schema.name);
  return (data) => {
    const message = type.decode(data);
    const error = type.verify(message);
    if (error) throw new Error(error);
    if (type.encode(message).finish().length !== data.length) throw new Error("fields that the schema does not have");
    return message;
  };
}

async function readIndexed(path) {
  const file = await open(path);
  const { size } = await stat(path);
  const readable = {
    size: async () => BigInt(size),
    read: async (offset, length) => {
      const bytes = new Uint8Array(Number(length));
      await file.read(bytes, 0, Number(length), Number(offset));
      return bytes;
    },
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers: kHandlers });
  const decoders = new Map();
  const counts = new Map();
  let last = 0n;
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    const schema = reader.schemasById.get(channel.schemaId);
    if (!decoders.has(channel.id)) decoders.set(channel.id, decoderOf(channel, schema));
    try {
      decoders.get(channel.id)(message.data);
    } catch (error) {
      fail(`${channel.topic} at ${message.logTime}: ${error.message}`);
    }
    if (message.logTime < last) fail(`${channel.topic}: ${message.logTime} after ${last}`);
    last = message.logTime;
    const sequence = counts.get(channel.id) ?? 0;
    if (message.sequence !== sequence) fail(`${channel.topic}: sequence ${message.sequence}, not ${sequence}`);
    counts.set(channel.id, sequence + 1);
  }
  await file.close();
  return { reader, counts };
}

/** The messages by channel, in the order of the file, with every checksum. */
async function countStreamed(path) {
  const reader = new McapStreamReader({ decompressHandlers: kHandlers, validateCrcs: true });
  const times = new Map();
  reader.append(await readFile(path));
  let last = 0n;
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
    if (record.type !== "Message") continue;
    if (record.logTime < last) fail(`in the order of the file ${record.logTime} after ${last}`);
    last = record.logTime;
    times.set(record.channelId, (times.get(record.channelId) ?? 0) + 1);
  }
  if (!reader.done()) fail("the file has no end");
  return times;
}

const path = process.argv[2];
const { reader, counts } = await readIndexed(path);
const streamed = await countStreamed(path);
const statistics = reader.statistics;
let total = 0;
for (const [id, channel] of reader.channelsById) {
  const count = counts.get(id) ?? 0;
  total += count;
  if (count !== (streamed.get(id) ?? 0)) fail(`${channel.topic}: ${count} by the index, ${streamed.get(id)} in the file`);
  if (BigInt(count) !== (statistics.channelMessageCounts.get(id) ?? 0n)) fail(`${channel.topic}: other count in the statistics`);
  console.log(`${channel.topic} ${reader.schemasById.get(channel.schemaId).name} ${count}`);
}
if (BigInt(total) !== statistics.messageCount) fail(`${total} messages, ${statistics.messageCount} in the statistics`);
if (total === 0) fail("no message");
if (reader.chunkIndexes.length !== statistics.chunkCount) fail("other number of chunks in the statistics");
console.log(`${total} messages in ${statistics.chunkCount} chunks`);
