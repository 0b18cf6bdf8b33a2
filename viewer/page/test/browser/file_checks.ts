// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** A finished mission: one file, opened from the disk. */
import { statSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type { Page } from "playwright-core";
import { coloursOf, expect, goTo, kDesktop, kPhone, measureAcross, textOf, until, type Harness } from "./harness";

/** What is known of the mine. */
export interface KnownMine {
  /** Where along the trajectory the tunnel runs east and is of a known width. */
  at_m: number;
  width_m: number;
  /** Of the ruler and of the width tool. */
  rulerTolerance_m: number;
  widthTolerance_m: number;
  water: RegExp;
  headline: RegExp;
}

const kSizeMax_bytes = 15e6;
const kPagesMax = 4;

async function loaded(page: Page): Promise<void> {
  await until("finished", async () => (await textOf(page, "connection")) === "finished mission");
  await until("headline", async () => (await textOf(page, "headline")).length > 5);
}

async function setSlider(page: Page, share: number): Promise<void> {
  await page.locator("#slider").evaluate((slider: HTMLInputElement, value) => {
    slider.value = value;
    slider.dispatchEvent(new Event("input"));
  }, String(1000 * share));
  await page.waitForTimeout(400);
}

async function checkMap(harness: Harness, page: Page, mine: KnownMine): Promise<void> {
  await harness.check("file: the ruler measures a known length", async () => {
    await goTo(page, mine.at_m);
    for (let i = 0; i < 5; ++i) await page.locator("#map").press("+");  // 25 pixels per metre times 1.3^5
    await page.waitForTimeout(200);
    const length_m = await measureAcross(page);
    expect(Math.abs(length_m - mine.width_m) <= mine.rulerTolerance_m, `${length_m} m instead of ${mine.width_m} m`);
    await harness.shoot(page, "ruler");
    await page.keyboard.press("Escape");
    expect((await textOf(page, "measure")) === "", "the ruler stays");
  });
  await harness.check("file: go to shows the width and how sure it is", async () => {
    await goTo(page, mine.at_m);
    const measured = /width ([\d.]+) m.* · at (\d+) m · 95 % within [\d.]+ m/.exec(await textOf(page, "measure"));
    expect(measured !== null && Math.abs(Number(measured[1]) - mine.width_m) <= mine.widthTolerance_m, await textOf(page, "measure"));
    expect(Math.abs(Number(measured![2]) - mine.at_m) <= 1, await textOf(page, "measure"));
    await harness.shoot(page, "width");
    await page.keyboard.press("Escape");
  });
  await harness.check("file: zoom and layers change the map", async () => {
    await page.locator("#fit").click();
    const first = await page.locator("#map").screenshot();
    await page.mouse.move(500, 400);
    await page.mouse.wheel(0, -600);
    await page.waitForTimeout(300);
    const second = await page.locator("#map").screenshot();
    await page.locator("#layers summary").click();
    for (const key of ["graph", "loops", "revoked", "uncertainty"]) await page.locator(`[data-layer=${key}]`).check();
    await page.waitForTimeout(300);
    await harness.shoot(page, "layers");
    await page.locator("#layers summary").click();
    const third = await page.locator("#map").screenshot();
    await page.locator("#layers summary").click();
    for (const key of ["graph", "loops", "revoked", "uncertainty"]) await page.locator(`[data-layer=${key}]`).uncheck();
    await page.locator("#layers summary").click();
    expect(!first.equals(second) && !second.equals(third), "no change");
    await page.locator("#fit").click();
  });
  await harness.check("file: the slider moves the robot", async () => {
    const before = await page.locator("#map").screenshot();
    await setSlider(page, 0.25);
    expect(!before.equals(await page.locator("#map").screenshot()), "the map did not change");
    await harness.shoot(page, "slider");
    await setSlider(page, 1);
  });
}

async function checkPanels(harness: Harness, page: Page, mine: KnownMine): Promise<void> {
  await harness.check("file: the headline and the hazards name the water", async () => {
    expect(mine.headline.test(await textOf(page, "headline")), await textOf(page, "headline"));
    expect(mine.water.test(await textOf(page, "panel-hazards")), await textOf(page, "panel-hazards"));
  });
  await harness.check("file: a click on a 3D scan of the map opens its card", async () => {
    await page.locator("#panel-scans button").nth(1).click();
    const place = /at (-?[\d.]+) E, (-?[\d.]+) N/.exec(await textOf(page, "panel-card"));
    expect(place !== null, await textOf(page, "panel-card"));
    await page.locator("#panel-card button", { hasText: "close" }).click();
    // The map centres on the second scan by its anchor; a click there selects it.
    await page.evaluate(() => { location.hash = ""; location.hash = "#scan-2"; });
    await until("card", async () => /Scan 2 /.test(await textOf(page, "panel-card")));
    await page.locator("#panel-card button", { hasText: "close" }).click();
    const box = (await page.locator("#map").boundingBox())!;
    await page.waitForTimeout(300);
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    expect(/Scan \d+ /.test(await textOf(page, "panel-card")), await textOf(page, "panel-card"));
    const shown = await page.locator("#panel-card img").evaluateAll((images) => images.map((image) => (image as HTMLImageElement).naturalWidth));
    expect(shown.length >= 1 && shown.every((width) => width > 0), `pictures ${shown.join()}`);
    await harness.shoot(page, "card");
    await page.locator("#panel-card button", { hasText: "close" }).click();
    await page.keyboard.press("Escape");
  });
  await harness.check("file: plots are drawn", async () => {
    await page.locator("#panel-plots").scrollIntoViewIfNeeded();
    await until("plots", async () => (await page.locator("#panel-plots .uplot").count()) >= 4);
    await page.locator("#panel-plots .u-over").first().click();
    await harness.shoot(page, "plots");
    await setSlider(page, 1);
  });
}

async function checkVolume(harness: Harness, page: Page): Promise<void> {
  const points = async () => parseInt(/^(\d+) points/.exec(await textOf(page, "volume-status"))?.[1] ?? "0");
  await harness.check("file: 3D renders points, of the scans until the time shown", async () => {
    await page.locator("[data-view=volume]").click();
    await until("points", async () => (await points()) > 0);
    expect((await coloursOf(page, "#volume canvas")) > 50, "background only");
    await harness.shoot(page, "volume");
    const all = await points();
    await setSlider(page, 0.2);
    await until("fewer points", async () => (await points()) < all);
    expect((await points()) > 0, "no points");
    await setSlider(page, 1);
    const box = (await page.locator("#volume canvas").boundingBox())!;
    for (const colouring of ["scan", "clearance", "height"]) await page.locator("#volume select").nth(1).selectOption(colouring);
    for (let dy = -120; dy <= 120 && !/height -?[\d.]+ m/.test(await textOf(page, "volume-status")); dy += 20) {
      await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2 + dy);
      await page.waitForTimeout(150);
    }
    expect(/E, .* N, height -?[\d.]+ m/.test(await textOf(page, "volume-status")), await textOf(page, "volume-status"));
    await page.locator("[data-view=map]").click();
  });
}

