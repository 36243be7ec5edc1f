/** Pointers and keys on the element in real Chromium: drag, flick, hover, pinch, wheel, keys. */

import { afterEach, expect, test, vi } from "vitest";
import type { TurnDetail } from "../element/events.ts";
import { pageTap } from "../element/page_tap.ts";
import type { TurnleafBook } from "../element.ts";
import { clock } from "../for_tests/clock.ts";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { TestPointer } from "../for_tests/test_pointer.ts";
import { DrawnBook } from "../webgl/drawn_book.ts";

const pose = DrawnBook.prototype.pose;
const request = globalThis.requestAnimationFrame;

afterEach(() => {
  vi.restoreAllMocks();
  DrawnBook.prototype.pose = pose;
  globalThis.requestAnimationFrame = request;
  document.body.replaceChildren();
  document.body.style.cssText = "";
});

/** Opens a book at page 6, with simulated pointers. */
async function opened(attributes: Record<string, string> = {}) {
  const element = book(scans(12), { page: "6", cover: "none", duration: "120", ...attributes });
  await happens(element, "load");
  await settled(element);
  return { element, pointer: new TestPointer(element) };
}

/** Counts the requested animation frames. */
function watchFrames(): { count: number } {
  const seen = { count: 0 };
  globalThis.requestAnimationFrame = (call) => {
    seen.count++;
    return request(call);
  };
  return seen;
}

/** Returns the leaves that are drawn in flight. */
function watchFlights(): { positions: Float32Array[] } {
  const seen: { positions: Float32Array[] } = { positions: [] };
  DrawnBook.prototype.pose = function (parts) {
    seen.positions = parts.leaves.map(({ positions }) => positions);
    return pose.call(this, parts);
  };
  return seen;
}

function count(element: TurnleafBook, name: string): { times: number } {
  const seen = { times: 0 };
  element.addEventListener(name, () => seen.times++);
  return seen;
}

/** Waits for what should not come. */
const wait = () => clock.pass(60);

test("a drag in the middle of a page turns it, a click there does not", async () => {
  const { element, pointer } = await opened();
  pointer.click(200, 110);
  await wait();
  expect(element.settled).toBe(true);
  pointer.point("pointerdown", 205, 110);
  await pointer.move([205, 110], [60, 100]);
  // Held still it comes to rest.
  await settled(element);
  pointer.point("pointerup", 60, 100);
  await settled(element);
  expect(element.page).toBe(8);
});

// If one page fills the screen there is no space beyond its spine to carry a leaf to.
test.each([
  { binding: "left", taken: 0.98, carried: 0.15, page: 7 },
  { binding: "right", taken: 0.02, carried: 0.85, page: 7 },
  { binding: "left", taken: 0.98, carried: 0.6, page: 6 },
  { binding: "right", taken: 0.02, carried: 0.4, page: 6 },
  // The previous page, pulled back from the spine; pulled too little, it falls back.
  { binding: "left", taken: 0.1, carried: 0.9, page: 5 },
  { binding: "right", taken: 0.9, carried: 0.1, page: 5 },
  { binding: "left", taken: 0.1, carried: 0.28, page: 6 },
] as const)(
  "a page that stands alone, bound at the $binding, is carried from $taken to $carried",
  async ({ binding, taken, carried, page }) => {
    const { element, pointer } = await opened({ layout: "single", binding });
    // A page of 90 by 120 pixels in the middle of the element.
    const at = (fraction: number): [number, number] => [150 + (fraction - 0.5) * 150, 120];
    pointer.point("pointerdown", ...at(taken));
    await pointer.move(at(taken), at(carried));
    await settled(element);
    pointer.point("pointerup", ...at(carried));
    await settled(element);
    expect(element.page).toBe(page);
  },
);

test("a click at an edge turns, and a flick of a finger on either page does", async () => {
  const { element, pointer } = await opened();
  pointer.click(280, 110);
  expect((await happens<TurnDetail>(element, "pagechange")).to).toBe(8);
  const touch = { pointerType: "touch", pointerId: 7 };
  // Outward on the left page: no leaf there goes that way, but the reader means forward.
  for (const [from, to, page] of [
    [120, 70, 10],
    [80, 140, 8],
    [180, 130, 10],
    [180, 240, 8],
  ]) {
    const changed = happens<TurnDetail>(element, "pagechange");
    pointer.point("pointerdown", from, 110, touch);
    pointer.flick([from, 110], [to, 112], touch);
    pointer.point("pointerup", to, 112, touch);
    expect((await changed).to).toBe(page);
    await settled(element);
  }
});

