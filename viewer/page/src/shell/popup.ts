// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Beside a place of the map: what it is. */
import { byId, eastNorth, el } from "../dom";
import type { Place } from "../map/layers/layer";
import type { MapView } from "../map/map_view";

const kOffset_px = 12;

export function hidePopup(): void { byId("popup").hidden = true; }

/** Shows the place, kept within the map; none hides it. */
export function showPopup(map: MapView, place: Place | null, px: number, py: number): void {
  const popup = byId("popup");
  popup.hidden = !place;
  if (!place) return;
  popup.replaceChildren(el("strong", {}, place.title), el("div", {}, place.text), el("div", { class: "soft" }, eastNorth(place.x, place.y)));
  popup.style.left = `${Math.max(0, Math.min(px + kOffset_px, map.camera.width - popup.offsetWidth))}px`;
  popup.style.top = `${Math.max(0, Math.min(py + kOffset_px, map.camera.height - popup.offsetHeight))}px`;
}
