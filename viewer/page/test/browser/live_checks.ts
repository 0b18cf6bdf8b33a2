// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The page as a server serves it while the robot drives. */
import type { Page } from "playwright-core";
import { kToken, SyntheticServer } from "../synthetic/server";
import { coloursOf, expect, textOf, until, type Harness } from "./harness";

async function sendPause(page: Page): Promise<void> {
  await page.locator("#panel-orders button", { hasText: "Pause" }).click();
  await page.locator("dialog button", { hasText: "Send" }).click();
}

/** Of any server; returns the page. */
export async function checkConnection(harness: Harness, url: string): Promise<Page> {
  const page = await harness.open(url);
  await harness.check("live: connects, shows phase and map", async () => {
    await until("live", async () => /live|log/.test(await textOf(page, "connection")));
    await until("phase", async () => (await textOf(page, "phase")) !== "–");
    await until("map", async () => (await coloursOf(page, "#map")) > 5);
    await harness.shoot(page, "live");
  });
  return page;
}

/** Of a server started with a token. */
export async function checkOrders(harness: Harness, page: Page, token: string): Promise<void> {
  await harness.check("live: an order without the token is rejected, with it accepted", async () => {
    await sendPause(page);
    await until("rejection", async () => /rejected/.test(await textOf(page, "answer")));
    await page.locator("#panel-orders input").fill(token);
    await sendPause(page);
    await until("acceptance", async () => /accepted/.test(await textOf(page, "answer")));
  });
}

export async function checkSynthetic(harness: Harness): Promise<void> {
  const server = new SyntheticServer(true);
  await server.listen();
  for (let t = 0; t <= 120; ++t) server.publish(t);
  const page = await checkConnection(harness, `http://127.0.0.1:${server.port}/`);
  await checkOrders(harness, page, kToken);
  await harness.check("live: only the accepted order was executed", async () => {
    expect(server.orders.length === 1 && (server.orders[0] as { order: string }).order === "pause", JSON.stringify(server.orders));
  });
  await harness.check("live: malformed messages are counted and the page continues", async () => {
    server.sendHostile("/pose", 121, Uint8Array.from([0xff, 0xff, 0xff]));
    server.sendHostile("/map", 121, Uint8Array.from([0x21, 1, 2, 3]));
    server.sendHostile("/mission", 121, Buffer.from("{"));
    server.sendHostile("/history", 121, Buffer.from('{"rows":[[1],"x",null]}'));
    server.sendHostile("/mission", 122, Buffer.from('{"phase":{"a":1},"reason":"<img src=x onerror=alert(1)>","speed_m_s":"fast"}'));
    server.sendFrame("{");
    server.sendFrame(Uint8Array.from([77]));
    await until("count", async () => /^([6-9]|\d\d) messages not decoded/.test(await textOf(page, "faults")));
    expect((await page.locator("header img").count()) === 0, "markup of a message was executed");
    server.publish(123);
    await until("next phase", async () => /plan|execute/.test(await textOf(page, "phase")));
  });
  await harness.check("live: connects again after a loss", async () => {
    server.disconnectAll();
    await until("lost", async () => /connection lost/.test(await textOf(page, "connection")));
    await until("live again", async () => /^live/.test(await textOf(page, "connection")));
  });
  await page.context().close();
  server.close();
}
