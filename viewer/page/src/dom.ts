// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Elements and texts; texts of messages never become markup. */
export type Child = Node | string | null;

export function el<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Record<string, string> = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  for (const child of children) if (child !== null) element.append(child);
  return element;
}

export function byId(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (!element) throw new Error(`page without #${id}`);
  return element;
}

export function setText(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** Without a head if there are no names. */
export function table(head: string[], rows: Child[][]): HTMLTableElement {
  const cells = (tag: "th" | "td", values: Child[]) => el("tr", {}, ...values.map((value) => el(tag, {}, value)));
  return el("table", {}, head.length > 0 ? el("thead", {}, cells("th", head)) : null, el("tbody", {}, ...rows.map((row) => cells("td", row))));
}

/** A sample of a colour, any background of CSS. */
export function swatch(colour: string, ...classes: string[]): HTMLElement {
  return el("span", { class: ["swatch", ...classes].join(" "), style: `background:${colour}` });
}

/** What colours stand for. */
export function legend(entries: [colour: string, meaning: string][]): HTMLElement {
  return el("div", { class: "legend" }, ...entries.map(([colour, meaning]) => el("label", {}, swatch(colour), meaning)));
}

/** Coordinates in the grid of the mine, metres. */
export function eastNorth(x: number, y: number, digits = 1): string {
  return `${x.toFixed(digits)} E, ${y.toFixed(digits)} N`;
}

export const kNone = "–";

export function fixed(value: number | null, digits: number, unit = ""): string {
  return value === null || !Number.isFinite(value) ? kNone : `${value.toFixed(digits)}${unit ? ` ${unit}` : ""}`;
}

/** h:mm:ss of a duration in seconds. */
export function clock(duration_s: number): string {
  if (!Number.isFinite(duration_s)) return kNone;
  const s = Math.max(0, Math.floor(duration_s));
  const two = (n: number) => String(n).padStart(2, "0");
  return `${Math.floor(s / 3600)}:${two(Math.floor(s / 60) % 60)}:${two(s % 60)}`;
}
