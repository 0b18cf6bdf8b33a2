// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Coordinates of the mine's grid, scale bar and north arrow. */
import { colour } from "../../theme";
import type { Brush } from "../brush";
import { roundStep } from "../camera";

const kSpacing_px = 160;
const kScaleBar_px = 130;
const kArrow_px = 34;
const kFont = "10px system-ui, sans-serif";

/** Grid lines with their coordinates (metres east and north of the origin of the map) at the edges. */
export function drawGridLines({ context, camera, labels }: Brush): void {
  const step_m = roundStep(kSpacing_px / camera.scale);
  const [x0, y1] = camera.toMap(0, 0);
  const [x1, y0] = camera.toMap(camera.width, camera.height);
  context.strokeStyle = colour("grid");
  context.fillStyle = colour("soft");
  context.lineWidth = 1;
  context.font = kFont;
  const line = (ax: number, ay: number, bx: number, by: number) => {
    context.beginPath();
    context.moveTo(ax, ay);
    context.lineTo(bx, by);
    context.stroke();
  };
  for (let x = Math.ceil(x0 / step_m) * step_m; x <= x1; x += step_m) {
    const px = Math.round(camera.toScreen(x, 0)[0]) + 0.5;
    line(px, 0, px, camera.height);
    if (labels.take(px + 2, 0, 40, 12)) context.fillText(`${+x.toFixed(3)} E`, px + 3, 11);
  }
  for (let y = Math.ceil(y0 / step_m) * step_m; y <= y1; y += step_m) {
    const py = Math.round(camera.toScreen(0, y)[1]) + 0.5;
    line(0, py, camera.width, py);
    if (labels.take(2, py - 12, 40, 12)) context.fillText(`${+y.toFixed(3)} N`, 3, py - 3);
  }
}

/** Takes the space of scale bar and north arrow, before texts are placed. */
export function reserveGraticule({ camera, labels }: Brush): void {
  labels.block(8, camera.height - 36, kScaleBar_px + 10, 30);
  labels.block(8, camera.height - 46 - kArrow_px, 28, kArrow_px + 8);
}

export function drawScaleBar({ context, camera }: Brush): void {
  const length_m = roundStep(kScaleBar_px / camera.scale);
  const length_px = length_m * camera.scale;
  const y = camera.height - 14;
  context.fillStyle = context.strokeStyle = colour("text");
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(12, y - 5);
  context.lineTo(12, y);
  context.lineTo(12 + length_px, y);
  context.lineTo(12 + length_px, y - 5);
  context.stroke();
  context.font = "11px system-ui, sans-serif";
  context.fillText(`${+length_m.toFixed(3)} m`, 16, y - 5);
}

/** North of the mine's grid, which is up. */
export function drawNorthArrow({ context, camera }: Brush): void {
  const x = 21, bottom = camera.height - 42;
  context.fillStyle = colour("text");
  context.beginPath();
  context.moveTo(x, bottom - kArrow_px + 12);
  context.lineTo(x + 6, bottom);
  context.lineTo(x, bottom - 5);
  context.lineTo(x - 6, bottom);
  context.closePath();
  context.fill();
  context.font = "bold 11px system-ui, sans-serif";
  context.textAlign = "center";
  context.fillText("N", x, bottom - kArrow_px + 9);
  context.textAlign = "start";
}
