// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Decodes messages by the schema that their channel advertises. */
import protobuf from "protobufjs";
import descriptor from "protobufjs/ext/descriptor";
import { bytesOfBase64 } from "./embedded";
import type { Channel } from "./source";

export type Decoder = (data: Uint8Array) => Record<string, unknown>;

interface DescriptorRoot {
  fromDescriptor(set: unknown): protobuf.Root;
}

const kText = new TextDecoder("utf-8", { fatal: true });
const roots = new Map<string, protobuf.Root>();

function decodeJson(data: Uint8Array): Record<string, unknown> {
  const value: unknown = JSON.parse(kText.decode(data));
  if (typeof value !== "object" || value === null) throw new Error("JSON without an object");
  return value as Record<string, unknown>;
}

/** Throws an Error where the encoding is unknown or the schema cannot be read. */
export function decoderOf(channel: Channel): Decoder {
  if (channel.encoding === "json") return decodeJson;
  if (channel.encoding !== "protobuf") throw new Error(`encoding ${channel.encoding}`);
  let root = roots.get(channel.schema);
  if (!root) {
    const set = descriptor.FileDescriptorSet.decode(bytesOfBase64(channel.schema));
    root = (protobuf.Root as unknown as DescriptorRoot).fromDescriptor(set);
    if (roots.size < 32) roots.set(channel.schema, root);
  }
  const type = root.lookupType(channel.schemaName);
  return (data) => type.decode(data) as unknown as Record<string, unknown>;
}
