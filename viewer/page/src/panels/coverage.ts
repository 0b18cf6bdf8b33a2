// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** How well the ground is known, by area, in the colours of the map. */
import { el, table } from "../dom";
import { coverageAreas } from "../state/grid";
import type { Model } from "../state/model";
import { idOf, Panel } from "./panel";

/** Of coverageAreas, with the colour of the ground: driven first. */
const kRows: [index: number, colour: string, label: string][] = [[3, "driven", "driven"], [2, "scanned", "scanned in 3D"], [1, "seen", "seen by the laser only"]];

export class CoveragePanel extends Panel {
  constructor(private readonly model: Model) { super("panel-coverage", "Ground"); }

  show(time_s: number): void {
    const grid = this.model.map.at(time_s)?.value ?? null;
    this.update(idOf(grid), () => {
      if (!grid) return [];
      const areas_m2 = coverageAreas(grid);
      return [table([], kRows.map(([index, colour, label]) => [
        el("span", {}, el("span", { class: "swatch inline", style: `background:var(--${colour})` }), label), `${areas_m2[index]!.toFixed(0)} m²`]))];
    });
  }
}
