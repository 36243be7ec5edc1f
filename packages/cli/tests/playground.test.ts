/** The playground, served by the built command, in a real Chromium under its strict policy. */

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import type { Page } from "playwright-core";
import { decodeTurn } from "turnleaf/keyframes";
import { afterAll, afterEach, beforeAll, expect, it } from "vitest";
import { firstSettings } from "../app/playground/settings.ts";
import {
  chromiumForTests,
  emptyPage,
  hearComplaints,
  pageForTests,
  type TestChromium,
} from "./browser.ts";
import { type Started, startServing } from "./command.ts";
import { comesTo, passTime, passTimeUntil, stopClock, textComesTo } from "./waiting.ts";

const atRest = "At rest: nothing is computed or drawn.";
/** Two models that cost next to nothing. */
const cheap = "left=cylinder&right=cone&seconds=1";

/** Milliseconds between frames: so few are enough, as leaves move in steps of their own. */
const [fast, slow] = [50, 250];

/** The page of all tests but the few that need one of their own; its time passes as a test lets it. */
const tests = pageForTests({ locale: "en-GB" });
const drawn = chromiumForTests({ isDrawn: true });
const undrawn = chromiumForTests();

let served: Started;
let page: Page;

beforeAll(async () => {
  served = await startServing("playground", "--no-open", "--port", "0");
  await stopClock(tests.page);
  await countFrames(tests.page);
});
afterAll(async () => {
  const ended = await served?.stop();
  expect(ended?.stderr).toBe("");
});
afterEach(async () => {
  expect(tests.complaints.splice(0)).toEqual([]);
});

/** Counts the frames that a page requests, from its next document on. */
const countFrames = (page: Page): Promise<unknown> =>
  page.addInitScript(() => {
    const { requestAnimationFrame } = window;
    window.requestAnimationFrame = (call) => {
      Object.assign(window, { asked: (Reflect.get(window, "asked") ?? 0) + 1 });
      return requestAnimationFrame(call);
    };
  });

const usual = { width: 700, height: 480 };

/** Opens the playground, at rest. */
async function open(link = ""): Promise<void> {
  page = tests.page;
  await load(link, usual);
  await isStill();
}

/** Opens the playground in a page whose time passes as on the machine. */
async function openRunning(link = "", size = usual): Promise<void> {
  await openFresh(undrawn);
  await load(link, size);
}

async function openFresh(of: TestChromium): Promise<void> {
  page = await of.newPage({ locale: "en-GB" });
  hearComplaints(page, tests.complaints);
}

