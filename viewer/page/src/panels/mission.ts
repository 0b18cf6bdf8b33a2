// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** State of the mission at the time shown. */
import { fixed, kNone, table } from "../dom";
import type { Model } from "../state/model";
import { num, str, type Raw } from "../state/values";
import { idOf, note, Panel } from "./panel";

const percent = (share: unknown, digits: number) => fixed(num(share) * 100, digits, "%");
const metres = (length_m: unknown, digits = 1) => fixed(num(length_m), digits, "m");

function rowsOf(mission: Raw): [string, string][] {
  const home = mission.returning_home === true ? `yes: ${str(mission.return_home_reason)}` : "no";
  return [
    ["outcome", str(mission.outcome, kNone)], ["driving", `${str(mission.driving)} ${str(mission.driving_reason)}`],
    ["decision", str(mission.decision_reason, kNone)], ["returning home", home],
    ["driven", metres(mission.distance_travelled_m)], ["explored", metres(mission.explored_m)], ["budget left", metres(mission.remaining_m)],
    ["speed", fixed(num(mission.speed_m_s), 2, "m/s")], ["battery", percent(mission.battery_share, 0)],
    ["methane", percent(mission.methane_share, 2)], ["oxygen", percent(mission.oxygen_share, 1)],
    ["carbon monoxide", fixed(num(mission.carbon_monoxide_share) * 1e6, 0, "ppm")],
    ["position, standard deviation", metres(mission.position_sd_m, 2)], ["match quality", fixed(num(mission.match_quality), 2)],
  ];
}

export class MissionPanel extends Panel {
  constructor(private readonly model: Model) { super("panel-mission", "Mission at this time", "screen"); }

  show(time_s: number): void {
    const mission = this.model.mission.at(time_s)?.value ?? null;
    this.update(idOf(mission), () => (mission ? [table([], rowsOf(mission))] : [note("No mission message yet.")]));
  }
}
