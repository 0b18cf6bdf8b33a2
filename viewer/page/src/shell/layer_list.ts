// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The list of layers with their colours, and the legend. */
import { byId, el, legend, swatch } from "../dom";
import { kLayers, kLegend } from "../map/layers/all";
import type { MapView } from "../map/map_view";

function choice(key: string, label: string, colour: string, on: boolean, change: (on: boolean) => void): HTMLElement {
  const box = el("input", { type: "checkbox", "data-layer": key });
  box.checked = on;
  box.onchange = () => change(box.checked);
  return el("label", {}, box, swatch(`var(--${colour})`), label);
}

export function fillLayerList(map: MapView): void {
  byId("layers").append(
    choice("coverage", "ground: driven, scanned, seen by laser only", "driven", map.showsCoverage, (on) => { map.showsCoverage = on; map.dirty = true; }),
    ...kLayers.map(({ key, label, swatch: colour, on }) => choice(key, label, colour, on, (shown) => { map.shown.set(key, shown); map.dirty = true; })),
    el("hr"),
    legend(kLegend.map(([colour, meaning]) => [`var(--${colour})`, meaning])));
}
