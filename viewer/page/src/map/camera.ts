// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** View of the map: metres to pixels of the canvas, y up. */
export class Camera {
  x = 0;
  y = 0;
  scale = 20;  // pixels per metre
  width = 1;
  height = 1;

  toScreen(x: number, y: number): [number, number] {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale];
  }
  toMap(px: number, py: number): [number, number] {
    return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale];
  }
  pan(dx_px: number, dy_px: number): void {
    this.x -= dx_px / this.scale;
    this.y += dy_px / this.scale;
  }
  /** Keeps the point below the pointer where it is. */
  zoom(factor: number, px: number, py: number): void {
    const [x, y] = this.toMap(px, py);
    this.scale = Math.min(2000, Math.max(0.2, this.scale * factor));
    this.x = x - (px - this.width / 2) / this.scale;
    this.y = y + (py - this.height / 2) / this.scale;
  }
  fit(bounds: { x0: number; y0: number; x1: number; y1: number }): void {
    this.x = (bounds.x0 + bounds.x1) / 2;
    this.y = (bounds.y0 + bounds.y1) / 2;
    const margin = 40;
    this.scale = Math.max(0.2, Math.min((this.width - 2 * margin) / Math.max(1, bounds.x1 - bounds.x0),
      (this.height - 2 * margin) / Math.max(1, bounds.y1 - bounds.y0)));
  }
}

/** Largest 1, 2 or 5 times a power of ten that is at most `limit`. */
export function roundStep(limit: number): number {
  const power = 10 ** Math.floor(Math.log10(limit));
  return power * (limit / power >= 5 ? 5 : limit / power >= 2 ? 2 : 1);
}
