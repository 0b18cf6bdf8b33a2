// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Places texts where none is yet; the first come first. */
export class Labels {
  #taken: [number, number, number, number][] = [];

  /** True if the rectangle (pixels, left, top, width, height) was free; it is then taken. */
  take(x: number, y: number, width: number, height: number): boolean {
    for (const [a, b, w, h] of this.#taken) {
      if (x < a + w && a < x + width && y < b + h && b < y + height) return false;
    }
    this.#taken.push([x, y, width, height]);
    return true;
  }
}
