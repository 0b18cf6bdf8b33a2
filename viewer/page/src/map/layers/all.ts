// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The layers in the order of drawing, and the meaning of the colours of ground and frontiers. */
import { kCoverage } from "../../state/grid";
import type { Layer } from "./layer";
import { kDistances, kGraph, kLoopClosures, kPath, kRevoked, kTrajectory, kUncertainty } from "./lines";
import { kFrontiers, kHazards, kScans } from "./places";
import { kLasers, kRobot } from "./robot";

export const kLayers: Layer[] = [
  kUncertainty, kGraph, kLoopClosures, kRevoked, kTrajectory, kDistances, kPath, kHazards, kFrontiers, kScans, kLasers, kRobot,
];

export const kLegend: [colour: string, meaning: string][] = [
  ["wall", "wall"], ["free", "free"], ...kCoverage,
  ["open", "frontier open"], ["done", "frontier explored"], ["blocked", "frontier blocked or too narrow"], ["soft", "frontier of another state"],
  ["water", "water, mud"], ["gas", "gas"], ["drop", "drop"], ["hazard", "other hazard"],
];
