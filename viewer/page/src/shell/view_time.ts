// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Which time of the mission the page shows: the newest of a live robot, that of a played log, or a chosen one. */
import type { LiveSource } from "../protocol/live";
import type { Model } from "../state/model";

export class ViewTime {
  /** Source of a live robot or a log; null for a file. */
  source: LiveSource | null = null;
  /** Shows what arrives as it arrives. */
  isFollowing = true;
  /** Seconds of the mission that pass in one second. */
  speed = 30;
  #chosen_s = NaN;
  #isPlaying = false;

  constructor(private readonly model: Model) {}

  /** A server that plays a log decides about the time. */
  get isLog(): boolean { return this.model.info?.source === "log" && this.model.info.canPlay; }
  get now_s(): number { return this.isFollowing || this.isLog ? this.model.end_s : this.#chosen_s; }
  get start_s(): number { return this.model.start_s; }
  get end_s(): number { return this.isLog ? this.model.info?.dataEnd_s ?? this.model.end_s : this.model.end_s; }
  get isPlaying(): boolean { return this.isLog ? this.model.playback?.status === "playing" : this.#isPlaying; }

  seek(time_s: number): void {
    if (this.isLog) return this.#control(this.isPlaying, time_s);
    this.#chosen_s = time_s;
    this.isFollowing = this.model.info?.source === "live" && time_s >= this.model.end_s;
  }

  follow(): void {
    this.isFollowing = true;
    this.#isPlaying = false;
  }

  togglePlay(): void {
    if (this.isLog) return this.#control(!this.isPlaying, null);
    this.#isPlaying = !this.#isPlaying;
    if (!this.#isPlaying) return;
    this.#chosen_s = this.now_s >= this.model.end_s - 0.01 ? this.model.start_s : this.now_s;
    this.isFollowing = false;
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    if (this.isLog) this.#control(this.isPlaying, null);
  }

  /** Advances what the page itself plays, by wall time. */
  advance(passed_s: number): void {
    if (!this.#isPlaying || this.isLog) return;
    this.#chosen_s += passed_s * this.speed;
    if (this.#chosen_s < this.model.end_s) return;
    this.#chosen_s = this.model.end_s;
    this.#isPlaying = false;
    this.isFollowing = this.model.info?.source === "live";
  }

  #control(play: boolean, seek_s: number | null): void {
    this.source?.play({ play, speed: this.speed, seek_s, id: "page" });
  }
}
