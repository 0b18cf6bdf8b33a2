// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The map: layers over the occupancy grid, ruler, width and what lies below the pointer. */
import { boundsOf } from "../state/grid";
import type { Model } from "../state/model";
import { apply, poseInMap, yawOf } from "../state/pose";
import { ellipsesOf, frontiersOf, hazardsOf, type Entity, type Polyline } from "../state/scene";
import { colour, hazardColour, stateColour } from "../theme";
import { Camera, roundStep } from "./camera";
import { Labels } from "./labels";
import { Raster } from "./raster";
import { widthAt, type Width } from "./width";

export const kLayers: [key: string, label: string, swatch: string, on: boolean][] = [
  ["coverage", "coverage: driven, scanned, seen by laser only", "driven", false],
  ["robot", "robot now", "robot", true], ["lasers", "lasers now", "laser", true], ["path", "path planned", "path", true],
  ["trajectory", "trajectory: outbound, return", "outbound", true], ["frontiers", "frontiers by state", "open", true],
  ["graph", "pose graph", "graph", false], ["loops", "loop closures in force", "loop", false],
  ["revoked", "loop closures revoked", "revoked", false], ["scans", "3D scans", "scan", true],
  ["hazards", "hazards", "water", true], ["uncertainty", "95 % uncertainty", "sd", false],
];

export interface Place {
  kind: "frontier" | "hazard" | "scan";
  x: number;
  y: number;
  title: string;
  text: string;
  number?: number;
}

export type Tool = "pan" | "ruler" | "width";
const kLabelScale = 12;  // pixels per metre from which numbers appear
const kPick_px = 14;