test("a finger that scrolls the page turns nothing, and one that is taken away lets go", async () => {
  const { element, pointer } = await opened();
  const started = count(element, "turnstart");
  const touch = { pointerType: "touch", pointerId: 7 };
  expect(getComputedStyle(pointer.stage).touchAction).toBe("pan-y");
  pointer.point("pointerdown", 220, 80, touch);
  await pointer.move([220, 80], [222, 140], touch);
  pointer.point("pointercancel", 222, 140, touch);
  expect(started.times).toBe(0);
  pointer.point("pointerdown", 220, 80, touch);
  await pointer.move([220, 80], [200, 82], touch);
  pointer.point("pointercancel", 200, 82, touch);
  await settled(element);
  expect(element.page).toBe(6);
  // One finger may scroll; two belong to the book.
  const finger = (identifier: number) =>
    new Touch({ identifier, target: pointer.canvas, clientX: 20 * identifier, clientY: 20 });
  const touchmove = (touches: Touch[]) =>
    pointer.canvas.dispatchEvent(
      new TouchEvent("touchmove", { touches, bubbles: true, cancelable: true, composed: true }),
    );
  expect(touchmove([finger(1)])).toBe(true);
  expect(touchmove([finger(1), finger(2)])).toBe(false);
  element.zoom = 3;
  expect(touchmove([finger(1)])).toBe(false);
  await settled(element);
  expect(getComputedStyle(pointer.stage).touchAction).toBe("none");
  element.zoom = 1;
  await settled(element);
  expect(getComputedStyle(pointer.stage).touchAction).toBe("pan-y");
  element.setAttribute("binding", "top");
  await settled(element);
  expect(getComputedStyle(pointer.stage).touchAction).toBe("pan-x");
});

test("a corner lifts under a mouse, holds still without a frame, and lies down", async () => {
  const { element, pointer } = await opened();
  const started = count(element, "turnstart");
  const flights = watchFlights();
  let corner: [number, number] = [0, 0];
  // The corner of the page at the foot, wherever it is seen.
  for (let y = 215; y > 150 && flights.positions.length === 0; y -= 3) {
    for (let x = 296; x > 200 && flights.positions.length === 0; x -= 3) {
      pointer.point("pointermove", x, y);
      if (pointer.canvas.style.cursor !== "grab") continue;
      corner = [x - 4, y - 4];
      pointer.point("pointermove", ...corner);
      await new Promise((resolve) => request(() => request(resolve)));
      break;
    }
  }
  expect(flights.positions.length).toBe(1);
  await settled(element);
  // Higher at that corner than anywhere else near its edge.
  const heights = flights.positions[0].filter((_, k) => k % 3 === 2);
  expect(Math.max(...heights)).toBeGreaterThan(heights[heights.length - 1] + 0.006);
  const frames = watchFrames();
  await wait();
  expect(frames.count).toBe(0);
  expect(started.times).toBe(0);
  // On the same corner nothing starts again.
  pointer.point("pointermove", corner[0] - 2, corner[1] - 2);
  await wait();
  expect(frames.count).toBe(0);
  pointer.point("pointermove", 200, 60);
  await settled(element);
  expect(flights.positions.length).toBe(0);
  expect(element.page).toBe(6);
  expect(started.times).toBe(0);

  // Lifted, a click turns it; the other way goes the other way.
  pointer.point("pointermove", ...corner);
  await settled(element);
  pointer.click(...corner);
  expect((await happens<TurnDetail>(element, "pagechange")).to).toBe(8);
  expect(started.times).toBe(1);
  await settled(element);
  pointer.point("pointermove", 200, 60);
  await settled(element);
  pointer.point("pointermove", ...corner);
  await settled(element);
  expect(await element.previous()).toBe(true);
  expect(element.page).toBe(6);
  expect(started.times).toBe(2);

  // A drag grabs it where it is lifted, and holds still without frames too.
  await settled(element);
  pointer.point("pointermove", 200, 60);
  await settled(element);
  pointer.point("pointermove", ...corner);
  await settled(element);
  pointer.point("pointerdown", ...corner);
  await pointer.move(corner, [corner[0] - 60, corner[1] - 20]);
  expect(started.times).toBe(3);
  await settled(element);
  frames.count = 0;
  await wait();
  expect(frames.count).toBe(0);
  expect(flights.positions.length).toBe(1);
  await pointer.move([corner[0] - 60, corner[1] - 20], [40, 120]);
  await settled(element);
  pointer.point("pointerup", 40, 120);
  await settled(element);
  expect(element.page).toBe(8);
  // Outside the element it falls as well.
  pointer.point("pointermove", 200, 60);
  pointer.point("pointermove", ...corner);
  await eventually(() => flights.positions.length).toBe(1);
  pointer.stage.dispatchEvent(new PointerEvent("pointerleave"));
  await settled(element);
  expect(flights.positions.length).toBe(0);
});

