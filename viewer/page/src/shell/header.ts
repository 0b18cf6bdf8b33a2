// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Above all: what is shown, phase, STOP, state of the connection, the headline of a finished mission. */
import { byId, kNone, setText } from "../dom";
import type { Model } from "../state/model";
import { str } from "../state/values";
import { isPhase } from "../theme";
import type { ViewTime } from "./view_time";

const kQuiet_s = 4;
const kOldestDate_s = 1e8;  // earlier times are those of a simulation that counts from zero

function connectionText(model: Model, isLog: boolean): string {
  const { connection } = model;
  switch (connection.kind) {
    case "connecting": return "connecting";
    case "file": return "finished mission";
    case "failed": return connection.reason;
    case "lost": return `connection lost, trying again in ${connection.retry_s.toFixed(0)} s`;
    case "open": {
      const quiet_s = (Date.now() - model.lastMessage_ms) / 1000;
      if (model.lastMessage_ms > 0 && quiet_s > kQuiet_s && !isLog) return `live, no data for ${quiet_s.toFixed(0)} s`;
      return model.info?.source === "log" ? "log" : "live";
    }
  }
}

export function updateHeader(model: Model, time: ViewTime): void {
  const time_s = time.now_s;
  const mission = model.mission.at(time_s)?.value ?? {};
  setText(byId("title"), model.info?.title || "Adit");
  document.title = model.info?.title ? `${model.info.title} – Adit` : "Adit";
  const phase = str(mission.phase, kNone);
  setText(byId("phase"), phase);
  byId("phase").style.color = isPhase(phase) ? `var(--phase-${phase})` : "";
  setText(byId("reason"), str(mission.reason));
  byId("reason").title = str(mission.reason);
  byId("stop").hidden = mission.stopped !== true;
  setText(byId("stop"), mission.stopped === true ? `STOP: ${str(mission.stop_reason, "no reason given")}` : "");
  setText(byId("connection"), connectionText(model, time.isLog));
  byId("faults").hidden = model.faultCount === 0;
  setText(byId("faults"), `${model.faultCount} messages not decoded`);
  byId("faults").title = [...model.faults].map(([what, count]) => `${what}: ${count}`).join("\n");
  const headline = str(model.summary.at(Infinity)?.value.headline);
  byId("headline").hidden = headline === "";
  setText(byId("headline"), headline);
  setText(byId("time"), time_s > kOldestDate_s ? `${new Date(time_s * 1000).toISOString().slice(0, 19).replace("T", " ")} UTC` : "");
}
