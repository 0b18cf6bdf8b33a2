// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Drives the page with Chromium: run.ts synthetic | florence MISSION.html | live URL [TOKEN]. ADIT_PAGE is the page as built
 * (dist/page.html), ADIT_SCREENSHOTS the folder of the screenshots, ADIT_CHROMIUM the browser.
 */
import { join } from "node:path";
import { kTunnelWidth_m } from "../synthetic/mine";
import { writeEmbedded } from "../synthetic/embed";
import { checkFile, type KnownMine } from "./file_checks";
import { Harness } from "./harness";
import { checkConnection, checkOrders, checkSynthetic } from "./live_checks";

const kSynthetic: KnownMine = {
  at_m: 30, width_m: kTunnelWidth_m, rulerTolerance_m: 0.01 * kTunnelWidth_m, widthTolerance_m: 0.01,
  water: /water0.45 m100 m \+ 6 m \(106.0 E, 0.0 N\)/, headline: /water/,
};
/** sim/worlds/florence.yaml: 2.8 m, walls with a relief, cells of 0.1 m; water from 40 m, where the robot starts at 2 m. */
const kFlorence: KnownMine = { at_m: 20, width_m: 2.8, rulerTolerance_m: 0.25, widthTolerance_m: 0.25, water: /water/, headline: /water at 3\d\sm/ };

const [kind, target = "", token] = process.argv.slice(2);
const harness = await Harness.launch();
if (kind === "synthetic") {
  await checkSynthetic(harness);
  const file = join(harness.shots, "mission.html");
  writeEmbedded(file);
  await checkFile(harness, file, kSynthetic);
} else if (kind === "florence") {
  await checkFile(harness, target, kFlorence);
} else if (kind === "live") {
  const page = await checkConnection(harness, target);
  if (token) await checkOrders(harness, page, token);
} else {
  throw new Error("synthetic, florence MISSION.html or live URL [TOKEN]");
}
process.exit(await harness.finish());
