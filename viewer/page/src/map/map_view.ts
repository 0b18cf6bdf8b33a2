// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The map: the ground, the layers over it, the tools that measure, and what lies below the pointer. */
import { boundsOf, type Grid } from "../state/grid";
import type { Model } from "../state/model";
import { colour } from "../theme";
import { Brush } from "./brush";
import { Camera } from "./camera";
import { Gestures } from "./gestures";
import { kLayers } from "./layers/all";
import { drawGridLines, drawNorthArrow, drawScaleBar, reserveGraticule } from "./layers/graticule";
import { drawGround } from "./layers/ground";
import type { Place } from "./layers/layer";
import { Measuring, type Tool } from "./measuring";
import { Raster } from "./raster";

const kNumberScale = 12;  // pixels per metre from which numbers appear
const kCentreScale = 25;
const kPick_px = 14;

export class MapView {
  readonly camera = new Camera();
  readonly measuring = new Measuring();
  readonly shown = new Map(kLayers.map(({ key, on }) => [key, on]));
  showsCoverage = true;
  dirty = true;
  onPick: (place: Place | null, px: number, py: number) => void = () => {};
  onMeasure: () => void = () => {};
  onMoved: () => void = () => {};
  #places: Place[] = [];
  #raster = new Raster();
  #isFitted = false;
  #time_s = NaN;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly model: Model) {
    new ResizeObserver(() => { this.dirty = true; }).observe(canvas);
    new Gestures(canvas, this.camera, {
      moved: () => { this.dirty = true; this.onMoved(); },
      clicked: (px, py) => this.#click(px, py),
      hovered: (px, py) => { canvas.title = this.#placeAt(px, py)?.title ?? ""; },
      fit: () => this.fit(),
    });
  }

  fit(): void {
    const grid = this.#grid();
    const bounds = grid && boundsOf(grid);
    if (bounds) this.camera.fit(bounds);
    this.dirty = true;
  }

  centre(x: number, y: number): void {
    this.#isFitted = true;
    this.camera.x = x;
    this.camera.y = y;
    this.camera.scale = Math.max(this.camera.scale, kCentreScale);
    this.measuring.marked = [x, y];
    this.dirty = true;
  }

  measureWidth(x: number, y: number): void {
    this.measuring.measureWidth(this.#grid(), [x, y]);
    this.#measured();
  }

  setTool(tool: Tool): void {
    this.measuring.clear();
    this.measuring.tool = tool;
    this.#measured();
  }

  draw(time_s: number): void {
    this.#time_s = time_s;
    const brush = this.#begin();
    if (!brush) return;
    const grid = this.#grid();
    if (grid && !this.#isFitted) { this.#isFitted = true; this.fit(); }
    reserveGraticule(brush);
    if (grid) drawGround(brush, grid, this.#raster, this.showsCoverage ? "coverage" : "occupancy");
    drawGridLines(brush);
    this.#places = [];
    const frame = { brush, model: this.model, time_s, isNumbered: this.camera.scale > kNumberScale, places: this.#places };
    for (const layer of kLayers) if (this.shown.get(layer.key)) layer.draw(frame);
    brush.drawTexts();
    this.measuring.draw(brush);
    drawScaleBar(brush);
    drawNorthArrow(brush);
  }

  /** The map at the time shown; before there was one, the first. */
  #grid(): Grid | null { return (this.model.map.at(this.#time_s) ?? this.model.map.first())?.value ?? null; }

  /** Null while the canvas has no size. */
  #begin(): Brush | null {
    const ratio = devicePixelRatio || 1;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width < 2 || height < 2) return null;
    const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.canvas.width !== w || this.canvas.height !== h) [this.canvas.width, this.canvas.height] = [w, h];
    [this.camera.width, this.camera.height] = [width, height];
    const context = this.canvas.getContext("2d")!;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = colour("unknown");
    context.fillRect(0, 0, width, height);
    return new Brush(context, this.camera);
  }

  #measured(): void {
    this.dirty = true;
    this.onMeasure();
  }

  #placeAt(px: number, py: number): Place | null {
    let best: Place | null = null;
    let best_px = kPick_px;
    for (const place of this.#places) {
      const [x, y] = this.camera.toScreen(place.x, place.y);
      const distance_px = Math.hypot(x - px, y - py);
      if (distance_px < best_px) { best_px = distance_px; best = place; }
    }
    return best;
  }

  #click(px: number, py: number): void {
    const [x, y] = this.camera.toMap(px, py);
    if (this.measuring.tool === "width") return this.measureWidth(x, y);
    if (this.measuring.tool === "pan") return this.onPick(this.#placeAt(px, py), px, py);
    this.measuring.addToRuler([x, y]);
    this.#measured();
  }
}
