// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Layers of lines: trajectory with distances, planned path, pose graph, loop closures, uncertainty. */
import { Chainage } from "../../state/chainage";
import { ellipsesOf } from "../../state/scene";
import { colour } from "../../theme";
import { roundStep } from "../camera";
import { entitiesAt, type Frame, type Layer } from "./layer";

const kDistanceSpacing_px = 110;

export const kTrajectory: Layer = {
  key: "trajectory", label: "trajectory: outbound, return", swatch: "outbound", on: true,
  draw(frame) {
    for (const entity of entitiesAt(frame, "trajectory")) {
      frame.brush.polylines([entity], { stroke: colour(entity.id === "return" ? "return" : "outbound"), width_px: 1.5 });
    }
  },
};

/** Chainages along the outbound trajectory, which name places underground. */
export const kDistances: Layer = {
  key: "distances", label: "distance from the start", swatch: "outbound", on: true,
  draw(frame) {
    const line = Chainage.at(frame.model, frame.time_s);
    if (!line) return;
    const step_m = Math.max(1, 2 * roundStep(kDistanceSpacing_px / frame.brush.camera.scale));
    for (let distance_m = step_m; distance_m <= line.length_m; distance_m += step_m) {
      for (const [x, y] of line.pointsAt(distance_m)) {
        frame.brush.at(x, y, 0, (context) => {
          context.fillStyle = colour("outbound");
          context.fillRect(-1.5, -4, 3, 8);
        });
        frame.brush.text(x, y, `${distance_m} m`, colour("outbound"), 3);
      }
    }
  },
};

export const kPath: Layer = {
  key: "path", label: "path planned", swatch: "path", on: true,
  draw(frame) { frame.brush.polylines(entitiesAt(frame, "path"), { stroke: colour("path"), width_px: 3 }); },
};

function graphPart(frame: Frame, id: string) {
  return entitiesAt(frame, "graph").filter((entity) => entity.id === id);
}

export const kGraph: Layer = {
  key: "graph", label: "pose graph", swatch: "graph", on: false,
  draw(frame) {
    frame.brush.polylines(graphPart(frame, "sequential"), { stroke: colour("graph"), width_px: 1 });
    if (!frame.isNumbered) return;
    for (const { texts } of graphPart(frame, "local maps")) {
      for (const { x, y, text } of texts) frame.brush.text(x, y, text, colour("graph"), 5);
    }
  },
};

export const kLoopClosures: Layer = {
  key: "loops", label: "loop closures in force", swatch: "loop", on: false,
  draw(frame) { frame.brush.polylines(graphPart(frame, "loop closures"), { stroke: colour("loop"), width_px: 1.2 }); },
};

export const kRevoked: Layer = {
  key: "revoked", label: "loop closures revoked", swatch: "revoked", on: false,
  draw(frame) { frame.brush.polylines(graphPart(frame, "revoked"), { stroke: colour("revoked"), width_px: 1.5, dash: [4, 3] }); },
};

export const kUncertainty: Layer = {
  key: "uncertainty", label: "95 % uncertainty", swatch: "sd", on: false,
  draw(frame) {
    for (const { line, semiAxis_m } of ellipsesOf(entitiesAt(frame, "uncertainty"))) {
      frame.brush.polyline(line, { stroke: colour("sd"), width_px: 1.5 });
      if (frame.isNumbered && Number.isFinite(semiAxis_m)) frame.brush.text(line.xyz[0]!, line.xyz[1]!, `${semiAxis_m.toFixed(2)} m`, colour("sd"), 4);
    }
  },
};