test("two fingers zoom about what is between them, one then pans, and edges hold", async () => {
  const { element, pointer } = await opened();
  const zooms: number[] = [];
  element.addEventListener("zoomchange", (event) =>
    zooms.push((event as CustomEvent<{ zoom: number }>).detail.zoom),
  );
  const [a, b] = [1, 2].map((pointerId) => ({ pointerId, pointerType: "touch" }));
  pointer.point("pointerdown", 140, 110, a);
  pointer.point("pointerdown", 160, 110, b);
  await Promise.all([
    pointer.move([140, 110], [120, 100], a),
    pointer.move([160, 110], [180, 120], b),
  ]);
  expect(element.zoom).toBeGreaterThan(2.9);
  expect(element.zoom).toBeLessThan(3.4);
  expect(zooms.at(-1)).toBe(element.zoom);
  pointer.point("pointerup", 180, 120, b);
  const level = element.zoom;
  await pointer.move([120, 100], [60, 60], a);
  pointer.point("pointerup", 60, 60, a);
  await settled(element);
  expect(element.zoom).toBe(level);
  expect(element.page).toBe(6);
  // No swipe turns while zoomed.
  pointer.point("pointerdown", 250, 110, a);
  pointer.flick([250, 110], [100, 110], a);
  pointer.point("pointerup", 100, 110, a);
  await settled(element);
  expect(element.page).toBe(6);
  // Pinched together it is whole again, and no smaller.
  pointer.point("pointerdown", 60, 110, a);
  pointer.point("pointerdown", 240, 110, b);
  await Promise.all([
    pointer.move([60, 110], [145, 110], a),
    pointer.move([240, 110], [155, 110], b),
  ]);
  pointer.point("pointerup", 155, 110, b);
  pointer.point("pointerup", 145, 110, a);
  expect(element.zoom).toBe(1);
  await settled(element);
});

test.each(["left", "right"])(
  "a page by itself in a book bound at its %s turns on at its fore-edge and back beside its spine; a tap between says so once no second comes",
  async (binding) => {
    const { element, pointer } = await opened({ layout: "single", binding });
    const bounds = element.bookBounds as DOMRect;
    const taps = count(element, "");
    element.shadowRoot
      ?.querySelector("[part=stage]")
      ?.addEventListener(pageTap, () => taps.times++);
    const touch = { pointerType: "touch" };
    const at = (fraction: number): [number, number] => {
      const across = binding === "left" ? fraction : 1 - fraction;
      return [bounds.left + across * bounds.width, bounds.top + bounds.height / 2];
    };
    for (const [place, page] of [
      [0.9, 7],
      [0.1, 6],
      [0.03, 5],
    ] as const) {
      pointer.click(...at(place), touch);
      await eventually(() => element.page).toBe(page);
      await settled(element);
    }
    expect(taps.times).toBe(0);
    pointer.click(...at(0.5), touch);
    expect(taps.times).toBe(0);
    await eventually(() => taps.times).toBe(1);
    // A double tap zooms.
    pointer.wait(1000);
    pointer.click(...at(0.5), touch);
    pointer.click(...at(0.5), touch);
    await eventually(() => element.zoom).toBe(2);
    await clock.pass(500);
    element.zoom = 1;
    await settled(element);
    // A finger that stays selects.
    pointer.point("pointerdown", ...at(0.5), touch);
    pointer.wait(600);
    pointer.point("pointerup", ...at(0.5), touch);
    await clock.pass(500);
    expect([taps.times, element.page]).toEqual([1, 5]);
  },
);

