/** The graphics context is lost: for a while, or for good. */

import { afterEach, expect, test, vi } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";
import { Viewer } from "../viewer/viewer.ts";

afterEach(() => {
  vi.useRealTimers();
  vi.restoreAllMocks();
  document.body.replaceChildren();
});

/**
 * Loses a canvas's context, and lets a minute of timers pass, in which it does
 * not come back.
 *
 * @param meanwhile called after the loss, before that minute
 */
async function loseForGood(
  canvas: HTMLCanvasElement,
  meanwhile: () => void | Promise<void>,
): Promise<void> {
  const lost = new Promise((done) => canvas.addEventListener("webglcontextlost", done));
  vi.useFakeTimers({ toFake: ["setTimeout", "clearTimeout"] });
  card(canvas)?.loseContext();
  await lost;
  await meanwhile();
  vi.advanceTimersByTime(60_000);
  vi.useRealTimers();
}

const canvasOf = (element: TurnleafBook) =>
  element.shadowRoot?.querySelector("[part=canvas]") as HTMLCanvasElement;

const card = (canvas: HTMLCanvasElement) =>
  canvas.getContext("webgl2")?.getExtension("WEBGL_lose_context");

/** Returns the errors and warnings logged while `work` runs. */
async function complaintsOf(work: () => Promise<void>): Promise<unknown[]> {
  const complaints: unknown[] = [];
  const heard = (event: Event) => complaints.push((event as ErrorEvent).message ?? event.type);
  const { error, warn } = console;
  console.error = console.warn = (...words) => complaints.push(words);
  for (const name of ["error", "unhandledrejection"]) addEventListener(name, heard);
  try {
    await work();
  } finally {
    for (const name of ["error", "unhandledrejection"]) removeEventListener(name, heard);
    [console.error, console.warn] = [error, warn];
  }
  return complaints;
}

test("the same book is seen again when it comes back, wherever it lies by then", async () => {
  const element = book(scans(12), { page: "4", duration: "80" });
  await happens(element, "load");
  await settled(element);
  expect(element.page).toBe(4);
  const canvas = canvasOf(element);
  const extension = card(canvas);
  const complaints = await complaintsOf(async () => {
    const lost = new Promise((done) => canvas.addEventListener("webglcontextlost", done));
    extension?.loseContext();
    await lost;
    expect(element.settled).toBe(false);
    // Commands are still carried out meanwhile.
    expect(await element.next()).toBe(true);
    expect(await element.goTo(4)).toBe(true);
    element.setAttribute("cloth", "#234");
    element.style.width = "310px";
    const restored = new Promise((done) => canvas.addEventListener("webglcontextrestored", done));
    extension?.restoreContext();
    await restored;
    await settled(element);
  });
  expect(complaints).toEqual([]);
  expect(element.page).toBe(4);
  expect(canvasOf(element)).toBe(canvas);
  expect(await element.next()).toBe(true);
  expect(element.page).toBe(6);
});

test("a book that nothing moves meanwhile is drawn again, once", async () => {
  const element = book(scans(12), { page: "4" });
  await happens(element, "load");
  await settled(element);
  const canvas = canvasOf(element);
  const drawn = vi.spyOn(canvas.getContext("webgl2") as WebGL2RenderingContext, "clear");
  const heard = (name: string) =>
    new Promise((done) => canvas.addEventListener(name, done, { once: true }));
  const lost = heard("webglcontextlost");
  card(canvas)?.loseContext();
  await lost;
  expect(drawn).not.toHaveBeenCalled();
  const restored = heard("webglcontextrestored");
  card(canvas)?.restoreContext();
  await restored;
  await settled(element);
  expect(drawn).toHaveBeenCalledOnce();
});

test("a book whose card does not come back goes on on the flat, at the same page", async () => {
  const element = book(scans(12), { page: "4", duration: "80" });
  await happens(element, "load");
  await settled(element);
  expect(await element.next()).toBe(true);
  const before = canvasOf(element);
  const waiting = element.goTo(1);
  const again = happens(element, "load");
  await loseForGood(before, async () => expect(await waiting).toBe(true));
  await again;
  await settled(element);
  const canvas = canvasOf(element);
  expect(canvas).not.toBe(before);
  expect(canvas.getContext("2d")).not.toBeNull();
  expect(element.shadowRoot?.querySelectorAll("canvas").length).toBe(1);
  expect(element.page).toBe(1);
  expect(await element.goTo(5)).toBe(true);
  expect(element.page).toBe(4);
  // When it opens again, it requests a context again.
  element.pages = scans(6);
  await happens(element, "load");
  expect(canvasOf(element).getContext("webgl2")).not.toBeNull();
});

test("a book taken away while its card is lost waits for nothing", async () => {
  const element = book(scans(6));
  await happens(element, "load");
  await settled(element);
  let loads = 0;
  element.addEventListener("load", () => loads++);
  let waiting = 0;
  await loseForGood(canvasOf(element), () => {
    waiting = vi.getTimerCount();
    element.remove();
    expect(vi.getTimerCount()).toBe(0);
  });
  expect(waiting).toBeGreaterThan(0);
  expect(loads).toBe(0);
});

/** Has the first `times` contexts on which a book is opened lost just before it is drawn. */
function loseWhileOpening(times: number) {
  const { open } = Viewer;
  const opening = vi.spyOn(Viewer, "open");
  for (let k = 0; k < times; k++) {
    opening.mockImplementationOnce((canvas, ...rest) => {
      card(canvas)?.loseContext();
      return open.call(Viewer, canvas, ...rest);
    });
  }
  return opening;
}

test.for([
  ["once", "webgl2", 1, 0],
  ["twice", "2d", 2, 1],
] as const)(
  "a book whose context is lost %s while it opens is drawn by %s",
  async ([, kind, times, warnings]) => {
    const warn = vi.spyOn(console, "warn").mockReturnValue();
    const open = loseWhileOpening(times);
    const element = book(scans(4));
    await happens(element, "load");
    await settled(element);
    expect(canvasOf(element).getContext(kind)).not.toBeNull();
    expect(element.shadowRoot?.querySelectorAll("canvas").length).toBe(1);
    expect(open).toHaveBeenCalledTimes(times + 1);
    const said = warn.mock.calls.filter(([text]) => String(text).includes("on the flat"));
    expect(said).toHaveLength(warnings);
  },
);

test("a book that cannot be drawn in 3D on a context that is there is shown on the flat", async () => {
  const warn = vi.spyOn(console, "warn").mockReturnValue();
  const error = new Error("no engine");
  const open = vi.spyOn(Viewer, "open").mockRejectedValueOnce(error);
  const element = book(scans(4));
  await happens(element, "load");
  await settled(element);
  expect(canvasOf(element).getContext("2d")).not.toBeNull();
  // Not tried again in 3D, which would hide what failed.
  expect(open).toHaveBeenCalledTimes(2);
  expect(warn.mock.calls.filter(([, reason]) => reason === error)).toHaveLength(1);
});
