// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Tools that measure on the map: a ruler between two points, the width of a tunnel at a point. */
import type { Grid } from "../state/grid";
import { colour } from "../theme";
import type { Brush } from "./brush";
import { widthAt, type Width } from "./width";

export type Tool = "pan" | "ruler" | "width";
export type Point = [x: number, y: number];

export class Measuring {
  tool: Tool = "pan";
  ruler: Point[] = [];
  width: Width | null = null;
  /** Where a width was asked for, or what the map was centred at. */
  marked: Point | null = null;

  clear(): void {
    this.tool = "pan";
    this.ruler = [];
    this.width = null;
    this.marked = null;
  }

  /** A third point begins another line. */
  addToRuler(point: Point): void {
    if (this.ruler.length >= 2) this.ruler = [];
    this.ruler.push(point);
  }

  measureWidth(grid: Grid | null, point: Point): void {
    this.width = grid && widthAt(grid, ...point);
    this.marked = point;
  }

  draw({ context, camera }: Brush): void {
    const ends = this.ruler.length > 0 ? this.ruler : this.width ? [this.width.a, this.width.b] : [];
    context.strokeStyle = context.fillStyle = colour("tool");
    context.lineWidth = 2;
    context.beginPath();
    ends.forEach(([x, y], i) => {
      const [px, py] = camera.toScreen(x, y);
      if (i === 0) context.moveTo(px, py);
      else context.lineTo(px, py);
      context.fillRect(px - 3, py - 3, 6, 6);
    });
    context.stroke();
    if (!this.marked) return;
    const [px, py] = camera.toScreen(...this.marked);
    context.beginPath();
    context.arc(px, py, 9, 0, 2 * Math.PI);
    context.stroke();
  }
}
