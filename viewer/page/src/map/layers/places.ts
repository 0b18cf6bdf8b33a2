// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Layers of places: hazards with their values, frontiers, 3D scans. A click selects them; zoomed in, each has its number. */
import { frontiersOf, hazardsOf, valueText } from "../../state/scene";
import { colour, hazardColour, stateColour } from "../../theme";
import { entitiesAt, type Layer } from "./layer";

const kMinSize_px = 6;
/** Written on the map only when zoomed in; there are many of them, beside every wall. */
const kCommonHazards = ["step", "low roof", "slope"];
const kFrontierCorners: [number, number][] = [[9, 0], [-5, 6], [-5, -6]];

export const kHazards: Layer = {
  key: "hazards", label: "hazards", swatch: "water", on: true,
  draw({ brush, time_s, model, isNumbered, places }) {
    for (const hazard of hazardsOf(model.hazards.at(time_s)?.value ?? [])) {
      const title = `${hazard.kind} ${valueText(hazard)}`.trim();
      const fill = hazardColour(hazard.kind);
      const [width, height] = hazard.size.map((size_m) => Math.max(kMinSize_px, size_m * brush.camera.scale)) as [number, number];
      brush.at(hazard.x, hazard.y, hazard.yaw_rad, (context) => {
        context.fillStyle = context.strokeStyle = fill;
        context.globalAlpha = 0.35;
        context.fillRect(-width / 2, -height / 2, width, height);
        context.globalAlpha = 1;
        context.lineWidth = 1.5;
        context.strokeRect(-width / 2, -height / 2, width, height);
      });
      places.push({ x: hazard.x, y: hazard.y, title, text: hazard.evidence });
      if (isNumbered || !kCommonHazards.includes(hazard.kind)) brush.text(hazard.x, hazard.y, title, fill, kCommonHazards.includes(hazard.kind) ? 3 : 0);
    }
  },
};

export const kFrontiers: Layer = {
  key: "frontiers", label: "frontiers by state", swatch: "open", on: true,
  draw(frame) {
    for (const frontier of frontiersOf(entitiesAt(frame, "frontiers"))) {
      const fill = stateColour(frontier.state);
      frame.brush.symbol(frontier.x, frontier.y, frontier.heading_rad, kFrontierCorners, fill);
      const width = Number.isFinite(frontier.width_m) ? `width ${frontier.width_m.toFixed(1)} m` : "";
      frame.places.push({ x: frontier.x, y: frontier.y, title: `Frontier ${frontier.id}: ${frontier.state}`, text: [frontier.evidence, width].filter(Boolean).join("; ") });
      if (frame.isNumbered) frame.brush.text(frontier.x, frontier.y, `${frontier.id} ${frontier.state}`, fill, 1);
    }
  },
};

export const kScans: Layer = {
  key: "scans", label: "3D scans", swatch: "scan", on: true,
  draw({ brush, model, time_s, isNumbered, places }) {
    for (const scan of model.scans.values()) {
      if (scan.time_s > time_s || !Number.isFinite(scan.x + scan.y)) continue;
      brush.at(scan.x, scan.y, 0, (context) => {
        context.beginPath();
        context.arc(0, 0, 4, 0, 2 * Math.PI);
        context.fillStyle = colour("halo");
        context.fill();
        context.lineWidth = 1.5;
        context.strokeStyle = colour("scan");
        context.stroke();
      });
      brush.reserve(scan.x, scan.y, 5);
      places.push({ x: scan.x, y: scan.y, title: `3D scan ${scan.number}`, text: "its card is beside the map", scan: scan.number });
      if (isNumbered) brush.text(scan.x, scan.y, String(scan.number), colour("scan"), 2);
    }
  },
};
