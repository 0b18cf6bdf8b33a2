// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Light or dark, and the colours of canvases, from the style sheet, so that both have one source. */
import { byId, setText } from "./dom";

const kPhases = new Set(["waiting", "explore", "scan", "plan", "execute", "paused", "ended"]);
const kStateColours: Record<string, string> = { open: "open", explored: "done", blocked: "blocked", "too narrow": "blocked" };
const kHazardColours: Record<string, string> = {
  water: "water", mud: "water", methane: "gas", oxygen: "gas", "carbon monoxide": "gas", gas: "gas", "drop": "drop",
};

let cache = new Map<string, string>();
let generation = 0;

export function colour(name: string): string {
  let value = cache.get(name);
  if (value === undefined) {
    value = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim() || "#888";
    cache.set(name, value);
  }
  return value;
}

export function rgb(name: string): [number, number, number] {
  const match = /^#(..)(..)(..)$/.exec(colour(name));
  return match ? [parseInt(match[1]!, 16), parseInt(match[2]!, 16), parseInt(match[3]!, 16)] : [128, 128, 128];
}

/** Changes whenever the colours do. */
export function themeGeneration(): number { return generation; }

/** True for a phase that has a colour of its own. */
export function isPhase(phase: string): boolean { return kPhases.has(phase); }
export function stateColour(state: string): string { return colour(kStateColours[state] ?? "soft"); }
export function hazardColour(kind: string): string { return colour(kHazardColours[kind] ?? "hazard"); }

function setTheme(theme: "light" | "dark"): void {
  document.documentElement.dataset.theme = theme;
  setText(byId("theme"), theme === "dark" ? "Light" : "Dark");
  cache = new Map();
  ++generation;
}

/** Follows the system, until the button is used; paper is light. */
export function wireTheme(onChange: () => void): void {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const fromSystem = () => { setTheme(dark.matches ? "dark" : "light"); onChange(); };
  const current = () => (document.documentElement.dataset.theme === "dark" ? "dark" : "light");
  let beforePrint: "light" | "dark" = "light";
  dark.addEventListener("change", fromSystem);
  byId("theme").onclick = () => { setTheme(current() === "dark" ? "light" : "dark"); onChange(); };
  window.addEventListener("beforeprint", () => { beforePrint = current(); setTheme("light"); onChange(); });
  window.addEventListener("afterprint", () => { setTheme(beforePrint); onChange(); });
  fromSystem();
}
