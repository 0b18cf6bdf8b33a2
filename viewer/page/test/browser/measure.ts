// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Size, load time and frame rates of a finished mission: vite-node test/browser/measure.ts MISSION.html */
import { statSync } from "node:fs";
import { pathToFileURL } from "node:url";
import type { Page } from "playwright-core";
import { Harness, textOf, until } from "./harness";

const kDrag_ms = 4000;

/** Frames that the browser draws in a second while the pointer drags to and fro over an element. */
async function framesWhileDragging(page: Page, selector: string): Promise<number> {
  const box = (await page.locator(selector).boundingBox())!;
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.evaluate(() => {
    const counter = window as unknown as { frames: number };
    counter.frames = 0;
    const count = () => { ++counter.frames; requestAnimationFrame(count); };
    requestAnimationFrame(count);
  });
  const begin = Date.now();
  for (let i = 0; Date.now() - begin < kDrag_ms; ++i) await page.mouse.move(x + 150 * Math.sin(i / 8), y + 60 * Math.cos(i / 8));
  const frames = await page.evaluate(() => (window as unknown as { frames: number }).frames);
  const passed_s = (Date.now() - begin) / 1000;
  await page.mouse.up();
  return frames / passed_s;
}

const file = process.argv[2]!;
const harness = await Harness.launch();
const begin = Date.now();
const page = await harness.open(pathToFileURL(file).href);
await until("map", async () => (await textOf(page, "connection")) === "finished mission");
const load_s = (Date.now() - begin) / 1000;
const map = await framesWhileDragging(page, "#map");
await page.locator("[data-view=volume]").click();
const points = async () => /^([1-9]\d*) points/.exec(await textOf(page, "volume-status"))?.[1];
const before3d = Date.now();
await until("points", async () => (await points()) !== undefined);
const volume_s = (Date.now() - before3d) / 1000;
const orbit = await framesWhileDragging(page, "#volume canvas");
console.log(JSON.stringify({ size_MB: statSync(file).size / 1e6, load_s, pan_frames_per_s: map, points: await points(), volume_s, orbit_frames_per_s: orbit }, null, 1));
process.exit(await harness.finish());
