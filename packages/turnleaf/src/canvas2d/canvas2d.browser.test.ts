/** A book on a 2D canvas, in a Chromium without WebGL: the same element with the same results. */

import { afterAll, afterEach, beforeAll, expect, test } from "vitest";
import type { TurnDetail } from "../element/events.ts";
import { clock } from "../for_tests/clock.ts";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";

const real = HTMLCanvasElement.prototype.getContext;

beforeAll(() => {
  HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...asked: unknown[]) {
    return String(asked[0]).startsWith("webgl") ? null : Reflect.apply(real, this, asked);
  } as typeof real;
});

afterAll(() => {
  HTMLCanvasElement.prototype.getContext = real;
});

afterEach(() => document.body.replaceChildren());

function canvasOf(element: HTMLElement): HTMLCanvasElement {
  return element.shadowRoot?.querySelector("[part=canvas]") as HTMLCanvasElement;
}

/**
 * Returns the colour at a place of the canvas, CSS pixels: red, green, blue,
 * opacity from 0 to 255.
 */
function colourAt(element: HTMLElement, x: number, y: number): number[] {
  const canvas = canvasOf(element);
  const scale = canvas.width / canvas.clientWidth;
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  return [...pen.getImageData(x * scale, y * scale, 1, 1).data];
}

/** Dispatches a pointer event at a place of the canvas, CSS pixels. */
function point(element: HTMLElement, name: string, x: number, y: number): void {
  const canvas = canvasOf(element);
  canvas.setPointerCapture = () => {};
  const { left, top } = canvas.getBoundingClientRect();
  canvas.dispatchEvent(
    new PointerEvent(name, {
      pointerId: 1,
      isPrimary: true,
      pointerType: "mouse",
      clientX: left + x,
      clientY: top + y,
    }),
  );
}

// A list of requests that is full takes no more: a module that is loaded then would go unseen.
performance.setResourceTimingBufferSize(2000);

test("without WebGL a book opens, turns and says where it is, and loads neither three.js nor the engine", async () => {
  const element = book(scans(12), { duration: "80" });
  await happens(element, "load");
  expect(element.page).toBe(1);
  await settled(element);
  expect(canvasOf(element).getContext("2d")).not.toBeNull();

  const started = happens<TurnDetail>(element, "turnstart");
  const changed = happens<TurnDetail>(element, "pagechange");
  expect(await element.next()).toBe(true);
  expect(await started).toEqual({ from: 1, to: 2, direction: "forward" });
  expect(await changed).toEqual({ from: 1, to: 2, direction: "forward" });
  expect(await element.goTo(7)).toBe(true);
  expect(element.page).toBe(6);
  // Several turns requested at once are done one after the other.
  const turns = [element.next(), element.next()];
  expect(await Promise.all(turns)).toEqual([true, true]);
  expect(element.page).toBe(10);
  expect(await element.goTo(1000)).toBe(true);
  expect(element.page).toBe(12);
  expect(await element.previous()).toBe(true);

  const loaded = performance.getEntriesByType("resource").map(({ name }) => name);
  expect(loaded.some((name) => name.includes("/canvas2d_backend.ts"))).toBe(true);
  expect(
    loaded.filter((name) => /\/webgl_backend\.ts|turnleaf\.wasm|deps\/three/.test(name)),
  ).toEqual([]);
});

test("a leaf is peeled from a corner, an edge or the foot, and falls to the side it was led to", async () => {
  const element = book(scans(12), { page: "6" });
  await happens(element, "load");
  await settled(element);
  // The page on the right: from the spine at 150 to its fore-edge.
  let edge = 299;
  for (; edge > 150 && canvasOf(element).style.cursor !== "grab"; edge--) {
    point(element, "pointermove", edge, 110);
  }
  expect(edge).toBeGreaterThan(200);
  for (const [x, y, toX, toY, page] of [
    [edge - 2, 180, 60, 150, 8],
    [edge - 2, 110, 60, 110, 10],
    [edge - 25, 185, edge - 60, 150, 10],
  ]) {
    const before = element.page;
    const changed = page === before ? null : happens(element, "pagechange");
    point(element, "pointermove", x, y);
    point(element, "pointerdown", x, y);
    for (let k = 1; k <= 5; k++) {
      point(element, "pointermove", x + ((toX - x) * k) / 5, y + ((toY - y) * k) / 5);
    }
    expect(element.page).toBe(before);
    // While it is held it lies on neither side.
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    expect(element.turning).toBe(true);
    // A pointer that rests before it releases throws nothing.
    await clock.pass(150);
    point(element, "pointerup", toX, toY);
    await changed;
    await settled(element);
    expect(element.page).toBe(page);
  }
});

