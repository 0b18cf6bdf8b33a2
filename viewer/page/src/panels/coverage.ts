// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** How well the ground is known, by area, in the colours of the map. */
import { el, swatch, table } from "../dom";
import { coverageAreas, kCoverage } from "../state/grid";
import type { Model } from "../state/model";
import { idOf, Panel } from "./panel";

export class CoveragePanel extends Panel {
  constructor(private readonly model: Model) { super("panel-coverage", "Ground"); }

  show(time_s: number): void {
    const grid = this.model.map.at(time_s)?.value ?? null;
    this.update(idOf(grid), () => {
      if (!grid) return [];
      const areas_m2 = coverageAreas(grid);
      const rows = kCoverage.map(([colour, meaning], i) => [el("span", {}, swatch(`var(--${colour})`, "inline"), meaning), `${areas_m2[i]!.toFixed(0)} m²`]);
      return [table([], rows.slice(1).reverse())];  // driven first, without what was never seen
    });
  }
}
