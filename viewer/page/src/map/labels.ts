// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Keeps texts apart from each other and from symbols; who asks first gets the space. */

interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

export class Labels {
  #taken: Box[] = [];

  /** Takes a rectangle (pixels; left, top) whether it is free or not: symbols are drawn in any case. */
  block(x: number, y: number, width: number, height: number): void {
    this.#taken.push({ x, y, width, height });
  }

  /** True if the rectangle was free; it is then taken. */
  take(x: number, y: number, width: number, height: number): boolean {
    for (const box of this.#taken) {
      if (x < box.x + box.width && box.x < x + width && y < box.y + box.height && box.y < y + height) return false;
    }
    this.block(x, y, width, height);
    return true;
  }

  /** A free place for a text beside a point: right, left, above or below; null if all are taken. The place is then taken. */
  beside(px: number, py: number, width: number, height: number, gap: number): { x: number; y: number } | null {
    const places = [
      { x: px + gap, y: py - height / 2 },
      { x: px - gap - width, y: py - height / 2 },
      { x: px - width / 2, y: py - gap - height },
      { x: px - width / 2, y: py + gap },
    ];
    return places.find(({ x, y }) => this.take(x, y, width, height)) ?? null;
  }
}