export class MapView {
  readonly camera = new Camera();
  readonly shown = new Map(kLayers.map(([key, , , on]) => [key, on]));
  tool: Tool = "pan";
  ruler: [number, number][] = [];
  width: Width | null = null;
  marked: [number, number] | null = null;
  dirty = true;
  onPick: (place: Place | null, x: number, y: number) => void = () => {};
  onMeasure: () => void = () => {};
  #places: Place[] = [];
  #raster = new Raster();
  #fitted = false;
  #time_s = NaN;
  #pointers = new Map<number, [number, number]>();
  #moved = 0;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly model: Model) {
    new ResizeObserver(() => { this.dirty = true; }).observe(canvas);
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.camera.zoom(Math.exp(-event.deltaY * 0.0015), event.offsetX, event.offsetY);
      this.dirty = true;
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.#pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
      this.#moved = 0;
    });
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", (event) => {
      const single = this.#pointers.size === 1;
      this.#pointers.delete(event.pointerId);
      if (single && this.#moved < 5) this.#click(event.offsetX, event.offsetY);
    });
    canvas.addEventListener("pointercancel", (event) => this.#pointers.delete(event.pointerId));
    canvas.addEventListener("keydown", (event) => this.#key(event));
  }

  fit(): void {
    const grid = this.model.map.at(this.#time_s)?.value ?? this.model.map.first()?.value;
    const bounds = grid && boundsOf(grid);
    if (bounds) this.camera.fit(bounds);
    this.dirty = true;
  }
  centre(x: number, y: number): void {
    this.camera.x = x;
    this.camera.y = y;
    this.camera.scale = Math.max(this.camera.scale, 25);
    this.marked = [x, y];
    this.dirty = true;
  }
  measureWidth(x: number, y: number): Width | null {
    const grid = this.model.map.at(this.#time_s)?.value;
    this.width = grid ? widthAt(grid, x, y) : null;
    this.marked = [x, y];
    this.dirty = true;
    this.onMeasure();
    return this.width;
  }
  clearTools(): void {
    this.tool = "pan";
    this.ruler = [];
    this.width = null;
    this.marked = null;
    this.dirty = true;
    this.onMeasure();
  }

  draw(time_s: number): void {
    this.#time_s = time_s;
    const ratio = devicePixelRatio || 1;
    const { clientWidth: w, clientHeight: h } = this.canvas;
    if (w < 2 || h < 2) return;
    if (this.canvas.width !== Math.round(w * ratio) || this.canvas.height !== Math.round(h * ratio)) {
      this.canvas.width = Math.round(w * ratio);
      this.canvas.height = Math.round(h * ratio);
    }
    this.camera.width = w;
    this.camera.height = h;
    const found = this.model.map.at(time_s) ?? this.model.map.first();
    if (found && !this.#fitted) { this.#fitted = true; this.fit(); }
    const context = this.canvas.getContext("2d")!;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = colour("unknown");
    context.fillRect(0, 0, w, h);
    const labels = new Labels();
    labels.take(8, h - 46, 150, 40);  // scale bar
    if (found) {
      const grid = found.value;
      const cell_px = grid.cell_m * this.camera.scale;
      const { image, factor } = this.#raster.at(grid, this.shown.get("coverage") ? "coverage" : "occupancy", cell_px);
      context.save();
      const [ox, oy] = this.camera.toScreen(grid.x, grid.y);
      context.translate(ox, oy);
      context.rotate(-Math.atan2(grid.sin, grid.cos));
      context.imageSmoothingEnabled = cell_px * factor < 1;
      const size = cell_px * factor;
      const rows = Math.ceil(grid.height / factor);
      context.drawImage(image, 0, -rows * size, image.width * size, rows * size);
      context.restore();
    }
    this.#gridLines(context, labels);
    this.#places = [];
    const scene = (key: "trajectory" | "path" | "graph" | "frontiers" | "hazards" | "uncertainty") => this.model[key].at(time_s)?.value ?? [];
    if (this.shown.get("uncertainty")) for (const { line } of ellipsesOf(scene("uncertainty"))) this.#line(context, line, colour("sd"), 1.5);
    const graph = scene("graph");
    const part = (id: string) => graph.filter((entity) => entity.id === id);
    if (this.shown.get("graph")) this.#lines(context, part("sequential"), colour("graph"), 1);
    if (this.shown.get("loops")) this.#lines(context, part("loop closures"), colour("loop"), 1.2);
    if (this.shown.get("revoked")) this.#lines(context, part("revoked"), colour("revoked"), 1.5, [4, 3]);
    if (this.shown.get("trajectory")) {
      for (const entity of scene("trajectory")) this.#lines(context, [entity], colour(entity.id === "return" ? "return" : "outbound"), 1.5);
    }
    if (this.shown.get("path")) this.#lines(context, scene("path"), colour("path"), 3);
    if (this.shown.get("hazards")) this.#hazards(context, scene("hazards"), labels);
    if (this.shown.get("frontiers")) this.#frontiers(context, scene("frontiers"), labels);
    if (this.shown.get("scans")) this.#scans(context, time_s, labels);
    if (this.shown.get("graph") && this.camera.scale > kLabelScale) {
      for (const entity of part("local maps")) for (const { x, y, text } of entity.texts) this.#label(context, labels, x, y, text, colour("graph"));
    }
    this.#robot(context, time_s);
    this.#tools(context);
    this.#scaleBar(context);
  }

  #line(context: CanvasRenderingContext2D, line: Polyline, stroke: string, width: number, dash: number[] = []): void {
    context.beginPath();
    for (let i = 0; i < line.xyz.length; i += 3) {
      const [px, py] = this.camera.toScreen(line.xyz[i]!, line.xyz[i + 1]!);
      if (i === 0 || (line.isList && i % 6 === 0)) context.moveTo(px, py);
      else context.lineTo(px, py);
    }
    if (line.closed) context.closePath();
    context.strokeStyle = stroke;
    context.lineWidth = width;
    context.setLineDash(dash);
    context.stroke();
    context.setLineDash([]);
  }
  #lines(context: CanvasRenderingContext2D, entities: Entity[], stroke: string, width: number, dash: number[] = []): void {
    for (const entity of entities) for (const line of entity.lines) this.#line(context, line, stroke, width, dash);
  }

  #label(context: CanvasRenderingContext2D, labels: Labels, x: number, y: number, text: string, fill: string): void {
    const [px, py] = this.camera.toScreen(x, y);
    context.font = "11px system-ui, sans-serif";
    const width = context.measureText(text).width;
    if (!labels.take(px + 7, py - 15, width + 4, 14)) return;
    context.lineWidth = 3;
    context.strokeStyle = colour("halo");
    context.strokeText(text, px + 9, py - 4);
    context.fillStyle = fill;
    context.fillText(text, px + 9, py - 4);
  }

  #hazards(context: CanvasRenderingContext2D, entities: Entity[], labels: Labels): void {
    for (const hazard of hazardsOf(entities)) {
      const [px, py] = this.camera.toScreen(hazard.x, hazard.y);
      const value = hazard.value ? `${hazard.value} ${hazard.unit}`.trim() : "";
      context.save();
      context.translate(px, py);
      context.rotate(-hazard.yaw_rad);
      const w = Math.max(6, hazard.size[0] * this.camera.scale), h = Math.max(6, hazard.size[1] * this.camera.scale);
      context.fillStyle = context.strokeStyle = hazardColour(hazard.kind);
      context.globalAlpha = 0.35;
      context.fillRect(-w / 2, -h / 2, w, h);
      context.globalAlpha = 1;
      context.lineWidth = 1.5;
      context.strokeRect(-w / 2, -h / 2, w, h);
      context.restore();
      this.#places.push({ kind: "hazard", x: hazard.x, y: hazard.y, title: `${hazard.kind} ${value}`.trim(), text: hazard.evidence });
      if (this.camera.scale > kLabelScale) this.#label(context, labels, hazard.x, hazard.y, `${hazard.kind} ${value}`, hazardColour(hazard.kind));
    }
  }

  #frontiers(context: CanvasRenderingContext2D, entities: Entity[], labels: Labels): void {
    for (const frontier of frontiersOf(entities)) {
      const [px, py] = this.camera.toScreen(frontier.x, frontier.y);
      context.save();
      context.translate(px, py);
      context.rotate(-frontier.heading_rad);
      context.beginPath();
      context.moveTo(9, 0);
      context.lineTo(-5, 6);
      context.lineTo(-5, -6);
      context.closePath();
      context.fillStyle = stateColour(frontier.state);
      context.fill();
      context.strokeStyle = colour("halo");
      context.lineWidth = 1.5;
      context.stroke();
      context.restore();
      const text = [frontier.evidence, Number.isFinite(frontier.width_m) ? `width ${frontier.width_m.toFixed(1)} m` : ""].filter(Boolean).join("; ");
      this.#places.push({ kind: "frontier", x: frontier.x, y: frontier.y, title: `Frontier ${frontier.id}: ${frontier.state}`, text });
      if (this.camera.scale > kLabelScale) this.#label(context, labels, frontier.x, frontier.y, `${frontier.id} ${frontier.state}`, stateColour(frontier.state));
    }
  }

  #scans(context: CanvasRenderingContext2D, time_s: number, labels: Labels): void {
    for (const scan of this.model.scans.values()) {
      if (scan.time_s > time_s || !Number.isFinite(scan.x + scan.y)) continue;
      const [px, py] = this.camera.toScreen(scan.x, scan.y);
      context.beginPath();
      context.arc(px, py, 4, 0, 2 * Math.PI);
      context.fillStyle = colour("halo");
      context.fill();
      context.lineWidth = 1.5;
      context.strokeStyle = colour("scan");
      context.stroke();
      this.#places.push({ kind: "scan", x: scan.x, y: scan.y, title: `3D scan ${scan.number}`, text: "click for its card", number: scan.number });
      if (this.camera.scale > kLabelScale) this.#label(context, labels, scan.x, scan.y, String(scan.number), colour("scan"));
    }
  }

  #robot(context: CanvasRenderingContext2D, time_s: number): void {
    const robot = this.model.robotAt(time_s);
    if (!robot) return;
    if (this.shown.get("lasers")) {
      context.fillStyle = colour("laser");
      for (const timeline of [this.model.laserFront, this.model.laserRear]) {
        const found = timeline.at(time_s);
        const frames = this.model.tf.at(time_s)?.value;
        const pose = found && frames && time_s - found.time_s < 1 ? poseInMap(frames, found.value.frame) : null;
        if (!pose || !found) continue;
        const { ranges, start_rad, end_rad } = found.value;
        const step = ranges.length > 1 ? (end_rad - start_rad) / (ranges.length - 1) : 0;
        for (let i = 0; i < ranges.length; ++i) {
          const range = ranges[i]!;
          if (range <= 0) continue;
          const [x, y] = apply(pose, range * Math.cos(start_rad + i * step), range * Math.sin(start_rad + i * step), 0);
          const [px, py] = this.camera.toScreen(x, y);
          context.fillRect(px - 1, py - 1, 2, 2);
        }
      }
    }
    if (!this.shown.get("robot")) return;
    const [px, py] = this.camera.toScreen(robot.x, robot.y);
    context.save();
    context.translate(px, py);
    context.rotate(-yawOf(robot));
    context.beginPath();
    context.moveTo(13, 0);
    context.lineTo(-9, 8);
    context.lineTo(-5, 0);
    context.lineTo(-9, -8);
    context.closePath();
    context.fillStyle = colour("robot");
    context.fill();
    context.lineWidth = 2;
    context.strokeStyle = colour("halo");
    context.stroke();
    context.restore();
  }

  #gridLines(context: CanvasRenderingContext2D, labels: Labels): void {
    const step = roundStep(160 / this.camera.scale) || 1;
    const [x0, y1] = this.camera.toMap(0, 0);
    const [x1, y0] = this.camera.toMap(this.camera.width, this.camera.height);
    context.strokeStyle = colour("grid");
    context.fillStyle = colour("soft");
    context.lineWidth = 1;
    context.font = "10px system-ui, sans-serif";
    for (let x = Math.ceil(x0 / step) * step; x <= x1; x += step) {
      const px = Math.round(this.camera.toScreen(x, 0)[0]) + 0.5;
      context.beginPath(); context.moveTo(px, 0); context.lineTo(px, this.camera.height); context.stroke();
      if (labels.take(px + 2, 0, 40, 12)) context.fillText(`${+x.toFixed(3)} E`, px + 3, 11);
    }
    for (let y = Math.ceil(y0 / step) * step; y <= y1; y += step) {
      const py = Math.round(this.camera.toScreen(0, y)[1]) + 0.5;
      context.beginPath(); context.moveTo(0, py); context.lineTo(this.camera.width, py); context.stroke();
      if (labels.take(2, py - 12, 40, 12)) context.fillText(`${+y.toFixed(3)} N`, 3, py - 3);
    }
  }

  #scaleBar(context: CanvasRenderingContext2D): void {
    const length = roundStep(130 / this.camera.scale);
    const y = this.camera.height - 14;
    context.fillStyle = context.strokeStyle = colour("text");
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(12, y - 5); context.lineTo(12, y); context.lineTo(12 + length * this.camera.scale, y);
    context.lineTo(12 + length * this.camera.scale, y - 5);
    context.stroke();
    context.font = "11px system-ui, sans-serif";
    context.fillText(`${+length.toFixed(3)} m`, 16, y - 5);
  }

  #tools(context: CanvasRenderingContext2D): void {
    const stroke = colour("tool");
    const ends = this.ruler.length > 0 ? this.ruler : this.width ? [this.width.a, this.width.b] : [];
    context.strokeStyle = context.fillStyle = stroke;
    context.lineWidth = 2;
    context.beginPath();
    ends.forEach(([x, y], i) => {
      const [px, py] = this.camera.toScreen(x, y);
      if (i === 0) context.moveTo(px, py); else context.lineTo(px, py);
      context.fillRect(px - 3, py - 3, 6, 6);
    });
    context.stroke();
    if (!this.marked) return;
    const [px, py] = this.camera.toScreen(...this.marked);
    context.beginPath();
    context.arc(px, py, 9, 0, 2 * Math.PI);
    context.stroke();
  }

  #nearest(px: number, py: number): Place | null {
    let best: Place | null = null;
    let distance = kPick_px;
    for (const place of this.#places) {
      const [x, y] = this.camera.toScreen(place.x, place.y);
      const d = Math.hypot(x - px, y - py);
      if (d < distance) { distance = d; best = place; }
    }
    return best;
  }

  #move(event: PointerEvent): void {
    const before = this.#pointers.get(event.pointerId);
    if (!before) {
      this.canvas.title = this.#nearest(event.offsetX, event.offsetY)?.title ?? "";
      return;
    }
    const now: [number, number] = [event.offsetX, event.offsetY];
    const others = [...this.#pointers].filter(([id]) => id !== event.pointerId);
    this.#moved += Math.hypot(now[0] - before[0], now[1] - before[1]);
    if (others.length === 0) {
      this.camera.x -= (now[0] - before[0]) / this.camera.scale;
      this.camera.y += (now[1] - before[1]) / this.camera.scale;
    } else {
      const other = others[0]![1];
      const ratio = Math.hypot(now[0] - other[0], now[1] - other[1]) / Math.max(1, Math.hypot(before[0] - other[0], before[1] - other[1]));
      this.camera.zoom(ratio, (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
    }
    this.#pointers.set(event.pointerId, now);
    this.dirty = true;
  }

  #click(px: number, py: number): void {
    const [x, y] = this.camera.toMap(px, py);
    if (this.tool === "ruler") {
      if (this.ruler.length >= 2) this.ruler = [];
      this.ruler.push([x, y]);
      this.dirty = true;
      this.onMeasure();
    } else if (this.tool === "width") {
      this.measureWidth(x, y);
    } else {
      this.onPick(this.#nearest(px, py), px, py);
    }
  }

  #key(event: KeyboardEvent): void {
    const pan: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const step = pan[event.key];
    if (step) {
      this.camera.x += 60 * step[0] / this.camera.scale;
      this.camera.y += 60 * step[1] / this.camera.scale;
      event.preventDefault();
    } else if (event.key === "+" || event.key === "=") this.camera.zoom(1.3, this.camera.width / 2, this.camera.height / 2);
    else if (event.key === "-") this.camera.zoom(1 / 1.3, this.camera.width / 2, this.camera.height / 2);
    else if (event.key === "f") this.fit();
    else return;
    this.dirty = true;
  }
}
