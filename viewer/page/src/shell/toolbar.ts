// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Buttons above map and 3D view: which of them is shown, tools, "go to N m", and what the tools measured. */
import { byId, fixed, setText } from "../dom";
import type { MapView } from "../map/map_view";
import type { Tool } from "../map/measuring";
import type { Width } from "../map/width";
import { Chainage } from "../state/chainage";
import type { Model } from "../state/model";
import { uncertaintyAlong } from "../state/uncertainty";
import type { ViewTime } from "./view_time";

const kNearTrajectory_m = 5;

function widthText({ width_m, least_m, most_m }: Width): string {
  const [least, most] = [least_m.toFixed(1), most_m.toFixed(1)];
  return `width ${width_m.toFixed(2)} m${least === most ? "" : ` (${least} to ${most} m within 1 m)`}`;
}

export class Toolbar {
  constructor(private readonly model: Model, private readonly time: ViewTime, private readonly map: MapView, private readonly onView: () => void) {
    for (const button of document.querySelectorAll<HTMLElement>("[data-view]")) button.onclick = () => this.showView(button.dataset.view!);
    byId("fit").onclick = () => map.fit();
    byId("ruler").onclick = () => this.#toggle("ruler");
    byId("width").onclick = () => this.#toggle("width");
    byId("goto").onsubmit = (event) => { event.preventDefault(); this.#goTo(parseFloat((byId("chainage") as HTMLInputElement).value)); };
    document.addEventListener("keydown", (event) => { if (event.key === "Escape") map.setTool("pan"); });
    map.onMeasure = () => this.#showMeasure();
  }

  showView(name: string): void {
    byId("map").hidden = byId("layers").hidden = name !== "map";
    byId("volume").hidden = name !== "volume";
    for (const id of ["fit", "ruler", "width", "goto", "measure"]) byId(id).hidden = name !== "map";
    for (const button of document.querySelectorAll<HTMLElement>("[data-view]")) button.setAttribute("aria-pressed", String(button.dataset.view === name));
    this.onView();
  }

  #toggle(tool: Tool): void {
    this.map.setTool(this.map.measuring.tool === tool ? "pan" : tool);
  }

  #trajectory(): Chainage | null { return Chainage.at(this.model, this.time.now_s); }

  #goTo(distance_m: number): void {
    const line = this.#trajectory();
    const point = line?.pointAt(distance_m);
    if (!point) return setText(byId("measure"), line ? `the farthest place is ${line.length_m.toFixed(0)} m from the start` : "no trajectory yet");
    this.showView("map");
    this.map.centre(...point);
    this.map.measureWidth(...point);
  }

  #showMeasure(): void {
    const { tool, ruler, marked, width } = this.map.measuring;
    const [a, b] = ruler;
    const parts: string[] = [];
    if (tool === "ruler" && !a) parts.push("click two points");
    if (a && b) parts.push(`${Math.hypot(a[0] - b[0], a[1] - b[1]).toFixed(2)} m`);
    if (tool === "width" && !marked) parts.push("click in a tunnel");
    if (marked) parts.push(width ? widthText(width) : "no wall on both sides", ...this.#placeOf(marked));
    setText(byId("measure"), parts.join(" · "));
    for (const name of ["ruler", "width"]) byId(name).setAttribute("aria-pressed", String(tool === name));
  }

  /** Distance along the trajectory and how sure it is, of a point near the trajectory. */
  #placeOf(point: [number, number]): string[] {
    const near = this.#trajectory()?.nearest(...point);
    if (!near || near.offset_m > kNearTrajectory_m) return [];
    const semiAxis_m = uncertaintyAlong(this.model.uncertainty.at(this.time.now_s)?.value ?? [], near.distance_m);
    return [`at ${near.distance_m.toFixed(0)} m`, ...(semiAxis_m === null ? [] : [`95 % within ${fixed(semiAxis_m, 2, "m")}`])];
  }
}
