// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Colours of canvases, from the style sheet, so that light and dark have one source. */
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

export function setTheme(theme: "light" | "dark" | "auto"): void {
  if (theme === "auto") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
  cache = new Map();
  ++generation;
}

export function watchTheme(onChange: () => void): void {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { cache = new Map(); ++generation; onChange(); });
}

const kStateColours: Record<string, string> = { open: "open", explored: "done", blocked: "blocked", "too narrow": "blocked" };
export function stateColour(state: string): string { return colour(kStateColours[state] ?? "soft"); }

const kHazardColours: Record<string, string> = { water: "water", mud: "water", gas: "gas", drop: "drop" };
export function hazardColour(kind: string): string { return colour(kHazardColours[kind] ?? "hazard"); }
