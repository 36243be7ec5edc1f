/** Many leaves in flight, through the element in real Chromium. */

import { afterEach, expect, test } from "vitest";
import type { TurnDetail } from "./element/events.ts";
import type { TurnleafBook } from "./element.ts";
import { book, happens, scans, settled } from "./element_for_tests.ts";
import { DrawnBook } from "./webgl/drawn_book.ts";

const pose = DrawnBook.prototype.pose;

afterEach(() => {
  DrawnBook.prototype.pose = pose;
  document.body.replaceChildren();
});

/** Counts the leaves that are drawn at once. */
function watchFlights(): { now: number; most: number } {
  const seen = { now: 0, most: 0 };
  DrawnBook.prototype.pose = function (parts) {
    seen.now = parts.leaves.length;
    seen.most = Math.max(seen.most, seen.now);
    return pose.call(this, parts);
  };
  return seen;
}

/** Collects where the book came to rest. */
function watchChanges(element: TurnleafBook): TurnDetail[] {
  const changes: TurnDetail[] = [];
  element.addEventListener("pagechange", (event) =>
    changes.push((event as CustomEvent<TurnDetail>).detail),
  );
  return changes;
}

const press = (element: TurnleafBook, key: string) =>
  element.dispatchEvent(new KeyboardEvent("keydown", { key, repeat: true }));

const pause = (milliseconds: number) => new Promise((resolve) => setTimeout(resolve, milliseconds));

test("a held arrow key riffles: ten leaves fly at once, and it stops soon after", async () => {
  const element = book(scans(120), { cover: "none", duration: "1200" });
  await happens(element, "load");
  await settled(element);
  const flights = watchFlights();
  let begun = 0;
  element.addEventListener("turnstart", () => begun++);
  const changes = watchChanges(element);
  for (let k = 0; k < 120 && flights.most < 10; k++) {
    press(element, "ArrowRight");
    await pause(33);
  }
  expect(flights.most).toBeGreaterThanOrEqual(10);
  const before = begun;
  await settled(element);
  expect(begun - before).toBeLessThanOrEqual(4);
  expect(element.page).toBe(2 * begun);
  expect(changes).toEqual([{ from: 1, to: 2 * begun, direction: "forward" }]);
});

test("the other arrow key takes back what flies", async () => {
  const element = book(scans(120), { cover: "none", duration: "1200", page: "40" });
  await happens(element, "load");
  await settled(element);
  for (let k = 0; k < 10; k++) {
    press(element, "ArrowRight");
    await pause(100);
  }
  for (let k = 0; k < 30; k++) {
    press(element, "ArrowLeft");
    await pause(60);
  }
  await settled(element);
  expect(element.page).toBeLessThan(40);
  expect(element.page % 2).toBe(0);
});

test("a far jump lands where told, with many leaves and one change of page", async () => {
  const element = book(scans(160), { cover: "none", duration: "400" });
  await happens(element, "load");
  await settled(element);
  const flights = watchFlights();
  const changes = watchChanges(element);
  expect(await element.goTo(141)).toBe(true);
  expect(element.page).toBe(140);
  expect(changes).toEqual([{ from: 1, to: 140, direction: "forward" }]);
  expect(flights.most).toBeGreaterThan(2);
  expect(flights.most).toBeLessThanOrEqual(12);
  await settled(element);
});

test("a second hand takes up another leaf, and the first hand's falls", async () => {
  const element = book(scans(40), { page: "20" });
  await happens(element, "load");
  await settled(element);
  const flights = watchFlights();
  const canvas = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  canvas.setPointerCapture = () => {};
  const { left, top } = canvas.getBoundingClientRect();
  const point = (name: string, pointerId: number, x: number, pointerType = "touch") =>
    canvas.dispatchEvent(
      new PointerEvent(name, {
        pointerId,
        pointerType,
        isPrimary: pointerId === 1,
        clientX: left + x,
        clientY: top + 120,
      }),
    );
  /** Where a pointer can grab the fore-edge, from the outside in. */
  const edge = (from: number, by: number) => {
    let x = from;
    do {
      x += by;
      point("pointermove", 9, x, "mouse");
    } while (canvas.style.cursor !== "grab" && x > 0 && x < 300);
    return x;
  };
  const [rightEdge, leftEdge] = [edge(300, -3), edge(0, 3)];
  // A second finger beside one that turns nothing yet would zoom.
  point("pointerdown", 1, rightEdge);
  point("pointermove", 1, rightEdge - 30);
  point("pointerdown", 2, leftEdge);
  point("pointermove", 2, leftEdge + 30);
  await expect.poll(() => flights.most, { timeout: 20_000 }).toBe(2);
  // The finger that lost its leaf moves further and is released; the other holds.
  point("pointermove", 1, rightEdge - 60);
  await expect.poll(() => flights.now, { timeout: 20_000 }).toBe(1);
  point("pointerup", 1, rightEdge - 60);
  await pause(200);
  expect(flights.now).toBe(1);
  point("pointermove", 2, leftEdge + 6);
  await pause(300);
  point("pointerup", 2, leftEdge + 6);
  await settled(element);
  expect(element.page).toBe(20);
});
