// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Checked reading of decoded messages: what is missing or of a wrong type gets a stated value. */

export type Raw = Record<string, unknown>;

export function raw(value: unknown): Raw {
  return typeof value === "object" && value !== null ? (value as Raw) : {};
}

export function list(value: unknown): unknown[] {
  return Array.isArray(value) ? value : [];
}

/** NaN unless it is a finite number (64-bit integers of protobuf included). */
export function num(value: unknown, otherwise = NaN): number {
  if (typeof value === "number") return Number.isFinite(value) ? value : otherwise;
  if (typeof value === "object" && value !== null && "toNumber" in value) {
    return num((value as { toNumber(): unknown }).toNumber(), otherwise);
  }
  return otherwise;
}

/** Texts are cut at a length that a well-formed one does not reach. */
export function str(value: unknown, otherwise = "", limit = 4000): string {
  if (typeof value === "string") return value.length > limit ? `${value.slice(0, limit)} …` : value;
  if (typeof value === "number" || typeof value === "boolean") return String(value);
  return otherwise;
}

export function bytes(value: unknown): Uint8Array {
  if (value instanceof Uint8Array) return value;
  return new Uint8Array(0);
}
