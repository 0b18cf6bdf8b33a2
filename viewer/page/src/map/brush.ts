// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Draws lines, symbols and texts at places of the map, on the canvas of one frame. */
import type { Entity, Polyline } from "../state/scene";
import { colour } from "../theme";
import type { Camera } from "./camera";
import { Labels } from "./labels";

const kTextHeight_px = 14;
const kFont = "11px system-ui, sans-serif";

export interface LineStyle {
  stroke: string;
  width_px: number;
  dash?: number[];
}

export class Brush {
  readonly labels = new Labels();
  #texts: { x: number; y: number; text: string; fill: string; rank: number }[] = [];

  constructor(readonly context: CanvasRenderingContext2D, readonly camera: Camera) {}

  polyline(line: Polyline, { stroke, width_px, dash = [] }: LineStyle): void {
    const { context } = this;
    context.beginPath();
    for (let i = 0; i < line.xyz.length; i += 3) {
      const [px, py] = this.camera.toScreen(line.xyz[i]!, line.xyz[i + 1]!);
      if (i === 0 || (line.isList && i % 6 === 0)) context.moveTo(px, py);
      else context.lineTo(px, py);
    }
    if (line.closed) context.closePath();
    context.strokeStyle = stroke;
    context.lineWidth = width_px;
    context.setLineDash(dash);
    context.stroke();
    context.setLineDash([]);
  }

  polylines(entities: Entity[], style: LineStyle): void {
    for (const entity of entities) for (const line of entity.lines) this.polyline(line, style);
  }

  /** Draws with the origin at a place of the map, in pixels, x along a direction of the map. */
  at(x: number, y: number, direction_rad: number, draw: (context: CanvasRenderingContext2D) => void): void {
    const [px, py] = this.camera.toScreen(x, y);
    this.context.save();
    this.context.translate(px, py);
    this.context.rotate(-direction_rad);
    draw(this.context);
    this.context.restore();
  }

  /** A closed shape (pixels about the place) with an outline that sets it off from the ground; no text covers it. */
  symbol(x: number, y: number, direction_rad: number, corners: [number, number][], fill: string): void {
    this.at(x, y, direction_rad, (context) => {
      context.beginPath();
      corners.forEach(([cx, cy], i) => (i === 0 ? context.moveTo(cx, cy) : context.lineTo(cx, cy)));
      context.closePath();
      context.fillStyle = fill;
      context.fill();
      context.strokeStyle = colour("halo");
      context.lineWidth = 1.5;
      context.stroke();
    });
    this.reserve(x, y, 6);
  }

  /** Keeps texts away from a place. */
  reserve(x: number, y: number, radius_px: number): void {
    const [px, py] = this.camera.toScreen(x, y);
    this.labels.block(px - radius_px, py - radius_px, 2 * radius_px, 2 * radius_px);
  }

  /** A text beside a place, drawn after all symbols; those of a lower rank get their place first. */
  text(x: number, y: number, text: string, fill: string, rank: number): void {
    this.#texts.push({ x, y, text, fill, rank });
  }

  /** Draws the texts for which there is a place within the canvas. */
  drawTexts(): void {
    const { context } = this;
    context.font = kFont;
    context.textBaseline = "middle";
    this.#texts.sort((a, b) => a.rank - b.rank);
    for (const { x, y, text, fill } of this.#texts) {
      const [px, py] = this.camera.toScreen(x, y);
      if (px < 0 || py < 0 || px > this.camera.width || py > this.camera.height) continue;
      const place = this.labels.beside(px, py, context.measureText(text).width + 4, kTextHeight_px, 8);
      if (place) this.#write(text, place.x + 2, place.y + kTextHeight_px / 2, fill);
    }
    context.textBaseline = "alphabetic";
    this.#texts = [];
  }

  #write(text: string, px: number, py: number, fill: string): void {
    const { context } = this;
    context.lineWidth = 3;
    context.lineJoin = "round";
    context.strokeStyle = colour("halo");
    context.strokeText(text, px, py);
    context.fillStyle = fill;
    context.fillText(text, px, py);
  }
}
