/** The element in real Chromium: opening, turning, failing, going away. */

import { afterEach, expect, test } from "vitest";
import "./index.ts";
import type { TurnDetail, TurnleafBook } from "./element.ts";

/** A scan of a page: its number in black on paper. */
function scan(number: number, width = 90, height = 120): string {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = "#f4ead2";
  pen.fillRect(0, 0, width, height);
  pen.fillStyle = "#000";
  pen.font = "40px serif";
  pen.fillText(String(number), 20, 70);
  return canvas.toDataURL("image/png");
}

const scans = (count: number) => Array.from({ length: count }, (_, i) => ({ src: scan(i + 1) }));

function book(pages: TurnleafBook["pages"], attributes: Record<string, string> = {}): TurnleafBook {
  const element = document.createElement("turnleaf-book");
  element.style.cssText = "width: 300px; height: 220px";
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.pages = pages;
  document.body.append(element);
  return element;
}

const happens = <T>(element: TurnleafBook, name: string): Promise<T> =>
  new Promise((resolve) =>
    element.addEventListener(name, (event) => resolve((event as CustomEvent<T>).detail), {
      once: true,
    }),
  );

const settled = (element: TurnleafBook) =>
  expect.poll(() => element.settled, { timeout: 20_000, interval: 50 }).toBe(true);

const message = (element: TurnleafBook) =>
  element.shadowRoot?.querySelector<HTMLElement>("[part=message]");

afterEach(() => document.body.replaceChildren());

test("a list of images opens, turns and says where it is", async () => {
  const element = book(scans(12), { duration: "80" });
  const { pageCount } = await happens<{ pageCount: number }>(element, "load");
  expect(pageCount).toBe(12);
  expect(element.page).toBe(1);
  await settled(element);

  const started = happens<TurnDetail>(element, "turnstart");
  const changed = happens<TurnDetail>(element, "pagechange");
  expect(await element.next()).toBe(true);
  expect(await started).toEqual({ from: 1, to: 2, direction: "forward" });
  expect(await changed).toEqual({ from: 1, to: 2, direction: "forward" });
  expect(await element.goTo(7)).toBe(true);
  expect(element.page).toBe(6);
  expect(element.shadowRoot?.querySelector(".live")?.textContent).toBe("Pages 6 and 7 of 12");
  expect(await element.previous()).toBe(true);
  expect(element.page).toBe(4);
  expect(await element.goTo(1000)).toBe(true);
  expect(element.page).toBe(12);
  expect(await element.next()).toBe(true);
  expect(element.page).toBe(12);
});

test("the attribute page opens there, and turns there when it changes", async () => {
  const element = book(scans(12), { page: "5", duration: "80" });
  await happens(element, "load");
  expect(element.page).toBe(4);
  const changed = happens<TurnDetail>(element, "pagechange");
  element.setAttribute("page", "9");
  expect((await changed).to).toBe(8);
});

test("a book of one page, and of pages of other proportions", async () => {
  for (const pages of [
    [{ src: scan(1) }],
    [{ src: scan(1, 200, 60) }, { src: scan(2, 50, 160) }],
  ]) {
    const element = book(pages);
    await happens(element, "load");
    await settled(element);
    expect(element.pageCount).toBe(pages.length);
    element.remove();
  }
});

test("nothing runs at rest, and nothing after removal", async () => {
  const element = book(scans(12), { duration: "400" });
  await happens(element, "load");
  await settled(element);
  let frames = 0;
  const real = globalThis.requestAnimationFrame;
  globalThis.requestAnimationFrame = (call) => {
    frames++;
    return real(call);
  };
  try {
    await new Promise((resolve) => setTimeout(resolve, 600));
    expect(frames).toBe(0);
    void element.next();
    await new Promise((resolve) => setTimeout(resolve, 150));
    expect(frames).toBeGreaterThan(0);
    element.remove();
    frames = 0;
    await new Promise((resolve) => setTimeout(resolve, 600));
    expect(frames).toBe(0);
  } finally {
    globalThis.requestAnimationFrame = real;
  }
});

test("it can be made and removed many times, and comes back where it was", async () => {
  // Chromium keeps 16 contexts alive and complains when one more takes the oldest away.
  const complaints: unknown[] = [];
  const warn = console.warn;
  console.warn = (...words) => complaints.push(words);
  try {
    const element = book(scans(12), { page: "6" });
    for (let round = 0; round < 20; round++) {
      await happens(element, "load");
      expect(element.page).toBe(6);
      expect(element.shadowRoot?.querySelectorAll("canvas").length).toBe(1);
      element.remove();
      expect(element.shadowRoot?.querySelectorAll("canvas").length).toBe(0);
      document.body.append(element);
    }
  } finally {
    console.warn = warn;
  }
  expect(complaints).toEqual([]);
});

test("a book that cannot be opened says why where the page would be", async () => {
  const element = document.createElement("turnleaf-book");
  element.src = "/no-such-book.pdf";
  document.body.append(element);
  const { message: sentence } = await happens<{ message: string }>(element, "error");
  expect(sentence).toContain("no-such-book.pdf");
  expect(message(element)?.textContent).toBe(sentence);
  expect(message(element)?.getAttribute("role")).toBe("alert");
  expect(message(element)?.hidden).toBe(false);

  // Another source takes the sentence away.
  const loaded = happens(element, "load");
  element.pages = scans(4);
  await loaded;
  expect(message(element)?.hidden).toBe(true);
});

test("a page that cannot be drawn does not take the others along", async () => {
  const pages = scans(6);
  pages[2] = { src: "data:image/png;base64,AAAA" };
  const element = book(pages, { page: "3", duration: "80" });
  await happens(element, "load");
  await settled(element);
  await expect
    .poll(() => element.shadowRoot?.querySelector(".live")?.textContent)
    .not.toMatch(/^Pages/);
  expect(await element.next()).toBe(true);
  expect(element.page).toBe(4);
});

test("the context of the graphics card is lost and comes back", async () => {
  const element = book(scans(6), { page: "3" });
  await happens(element, "load");
  await settled(element);
  const canvas = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const lose = canvas.getContext("webgl2")?.getExtension("WEBGL_lose_context");
  const restored = new Promise((resolve) =>
    canvas.addEventListener("webglcontextrestored", resolve, { once: true }),
  );
  lose?.loseContext();
  await new Promise((resolve) => setTimeout(resolve, 100));
  lose?.restoreContext();
  await restored;
  await settled(element);
  expect(element.page).toBe(2);
  expect(await element.next()).toBe(true);
});
