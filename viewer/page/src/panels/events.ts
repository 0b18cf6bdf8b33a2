// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Events up to the time shown, the newest first. */
import { clock, el, table } from "../dom";
import { kWarning, type Model } from "../state/model";
import { kRowLimit, note, Panel } from "./panel";

export class EventsPanel extends Panel {
  constructor(private readonly model: Model) { super("panel-events", "Events", "scroll screen"); }

  show(time_s: number): void {
    const past = this.model.events.filter((event) => event.time_s <= time_s);
    const events = past.slice(-kRowLimit).reverse();
    this.update(`${past.length} ${events[0]?.time_s} ${events[0]?.message}`, () => {
      if (events.length === 0) return [note("None up to this time.")];
      return [table(["time", "from", "event"], events.map((event) => [clock(event.time_s - this.model.start_s), event.name,
        el("span", event.level >= kWarning ? { class: "warn" } : {}, event.message)]))];
    });
  }
}
