// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** Chromium, checks with a name, and what can be read from a page that is drawn on canvases. */
import { mkdirSync, mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium, type Browser, type Page } from "playwright-core";

const kChromium = process.env.ADIT_CHROMIUM ?? "/usr/bin/chromium";
const kTimeout_ms = 20_000;

export const kDesktop = { width: 1440, height: 900 };
export const kPhone = { width: 390, height: 844 };

export function expect(condition: boolean, what: string): void {
  if (!condition) throw new Error(what);
}

export async function until(what: string, condition: () => Promise<boolean>): Promise<void> {
  for (const end = Date.now() + kTimeout_ms; Date.now() < end;) {
    if (await condition()) return;
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  throw new Error(`not within ${kTimeout_ms / 1000} s: ${what}`);
}

export const textOf = async (page: Page, id: string) => (await page.locator(`#${id}`).textContent()) ?? "";

export class Harness {
  readonly shots: string;
  readonly requests: string[] = [];
  readonly #errors: string[] = [];
  #failures = 0;

  private constructor(private readonly browser: Browser) {
    this.shots = process.env.ADIT_SCREENSHOTS ?? mkdtempSync(join(tmpdir(), "adit-page-"));
    mkdirSync(this.shots, { recursive: true });
  }

  static async launch(): Promise<Harness> {
    return new Harness(await chromium.launch({ executablePath: kChromium, args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
      "--disable-background-networking", "--disable-component-update", "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] }));
  }

  async open(url: string, size = kDesktop, colorScheme: "light" | "dark" = "light"): Promise<Page> {
    const page = await (await this.browser.newContext({ viewport: size, colorScheme })).newPage();
    page.on("pageerror", (error) => this.#errors.push(String(error)));
    page.on("request", (request) => this.requests.push(request.url()));
    await page.goto(url);
    return page;
  }

  async check(name: string, action: () => Promise<void>): Promise<void> {
    try {
      await action();
      console.log(`passed  ${name}`);
    } catch (error) {
      ++this.#failures;
      console.log(`FAILED  ${name}: ${String(error)}`);
    }
  }

  async shoot(page: Page, name: string, fullPage = false): Promise<void> {
    await page.screenshot({ path: join(this.shots, `${name}.png`), fullPage });
  }

  /** Exit code: 0 if all passed and no page threw. */
  async finish(): Promise<number> {
    await this.check("no exception reached a page", async () => expect(this.#errors.length === 0, this.#errors.join("; ")));
    await this.browser.close();
    console.log(`screenshots in ${this.shots}`);
    return this.#failures === 0 ? 0 : 1;
  }
}

/** Number of different colours in a screenshot of an element, read by the browser itself. */
export async function coloursOf(page: Page, selector: string): Promise<number> {
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

/** Of the column of pixels through the middle of the map, the offsets of the nearest walls above and below the middle. */
export async function wallsAtMiddle(page: Page): Promise<{ above: number; below: number }> {
  return page.evaluate(() => {
    const canvas = document.getElementById("map") as HTMLCanvasElement;
    const [x, y] = [Math.round(canvas.width / 2) + 20, Math.round(canvas.height / 2)];  // beside the mark in the middle
    const column = canvas.getContext("2d")!.getImageData(x, 0, 1, canvas.height).data;
    const wall = getComputedStyle(document.documentElement).getPropertyValue("--wall").trim();
    const isWall = (row: number) => [1, 3, 5].every((at, i) => Math.abs(column[4 * row + i]! - parseInt(wall.slice(at, at + 2), 16)) < 24);
    let [above, below] = [1, 1];
    while (above < y && !isWall(y - above)) ++above;
    while (y + below < canvas.height && !isWall(y + below)) ++below;
    return { above: above - 1, below };  // edges of pixels, from the middle
  });
}

/** Clicks with the ruler on the walls above and below the middle of the map; returns the length that it shows. */
export async function measureAcross(page: Page): Promise<number> {
  const { above, below } = await wallsAtMiddle(page);
  const box = (await page.locator("#map").boundingBox())!;
  const [x, y] = [Math.round(box.x + box.width / 2) + 20, box.y + Math.round(box.height / 2)];
  await page.locator("#ruler").click();
  await page.mouse.click(x, y - above);
  await page.mouse.click(x, y + below);
  return parseFloat(await textOf(page, "measure"));
}

export async function goTo(page: Page, distance_m: number): Promise<void> {
  await page.locator("#chainage").fill(String(distance_m));
  await page.locator("#chainage").press("Enter");
  await page.waitForTimeout(200);
}
