// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
import "./style.css";
import { byId, clock, el, fixed, kNone, setText } from "./dom";
import { kLayers, MapView, type Tool } from "./map/map_view";
import { Panels } from "./panels/panels";
import { Plots } from "./plots/plots";
import { loadEmbedded } from "./protocol/embedded";
import { LiveSource } from "./protocol/live";
import { Chainage } from "./state/chainage";
import { isKnown, Model } from "./state/model";
import { ellipsesOf } from "./state/scene";
import { str } from "./state/values";
import { colour, setTheme, watchTheme } from "./theme";
import { VolumeView } from "./view3d/volume_view";

const model = new Model();
let source: LiveSource | null = null;
let follow = true;
let viewTime_s = NaN;
let playing = false;
let dragging = false;

const map = new MapView(byId("map") as HTMLCanvasElement, model);
const volume = new VolumeView(byId("volume"), model);
const panels = new Panels(byId("panels"), model, {
  centre(x, y) { showView("map"); map.centre(x, y); },
  call: (service, request) => source?.call(service, request) ?? Promise.reject(new Error("not connected")),
});
const plots = new Plots(model, (time_s) => {
  if (isLog()) { source?.play({ play: model.playback?.status === "playing", speed: model.playback?.speed ?? 1, seek_s: time_s, id: "page" }); return; }
  viewTime_s = time_s;
  follow = false;
});
byId("panels").append(plots.section);
const slider = byId("slider") as HTMLInputElement;
const popup = byId("popup");

/** A fault of one view is counted, and the others are drawn. */
function guarded(what: string, action: () => void): void {
  try { action(); } catch (error) { model.countFault(what); console.error(error); }
}

const isLog = () => model.info?.source === "log" && model.info.canPlay;
const timeNow = () => (follow || isLog() ? model.end_s : viewTime_s);
const lastTime = () => (isLog() ? model.info?.dataEnd_s ?? model.end_s : model.end_s);

function showView(name: string): void {
  byId("map").hidden = name !== "map";
  byId("volume").hidden = name !== "volume";
  byId("layers").hidden = name !== "map";
  popup.hidden = true;
  for (const button of document.querySelectorAll<HTMLElement>("[data-view]")) button.setAttribute("aria-pressed", String(button.dataset.view === name));
}

function chainage(): Chainage | null {
  const found = model.trajectory.at(timeNow());
  return found && Chainage.of(found.value);
}

/** Half axis of the 95 % ellipse at a distance along the trajectory, from its two neighbours. */
function uncertaintyAt(distance_m: number): number | null {
  const along = ellipsesOf(model.uncertainty.at(timeNow())?.value ?? []).filter((e) => Number.isFinite(e.distance_m)).sort((a, b) => a.distance_m - b.distance_m);
  const after = along.findIndex((e) => e.distance_m >= distance_m);
  const b = along[after];
  const a = along[after - 1] ?? b;
  if (!a || !b) return null;
  const share = b.distance_m > a.distance_m ? (distance_m - a.distance_m) / (b.distance_m - a.distance_m) : 0;
  return a.semiAxis_m + share * (b.semiAxis_m - a.semiAxis_m);
}

function showMeasure(): void {
  const parts: string[] = [];
  const [a, b] = map.ruler;
  if (map.tool === "ruler" && !a) parts.push("click two points");
  if (a && b) parts.push(`${Math.hypot(a[0] - b[0], a[1] - b[1]).toFixed(2)} m`);
  if (map.tool === "width" && !map.marked) parts.push("click in a tunnel");
  if (map.marked) {
    parts.push(map.width ? `width ${map.width.width_m.toFixed(2)} m` : "no wall on both sides");
    const near = chainage()?.nearest(...map.marked);
    if (near && near.offset_m < 5) {
      parts.push(`at ${near.distance_m.toFixed(0)} m`);
      const sd = uncertaintyAt(near.distance_m);
      if (sd !== null) parts.push(`95 % within ${fixed(sd, 2, "m")}`);
    }
  }
  setText(byId("measure"), parts.join(" · "));
  for (const tool of ["ruler", "width"]) byId(tool).setAttribute("aria-pressed", String(map.tool === tool));
}

function setTool(tool: Tool): void {
  const next = map.tool === tool ? "pan" : tool;
  map.clearTools();
  map.tool = next;
  popup.hidden = true;
  showMeasure();
}

