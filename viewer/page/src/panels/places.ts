// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Tables of hazards and frontiers; each row leads to its place on the map. */
import { clock, eastNorth, fixed, table } from "../dom";
import { Chainage } from "../state/chainage";
import type { Model } from "../state/model";
import { frontiersOf, hazardsOf, kFrontierStates, valueText } from "../state/scene";
import { button, idOf, kRowLimit, note, Panel } from "./panel";

export type Centre = (x: number, y: number) => void;

const kNearTrajectory_m = 15;
const kOnTrajectory_m = 2.5;
/** What ends the exploration of a mine comes first. */
const kHazardOrder = ["water", "methane", "oxygen", "carbon monoxide", "gas", "fall", "drop", "mud", "low roof"];
const kStateOrder = ["open", "blocked", "too narrow", ...kFrontierStates];

function rank(order: string[], value: string): number {
  return order.includes(value) ? order.indexOf(value) : order.length;
}

/** Coordinates, and where the place is near the trajectory the distance along it. */
function placeText(line: Chainage | null, x: number, y: number): string {
  const place = eastNorth(x, y);
  const near = line?.nearest(x, y);
  if (!near || near.offset_m > kNearTrajectory_m) return place;
  const offset = near.offset_m > kOnTrajectory_m ? ` + ${near.offset_m.toFixed(0)} m` : "";
  return `${near.distance_m.toFixed(0)} m${offset} (${place})`;
}

export class HazardsPanel extends Panel {
  constructor(private readonly model: Model, private readonly centre: Centre) { super("panel-hazards", "Hazards", "scroll"); }

  show(time_s: number): void {
    const entities = this.model.hazards.at(time_s)?.value ?? null;
    this.update(idOf(entities), () => {
      const hazards = [...hazardsOf(entities ?? [])].sort((a, b) => rank(kHazardOrder, a.kind) - rank(kHazardOrder, b.kind) || a.kind.localeCompare(b.kind) || a.time_s - b.time_s);
      if (hazards.length === 0) return [note("None observed up to this time.")];
      const line = Chainage.at(this.model, time_s);
      return [table(["kind", "value", "at", "evidence", "time", ""], hazards.slice(0, kRowLimit).map((h) => [h.kind, valueText(h),
        placeText(line, h.x, h.y), h.evidence, clock(h.time_s - this.model.start_s), button("show", () => this.centre(h.x, h.y))]))];
    });
  }
}

export class FrontiersPanel extends Panel {
  constructor(private readonly model: Model, private readonly centre: Centre) { super("panel-frontiers", "Frontiers", "scroll"); }

  show(time_s: number): void {
    const entities = this.model.frontiers.at(time_s)?.value ?? null;
    this.update(idOf(entities), () => {
      const frontiers = [...frontiersOf(entities ?? [])].sort((a, b) => rank(kStateOrder, a.state) - rank(kStateOrder, b.state));
      if (frontiers.length === 0) return [note("None up to this time.")];
      const line = Chainage.at(this.model, time_s);
      return [table(["no.", "state", "evidence", "width", "at", ""], frontiers.slice(0, kRowLimit).map((f) => [f.id, f.state, f.evidence, fixed(f.width_m, 1, "m"),
        placeText(line, f.x, f.y), button("show", () => this.centre(f.x, f.y))]))];
    });
  }
}
