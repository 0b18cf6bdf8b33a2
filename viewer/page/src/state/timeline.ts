// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The messages of one topic in order of time, decoded when looked at; memory is bounded. */
import { countWhile } from "./search";

interface Entry {
  time_s: number;
  data: Uint8Array;
  bad: boolean;
}

export interface Found<T> {
  time_s: number;
  value: T;
}

export class Timeline<T> {
  #entries: Entry[] = [];
  #size = 0;
  #cached: { entry: Entry; found: Found<T> } | null = null;

  /** Above `budget` bytes every second message of the older half is dropped; `onBad` counts what cannot be decoded. */
  constructor(private readonly decode: (data: Uint8Array) => T, private readonly budget: number,
              private readonly onBad: () => void) {}

  get count(): number { return this.#entries.length; }
  get size(): number { return this.#size; }
  get first_s(): number | null { return this.#entries[0]?.time_s ?? null; }
  get last_s(): number | null { return this.#entries[this.#entries.length - 1]?.time_s ?? null; }
  times(): number[] { return this.#entries.map((entry) => entry.time_s); }

  /** A message with the time of another replaces it. */
  add(time_s: number, data: Uint8Array): void {
    const entry = { time_s, data, bad: false };
    const at = this.#indexAfter(time_s);
    const before = this.#entries[at - 1];
    if (before?.time_s === time_s) {
      this.#size -= before.data.length;
      this.#entries[at - 1] = entry;
    } else {
      this.#entries.splice(at, 0, entry);
    }
    this.#size += data.length;
    while (this.#size > this.budget && this.#entries.length > 2) this.#thin();
  }

  /** The last at or before a time that can be decoded. */
  at(time_s: number): Found<T> | null {
    for (let i = this.#indexAfter(time_s) - 1; i >= 0; --i) {
      const found = this.#decoded(this.#entries[i]!);
      if (found) return found;
    }
    return null;
  }

  last(): Found<T> | null { return this.at(Infinity); }

  /** The first that can be decoded. */
  first(): Found<T> | null {
    for (const entry of this.#entries) {
      const found = this.#decoded(entry);
      if (found) return found;
    }
    return null;
  }

  /** Forgets what is later, since a log was rewound. */
  truncate(time_s: number): void {
    for (const entry of this.#entries.splice(this.#indexAfter(time_s))) this.#size -= entry.data.length;
  }

  #decoded(entry: Entry): Found<T> | null {
    if (entry.bad) return null;
    if (this.#cached?.entry === entry) return this.#cached.found;
    try {
      const found = { time_s: entry.time_s, value: this.decode(entry.data) };
      this.#cached = { entry, found };
      return found;
    } catch {
      entry.bad = true;
      this.onBad();
      return null;
    }
  }

  #indexAfter(time_s: number): number {
    return countWhile(this.#entries.length, (i) => this.#entries[i]!.time_s <= time_s);
  }

  #thin(): void {
    const half = Math.ceil(this.#entries.length / 2);
    let removed = 0;
    this.#entries = this.#entries.filter((entry, i) => {
      // The first stays, since it is what the page shows at the beginning.
      const drop = i > 0 && i < half && i % 2 === 1;
      if (drop) this.#size -= entry.data.length;
      if (drop) ++removed;
      return !drop;
    });
    if (removed === 0 && this.#entries.length > 1) this.#size -= this.#entries.splice(1, 1)[0]!.data.length;
  }
}
