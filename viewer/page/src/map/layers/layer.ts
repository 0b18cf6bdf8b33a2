// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** A layer of the map: one entry of the list of layers, one function that draws it. */
import type { Entity } from "../../state/scene";
import type { Model } from "../../state/model";
import type { Brush } from "../brush";

/** What a click can select. */
export interface Place {
  x: number;
  y: number;
  title: string;
  text: string;
  /** Number of the 3D scan whose card opens. */
  scan?: number;
}

/** One frame of the map at one time of the mission. */
export interface Frame {
  brush: Brush;
  model: Model;
  time_s: number;
  /** Zoomed in so far that values and numbers are written beside symbols. */
  isNumbered: boolean;
  /** Filled by the layers in the order of drawing. */
  places: Place[];
}

export interface Layer {
  key: string;
  label: string;
  /** Name of its colour in the style sheet. */
  swatch: string;
  /** Shown when the page opens. */
  on: boolean;
  draw(frame: Frame): void;
}

type SceneTopic = "trajectory" | "path" | "graph" | "frontiers" | "hazards" | "uncertainty";

export function entitiesAt(frame: Frame, topic: SceneTopic): Entity[] {
  return frame.model[topic].at(frame.time_s)?.value ?? [];
}
