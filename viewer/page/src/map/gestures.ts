// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Mouse, fingers and keys of a canvas: pan, zoom, click. */
import type { Camera } from "./camera";

const kClick_px = 5;  // less than this between press and release is a click
const kKeyPan_px = 60;
const kKeyZoom = 1.3;
const kKeyPans: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export interface GestureActions {
  moved(): void;
  clicked(px: number, py: number): void;
  hovered(px: number, py: number): void;
  fit(): void;
}

export class Gestures {
  #pointers = new Map<number, [number, number]>();
  #travelled_px = 0;

  constructor(canvas: HTMLCanvasElement, private readonly camera: Camera, private readonly actions: GestureActions) {
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      camera.zoom(Math.exp(-event.deltaY * 0.0015), event.offsetX, event.offsetY);
      actions.moved();
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.#pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
      this.#travelled_px = 0;
    });
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", (event) => {
      const isSingle = this.#pointers.size === 1;
      this.#pointers.delete(event.pointerId);
      if (isSingle && this.#travelled_px < kClick_px) actions.clicked(event.offsetX, event.offsetY);
    });
    canvas.addEventListener("pointercancel", (event) => this.#pointers.delete(event.pointerId));
    canvas.addEventListener("keydown", (event) => this.#key(event));
  }

  #move(event: PointerEvent): void {
    const before = this.#pointers.get(event.pointerId);
    if (!before) return this.actions.hovered(event.offsetX, event.offsetY);
    const now: [number, number] = [event.offsetX, event.offsetY];
    const other = [...this.#pointers].find(([id]) => id !== event.pointerId)?.[1];
    this.#travelled_px += Math.hypot(now[0] - before[0], now[1] - before[1]);
    if (other) {
      const ratio = Math.hypot(now[0] - other[0], now[1] - other[1]) / Math.max(1, Math.hypot(before[0] - other[0], before[1] - other[1]));
      this.camera.zoom(ratio, (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
    } else {
      this.camera.pan(now[0] - before[0], now[1] - before[1]);
    }
    this.#pointers.set(event.pointerId, now);
    this.actions.moved();
  }

  #key(event: KeyboardEvent): void {
    const pan = kKeyPans[event.key];
    const middle: [number, number] = [this.camera.width / 2, this.camera.height / 2];
    if (pan) {
      this.camera.pan(-kKeyPan_px * pan[0], kKeyPan_px * pan[1]);
      event.preventDefault();
    } else if (event.key === "+" || event.key === "=") this.camera.zoom(kKeyZoom, ...middle);
    else if (event.key === "-") this.camera.zoom(1 / kKeyZoom, ...middle);
    else if (event.key === "f") this.actions.fit();
    else return;
    this.actions.moved();
  }
}
