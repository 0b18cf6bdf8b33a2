// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Processes as the supervisor has them, with buttons where orders are taken, and the health of the stages. */
import { el, fixed, kNone, table, type Child } from "../dom";
import type { Model } from "../state/model";
import { list, num, raw, str } from "../state/values";
import type { Orders } from "./orders";
import { button, idOf, Panel } from "./panel";

const kMegabyte = 1 << 20;
const kActions = ["start", "stop", "restart"];

export class ProcessesPanel extends Panel {
  constructor(private readonly model: Model, private readonly orders: Orders) { super("panel-processes", "Processes and stages", "scroll screen"); }

  show(time_s: number): void {
    const message = this.model.processes.at(time_s)?.value ?? null;
    const withOrders = this.orders.isOffered("adit/process");
    this.update(`${idOf(message)} ${withOrders}`, () => {
      const processes = list(message?.computers).flatMap((computer) => list(raw(computer).processes).map((entry) => this.#row(entry, withOrders)));
      const stages = list(message?.stages).map(stageRow);
      return [
        processes.length > 0 ? table(["process", "group", "state", "pid", "CPU", "memory", "restarts", ""], processes) : null,
        stages.length > 0 ? table(["stage", "health", "handled", "rejected", "dropped", "age"], stages) : null,
      ];
    });
  }

  #row(entry: unknown, withOrders: boolean): Child[] {
    const process = raw(entry);
    const name = str(process.name);
    const buttons = kActions.map((action) => button(action, () => this.orders.confirm("adit/process", { process: name, action }, `${action} ${name}`)));
    return [name, str(process.group), process.running === true ? "running" : str(process.end, "ended"), str(process.pid, kNone),
      fixed(num(process.cpu_share) * 100, 0, "%"), fixed(num(process.memory_bytes) / kMegabyte, 0, "MB"), str(process.restarts),
      withOrders ? el("span", {}, ...buttons) : null];
  }
}

function stageRow(entry: unknown): Child[] {
  const stage = raw(entry);
  const level = str(stage.level);
  return [str(stage.name), el("span", level === "ok" ? {} : { class: "warn" }, `${level} ${str(stage.reason)}`), str(stage.handled), str(stage.rejected),
    str(stage.dropped), fixed(num(stage.age_s), 1, "s")];
}
