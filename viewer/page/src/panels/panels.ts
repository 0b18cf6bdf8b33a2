// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The panels beside the map, in their order. */
import type { Model } from "../state/model";
import { CoveragePanel } from "./coverage";
import { EventsPanel } from "./events";
import { MissionPanel } from "./mission";
import { Orders, type Call } from "./orders";
import { FrontiersPanel, HazardsPanel, type Centre } from "./places";
import { ProcessesPanel } from "./processes";
import { CardPanel, ScansPanel } from "./scans";
import { SummaryPanel } from "./summary";

export interface PanelActions {
  centre: Centre;
  call: Call;
}

export class Panels {
  readonly #card: CardPanel;
  readonly #shown: { section: HTMLElement; show(time_s: number): void }[];

  constructor(host: HTMLElement, model: Model, { centre, call }: PanelActions) {
    const orders = new Orders(model, call);
    this.#card = new CardPanel(model);
    this.#shown = [new SummaryPanel(model), orders, this.#card, new MissionPanel(model), new CoveragePanel(model), new HazardsPanel(model, centre), new FrontiersPanel(model, centre),
      new ScansPanel(model, (number) => this.openScan(number)), new ProcessesPanel(model, orders), new EventsPanel(model)];
    host.append(...this.#shown.map(({ section }) => section));
  }

  openScan(number: number): void { this.#card.open(number); }

  update(time_s: number): void { for (const panel of this.#shown) panel.show(time_s); }
}
