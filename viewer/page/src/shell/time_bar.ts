// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The slider over the mission, with its phases, stops and other events as marks. */
import { byId, clock, setText } from "../dom";
import { kWarning, type Model } from "../state/model";
import { colour, isPhase, themeGeneration } from "../theme";
import type { ViewTime } from "./view_time";

const kSteps = 1000;

export class TimeBar {
  readonly #slider = byId("slider") as HTMLInputElement;
  #isDragged = false;
  #drawn = "";

  constructor(private readonly model: Model, private readonly time: ViewTime) {
    const speed = byId("speed") as HTMLSelectElement;
    this.#slider.oninput = () => {
      const share = Number(this.#slider.value) / kSteps;
      time.seek(share >= 1 ? time.end_s : time.start_s + share * (time.end_s - time.start_s));
    };
    this.#slider.onpointerdown = () => { this.#isDragged = true; };
    window.addEventListener("pointerup", () => { this.#isDragged = false; });
    byId("follow").onclick = () => time.follow();
    byId("play").onclick = () => time.togglePlay();
    speed.onchange = () => time.setSpeed(Number(speed.value));
  }

  get isDragged(): boolean { return this.#isDragged; }

  update(): void {
    const { time } = this;
    const span_s = time.end_s - time.start_s;
    setText(byId("elapsed"), `${clock(time.now_s - time.start_s)} of ${clock(span_s)}`);
    setText(byId("play"), time.isPlaying ? "Pause" : "Play");
    byId("follow").hidden = time.isFollowing || this.model.info?.source !== "live";
    if (!(span_s > 0)) return;
    if (!this.#isDragged) this.#slider.value = String(kSteps * (time.now_s - time.start_s) / span_s);
    this.#drawMarks(span_s);
  }

  #drawMarks(span_s: number): void {
    const canvas = byId("marks") as HTMLCanvasElement;
    const { history, events } = this.model;
    const key = [span_s, this.time.start_s, history.length, events.length, canvas.clientWidth, canvas.clientHeight, themeGeneration()].join();
    if (key === this.#drawn) return;
    this.#drawn = key;
    [canvas.width, canvas.height] = [canvas.clientWidth, canvas.clientHeight];
    const context = canvas.getContext("2d")!;
    const x = (time_s: number) => (time_s - this.time.start_s) / span_s * canvas.width;
    history.forEach((row, i) => {
      if (!isPhase(row.phase)) return;
      context.fillStyle = colour(`phase-${row.phase}`);
      context.fillRect(x(row.time_s), 6, Math.max(1, x(history[i + 1]?.time_s ?? row.time_s) - x(row.time_s) + 0.5), 8);
    });
    for (const event of events) {
      const isWarning = event.level >= kWarning;
      context.fillStyle = colour(/revoked/i.test(event.message) ? "revoked" : isWarning ? "warn" : "soft");
      context.fillRect(x(event.time_s) - 1, isWarning ? 0 : 3, 2, 6);
    }
  }
}