async function load(link: string, size: typeof usual): Promise<void> {
  await page.setViewportSize(size);
  const response = await page.goto(`${served.url}${link && `#${link}`}`);
  expect(response?.headers()["content-security-policy"]).toContain("style-src 'self'");
  // Written once both leaves are drawn.
  await comesTo(page, () => document.querySelectorAll(".plot:first-child p:not(:empty)").length, 2);
}

const status = () => page.getByRole("status").textContent();
/** Lets time pass until both leaves are at rest. */
const isStill = () => passTimeUntil(page, async () => (await status()) === atRest, slow);
const words = (plot: "energy" | "strain" | "cost") =>
  page.locator(".plot").nth(["energy", "strain", "cost"].indexOf(plot)).locator("p:not(:empty)");

/**
 * Runs in the page. Returns whether both leaves stand well above the table, by
 * their potential energy.
 */
const areBothUp = (): boolean =>
  [...document.querySelectorAll(".plot:first-child p")].every(({ textContent }) => {
    const [, number, unit] = /height ([\d.]+) (\D?)J/.exec(textContent ?? "") ?? [];
    return unit === "m" || (unit === "µ" && Number(number) > 100);
  });

/** Lets time pass until both stand up. */
const comeUp = () => passTimeUntil(page, () => page.evaluate(areBothUp), fast);
/** Lets time pass until one of them does not. */
const goDown = () => passTimeUntil(page, async () => !(await page.evaluate(areBothUp)), fast);

const press = (name: string) => page.getByRole("button", { name, exact: true }).click();

it("draws two leaves and all that is drawn on them without a complaint", async () => {
  const all = "left=springs-both&masses=yes&springs=yes&lines=yes&strain=yes";
  await openFresh(drawn);
  await stopClock(page);
  await load(all, { width: 300, height: 240 });
  await isStill();
  await press("Turn by edge");
  await passTimeUntil(page, () => page.evaluate(areBothUp), 120);
  expect(tests.complaints).toEqual([]);
});

it("shows two leaves without a complaint, and asks for no frame at rest", async () => {
  await open();
  expect(await page.title()).toBe("Turnleaf playground");
  expect(await page.locator(".pair canvas").count()).toBe(2);
  const before = await page.evaluate(() => Reflect.get(window, "asked"));
  await passTime(page, 10, 70);
  expect(await page.evaluate(() => Reflect.get(window, "asked"))).toBe(before);
});

for (const [k, name, sign] of [
  [0, "first", 1],
  [1, "second", -1],
] as const) {
  it(`moves both leaves by one drag on the ${name} picture, and both come to rest`, async () => {
    await open(cheap);
    if (sign === -1) {
      await press("Turn by edge");
      await comeUp();
      await isStill();
    }
    const box = await page.locator(".pair canvas").nth(k).boundingBox();
    if (!box) throw new Error("no picture");
    // From the leaf's lower outer part, on the side where it lies, over the spine.
    const moveTo = (off: number, y: number) =>
      page.mouse.move(box.x + (0.5 + sign * off) * box.width, box.y + y * box.height, { steps: 4 });
    await moveTo(0.24, 0.85);
    await page.mouse.down();
    await moveTo(0, 0.6);
    await comeUp();
    await moveTo(-0.24, 0.85);
    await goDown();
    await page.mouse.up();
    await isStill();
  });
}

it("takes the corner by keys, and lets it go", async () => {
  await open(cheap);
  const canvas = page.locator(".pair canvas").first();
  await canvas.press("Enter");
  for (let step = 0; step < 10; step++) await canvas.press("ArrowLeft");
  await comeUp();
  await canvas.press("Enter");
  // They may have been still before they are let go.
  await goDown();
  await isStill();
});

it("plays each turn, pauses it, and goes on step by step", async () => {
  await open(cheap);
  for (const name of ["Turn by edge", "Turn by corner", "Let go half-way"]) {
    await press(name);
    await comeUp();
    await press("Pause");
    const before = await words("energy").allTextContents();
    expect(await status()).toBe("Paused.");
    await press("One step");
    expect(await status()).toBe("Paused.");
    expect(await words("energy").allTextContents()).not.toEqual(before);
    await press("Go on");
    await isStill();
  }
});

it("plays a replay beside the sheet that was recorded, and it follows a drag", async () => {
  await open("left=sheet&right=replay");
  await press("Turn by corner");
  await comeUp();
  await isStill();
  const box = await page.locator(".pair canvas").nth(1).boundingBox();
  if (!box) throw new Error("no picture");
  const moveTo = (off: number, y: number) =>
    page.mouse.move(box.x + (0.5 + off) * box.width, box.y + y * box.height, { steps: 4 });
  await moveTo(-0.24, 0.85);
  await page.mouse.down();
  await moveTo(0, 0.6);
  await comeUp();
  await moveTo(0.2, 0.7);
  await page.mouse.up();
  await isStill();
});

it("says how much slower than real time the shell is", async () => {
  await openRunning("right=shell&nodes=12");
  await press("Turn by corner");
  await textComesTo(page, "[role=status]", /^[\d.]+ times slower than real time\.$/);
  await press("Pause");
});

it("carries all settings in the link", async () => {
  await open();
  await page.getByLabel("Model of the first leaf").selectOption({ label: "Cone" });
  await page.getByLabel("Stock").selectOption({ label: "Card, 250 g/m²" });
  await page.getByLabel("Dog-ear angle").fill("40");
  await page.getByLabel("Steps").fill("3");
  await page.getByLabel("Nodes").fill("8");
  await page.getByLabel("Gravity").fill("1.6");
  await page.getByLabel("Time").selectOption({ label: "Slow, 1/4" });
  for (const name of ["Masses", "Springs", "Dog-ear lines", "Strain"]) {
    await page.getByLabel(name, { exact: true }).check();
  }
  const link = new URL(page.url()).hash.slice(1);
  expect(Object.fromEntries(new URLSearchParams(link))).toEqual({
    left: "cone",
    grammage: "250",
    caliper: "300",
    stiffness: "4.5",
    gravity: "1.6",
    angle: "40",
    nodes: "8",
    steps: "180",
    pace: "0.25",
    masses: "yes",
    springs: "yes",
    lines: "yes",
    strain: "yes",
  });
  await emptyPage(page);
  await open(link);
  expect(await page.getByLabel("Model of the first leaf").inputValue()).toBe("cone");
  expect(await page.getByLabel("Stock").inputValue()).toBe("card");
  expect(await page.getByLabel("Steps").getAttribute("aria-valuetext")).toBe("180/s");
  expect(await page.getByLabel("Nodes").getAttribute("aria-valuetext")).toBe("8 × 11");
  expect(await page.getByLabel("Strain").isChecked()).toBe(true);
  expect(new URL(page.url()).hash.slice(1)).toBe(link);
});

it("ignores a hostile link with one sentence", async () => {
  await open(`left=${encodeURIComponent("<img src=x onerror=alert(1)>")}&gravity=3`);
  const alert = page.getByRole("alert");
  expect(await alert.textContent()).toBe(
    "The link was ignored: its value for “First model” is none that can be set here.",
  );
  expect(await page.getByLabel("Gravity").inputValue()).toBe(String(firstSettings.gravity));
  expect(await page.locator("img").count()).toBe(0);
  await page.evaluate(() => {
    location.hash = "#__proto__=1";
  });
  await textComesTo(page, "[role=alert]", "The link was ignored: it is none of this page's.");
  await page.evaluate(() => {
    location.hash = "#gravity=2";
  });
  await page.waitForFunction(
    (input) => (input as HTMLInputElement).value === "2",
    await page.getByLabel("Gravity").elementHandle(),
  );
  expect(await alert.textContent()).toBe("");
});

/** Returns the angles of a crease now and at rest, degrees, and its moment, mN, as they are shown. */
async function creaseNow(k: number): Promise<number[]> {
  const text = await page.locator(".creases .live").nth(k).textContent();
  const found = /now (-?\d+)°, rests at (-?\d+)°, moment a length (-?[\d.]+) mN/.exec(text ?? "");
  return (found ?? []).slice(1).map(Number);
}

it("folds the sheet along a line that is drawn on the flat page", async () => {
  await open("left=cylinder");
  const paper = page.locator(".flat-page .paper");
  await paper.scrollIntoViewIfNeeded();
  const box = await paper.boundingBox();
  if (!box) throw new Error("no page");
  await page.mouse.move(box.x + 0.6 * box.width, box.y + box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.8 * box.width, box.y + 0.85 * box.height, { steps: 4 });
  await page.mouse.move(box.x + box.width, box.y + 0.7 * box.height, { steps: 4 });
  await page.mouse.up();
  // Of the page itself: what drives it hears of a new address a little later.
  expect(await page.evaluate(() => location.hash)).toBe("#left=cylinder&creases=60.0.100.30.150");
  await isStill();
  const [angle = 0, rest, moment = 0] = await creaseNow(0);
  expect(rest).toBe(150);
  // The flap's weight shuts or opens it a little, against the crease's stiffness.
  expect(Math.abs(angle - 150)).toBeLessThan(20);
  // k of book paper: 6 x 0.12 mN m over the width of 0.148 m.
  const expected = ((6 * 0.12) / 0.148) * (((angle - 150) * Math.PI) / 180);
  expect(Math.abs(moment - expected)).toBeLessThan(0.06);
  await page.getByLabel("Rest of 1").fill("-90");
  await passTimeUntil(page, async () => (await creaseNow(0))[1] === -90, slow);
  await page.getByRole("button", { name: "Remove crease 1" }).click();
  expect(await page.locator(".creases .live").count()).toBe(0);
  await isStill();
});

it("keeps creases that the sheet can have, and says why it has no others", async () => {
  await open("left=cylinder&creases=62.0.100.27.150");
  await passTimeUntil(page, async () => (await creaseNow(0))[1] === 150, slow);
  const paper = page.locator(".flat-page .paper");
  await paper.scrollIntoViewIfNeeded();
  const box = await paper.boundingBox();
  if (!box) throw new Error("no page");
  await page.mouse.move(box.x + 2, box.y + 0.5 * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.9 * box.width, box.y + 0.4 * box.height, { steps: 4 });
  await page.mouse.up();
  expect(await page.getByRole("alert").textContent()).toBe(
    "The sheet was not creased so. A crease does not meet the spine, where the leaf is bound.",
  );
  expect(new URL(page.url()).hash).toBe("#left=cylinder&creases=62.0.100.27.150");
  expect(await page.locator(".creases .live").count()).toBe(1);
});

/** Returns the bytes that a click downloads. */
async function downloaded(click: () => Promise<void>): Promise<{ name: string; bytes: Buffer }> {
  const [download] = await Promise.all([page.waitForEvent("download"), click()]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

it("keeps settings and a picture", async () => {
  await open("strain=yes&air=2");
  const settings = await downloaded(() => press("Settings (JSON)"));
  expect(settings.name).toBe("turn.json");
  expect(JSON.parse(settings.bytes.toString())).toMatchObject({
    left: "springs-both",
    right: "sheet",
    strain: true,
    air: 2,
    link: page.url(),
  });
  const picture = await downloaded(() => press("Picture (PNG)"));
  const sizes = await page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const { width, height } = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const all = [...document.querySelectorAll<HTMLCanvasElement>(".pair canvas")];
    return [width, height, all.reduce((sum, canvas) => sum + canvas.width, 0), all[0]?.height];
  }, picture.bytes.toString("base64"));
  expect(Math.abs(sizes[0] - sizes[2])).toBeLessThanOrEqual(1);
  expect(Math.abs(sizes[1] - Number(sizes[3]))).toBeLessThanOrEqual(1);
});

it("records a turn as a film and as key frames of either leaf", async () => {
  await open(cheap);
  await press("Record");
  await press("Turn by corner");
  await comeUp();
  await isStill();
  await press("Stop recording");
  const files = page.getByRole("list", { name: "Files to keep" }).getByRole("link");
  await files.nth(2).waitFor();
  expect(await files.allTextContents()).toEqual(["turn.webm", "1-cylinder.tlkf", "2-cone.tlkf"]);
  for (const [k, model] of [
    [1, "cylinder"],
    [2, "cone"],
  ] as const) {
    const { bytes } = await downloaded(() => files.nth(k).click());
    const turn = decodeTurn(new Uint8Array(bytes));
    expect(turn.model).toBe(model);
    expect(turn.error).toBeLessThanOrEqual(0.001);
    expect(turn.times.length).toBeGreaterThan(2);
  }
  const film = await downloaded(() => files.first().click());
  // Without a policy that forbids films.
  const bare = await undrawn.newPage();
  const seen = await bare.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const video = document.createElement("video");
    video.muted = true;
    video.src = URL.createObjectURL(new Blob([bytes], { type: "video/webm" }));
    await new Promise((resolve, reject) => {
      video.onloadeddata = resolve;
      video.onerror = () => reject(new Error(video.error?.message));
    });
    return [video.videoWidth, video.videoHeight];
  }, film.bytes.toString("base64"));
  expect(Math.min(...seen)).toBeGreaterThan(100);
});

it("is named and labelled throughout", async () => {
  await openRunning("", { width: 390, height: 844 });
  await page.evaluate(readFileSync(createRequire(import.meta.url).resolve("axe-core"), "utf8"));
  const found = await page.evaluate(async () => {
    const { axe } = window as never as {
      axe: { run(): Promise<{ violations: { id: string }[] }> };
    };
    return (await axe.run()).violations.map(({ id }) => id);
  });
  expect(found).toEqual([]);
  const fits = await page.evaluate(
    () => document.documentElement.scrollWidth <= document.documentElement.clientWidth,
  );
  expect(fits).toBe(true);
});
