// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Orders to a live robot, where the server takes them: each is confirmed, and carries the token. */
import { el, setText } from "../dom";
import type { Model } from "../state/model";
import { button, note, Panel } from "./panel";

export type Call = (service: string, request: Record<string, string>) => Promise<unknown>;

const kOrders: [order: string, label: string][] = [["pause", "Pause"], ["resume", "Resume"], ["return_home", "Return home"], ["stop", "Stop"]];

export class Orders extends Panel {
  readonly #token = el("input", { type: "password", placeholder: "token", "aria-label": "token of orders", autocomplete: "off" });
  readonly #answer = el("p", { role: "status", id: "answer" });

  constructor(private readonly model: Model, private readonly call: Call) { super("panel-orders", "Orders", "screen"); }

  isOffered(service: string): boolean {
    return this.model.info?.orders === true && this.model.services.some(({ name }) => name === service);
  }

  show(): void {
    const isOffered = this.isOffered("adit/order");
    const isLive = this.model.info?.source === "live";
    this.update(`${isOffered} ${isLive}`, () => {
      if (!isLive) return [];
      if (!isOffered) return [note("None: this view is read-only.")];
      return [this.#token, ...kOrders.map(([order, label]) => button(label, () => this.confirm("adit/order", { order }, label.toLowerCase()))), this.#answer];
    });
  }

  confirm(service: string, request: Record<string, string>, what: string): void {
    const dialog = el("dialog", {}, el("p", {}, `Send the order "${what}" to the robot?`));
    const close = () => { dialog.close(); dialog.remove(); };
    dialog.append(button("Send", () => { close(); this.#send(service, request, what); }), button("Cancel", close));
    document.body.append(dialog);
    dialog.showModal();
  }

  #send(service: string, request: Record<string, string>, what: string): void {
    setText(this.#answer, `${what}: sent`);
    this.call(service, { ...request, token: this.#token.value })
      .then(() => setText(this.#answer, `${what}: accepted`), (error: Error) => setText(this.#answer, `${what}: rejected, ${error.message}`));
  }
}
