/** Many leaves in flight, through the element in real Chromium, under the test's own clock. */

import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { TurnDetail } from "./element/events.ts";
import type { TurnleafBook } from "./element.ts";
import { clock } from "./for_tests/clock.ts";
import { book, happens, scans, settled } from "./for_tests/element_books.ts";
import { DrawnBook } from "./webgl/drawn_book.ts";

const pose = DrawnBook.prototype.pose;

beforeEach(() => {
  // Leaves are counted, not pixels.
  vi.spyOn(WebGL2RenderingContext.prototype, "drawElements").mockImplementation(() => undefined);
});

afterEach(() => {
  vi.restoreAllMocks();
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

/** Opens a book, and stops its clock once it rests. */
async function opened(count: number, attributes: Record<string, string>) {
  const element = book(scans(count), attributes);
  await happens(element, "load");
  await settled(element);
  clock.hold();
  return { element, clock, rest: () => clock.until(() => element.settled) };
}

test("a held arrow key riffles: ten leaves fly at once, and it stops soon after", async () => {
  const { element, clock, rest } = await opened(120, { cover: "none", duration: "1200" });
  const flights = watchFlights();
  let begun = 0;
  element.addEventListener("turnstart", () => begun++);
  const changes = watchChanges(element);
  for (let k = 0; k < 120 && flights.most < 10; k++) {
    press(element, "ArrowRight");
    clock.frames(2);
  }
  expect(flights.most).toBeGreaterThanOrEqual(10);
  const before = begun;
  await rest();
  expect(begun - before).toBeLessThanOrEqual(4);
  expect(element.page).toBe(2 * begun);
  expect(changes).toEqual([{ from: 1, to: 2 * begun, direction: "forward" }]);
});

test("the other arrow key takes back what flies", async () => {
  const { element, clock, rest } = await opened(120, {
    cover: "none",
    duration: "1200",
    page: "40",
  });
  for (let k = 0; k < 10; k++) {
    press(element, "ArrowRight");
    clock.frames(6);
  }
  for (let k = 0; k < 30; k++) {
    press(element, "ArrowLeft");
    clock.frames(4);
  }
  await rest();
  expect(element.page).toBeLessThan(40);
  expect(element.page % 2).toBe(0);
});

test("a far jump lands at its page, with many leaves and one change of page", async () => {
  const { element, rest } = await opened(160, { cover: "none", duration: "400" });
  const flights = watchFlights();
  const changes = watchChanges(element);
  const turned = element.goTo(141);
  await rest();
  expect(await turned).toBe(true);
  expect(element.page).toBe(140);
  expect(changes).toEqual([{ from: 1, to: 140, direction: "forward" }]);
  expect(flights.most).toBeGreaterThan(2);
  expect(flights.most).toBeLessThanOrEqual(12);
});

test("a second pointer picks up another leaf, and the first one's falls", async () => {
  const { element, clock, rest } = await opened(40, { page: "20" });
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
  clock.frames(2);
  expect(flights.most).toBe(2);
  // The finger that lost its leaf moves further and is released; the other holds.
  point("pointermove", 1, rightEdge - 60);
  await clock.until(() => flights.now === 1);
  point("pointerup", 1, rightEdge - 60);
  clock.frames(12);
  expect(flights.now).toBe(1);
  point("pointermove", 2, leftEdge + 6);
  clock.frames(18);
  point("pointerup", 2, leftEdge + 6);
  await rest();
  expect(element.page).toBe(20);
});