function wire(): void {
  for (const button of document.querySelectorAll<HTMLElement>("[data-view]")) button.onclick = () => showView(button.dataset.view!);
  byId("fit").onclick = () => map.fit();
  byId("ruler").onclick = () => setTool("ruler");
  byId("width").onclick = () => setTool("width");
  map.onMeasure = showMeasure;
  // A popup belongs to a place on the screen, which moves with the map.
  byId("map").addEventListener("wheel", () => { popup.hidden = true; }, { passive: true });
  document.addEventListener("keydown", (event) => { if (event.key === "Escape") { map.clearTools(); popup.hidden = true; } });
  byId("goto").onsubmit = (event) => {
    event.preventDefault();
    const line = chainage();
    const point = line?.pointAt(parseFloat((byId("chainage") as HTMLInputElement).value));
    if (!point) { setText(byId("measure"), line ? `the trajectory is ${line.length_m.toFixed(0)} m long` : "no trajectory yet"); return; }
    showView("map");
    map.centre(...point);
    map.measureWidth(...point);
  };
  map.onPick = (place, px, py) => {
    popup.hidden = !place;
    if (!place) return;
    popup.replaceChildren(el("strong", {}, place.title), el("div", {}, place.text), el("div", { class: "soft" }, `${place.x.toFixed(1)} E, ${place.y.toFixed(1)} N`));
    popup.style.left = `${Math.max(0, Math.min(px + 12, map.camera.width - 300))}px`;
    popup.style.top = `${Math.min(py + 12, map.camera.height - 90)}px`;
    if (place.number !== undefined) panels.openScan(place.number);
  };
  for (const [key, label, swatch, on] of kLayers) {
    const box = el("input", { type: "checkbox", "data-layer": key });
    box.checked = on;
    box.onchange = () => { map.shown.set(key, box.checked); map.dirty = true; };
    byId("layers").append(el("label", {}, box, el("span", { class: "swatch", style: `background:var(--${swatch})` }), label));
  }
  const legend = [["wall", "wall"], ["free", "free"], ["unknown", "never seen"], ["driven", "driven"], ["scanned", "scanned in 3D"], ["seen", "seen by the laser only"],
    ["open", "frontier open"], ["done", "frontier explored"], ["blocked", "frontier blocked, too narrow"]];
  byId("layers").append(el("hr"), ...legend.map(([name, label]) => el("label", {}, el("span", { class: "swatch", style: `background:var(--${name});outline:1px solid var(--line)` }), label!)));
  byId("theme").onclick = () => {
    const dark = document.documentElement.dataset.theme === "dark";
    setTheme(dark ? "light" : "dark");
    setText(byId("theme"), dark ? "Dark" : "Light");
    map.dirty = true;
  };
  const fromSystem = () => {
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    setTheme(dark ? "dark" : "light");
    setText(byId("theme"), dark ? "Light" : "Dark");
    map.dirty = true;
  };
  watchTheme(fromSystem);
  fromSystem();
  slider.oninput = () => {
    const time_s = model.start_s + Number(slider.value) / 1000 * (lastTime() - model.start_s);
    if (isLog()) { source?.play({ play: model.playback?.status === "playing", speed: model.playback?.speed ?? 1, seek_s: time_s, id: "page" }); return; }
    viewTime_s = time_s;
    follow = Number(slider.value) >= 1000 && model.info?.source === "live";
  };
  slider.onpointerdown = () => { dragging = true; };
  window.addEventListener("pointerup", () => { dragging = false; });
  byId("follow").onclick = () => { follow = true; playing = false; };
  const speed = () => Number((byId("speed") as HTMLSelectElement).value);
  byId("play").onclick = () => {
    if (isLog()) { source?.play({ play: model.playback?.status !== "playing", speed: speed(), seek_s: null, id: "page" }); return; }
    playing = !playing;
    if (playing && timeNow() >= model.end_s - 0.01) viewTime_s = model.start_s;
    if (playing) follow = false;
  };
  byId("speed").onchange = () => { if (isLog()) source?.play({ play: model.playback?.status === "playing", speed: speed(), seek_s: null, id: "page" }); };
  window.addEventListener("beforeprint", () => { showView("map"); map.fit(); map.draw(timeNow()); });
}