test("a second finger soon after one that has begun to move a leaf zooms, and the leaf goes back", async () => {
  const { element, pointer } = await opened();
  const [a, b] = [1, 2].map((pointerId) => ({ pointerId, pointerType: "touch" }));
  const pinch = async (pause: number, far: number): Promise<void> => {
    pointer.point("pointerdown", 220, 110, a);
    pointer.point("pointermove", 220 - far / 2, 110, a);
    pointer.point("pointermove", 220 - far, 110, a);
    expect(element.state).toBe("dragged");
    pointer.wait(pause);
    pointer.point("pointerdown", 100, 110, b);
    await Promise.all([
      pointer.move([220 - far, 110], [260, 110], a),
      pointer.move([100, 110], [40, 110], b),
    ]);
  };
  const release = async (): Promise<void> => {
    pointer.point("pointerup", 260, 110, a);
    pointer.point("pointerup", 40, 110, b);
    await settled(element);
  };
  await pinch(80, 20);
  expect(element.zoom).toBeGreaterThan(1.5);
  await release();
  expect(element.state).toBe("resting");
  expect(element.page).toBe(6);
  element.zoom = 1;
  await settled(element);
  // A finger that has held its leaf for a while, or drawn it away, goes on to: the other takes another leaf.
  for (const [pause, far] of [
    [400, 20],
    [80, 60],
  ] as const) {
    await pinch(pause, far);
    expect(element.zoom).toBe(1);
    await release();
  }
});

test("a double tap zooms to the page and back, keys zoom and pan", async () => {
  const { element, pointer } = await opened();
  const touch = { pointerType: "touch", pointerId: 3 };
  pointer.click(200, 100, touch);
  pointer.click(203, 102, touch);
  expect(element.zoom).toBeGreaterThanOrEqual(2);
  await settled(element);
  const cursor = pointer.canvas.style.cursor;
  pointer.point("pointermove", 150, 100);
  expect(pointer.canvas.style.cursor).toBe("grab");
  pointer.canvas.style.cursor = cursor;
  pointer.click(120, 100, touch);
  pointer.click(120, 100, touch);
  expect(element.zoom).toBe(1);
  await settled(element);
  pointer.click(200, 100);
  pointer.click(200, 100);
  expect(element.zoom).toBeGreaterThanOrEqual(2);
  pointer.key("0");
  expect(element.zoom).toBe(1);
  pointer.key("+");
  expect(element.zoom).toBeCloseTo(1.5, 6);
  pointer.key("+");
  expect(element.zoom).toBeCloseTo(2.25, 6);
  pointer.key("ArrowRight");
  await settled(element);
  expect(element.page).toBe(6);
  pointer.key("-");
  pointer.key("-");
  pointer.key("-");
  expect(element.zoom).toBe(1);
  pointer.key("ArrowRight");
  await happens(element, "pagechange");
  expect(element.page).toBe(8);
});

test("the wheel zooms with Ctrl, pans while zoomed, turns where nothing else scrolls", async () => {
  const { element, pointer } = await opened();
  expect(pointer.roll(0, -40, { ctrlKey: true })).toBe(false);
  expect(element.zoom).toBeGreaterThan(1.3);
  await settled(element);
  const level = element.zoom;
  expect(pointer.roll(30, 20)).toBe(false);
  await settled(element);
  expect(element.zoom).toBe(level);
  expect(element.page).toBe(6);
  element.zoom = 1;
  await settled(element);

  // Across it turns, once per swipe.
  for (let k = 0; k < 6; k++) expect(pointer.roll(30, 2)).toBe(false);
  await settled(element);
  expect(element.page).toBe(8);
  pointer.wait(1000);

  // Down, the page scrolls if it can.
  const tall = document.createElement("div");
  tall.style.height = "3000px";
  document.body.append(tall);
  expect(pointer.roll(0, 120)).toBe(true);
  await settled(element);
  expect(element.page).toBe(8);
  tall.remove();
  document.documentElement.style.overflow = "hidden";
  try {
    expect(pointer.roll(0, 120)).toBe(false);
    expect((await happens<TurnDetail>(element, "pagechange")).to).toBe(10);
    pointer.wait(1000);
    expect(pointer.roll(0, -120)).toBe(false);
    expect((await happens<TurnDetail>(element, "pagechange")).to).toBe(8);
  } finally {
    document.documentElement.style.overflow = "";
  }
});