async function checkOtherMedia(harness: Harness, page: Page, url: string): Promise<void> {
  await harness.check("file: prints on at most four pages", async () => {
    const pdf = await page.pdf({ format: "A4", path: join(harness.shots, "print.pdf") });
    const pages = pdf.toString("latin1").match(/\/Type\s*\/Page\b/g)?.length ?? 0;
    expect(pages >= 1 && pages <= kPagesMax, `${pages} pages`);
  });
  await harness.check("file: phone size and dark mode", async () => {
    const phone = await harness.open(url, kPhone, "dark");
    await loaded(phone);
    await phone.waitForTimeout(500);
    const [width, background] = await phone.evaluate(() => [document.documentElement.scrollWidth, getComputedStyle(document.body).backgroundColor] as const);
    expect(width <= kPhone.width, `${width} pixels wide`);
    expect(background === "rgb(21, 24, 28)", background);
    await harness.shoot(phone, "phone");
    await harness.shoot(phone, "phone_whole", true);
    await phone.context().close();
  });
  await harness.check("file: dark mode", async () => {
    const dark = await harness.open(url, kDesktop, "dark");
    await loaded(dark);
    await dark.waitForTimeout(500);
    await harness.shoot(dark, "dark");
    await dark.context().close();
  });
}

export async function checkFile(harness: Harness, file: string, mine: KnownMine): Promise<void> {
  const url = pathToFileURL(file).href;
  harness.requests.length = 0;
  const page = await harness.open(url);
  await harness.check("file: loads, within 15 MB, and requests nothing else", async () => {
    await loaded(page);
    expect(statSync(file).size <= kSizeMax_bytes, `${statSync(file).size} bytes`);
    expect((await textOf(page, "faults")) === "0 messages not decoded", await textOf(page, "faults"));
    const others = harness.requests.filter((request) => request !== url && !/^(data|blob):/.test(request));
    expect(others.length === 0, `requests: ${others.join()}`);
    await page.waitForTimeout(500);
    await harness.shoot(page, "file");
  });
  await checkMap(harness, page, mine);
  await checkPanels(harness, page, mine);
  await checkVolume(harness, page);
  await checkOtherMedia(harness, page, url);
  await page.context().close();
}
