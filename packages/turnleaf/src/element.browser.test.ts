/** The element in real Chromium: opening, turning, failing, being removed. */

import { afterEach, expect, test } from "vitest";
import type { TurnDetail } from "./element/events.ts";
import type { TurnleafBook } from "./element.ts";
import { clock } from "./for_tests/clock.ts";
import { book, happens, scan, scans, settled } from "./for_tests/element_books.ts";
import { eventually } from "./for_tests/eventually.ts";

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
  // A loop over `next` ends.
  expect(await element.next()).toBe(false);
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

test("a book says that it turns, and one that is destroyed opens again where it lay", async () => {
  const element = book(scans(12), { page: "4", duration: "200" });
  expect(element.turning).toBe(false);
  await happens(element, "load");
  expect(element.turning).toBe(false);
  const turned = element.next();
  expect(element.turning).toBe(true);
  expect(await turned).toBe(true);
  expect(element.turning).toBe(false);
  element.destroy();
  expect(element.isConnected).toBe(false);
  expect([element.pageCount, element.turning]).toEqual([0, false]);
  expect(await element.next()).toBe(false);
  document.body.append(element);
  await happens(element, "load");
  expect(element.page).toBe(6);
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
    await clock.pass(600);
    expect(frames).toBe(0);
    void element.next();
    await eventually(() => frames).toBeGreaterThan(0);
    element.remove();
    frames = 0;
    await clock.pass(600);
    expect(frames).toBe(0);
  } finally {
    globalThis.requestAnimationFrame = real;
  }
});

test("it can be made and removed many times, and comes back where it was", async () => {
  // Chromium keeps 16 contexts alive and warns when one more evicts the oldest.
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

  // Another source removes the sentence.
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
  await eventually(() => element.shadowRoot?.querySelector(".live")?.textContent).not.toMatch(
    /^Pages/,
  );
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
  await clock.pass(100);
  lose?.restoreContext();
  await restored;
  await settled(element);
  expect(element.page).toBe(2);
  expect(await element.next()).toBe(true);
});

test("the next book is drawn on the canvas of the one before, and a lost one is replaced", async () => {
  const canvasOf = (element: TurnleafBook) =>
    element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const isLost = (canvas: HTMLCanvasElement) => canvas.getContext("webgl2")?.isContextLost();
  const another = async (element: TurnleafBook, pages: TurnleafBook["pages"]) => {
    const loaded = happens(element, "load");
    element.pages = pages;
    await loaded;
    await settled(element);
  };
  const element = book(scans(12), { duration: "80" });
  await happens(element, "load");
  await settled(element);
  const canvas = canvasOf(element);
  await another(element, scans(4));
  expect(canvasOf(element)).toBe(canvas);
  expect(await element.next()).toBe(true);
  // Two at once: the first one asked for is given up while it opens.
  element.pages = scans(6);
  await another(element, scans(8));
  expect(element.pageCount).toBe(8);
  expect(isLost(canvasOf(element))).toBe(false);

  // One that fails leaves the open book on its canvas.
  const failed = happens(element, "error");
  element.pages = [{ src: "none.png" }];
  await failed;
  expect(isLost(canvasOf(element))).toBe(false);
  expect(element.pageCount).toBe(8);

  canvasOf(element).getContext("webgl2")?.getExtension("WEBGL_lose_context")?.loseContext();
  const before = canvasOf(element);
  await another(element, scans(6));
  expect([isLost(before), before.isConnected]).toEqual([true, false]);
  const last = canvasOf(element);
  element.remove();
  expect([isLost(last), last.isConnected]).toEqual([true, false]);
});

test("a pending turn resolves when the book is closed", async () => {
  const element = book(scans(12), { duration: "400" });
  await happens(element, "load");
  const landed = [element.next(), element.goTo(9)];
  await happens(element, "turnstart");
  element.remove();
  expect(await Promise.all(landed)).toEqual([false, false]);
});

test("a listener may take the book away", async () => {
  const errors: unknown[] = [];
  const heard = (event: ErrorEvent) => errors.push(event.error);
  addEventListener("error", heard);
  for (const name of ["turnstart", "pagechange"]) {
    const element = book(scans(12), { duration: "80" });
    await happens(element, "load");
    element.addEventListener(name, () => element.remove());
    void element.next();
    await element.next();
    await clock.pass(100);
  }
  removeEventListener("error", heard);
  expect(errors).toEqual([]);
});

test("a book that was replaced while it opened leaves the other alone", async () => {
  const element = book(scans(4));
  const late = new Blob(["%PDF-1.4"]);
  let [asked, done] = [false, false];
  late.slice = () => {
    asked = true;
    const slow = new Blob();
    slow.arrayBuffer = async () => {
      await clock.pass(400);
      done = true;
      return await new Response((await (await fetch(scan(1))).blob()) as Blob).arrayBuffer();
    };
    return slow;
  };
  element.pages = late;
  await eventually(() => asked).toBe(true);
  element.pages = scans(6);
  await happens(element, "load");
  const canvas = element.shadowRoot?.querySelector("canvas");
  await eventually(() => done).toBe(true);
  await clock.pass(100);
  expect(element.shadowRoot?.querySelectorAll("canvas").length).toBe(1);
  expect(element.shadowRoot?.querySelector("canvas")).toBe(canvas);
  expect(element.pageCount).toBe(6);
});