test("a slider drawn over the block redirects the leaves, and the book lands at the last request", async () => {
  const element = book(scans(60), { cover: "none", duration: "200" });
  await happens(element, "load");
  await settled(element);
  const flights = watchFlights();
  clock.hold();
  let most = 0;
  const landed: Promise<boolean>[] = [];
  for (const page of [4, 10, 16, 24, 34, 44, 50, 46, 38, 30, 26, 22]) {
    landed.push(element.goTo(page));
    clock.frames(4);
    most = Math.max(most, flights.positions.length);
  }
  await clock.until(() => element.settled);
  expect((await Promise.all(landed)).at(-1)).toBe(true);
  expect(element.page).toBe(22);
  expect(most).toBeGreaterThan(1);
});

test("who asked for less motion sees no corner lift and no glide", async () => {
  const real = globalThis.matchMedia;
  globalThis.matchMedia = (query) =>
    query.includes("reduced-motion") ? ({ matches: true } as MediaQueryList) : real(query);
  try {
    const { element, pointer } = await opened();
    const flights = watchFlights();
    for (let y = 215; y > 150; y -= 6) {
      for (let x = 296; x > 240; x -= 6) pointer.point("pointermove", x, y);
    }
    element.zoom = 4;
    expect(element.zoom).toBe(4);
    await new Promise((resolve) => request(() => request(resolve)));
    expect(flights.positions.length).toBe(0);
    await settled(element);
  } finally {
    globalThis.matchMedia = real;
  }
});

test("zoomed, Space and Page Down go down the page, to the head of the next, and then turn the leaf", async () => {
  const element = book(scans(12), { page: "6", cover: "none", duration: "0", controls: "" });
  element.style.cssText = "width: 600px; height: 500px";
  await happens(element, "load");
  await settled(element);
  await eventually(() => element.shadowRoot?.querySelector("[part=toolbar]")).toBeTruthy();
  const stage = element.shadowRoot?.querySelector("[part=stage]") as HTMLElement;
  const { left } = element.spread;
  element.zoomTo(3, { x: 150, y: 60 });
  await settled(element);
  element.focus();
  const press = async (key: string, more = {}): Promise<void> => {
    const target = element.shadowRoot?.querySelector(".frame");
    target?.dispatchEvent(
      new KeyboardEvent("keydown", {
        key,
        bubbles: true,
        composed: true,
        cancelable: true,
        ...more,
      }),
    );
    await clock.pass(400);
    await settled(element);
  };
  /** Returns the book's box, whose place says what is seen: as it is zoomed, its left half is the left page. */
  const seen = () => {
    const { x, y, width, height } = element.bookBounds as DOMRect;
    return { x: x - stage.offsetLeft, y: y - stage.offsetTop, width, height };
  };
  const turned = vi.fn();
  element.addEventListener("pagechange", turned);
  const start = seen();
  await press(" ");
  expect(start.y - seen().y).toBeGreaterThan(100);
  expect(seen().x).toBeCloseTo(start.x, 0);
  for (let k = 0; k < 6 && seen().y + seen().height > stage.clientHeight + 2; k++)
    await press("PageDown");
  // The foot of the left page, then the head of the right one, at the same place across.
  expect(seen().y + seen().height).toBeCloseTo(stage.clientHeight, 0);
  await press(" ");
  expect(turned).not.toHaveBeenCalled();
  expect(seen().y).toBeCloseTo(0, 0);
  expect(start.x - seen().x).toBeCloseTo(start.width / 2, -1);
  await press(" ", { shiftKey: true });
  expect(seen().y + seen().height).toBeCloseTo(stage.clientHeight, 0);
  await press(" ");
  for (let k = 0; k < 8 && turned.mock.calls.length === 0; k++) await press(" ");
  expect(element.spread.left).toBe((left ?? 0) + 2);
  expect(element.zoom).toBe(3);
  // The piles are not as high as they were.
  expect(seen().y).toBeCloseTo(0, -1);
  expect(seen().x).toBeCloseTo(start.x, -1);
});