function drawMarks(): void {
  const canvas = byId("marks") as HTMLCanvasElement;
  const { clientWidth: w, clientHeight: h } = canvas;
  canvas.width = w;
  canvas.height = h;
  const context = canvas.getContext("2d")!;
  const span = lastTime() - model.start_s;
  if (!(span > 0)) return;
  const x = (t: number) => (t - model.start_s) / span * w;
  model.history.forEach((row, i) => {
    const next = model.history[i + 1];
    if (!/^[a-z]+$/.test(row.phase)) return;
    context.fillStyle = colour(`phase-${row.phase}`);
    context.fillRect(x(row.time_s), 6, Math.max(1, x(next?.time_s ?? row.time_s) - x(row.time_s) + 0.5), 8);
  });
  for (const event of model.events) {
    context.fillStyle = colour(/revoked/i.test(event.message) ? "revoked" : event.level >= 3 ? "warn" : "soft");
    context.fillRect(x(event.time_s) - 1, event.level >= 3 ? 0 : 3, 2, 6);
  }
}

function connectionText(): string {
  const { connection } = model;
  switch (connection.kind) {
    case "connecting": return "connecting";
    case "file": return "finished mission";
    case "failed": return connection.reason;
    case "lost": return `connection lost, trying again in ${connection.retry_s.toFixed(0)} s`;
    case "open": {
      const quiet_s = (Date.now() - model.lastMessage_ms) / 1000;
      if (model.lastMessage_ms > 0 && quiet_s > 4 && !isLog()) return `live, no data for ${quiet_s.toFixed(0)} s`;
      return model.info?.source === "log" ? "log" : "live";
    }
  }
}

function updateHeader(time_s: number): void {
  const mission = model.mission.at(time_s)?.value ?? {};
  setText(byId("title"), model.info?.title || "Adit");
  document.title = model.info?.title ? `${model.info.title} – Adit` : "Adit";
  const phase = str(mission.phase, kNone);
  setText(byId("phase"), phase);
  if (/^[a-z]+$/.test(phase)) byId("phase").style.color = `var(--phase-${phase})`;
  setText(byId("reason"), str(mission.reason));
  byId("stop").hidden = mission.stopped !== true;
  setText(byId("stop"), mission.stopped === true ? `STOP: ${str(mission.stop_reason, "no reason given")}` : "");
  setText(byId("connection"), connectionText());
  byId("faults").hidden = model.faultCount === 0;
  setText(byId("faults"), `${model.faultCount} messages not decoded`);
  byId("faults").title = [...model.faults].map(([what, count]) => `${what}: ${count}`).join("\n");
  const headline = str(model.summary.at(Infinity)?.value.headline);
  byId("headline").hidden = headline === "";
  setText(byId("headline"), headline);
  setText(byId("time"), time_s > 1e8 ? `${new Date(time_s * 1000).toISOString().slice(0, 19).replace("T", " ")} UTC` : "");
  setText(byId("elapsed"), `${clock(time_s - model.start_s)} of ${clock(lastTime() - model.start_s)}`);
  byId("follow").hidden = follow || model.info?.source !== "live";
  const running = isLog() ? model.playback?.status === "playing" : playing;
  setText(byId("play"), running ? "Pause" : "Play");
}

let lastFrame_ms = 0;
let lastPanels_ms = 0;
let drawn = "";
function frame(now_ms: number): void {
  const passed_s = Math.min(0.5, (now_ms - lastFrame_ms) / 1000);
  lastFrame_ms = now_ms;
  if (playing && !dragging && !isLog()) {
    viewTime_s += passed_s * Number((byId("speed") as HTMLSelectElement).value);
    if (viewTime_s >= model.end_s) { viewTime_s = model.end_s; playing = false; follow = model.info?.source === "live"; }
  }
  const time_s = timeNow();
  const key = `${time_s} ${model.revision} ${byId("map").clientWidth} ${byId("map").clientHeight}`;
  if (map.dirty || key !== drawn) {
    drawn = key;
    map.dirty = false;
    guarded("drawing of the map", () => map.draw(time_s));
  }
  guarded("drawing of the 3D view", () => volume.draw(time_s));
  if (now_ms - lastPanels_ms > 200) {
    lastPanels_ms = now_ms;
    guarded("header", () => updateHeader(time_s));
    guarded("panels", () => panels.update(time_s));
    guarded("marks", drawMarks);
    guarded("plots", () => plots.update(time_s));
    const span = lastTime() - model.start_s;
    if (!dragging && span > 0) slider.value = String(1000 * (time_s - model.start_s) / span);
  }
  requestAnimationFrame(frame);
}

wire();
requestAnimationFrame(frame);
void loadEmbedded(model).then((isFile) => {
  if (isFile) return;
  const given = new URLSearchParams(location.search).get("ws");
  const scheme = location.protocol === "https:" ? "wss" : "ws";
  const host = given ?? (location.host || "127.0.0.1:8765");
  source = new LiveSource(/^wss?:/.test(host) ? host : `${scheme}://${host}/`, model, isKnown);
  source.connect();
});
