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

  /** A free place for a text beside a point, the nearest first: right, left, above, below, then farther off; null if all are taken. */
  beside(px: number, py: number, width: number, height: number, gap: number): { x: number; y: number } | null {
    const right = px + gap, left = px - gap - width, middle = px - width / 2;
    const above = (rows: number) => py - gap - rows * height;
    const below = (rows: number) => py + gap + (rows - 1) * height;
    const places: [number, number][] = [
      [right, py - height / 2], [left, py - height / 2], [middle, above(1)], [middle, below(1)],
      [right, above(1)], [right, below(1)], [left, above(1)], [left, below(1)], [middle, above(2)], [middle, below(2)],
    ];
    const free = places.find(([x, y]) => this.take(x, y, width, height));
    return free ? { x: free[0], y: free[1] } : null;
  }
}
