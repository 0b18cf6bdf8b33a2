// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Reads one field of packed cells or points (foxglove.PackedElementField). */
import { list, num, raw, str, type Raw } from "./values";

const kSize = [0, 1, 1, 2, 2, 4, 4, 4, 8];

export interface PackedField {
  offset: number;
  type: number;
}

export function fieldOf(message: Raw, name: string): PackedField | null {
  for (const entry of list(message.fields)) {
    const field = raw(entry);
    if (str(field.name) === name) return { offset: num(field.offset, 0), type: num(field.type, 0) };
  }
  return null;
}

/** Reader of the field of the element at a byte; throws where the field does not fit in the stride. */
export function readerOf(data: Uint8Array, field: PackedField, stride: number): (at: number) => number {
  const size = kSize[field.type] ?? 0;
  if (size === 0 || field.offset + size > stride) throw new Error("field outside of its element");
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  const { offset } = field;
  switch (field.type) {
    case 1: return (at) => data[at + offset]!;
    case 2: return (at) => view.getInt8(at + offset);
    case 3: return (at) => view.getUint16(at + offset, true);
    case 4: return (at) => view.getInt16(at + offset, true);
    case 5: return (at) => view.getUint32(at + offset, true);
    case 6: return (at) => view.getInt32(at + offset, true);
    case 7: return (at) => view.getFloat32(at + offset, true);
    default: return (at) => view.getFloat64(at + offset, true);
  }
}
