// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Quantities over time; a click moves the slider, the cursors move together. */
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { el } from "../dom";
import type { Model } from "../state/model";
import { colour, themeGeneration } from "../theme";

const kPlots: [title: string, matches: (key: string) => boolean][] = [
  ["speed, m/s", (k) => k === "speed"], ["battery, %", (k) => k === "battery"], ["methane, %", (k) => k === "methane"], ["oxygen, %", (k) => k === "oxygen"],
  ["carbon monoxide, ppm", (k) => k === "carbon monoxide"], ["match quality", (k) => k === "match quality"], ["position sd, m", (k) => k === "position sd"],
  ["CPU, %", (k) => k.startsWith("cpu ")], ["memory, MB", (k) => k.startsWith("memory ")],
];
const kColours = ["outbound", "return", "done", "sd", "gas", "open", "drop", "loop", "revoked", "soft"];

export class Plots {
  readonly section = el("section", { id: "panel-plots", class: "screen" }, el("h2", {}, "Plots"));
  #plots = new Map<string, { plot: uPlot; host: HTMLElement; key: string }>();
  #time_s = NaN;

  constructor(private readonly model: Model, private readonly seek: (time_s: number) => void) {}

  update(time_s: number): void {
    const moved = this.#time_s !== time_s;
    this.#time_s = time_s;
    for (const [title, matches] of kPlots) {
      const keys = [...this.model.series.keys()].filter(matches);
      if (keys.length === 0) continue;
      const series = keys.map((key) => this.model.series.get(key)!);
      const shape = `${keys.join()} ${themeGeneration()} ${this.section.clientWidth}`;
      const revision = series.reduce((sum, s) => sum + s.revision, 0);
      let known = this.#plots.get(title);
      const data = () => (series.length === 1 ? [series[0]!.t, series[0]!.v] : uPlot.join(series.map((s) => [s.t, s.v]))) as uPlot.AlignedData;
      if (!known || !known.key.startsWith(`${shape}|`)) {
        known?.plot.destroy();
        const host = known?.host ?? el("div");
        if (!known) this.section.append(host);
        known = { host, key: "", plot: this.#create(host, title, keys, data()) };
        this.#plots.set(title, known);
      } else if (known.key !== `${shape}|${revision}`) known.plot.setData(data());
      else if (moved) known.plot.redraw(false);
      known.key = `${shape}|${revision}`;
    }
  }

  #create(host: HTMLElement, title: string, keys: string[], data: uPlot.AlignedData): uPlot {
    const axis = { stroke: colour("soft"), grid: { stroke: colour("line"), width: 1 }, ticks: { stroke: colour("line") }, font: "10px system-ui" };
    const plot = new uPlot({
      title, width: Math.max(200, this.section.clientWidth - 26), height: keys.length > 1 ? 160 : 105, legend: { show: keys.length > 1 },
      cursor: { sync: { key: "adit" }, drag: { x: false, y: false } },
      axes: [{ ...axis, size: 32, values: (_u, ticks) => ticks.map((t) => `${((t - this.model.start_s) / 60).toFixed(1)} min`) }, { ...axis, size: 44 }],
      series: [{}, ...keys.map((key, i) => ({ label: key.replace(/^(cpu|memory) /, ""), stroke: colour(kColours[i % kColours.length]!), width: 1.2, spanGaps: true, points: { show: false } }))],
      hooks: { draw: [(u) => {
        const x = u.valToPos(this.#time_s, "x", true);
        u.ctx.fillStyle = colour("tool");
        u.ctx.fillRect(x - 0.5, u.bbox.top, 1.5, u.bbox.height);
      }] },
    }, data, host);
    plot.over.addEventListener("click", (event) => this.seek(plot.posToVal(event.offsetX, "x")));
    return plot;
  }
}
