// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Drives the built page with Chromium, live and from a file. ADIT_VIEWER_URL and ADIT_MISSION_HTML name a real server and a real
 * mission instead; ADIT_SCREENSHOTS the folder of the screenshots.
 */
import { mkdirSync, mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium, type Page } from "playwright-core";
import { writeEmbedded } from "../synthetic/embed";
import { SyntheticServer } from "../synthetic/server";

const shots = process.env.ADIT_SCREENSHOTS ?? mkdtempSync(join(tmpdir(), "adit-page-"));
mkdirSync(shots, { recursive: true });
let failures = 0;
async function check(name: string, action: () => Promise<void>): Promise<void> {
  try { await action(); console.log(`passed  ${name}`); } catch (error) { ++failures; console.log(`FAILED  ${name}: ${String(error)}`); }
}
function expect(condition: boolean, what: string): void { if (!condition) throw new Error(what); }
const text = async (page: Page, id: string) => (await page.locator(`#${id}`).textContent()) ?? "";
async function until(what: string, condition: () => Promise<boolean>): Promise<void> {
  for (let i = 0; i < 80; ++i) { if (await condition()) return; await new Promise((r) => setTimeout(r, 100)); }
  throw new Error(`not within 8 s: ${what}`);
}
/** Number of different colours in a screenshot of an element, read by the browser itself. */
async function coloursOf(page: Page, selector: string): Promise<number> {
  const png = (await page.locator(selector).screenshot()).toString("base64");
  return page.evaluate(async (data) => {
    const image = new Image();
    image.src = "data:image/png;base64," + data;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.width, image.height];
    const context = canvas.getContext("2d")!;
    context.drawImage(image, 0, 0);
    return new Set(new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer)).size;
  }, png);
}

const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
const errors: string[] = [];
const requests: string[] = [];
async function open(url: string, size = { width: 1440, height: 900 }, colorScheme: "light" | "dark" = "light"): Promise<Page> {
  const page = await (await browser.newContext({ viewport: size, colorScheme })).newPage();
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(url);
  return page;
}

const server = process.env.ADIT_VIEWER_URL ? null : new SyntheticServer(true);
await server?.listen();
const url = process.env.ADIT_VIEWER_URL ?? `http://127.0.0.1:${server!.port}/`;
for (let t = 0; t <= 120; ++t) server?.publish(t);
const live = await open(url);
await check("live: connects, shows phase and map", async () => {
  await until("live", async () => /live|log/.test(await text(live, "connection")));
  await until("phase", async () => (await text(live, "phase")) !== "–");
  await until("map", async () => (await coloursOf(live, "#map")) > 5);
  await live.screenshot({ path: join(shots, "live.png") });
});
if (server) {
  await check("live: an order without token is rejected, with token accepted", async () => {
    const send = async () => { await live.locator("#panel-orders button", { hasText: "Pause" }).click(); await live.locator("dialog button", { hasText: "Send" }).click(); };
    await send();
    await until("rejection", async () => /rejected, wrong token/.test(await text(live, "answer")));
    expect(server.orders.length === 0, "order without token was executed");
    await live.locator("#panel-orders input").fill("synthetic");
    await send();
    await until("acceptance", async () => /accepted/.test(await text(live, "answer")));
    expect((server.orders[0] as { order: string }).order === "pause", "wrong order");
  });
  await check("live: hostile messages are counted and the page continues", async () => {
    server.sendHostile("/pose", 121, Uint8Array.from([0xff, 0xff, 0xff]));
    server.sendHostile("/map", 121, Uint8Array.from([0x21, 1, 2, 3]));
    server.sendHostile("/mission", 121, Buffer.from("{"));
    server.sendHostile("/history", 121, Buffer.from('{"rows":[[1],"x",null]}'));
    server.sendHostile("/mission", 122, Buffer.from('{"phase":{"a":1},"reason":"<img src=x onerror=alert(1)>","speed_m_s":"fast"}'));
    server.sendFrame("{");
    server.sendFrame(Uint8Array.from([77]));
    await until("count", async () => /^([6-9]|\d\d) messages not decoded/.test(await text(live, "faults")));
    expect((await live.locator("header img").count()) === 0, "markup of a message was executed");
    server.publish(123);
    await until("next phase", async () => (await text(live, "phase")) === "plan" || (await text(live, "phase")) === "execute");
  });
  await check("live: connects again after a loss", async () => {
    server.disconnectAll();
    await until("lost", async () => /connection lost/.test(await text(live, "connection")));
    await until("live again", async () => /^live/.test(await text(live, "connection")));
  });
} else console.log("skipped  orders, hostile messages, loss of connection (real server)");
await live.context().close();
server?.close();