test("a finger's tap or swipe beside the book turns it to that side, and a mouse's does nothing", async () => {
  const { element, pointer } = await opened();
  element.style.cssText = "width: 600px; height: 220px";
  await settled(element);
  const touch = { pointerType: "touch", pointerId: 7 };
  const { x, width } = element.bookBounds as DOMRect;
  const { left } = element.getBoundingClientRect();
  const [before, beyond] = [x - left - 40, x - left + width + 40];
  const lands = async (act: () => void): Promise<number> => {
    act();
    await clock.pass(1000);
    await settled(element);
    return element.page;
  };
  expect(before).toBeGreaterThan(20);
  expect(await lands(() => pointer.click(beyond, 110, touch))).toBe(8);
  expect(await lands(() => pointer.click(before, 110, touch))).toBe(6);
  const swipe = (from: number, to: number) => () => {
    pointer.point("pointerdown", from, 110, touch);
    pointer.flick([from, 110], [to, 112], touch);
    pointer.point("pointerup", to, 112, touch);
  };
  expect(await lands(swipe(beyond, beyond - 90))).toBe(8);
  expect(await lands(swipe(before, before + 90))).toBe(6);
  expect(await lands(() => pointer.click(beyond, 110))).toBe(6);
  element.binding = "right";
  await settled(element);
  const page = element.page;
  expect(await lands(() => pointer.click(before, 110, touch))).toBeGreaterThan(page);
});

test("zoomed to a column, Space goes down it, to the head of the column beside it, and then to the next page's", async () => {
  const lines = (x: number) =>
    Array.from({ length: 30 }, (_, k) => ({
      text: "words",
      x,
      y: 40 + 12 * k,
      width: 120,
      height: 9,
    }));
  const page = { ...scans(1)[0], width: 300, height: 420, text: [...lines(20), ...lines(160)] };
  const element = book(
    { pages: Array.from({ length: 6 }, () => page) },
    { page: "2", cover: "none", duration: "0", controls: "" },
  );
  element.style.cssText = "width: 600px; height: 500px";
  await happens(element, "load");
  await settled(element);
  const stage = element.shadowRoot?.querySelector("[part=stage]") as HTMLElement;
  await eventually(() => element.shadowRoot?.querySelectorAll(".pieces").length).toBeGreaterThan(4);
  element.focus();
  const press = async (key: string): Promise<void> => {
    const more = { bubbles: true, composed: true, cancelable: true };
    const target = element.shadowRoot?.querySelector(".frame");
    target?.dispatchEvent(new KeyboardEvent("keydown", { key, ...more }));
    await clock.pass(400);
    await settled(element);
  };
  /** Returns which of the four columns of two pages is in the middle, from 0, and whether its head or foot is in sight. */
  const seen = () => {
    const { x, y, width, height } = element.bookBounds as DOMRect;
    const at = (stage.offsetLeft + stage.clientWidth / 2 - x) / (width / 2);
    const column = 2 * Math.floor(at) + (at % 1 > 0.5 ? 1 : 0);
    const [top, foot] = [y - stage.offsetTop, y + height - stage.offsetTop - stage.clientHeight];
    return [column, Math.abs(top) < 2 ? "head" : Math.abs(foot) < 2 ? "foot" : "between"];
  };
  const { x, y, width, height } = element.bookBounds as DOMRect;
  // The middle of the first column comes into the middle of what is in sight.
  element.zoomTo(4, { x: x + (width / 2) * 0.27, y: y + height * 0.05 });
  await settled(element);
  const order: string[] = [];
  for (let k = 0; k < 40 && order.at(-1) !== "4 0"; k++) {
    await press(" ");
    const [column] = seen();
    const now = `${element.spread.left} ${column}`;
    if (order.at(-1) !== now) {
      if (order.length > 0) expect(seen()[1]).toBe("head");
      order.push(now);
    }
  }
  expect(order).toEqual(["2 0", "2 1", "2 2", "2 3", "4 0"]);
  await press("PageUp");
  expect(seen()).toEqual([3, "foot"]);
  expect(element.spread.left).toBe(2);
});
