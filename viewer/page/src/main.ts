// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Joins source, model and views, and draws what changed. */
import "./style.css";
import { byId } from "./dom";
import { MapView } from "./map/map_view";
import { Panels } from "./panels/panels";
import { Plots } from "./plots/plots";
import { loadEmbedded } from "./protocol/embedded";
import { LiveSource } from "./protocol/live";
import { updateHeader } from "./shell/header";
import { fillLayerList } from "./shell/layer_list";
import { hidePopup, showPopup } from "./shell/popup";
import { TimeBar } from "./shell/time_bar";
import { Toolbar } from "./shell/toolbar";
import { ViewTime } from "./shell/view_time";
import { isKnown, Model } from "./state/model";
import { frontiersOf } from "./state/scene";
import { wireTheme } from "./theme";
import { VolumeView } from "./view3d/volume_view";

const kPanelPeriod_ms = 200;
const kDefaultHost = "127.0.0.1:8765";

const model = new Model();
const time = new ViewTime(model);
const timeBar = new TimeBar(model, time);
const map = new MapView(byId("map") as HTMLCanvasElement, model);
const volume = new VolumeView(byId("volume"), model);
const toolbar = new Toolbar(model, time, map, hidePopup);
const panels = new Panels(byId("panels"), model, {
  centre(x, y) { toolbar.showView("map"); map.centre(x, y); },
  call: (service, request) => time.source?.call(service, request) ?? Promise.reject(new Error("not connected")),
});
const plots = new Plots(model, (time_s) => time.seek(time_s));
byId("panels").append(plots.section);
fillLayerList(map);
wireTheme(() => { map.dirty = true; });
map.onMoved = hidePopup;  // it belongs to a place on the screen
map.onPick = (place, px, py) => {
  showPopup(map, place, px, py);
  if (place?.scan !== undefined) panels.openScan(place.scan);
};
document.addEventListener("keydown", (event) => { if (event.key === "Escape") hidePopup(); });
window.addEventListener("beforeprint", () => { toolbar.showView("map"); map.fit(); map.draw(time.now_s); });

/** A fault of one view is counted, and the others are drawn. */
function guarded(what: string, action: () => void): void {
  try { action(); } catch (error) { model.countFault(what); console.error(error); }
}

let lastFrame_ms = 0;
let lastPanels_ms = 0;
let drawn = "";
function frame(now_ms: number): void {
  if (!timeBar.isDragged) time.advance(Math.min(0.5, (now_ms - lastFrame_ms) / 1000));
  lastFrame_ms = now_ms;
  const time_s = time.now_s;
  const key = `${time_s} ${model.revision}`;  // MapView itself notices another size
  if (map.dirty || key !== drawn) {
    drawn = key;
    map.dirty = false;
    guarded("drawing of the map", () => map.draw(time_s));
  }
  guarded("drawing of the 3D view", () => volume.draw(time_s));
  if (now_ms - lastPanels_ms > kPanelPeriod_ms) {
    lastPanels_ms = now_ms;
    guarded("header", () => updateHeader(model, time));
    guarded("panels", () => panels.update(time_s));
    guarded("time bar", () => timeBar.update());
    guarded("plots", () => plots.update(time_s));
  }
  requestAnimationFrame(frame);
}

function connect(): void {
  const given = new URLSearchParams(location.search).get("ws");
  const scheme = location.protocol === "https:" ? "wss" : "ws";
  const host = given ?? (location.host || kDefaultHost);
  time.source = new LiveSource(/^wss?:/.test(host) ? host : `${scheme}://${host}/`, model, isKnown);
  time.source.connect();
}

/** "#scan-3" and "#frontier-3", to which map.svg links. */
function followHash(): void {
  const [, kind, id] = /^#(scan|frontier)-(\d+)$/.exec(location.hash) ?? [];
  const scan = kind === "scan" ? model.scans.get(Number(id)) : undefined;
  const frontier = kind === "frontier" ? frontiersOf(model.frontiers.at(time.now_s)?.value ?? []).find((known) => known.id === id) : undefined;
  if (scan) panels.openScan(scan.number);
  const place = scan ?? frontier;
  if (place) map.centre(place.x, place.y);
}

window.addEventListener("hashchange", followHash);
requestAnimationFrame(frame);
void loadEmbedded(model).then((isFile) => { if (isFile) followHash(); else connect(); });
