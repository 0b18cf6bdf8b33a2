// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Samples of one quantity by time, of bounded number: the older half is thinned to minimum and maximum of each four. */
export class Series {
  t: number[] = [];
  v: number[] = [];
  revision = 0;
  constructor(private readonly limit = 4096) {}

  add(time_s: number, value: number): void {
    if (!Number.isFinite(value) || !Number.isFinite(time_s)) return;
    let at = this.t.length;
    while (at > 0 && this.t[at - 1]! > time_s) --at;
    if (at > 0 && time_s - this.t[at - 1]! < 0.3) return;
    this.t.splice(at, 0, time_s);
    this.v.splice(at, 0, value);
    ++this.revision;
    if (this.t.length > this.limit) this.#thin();
  }

  #thin(): void {
    const half = Math.floor(this.limit / 8) * 4;
    const keep: number[] = [];
    for (let i = 0; i < half; i += 4) {
      const four = [i, i + 1, i + 2, i + 3];
      const low = four.reduce((a, b) => (this.v[b]! < this.v[a]! ? b : a));
      const high = four.reduce((a, b) => (this.v[b]! >= this.v[a]! ? b : a));
      keep.push(Math.min(low, high), Math.max(low, high));
    }
    const indices = [...new Set(keep)];
    this.t = [...indices.map((i) => this.t[i]!), ...this.t.slice(half)];
    this.v = [...indices.map((i) => this.v[i]!), ...this.v.slice(half)];
  }
}