const file = process.env.ADIT_MISSION_HTML ?? join(shots, "mission.html");
if (!process.env.ADIT_MISSION_HTML) writeEmbedded(file);
const fileUrl = pathToFileURL(file).href;
requests.length = 0;
const page = await open(fileUrl);
const known = !process.env.ADIT_MISSION_HTML;
await check("file: loads", async () => {
  await until("finished", async () => (await text(page, "connection")) === "finished mission");
  await until("headline", async () => (await text(page, "headline")).length > 5);
  expect(requests.every((r) => r === fileUrl || r.startsWith("data:") || r.startsWith("blob:")), `requests: ${requests.join()}`);
  await page.screenshot({ path: join(shots, "file.png") });
});
if (known) {
  await check("file: go to 30 m shows the width; ruler over the tunnel agrees to 1 %", async () => {
    await page.locator("#chainage").fill("30");
    await page.locator("#chainage").press("Enter");
    const measured = /width ([\d.]+) m · at 30 m · 95 % within 0.1\d m/.exec(await text(page, "measure"));
    expect(measured !== null && Math.abs(Number(measured[1]) - 4) < 0.04, await text(page, "measure"));
    await page.screenshot({ path: join(shots, "width.png") });
    // The map is centred at (30, 0) with 25 pixels to the metre: the walls at y = +2 and -2 are 50 pixels off.
    const box = (await page.locator("#map").boundingBox())!;
    const [cx, cy] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.locator("#ruler").click();
    await page.mouse.click(cx, cy - 50);
    await page.mouse.click(cx, cy + 50);
    expect(Math.abs(parseFloat(await text(page, "measure")) - 4) < 0.04, await text(page, "measure"));
    await page.keyboard.press("Escape");
    expect((await text(page, "measure")) === "", "ruler stays");
  });
  await check("file: a click on a scan opens its card, one on the map names it", async () => {
    await page.locator("#panel-frontiers button").first().click();
    await page.locator("#chainage").fill("20");
    await page.locator("#chainage").press("Enter");
    const box = (await page.locator("#map").boundingBox())!;
    await page.keyboard.press("Escape");
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    expect(/Scan (2|10)/.test(await text(page, "panel-card")), await text(page, "panel-card"));
    expect((await page.locator("#panel-card img").count()) === 1, "no picture");
  });
  await check("file: water is found in the table of hazards", async () => {
    expect(/water0.45 m100 m \+ 6 m \(106.0 E, 0.0 N\)/.test(await text(page, "panel-hazards")), await text(page, "panel-hazards"));
  });
  await check("file: the slider moves the robot", async () => {
    await page.locator("#fit").click();
    const before = await page.locator("#map").screenshot();
    await page.locator("#slider").evaluate((e: HTMLInputElement) => { e.value = "250"; e.dispatchEvent(new Event("input")); });
    await until("time", async () => (await text(page, "elapsed")).startsWith("0:00:50"));
    expect(!before.equals(await page.locator("#map").screenshot()), "the map did not change");
    await page.screenshot({ path: join(shots, "slider.png") });
  });
} else console.log("skipped  known lengths and places (real mission)");
await check("file: zoom and layers change the map", async () => {
  const first = await page.locator("#map").screenshot();
  await page.mouse.move(500, 400);
  await page.mouse.wheel(0, -600);
  await page.waitForTimeout(300);
  const second = await page.locator("#map").screenshot();
  await page.locator("#layers summary").click();
  await page.locator("[data-layer=coverage]").check();
  await page.waitForTimeout(300);
  const third = await page.locator("#map").screenshot();
  expect(!first.equals(second) && !second.equals(third), "no change");
  await page.screenshot({ path: join(shots, "layers.png") });
});
await check("file: plots are drawn", async () => {
  await page.locator("#panel-plots").scrollIntoViewIfNeeded();
  await until("plots", async () => (await page.locator("#panel-plots .uplot").count()) >= 5);
  await page.locator("#panel-plots .u-over").first().click();
  await page.screenshot({ path: join(shots, "plots.png") });
});
await check("file: 3D renders points", async () => {
  await page.locator("[data-view=volume]").click();
  await until("points", async () => /^[1-9]\d* points/.test(await text(page, "volume-status")));
  expect((await coloursOf(page, "#volume canvas")) > 50, "background only");
  await page.screenshot({ path: join(shots, "volume.png") });
});
await check("file: prints on at most four pages", async () => {
  const pdf = await page.pdf({ format: "A4", path: join(shots, "print.pdf") });
  const pages = pdf.toString("latin1").match(/\/Type\s*\/Page\b/g)?.length ?? 0;
  expect(pages >= 1 && pages <= 4, `${pages} pages`);
});
await page.context().close();
await check("phone size and dark mode", async () => {
  const phone = await open(fileUrl, { width: 390, height: 844 }, "dark");
  await until("finished", async () => (await text(phone, "connection")) === "finished mission");
  await phone.waitForTimeout(500);
  const [width, background] = await phone.evaluate(() => [document.documentElement.scrollWidth, getComputedStyle(document.body).backgroundColor] as const);
  expect(width <= 390, `${width} pixels wide`);
  expect(background === "rgb(21, 24, 28)", background);
  await phone.screenshot({ path: join(shots, "phone.png"), fullPage: true });
});
await check("no exception reached the page", async () => expect(errors.length === 0, errors.join("; ")));
await browser.close();
console.log(`screenshots in ${shots}`);
process.exit(failures === 0 ? 0 : 1);
