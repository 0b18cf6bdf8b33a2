// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The list of 3D scans, and the card of one: terrain, C-space, path or reason. */
import { clock, eastNorth, el, fixed, kNone, legend, table } from "../dom";
import type { Model, ScanCard } from "../state/model";
import { list, num, raw, str } from "../state/values";
import { button, idOf, kRowLimit, note, Panel } from "./panel";

/** Only images inside of the message are shown; an address could load something. */
const kPicture = /^data:image\/(png|jpeg|svg\+xml);base64,/;
const kCaptions: Record<string, string> = { terrain: "terrain with the planned path", c_space: "C-space at the heading of the path", view: "points, in the direction of the laser" };

/** Colours of the pictures: of the ground (tools/report draws them), and of the cells that block the path. */
const kPictureLegend: [colour: string, meaning: string][] = [
  ["linear-gradient(90deg, #fff, #000)", "terrain: 0 to 0.3 m of roughness; C-space: even to rough, black not passable"], ["#e2d6b5", "not scanned"], ["#b3a6cf", "in shadow"],
  ["#e8b184", "below a beam"], ["#86b5dc", "no return: possible water"], ["#0d8a4e", "planned path, outlines of the vehicle"], ["#0b5fff", "goal"],
  ["#ff00b8", "blocked: step"], ["#e0182d", "blocked: too high for the belly"], ["#7b1fa2", "blocked: roof too low"], ["#d9ab00", "blocked: unknown"],
  ["#1560bd", "blocked: possible water"], ["#7a4a21", "blocked: too steep"], ["#008b8b", "blocked: drop"],
];

function pictureLegend(): HTMLElement {
  return el("details", {}, el("summary", {}, "Legend"), legend(kPictureLegend));
}

export class ScansPanel extends Panel {
  constructor(private readonly model: Model, private readonly open: (number: number) => void) { super("panel-scans", "3D scans", "scroll screen"); }

  show(time_s: number): void {
    const scans = this.model.scansUntil(time_s).slice(-kRowLimit);
    this.update(`scans ${scans.map((scan) => idOf(scan)).join()}`, () => {
      if (scans.length === 0) return [note("None up to this time.")];
      return [table(["no.", "time", "points", "plan", ""], scans.map((scan) => [String(scan.number), clock(scan.time_s - this.model.start_s), str(scan.raw.points),
        str(raw(list(scan.raw.plans).at(-1)).outcome, kNone), button("open", () => this.open(scan.number))]))];
    });
  }
}

export class CardPanel extends Panel {
  #open: number | null = null;

  constructor(private readonly model: Model) { super("panel-card", "Card of the 3D scan", "screen"); }

  open(number: number): void {
    this.#open = number;
    this.show();
    this.section.scrollIntoView({ block: "nearest" });
  }

  show(): void {
    const scan = this.#open === null ? undefined : this.model.scans.get(this.#open);
    this.update(`card ${idOf(scan ?? null)}`, () => (scan ? this.#build(scan) : []));
  }

  #build(scan: ScanCard): HTMLElement[] {
    const pictures = Object.entries(raw(scan.raw.pictures)).filter(([, url]) => kPicture.test(String(url)));
    const step = (by: number) => button(by < 0 ? "previous" : "next", () => { if (this.model.scans.has(scan.number + by)) this.open(scan.number + by); });
    return [
      el("p", {}, `Scan ${scan.number} by ${str(scan.raw.laser)}, ${str(scan.raw.points)} points, at ${eastNorth(scan.x, scan.y)}${scan.raw.complete === false ? ", incomplete" : ""}`),
      table(["plan", "reason", "reached", "length", "clearance"], list(scan.raw.plans).map((plan) => [str(raw(plan).outcome), str(raw(plan).reason),
        fixed(num(raw(plan).reached_m), 1, "m"), fixed(num(raw(plan).length_m), 1, "m"), fixed(num(raw(plan).clearance_m), 2, "m")])),
      ...pictures.map(([name, url]) => el("figure", {}, el("img", { src: String(url), alt: kCaptions[name] ?? name }), el("figcaption", {}, kCaptions[name] ?? name))),
      ...(pictures.length > 0 ? [pictureLegend()] : []),
      el("p", {}, step(-1), " ", step(1), " ", button("close", () => { this.#open = null; this.show(); })),
    ];
  }
}