test("a corner lifts under the pointer, and takes no frame once it holds still", async () => {
  const element = book(scans(12), { page: "6", layout: "spread" });
  await happens(element, "load");
  await settled(element);
  let edge = 299;
  for (; edge > 150 && canvasOf(element).style.cursor !== "grab"; edge--) {
    point(element, "pointermove", edge, 110);
  }
  let foot = 219;
  for (; foot > 110 && colourAt(element, edge - 6, foot)[0] < 200; foot--);
  const turned: unknown[] = [];
  for (const name of ["turnstart", "pagechange"]) {
    element.addEventListener(name, () => turned.push(name));
  }
  /** Returns the pixels around the corner. */
  const seen = (): Uint8ClampedArray => {
    const canvas = canvasOf(element);
    const scale = canvas.width / canvas.clientWidth;
    const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
    const [x, y, size] = [edge - 24, foot - 24, 24].map((length) => length * scale);
    return pen.getImageData(x, y, size, size).data;
  };
  const before = seen();
  const changed = () => seen().filter((value, k) => Math.abs(value - before[k]) > 12).length;
  point(element, "pointermove", edge - 4, foot - 4);
  await eventually(changed).toBeGreaterThan(30);
  await settled(element);
  point(element, "pointermove", 150, 2);
  await eventually(changed).toBe(0);
  expect(turned).toEqual([]);
});

test("nothing runs at rest, and a removed book is gone", async () => {
  const element = book(scans(6), { page: "3" });
  await happens(element, "load");
  await settled(element);
  let frames = 0;
  const request = globalThis.requestAnimationFrame;
  globalThis.requestAnimationFrame = (call) => {
    frames++;
    return request(call);
  };
  try {
    const quiet = async () => {
      const before = frames;
      await clock.pass(300);
      return frames - before;
    };
    // A page that was still being drawn when the book came to rest may request a frame of its own.
    await eventually(quiet).toBe(0);
    frames = 0;
    void element.next();
    expect(frames).toBe(1);
    element.remove();
    await clock.pass(200);
    expect(frames).toBe(1);
  } finally {
    globalThis.requestAnimationFrame = request;
  }
});

test("the frame in which a leaf lands is the last one", async () => {
  const element = book(scans(12), { page: "3", duration: "80" });
  await happens(element, "load");
  await eventually(() => element.ready).toBe(true);
  const request = globalThis.requestAnimationFrame;
  const drawn = { before: 0, after: 0 };
  let hasLanded = false;
  element.addEventListener("pagechange", () => {
    hasLanded = true;
  });
  globalThis.requestAnimationFrame = (call) =>
    request((now) => {
      drawn[hasLanded ? "after" : "before"]++;
      call(now);
    });
  try {
    await element.next();
    await clock.pass(300);
    expect(drawn.before).toBeGreaterThan(0);
    expect(drawn.after).toBe(0);
  } finally {
    globalThis.requestAnimationFrame = request;
  }
});

test.each(["left", "right", "top", "bottom"] as const)("it is bound at the %s", async (binding) => {
  const look = { binding, cover: "none", layout: "spread" };
  const element = book(scans(12), { page: "6", duration: "80", ...look });
  await happens(element, "load");
  await settled(element);
  const { left, right } = element.spread;
  expect([left, right].sort()).toEqual([6, 7]);
  // The scans' paper, on both pages, below their numbers.
  const [across, down] = binding === "left" || binding === "right" ? [60, 0] : [0, 60];
  for (const sign of [-1, 1]) {
    const below = across > 0 ? 50 : 0;
    const [red, , blue] = colourAt(element, 150 + sign * across, 110 + below + sign * down);
    expect(red).toBeGreaterThan(200);
    expect(red - blue).toBeGreaterThan(10);
  }
  expect(await element.next()).toBe(true);
  expect(element.page).toBe(8);
});