test("a book stays where it lies in other covers, and comes back where it was asked for", async () => {
  const element = book(scans(12), { page: "6" });
  await happens(element, "load");
  const canvas = element.shadowRoot?.querySelector("canvas");
  element.setAttribute("cloth", "#234");
  element.setAttribute("cover", "none");
  await settled(element);
  expect(element.page).toBe(6);
  expect(element.shadowRoot?.querySelector("canvas")).toBe(canvas);

  element.remove();
  element.setAttribute("page", "9");
  document.body.append(element);
  await happens(element, "load");
  expect(element.page).toBe(8);

  // Back at the beginning, whatever its attribute says.
  element.setAttribute("duration", "80");
  await element.goTo(1);
  element.remove();
  document.body.append(element);
  await happens(element, "load");
  expect(element.page).toBe(1);

  // Another book opens where its attribute says, not where the last one was left.
  await element.goTo(4);
  element.remove();
  element.pages = scans(14);
  document.body.append(element);
  await happens(element, "load");
  expect(element.page).toBe(8);
});

test("a page asked for before the book opens is the one it opens at", async () => {
  const element = document.createElement("turnleaf-book");
  element.style.cssText = "width: 300px; height: 220px";
  document.body.append(element);
  element.page = 5;
  expect(element.page).toBe(5);
  element.pages = scans(12);
  await happens(element, "load");
  expect(element.page).toBe(4);
});

test("what is set before the element is defined counts", async () => {
  const early = document.implementation.createHTMLDocument().createElement("turnleaf-book");
  Object.assign(early, { pages: scans(6), page: 4 });
  document.body.append(early);
  const element = early as TurnleafBook;
  await happens(element, "load");
  expect(element.pageCount).toBe(6);
  expect(element.page).toBe(4);
});

test("an element with many attributes fetches its book once", async () => {
  const asked: unknown[] = [];
  const real = globalThis.fetch;
  globalThis.fetch = (...args) => {
    asked.push(args[0]);
    return real(...args);
  };
  try {
    document.body.innerHTML = `<turnleaf-book src="/no-such.pdf" cover="none" cloth="#123" page="2"></turnleaf-book>`;
    await happens(document.querySelector("turnleaf-book") as TurnleafBook, "error");
  } finally {
    globalThis.fetch = real;
  }
  expect(asked.length).toBe(1);
});

test("who asked for less motion sees none, by key either", async () => {
  const real = globalThis.matchMedia;
  globalThis.matchMedia = (query) =>
    query.includes("reduced-motion") ? ({ matches: true } as MediaQueryList) : real(query);
  try {
    const element = book(scans(7));
    await happens(element, "load");
    element.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }));
    expect(element.page).toBe(2);
    expect(await element.goTo(7)).toBe(true);
    expect(await element.next()).toBe(true);
    expect(await element.next()).toBe(false);
    expect(element.shadowRoot?.querySelector(".live")?.textContent).toBe("Back of 7");
  } finally {
    globalThis.matchMedia = real;
  }
});

test("a leaf whose pointer is lost falls", async () => {
  const element = book(scans(12), { page: "4" });
  await happens(element, "load");
  await settled(element);
  const canvas = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  canvas.setPointerCapture = () => {};
  const { left, top } = canvas.getBoundingClientRect();
  const point = (name: string, x: number) =>
    canvas.dispatchEvent(
      new PointerEvent(name, {
        pointerId: 1,
        isPrimary: true,
        pointerType: "mouse",
        clientX: left + x,
        clientY: top + 120,
      }),
    );
  let x = 299;
  for (; x > 150 && canvas.style.cursor !== "grab"; x -= 3) point("pointermove", x);
  expect(canvas.style.cursor).toBe("grab");
  point("pointerdown", x);
  point("pointermove", x - 20);
  await clock.pass(300);
  expect(element.settled).toBe(false);
  point("lostpointercapture", x - 20);
  await settled(element);
  expect(element.page).toBe(4);
});

test("the paper changes without opening the book anew; unknown words are the usual paper", async () => {
  const element = book(scans(12), { page: "4", duration: "80", stock: "vellum", assist: "maybe" });
  await happens(element, "load");
  await settled(element);
  expect(element.stock).toBe("book");
  const canvas = element.shadowRoot?.querySelector("canvas");
  for (const stock of ["card", "bible", "", "coated"] as const) {
    element.setAttribute("stock", stock);
    expect(element.stock).toBe(stock || "book");
    const turned = element.next();
    // In mid-turn too: leaves in flight land first.
    element.stock = "office";
    element.setAttribute("assist", stock === "card" ? "off" : "on");
    element.paper = { grain: "across", wind: [0.1, 0, 0], binding: Number.NaN };
    expect(await turned).toBe(true);
    element.paper = null;
    expect(await element.previous()).toBe(true);
  }
  element.removeAttribute("stock");
  expect(element.stock).toBe("book");
  expect(element.page).toBe(4);
  expect(element.shadowRoot?.querySelector("canvas")).toBe(canvas);
});

test("another screen's pixels, and room that comes late", async () => {
  const ratio = Object.getOwnPropertyDescriptor(globalThis, "devicePixelRatio");
  const real = globalThis.matchMedia;
  const screens: EventTarget[] = [];
  globalThis.matchMedia = (query) => {
    if (!query.includes("dppx")) return real(query);
    const screen = new EventTarget();
    screens.push(screen);
    return screen as MediaQueryList;
  };
  try {
    const element = book(scans(4));
    element.style.display = "none";
    await happens(element, "load");
    await clock.pass(100);
    expect(element.settled).toBe(false);
    element.style.display = "";
    await settled(element);
    const canvas = element.shadowRoot?.querySelector("canvas");
    expect(canvas?.width).toBe(600);
    Object.defineProperty(globalThis, "devicePixelRatio", { value: 3, configurable: true });
    screens.at(-1)?.dispatchEvent(new Event("change"));
    await settled(element);
    expect(canvas?.width).toBe(900);
    expect(screens.length).toBe(2);
  } finally {
    globalThis.matchMedia = real;
    if (ratio) Object.defineProperty(globalThis, "devicePixelRatio", ratio);
  }
});
