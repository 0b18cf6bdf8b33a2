// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** A section beside the map whose content is built when what it shows has changed. */
import { el, type Child } from "../dom";

/** Rows of a table that a person can read; more would slow the page. */
export const kRowLimit = 400;

export class Panel {
  readonly section: HTMLElement;
  readonly #body = el("div");
  #key = "";

  constructor(id: string, title: string, classes = "") {
    this.section = el("section", classes ? { id, class: classes } : { id }, el("h2", {}, title), this.#body);
  }

  /** `key` stands for all that the content depends on; a panel without content is hidden. */
  update(key: string, build: () => Child[]): void {
    if (key === this.#key) return;
    this.#key = key;
    const children = build().filter((child): child is Node | string => child !== null);
    this.section.hidden = children.length === 0;
    this.#body.replaceChildren(...children);
  }
}

const ids = new WeakMap<object, number>();
let nextId = 1;

/** Differs between two values; messages are immutable, so it stands for their content. */
export function idOf(value: object | null): string {
  if (!value) return "none";
  if (!ids.has(value)) ids.set(value, nextId++);
  return String(ids.get(value));
}

export function button(text: string, action: () => void): HTMLButtonElement {
  const element = el("button", { type: "button" }, text);
  element.addEventListener("click", action);
  return element;
}

export function note(text: string): HTMLElement { return el("p", { class: "soft" }, text); }
