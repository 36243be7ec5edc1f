/** Leaves torn out by command and by hand: their pages leave the book, lie beside it, and are put back. */

import { afterEach, expect, test, vi } from "vitest";
import type { TurnleafBook } from "../element.ts";
import type { UV } from "../engine/book_engine.ts";
import { CreasableBook } from "../engine/creasable_book.ts";
import type { CreasedMesh, Surface } from "../engine/shapes.ts";
import {
  book,
  drawRoughly,
  happens,
  keepWhatIsDrawn,
  scans,
  settled,
} from "../for_tests/element_books.ts";
import { TestClock } from "../for_tests/test_clock.ts";
import { TestPointer } from "../for_tests/test_pointer.ts";
import { LooseSheetPile } from "../viewer/loose_sheets.ts";

keepWhatIsDrawn();
drawRoughly();
afterEach(() => {
  vi.restoreAllMocks();
  document.body.replaceChildren();
});

async function opened(attributes: Record<string, string> = {}, count = 12): Promise<TurnleafBook> {
  const element = book(scans(count), {
    page: "5",
    cover: "none",
    duration: "300",
    tearable: "perforated",
    ...attributes,
  });
  // With room on the table beside the book.
  element.style.cssText = "width: 760px; height: 320px";
  await happens(element, "load");
  // A pull tears nothing until what tears is loaded.
  await expect.poll(() => element.ready, { timeout: 20_000 }).toBe(true);
  return element;
}

/** Returns how many pixels of the canvas beside the book show something, of those on its right. */
function besideBook(element: TurnleafBook): number {
  const drawn = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const bounds = element.bookBounds as DOMRect;
  const copy = document.createElement("canvas");
  const from = bounds.right + 14;
  const width = element.clientWidth - from - 2;
  [copy.width, copy.height] = [Math.floor(width), element.clientHeight];
  const pen = copy.getContext("2d") as CanvasRenderingContext2D;
  const scale = drawn.width / element.clientWidth;
  pen.drawImage(
    drawn,
    from * scale,
    0,
    copy.width * scale,
    copy.height * scale,
    0,
    0,
    copy.width,
    copy.height,
  );
  const { data } = pen.getImageData(0, 0, copy.width, copy.height);
  // Paper is opaque; shadows are not.
  return data.filter((value, k) => k % 4 === 3 && value > 250).length / (data.length / 4);
}

/** Pulls the upper corner of the right page outward, in steps of a frame, some pixels farther each. */
async function pull(element: TurnleafBook, steps: number, each = 6): Promise<TestPointer> {
  const pointer = new TestPointer(element);
  const { right, top } = element.bookBounds as DOMRect;
  const [x, y] = [right - 6, top + 8];
  pointer.point("pointerdown", x, y);
  for (let k = 1; k <= steps; k++) {
    pointer.point("pointermove", x + each * k, y - 0.3 * each * k, { buttons: 1 });
    await new Promise((resolve) => requestAnimationFrame(resolve));
  }
  return pointer;
}

/** Tears the leaf of page 5 out by frames of a clock of its own, which it returns. */
async function tearOutByClock(element: TurnleafBook): Promise<TestClock> {
  const clock = new TestClock();
  const torn = element.tearOut(5);
  await clock.until(() => element.tornLeaves === 1 && element.settled);
  expect(await torn).toBe(true);
  return clock;
}

test("a leaf is torn out by command, lies beside the book, and is put back", async () => {
  const element = await opened();
  const heard: string[] = [];
  for (const name of ["tear", "pageschange", "torn", "turnstart", "pagechange"]) {
    element.addEventListener(name, (event) =>
      heard.push(`${name} ${JSON.stringify((event as CustomEvent).detail)}`),
    );
  }
  expect(besideBook(element)).toBe(0);
  expect(await element.tearOut(5)).toBe(true);
  expect(heard).toEqual([
    'tear {"pages":[5,6]}',
    'pageschange {"pageCount":10}',
    'torn {"pages":[5,6]}',
  ]);
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([10, 1]);
  expect(element.spread).toEqual({ left: 4, right: 5 });
  expect(element.state).toBe("resting");
  await expect.poll(() => besideBook(element), { timeout: 20_000 }).toBeGreaterThan(0.2);
  expect(await element.putBack()).toBe(true);
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([12, 0]);
  expect(element.spread).toEqual({ left: 4, right: 5 });
  await expect.poll(() => besideBook(element)).toBe(0);
  expect(await element.putBack()).toBe(false);
});

test("pages that are put back are bookmarked as they were", async () => {
  const element = await opened();
  element.bookmarks = [2, 6, 9];
  expect(await element.tearOut(5)).toBe(true);
  expect(element.bookmarks).toEqual([2, 7]);
  expect(await element.putBack()).toBe(true);
  expect(element.bookmarks).toEqual([2, 6, 9]);
});

test("a leaf on the left is torn out too, and several are put back from the last one on", async () => {
  const element = await opened({ page: "7", tearable: "stapled" });
  expect(element.spread).toEqual({ left: 6, right: 7 });
  expect(await element.tearOut(6)).toBe(true);
  await settled(element);
  expect(element.spread).toEqual({ left: 4, right: 5 });
  expect(await element.tearOut(5)).toBe(true);
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([8, 2]);
  await element.putBack();
  await element.putBack();
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([12, 0]);
  expect(await element.goTo(7, { motion: false })).toBe(true);
  expect(element.spread).toEqual({ left: 6, right: 7 });
});

test("a listener keeps the leaf whole", async () => {
  const element = await opened();
  element.addEventListener("tear", (event) => event.preventDefault());
  expect(await element.tearOut(5)).toBe(false);
  await expect.poll(() => element.state, { timeout: 20_000 }).toBe("resting");
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([12, 0]);
  expect(element.spread).toEqual({ left: 4, right: 5 });
});

test("nothing is torn without the attribute, and no page that does not lie open", async () => {
  const element = await opened({ tearable: "glued" });
  expect(element.tearable).toBe("none");
  expect(await element.tearOut(5)).toBe(false);
  const pointer = await pull(element, 30);
  pointer.point("pointerup", 700, 100);
  await expect.poll(() => element.state, { timeout: 20_000 }).toBe("resting");
  expect(element.pageCount).toBe(12);
  element.tearable = "sewn";
  expect(element.tearable).toBe("sewn");
  // Of the leaves beside 4 and 5 their other pages are not in sight.
  for (const page of [9, 3, 6]) expect(await element.tearOut(page)).toBe(false);
  expect(element.pageCount).toBe(12);
});

test("what is out goes back after the page before it, or after what has that one's place", async () => {
  const element = await opened();
  expect(await element.tearOut(5)).toBe(true);
  expect(await element.removePages(4)).toBe(true);
  expect([element.tornLeaves, element.pageCount]).toEqual([1, 9]);
  expect(await element.putBack()).toBe(true);
  expect([element.page, element.pageCount]).toEqual([4, 11]);
});

test("a loose sheet is moved and comes to rest in a book whose pages are folded after it was torn", async () => {
  const element = await opened();
  expect(await element.tearOut(5)).toBe(true);
  await settled(element);
  expect(await element.dogEar(5, "foot", 0.2)).toBe(true);
  expect(await element.crumple()).toBe(true);
  await settled(element);
  expect(element.dogEars).toEqual([{ page: 5, corner: "foot", size: 0.2 }]);
});

test("a page with a folded corner is torn out as it is, crumpled, and put back folded", async () => {
  const element = await opened();
  expect(await element.dogEar(5, "head", 0.3)).toBe(true);
  await settled(element);
  const dogEars = [{ page: 5, corner: "head", size: 0.3 }];
  expect(element.dogEars).toEqual(dogEars);
  const clock = await tearOutByClock(element);
  expect([element.pageCount, element.dogEars]).toEqual([10, []]);
  expect(besideBook(element)).toBeGreaterThan(0.2);
  expect(element.wholeSheet).toBe("folded");
  expect(element.tearAcross({ x: 0, y: 0.5 }, { x: 1, y: 0.5 })).toBe(false);
  expect(element.crumple()).toBe(true);
  expect(element.wholeSheet).toBeNull();
  await clock.until(() => element.settled);
  expect(await element.putBack()).toBe(true);
  await clock.until(() => element.settled);
  expect([element.pageCount, element.dogEars]).toEqual([12, dogEars]);
});

test("a book whose folded leaf is torn out, or put back, is bound with the folds that its pages have then", async () => {
  const bound: number[][] = [];
  const { another } = CreasableBook.prototype;
  vi.spyOn(CreasableBook.prototype, "another").mockImplementation(function (
    this: CreasableBook,
    size,
  ) {
    const engine = another.call(this, size);
    const creased: number[] = [];
    bound.push(creased);
    const { creases } = engine;
    const crease = creases?.crease;
    if (creases && crease) {
      Object.assign(creases, {
        crease: (...of: Parameters<typeof crease>) => {
          creased.push(of[0]);
          return crease(...of);
        },
      });
    }
    return engine;
  });
  const element = await opened();
  expect(await element.dogEar(5, "head", 0.3)).toBe(true);
  await settled(element);
  const clock = await tearOutByClock(element);
  expect(bound.at(-1)).toEqual([]);
  const before = bound.length;
  expect(await element.putBack()).toBe(true);
  await clock.until(() => element.settled);
  expect(bound.slice(before).map((leaves) => leaves[0])).toEqual([2]);
});

test("a book keeps its last leaf", async () => {
  const element = await opened({ page: "1" }, 2);
  expect(await element.tearOut(1)).toBe(false);
  await expect.poll(() => element.state, { timeout: 20_000 }).toBe("resting");
  expect(element.pageCount).toBe(2);
});

test("a pointer tears a leaf out, carries it, lays it down and takes it again", async () => {
  const element = await opened();
  const torn = happens<{ pages: number[] }>(element, "torn");
  const pointer = await pull(element, 30);
  expect((await torn).pages).toEqual([5, 6]);
  expect(element.spread).toEqual({ left: 4, right: 5 });
  // Carried to the table at the right.
  pointer.point("pointermove", 690, 120, { buttons: 1 });
  await new Promise((resolve) => setTimeout(resolve, 300));
  pointer.point("pointerup", 690, 120);
  await settled(element);
  expect(element.state).toBe("resting");
  await expect.poll(() => besideBook(element), { timeout: 20_000 }).toBeGreaterThan(0.1);
  // Taken again it is no turn of a page, however it is flicked.
  const turns: Event[] = [];
  element.addEventListener("turnstart", (event) => turns.push(event));
  pointer.point("pointerdown", 660, 160);
  pointer.flick([660, 160], [1500, 160], { buttons: 1 });
  await new Promise((resolve) => setTimeout(resolve, 400));
  pointer.point("pointerup", 1500, 160);
  // Out of sight it is thrown away; its pages can still be put back.
  await expect.poll(() => besideBook(element), { timeout: 20_000 }).toBe(0);
  expect(turns).toEqual([]);
  expect(element.tornLeaves).toBe(1);
  expect(await element.putBack()).toBe(true);
  expect(element.pageCount).toBe(12);
});

test("a leaf that was pulled a little falls back whole", async () => {
  const element = await opened({ tearable: "sewn" });
  const heard: Event[] = [];
  element.addEventListener("tear", (event) => heard.push(event));
  const pointer = await pull(element, 8, 1);
  pointer.point("pointerup", 500, 60);
  await expect.poll(() => element.state, { timeout: 20_000 }).toBe("resting");
  await settled(element);
  expect([heard.length, element.pageCount]).toEqual([0, 12]);
  expect(await element.next()).toBe(true);
});

/** Returns what is drawn while a leaf that was pulled taut first is held over the spine, in grey. */
async function heldOverSpine(tearable: string): Promise<Uint8ClampedArray> {
  const element = await opened({ tearable });
  const pointer = await pull(element, 10, 2);
  const { left, right, top } = element.bookBounds as DOMRect;
  const [from, to] = [right, (left + right) / 2];
  for (let k = 1; k <= 20; k++) {
    pointer.point("pointermove", from + ((to - from) * k) / 20, top + 10 + 2 * k, { buttons: 1 });
    await new Promise((resolve) => requestAnimationFrame(resolve));
  }
  await expect.poll(() => element.settled, { timeout: 20_000 }).toBe(true);
  const drawn = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [190, 80];
  const pen = copy.getContext("2d") as CanvasRenderingContext2D;
  pen.drawImage(drawn, 0, 0, copy.width, copy.height);
  const grey = pen.getImageData(0, 0, copy.width, copy.height).data.filter((_, k) => k % 4 === 0);
  pointer.point("pointerup", to, top + 50);
  element.remove();
  return grey;
}

test("a leaf that was pulled taut and taken back turns as any other", async () => {
  const plain = await heldOverSpine("none");
  const tearable = await heldOverSpine("sewn");
  const differing = plain.filter((grey, k) => Math.abs(grey - tearable[k]) > 40).length;
  expect(differing / plain.length).toBeLessThan(0.01);
});

test("a listener is asked again where nothing gave way before", async () => {
  const element = await opened();
  const asked: Event[] = [];
  element.addEventListener("tear", (event) => {
    asked.push(event);
    event.preventDefault();
  });
  const pointer = await pull(element, 10, 2);
  pointer.point("pointerup", 500, 60);
  await expect.poll(() => element.state, { timeout: 20_000 }).toBe("resting");
  expect(await element.tearOut(5)).toBe(false);
  expect(asked).toHaveLength(1);
});

test("a loose sheet is crumpled by command, once, and its pages are put back whole", async () => {
  const element = await opened();
  expect(element.crumple()).toBe(false);
  const clock = await tearOutByClock(element);
  const flat = besideBook(element);
  expect(element.crumple()).toBe(true);
  expect(element.crumple()).toBe(false);
  await clock.until(() => element.settled);
  vi.restoreAllMocks();
  // A ball of a little less than half of the width covers a fifth of the sheet.
  expect(besideBook(element)).toBeLessThan(0.5 * flat);
  expect(besideBook(element)).toBeGreaterThan(0.05 * flat);
  expect(await element.putBack()).toBe(true);
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([12, 0]);
  await expect.poll(() => besideBook(element)).toBe(0);
});

test("a double tap crumples a loose sheet", async () => {
  const element = await opened();
  await element.tearOut(5);
  await settled(element);
  await expect.poll(() => besideBook(element), { timeout: 20_000 }).toBeGreaterThan(0.2);
  const flat = besideBook(element);
  const pointer = new TestPointer(element);
  const x = (element.bookBounds as DOMRect).right + 60;
  for (let tap = 0; tap < 2; tap++) {
    pointer.point("pointerdown", x, 160);
    pointer.point("pointerup", x, 160);
  }
  await expect.poll(() => besideBook(element), { timeout: 20_000 }).toBeLessThan(0.5 * flat);
  expect([element.zoom, element.tornLeaves]).toEqual([1, 1]);
});

test("the leaf beside a board is not torn out in the board's place", async () => {
  const element = await opened({ cover: "hard", page: "2" });
  expect(element.page).toBe(2);
  expect(await element.tearOut(2)).toBe(false);
  expect([element.page, element.pageCount]).toEqual([2, 12]);
});

test("a soft cover stays, and so no other leaf becomes one", async () => {
  const element = await opened({ cover: "soft", page: "1" });
  expect(await element.tearOut(1)).toBe(false);
  const pointer = await pull(element, 40);
  pointer.point("pointerup", 700, 20);
  await expect.poll(() => element.settled, { timeout: 20_000 }).toBe(true);
  expect([element.tornLeaves, element.pageCount]).toEqual([0, 12]);
});

test("a leaf torn off while the one before it turns leaves the book open behind both", async () => {
  const element = await opened({ page: "3", duration: "2000" });
  const pages: number[] = [];
  element.addEventListener("pagechange", ({ detail }) => pages.push(detail.to));
  const clock = new TestClock();
  void element.next();
  // It is over the left page, and not yet down.
  clock.frames(80);
  const pointer = new TestPointer(element);
  const { right, top } = element.bookBounds as DOMRect;
  pointer.point("pointerdown", right - 6, top + 8);
  for (let k = 1; element.tornLeaves === 0 && k <= 60; k++) {
    pointer.point("pointermove", right - 6 + 8 * k, top + 8, { buttons: 1 });
    clock.frames(1);
  }
  pointer.point("pointerup", 0, 0);
  await clock.until(() => element.settled);
  vi.restoreAllMocks();
  // Pages 5 and 6 are out: beside 4 lies what was 7.
  const { pageCount, spread } = element;
  expect([pageCount, spread, pages]).toEqual([10, { left: 4, right: 5 }, [4]]);
});

test("a leaf whose corner is lifted under a mouse is torn out by command", async () => {
  const element = await opened();
  const pointer = new TestPointer(element);
  const { right, top } = element.bookBounds as DOMRect;
  const clock = new TestClock();
  pointer.point("pointermove", right - 5, top + 5);
  clock.frames(6);
  expect(element.state).toBe("lifting");
  const torn = element.tearOut(5);
  await clock.until(() => element.tornLeaves === 1 || element.settled);
  await clock.until(() => element.settled);
  vi.restoreAllMocks();
  expect([await torn, element.pageCount]).toEqual([true, 10]);
});

test("in a book of single pages a page is torn out by its outer edge, and elsewhere the one before it comes back", async () => {
  const element = await opened({ layout: "single" });
  expect(element.spread).toEqual({ left: null, right: 5 });
  const { left, right, top } = element.bookBounds as DOMRect;
  const clock = new TestClock();
  const pointer = new TestPointer(element);
  /** Pulls from a place at the head of the page outward. */
  const pullFrom = (x: number): void => {
    pointer.point("pointerdown", x, top + 8);
    for (let k = 1; element.tornLeaves === 0 && k <= 60; k++) {
      pointer.point("pointermove", x + 6 * k, top + 8 - 1.8 * k, { buttons: 1 });
      clock.frames(1);
    }
  };
  pullFrom((left + right) / 2);
  pointer.wait(1000);
  expect([element.tornLeaves, element.state]).toEqual([0, "dragged"]);
  pointer.point("pointerup", 0, 0);
  await clock.until(() => element.settled);
  expect([element.page, element.pageCount]).toEqual([4, 12]);
  pullFrom(right - 6);
  pointer.point("pointerup", 0, 0);
  await clock.until(() => element.settled);
  expect([element.tornLeaves, element.pageCount]).toEqual([1, 11]);
});

test("a loose sheet is torn across by command; both pieces stay, and its pages are put back whole", async () => {
  const element = await opened();
  const [from, to] = [
    { x: 0, y: 0.5 },
    { x: 1, y: 0.45 },
  ];
  expect(element.tearAcross(from, to)).toBe(false);
  const clock = await tearOutByClock(element);
  const whole = besideBook(element);
  // Along an edge, off the page, nowhere.
  expect(element.tearAcross(from, { x: 0, y: 0.9 })).toBe(false);
  expect(element.tearAcross(from, { x: 1.2, y: 0.5 })).toBe(false);
  expect(element.tearAcross(from, { x: Number.NaN, y: 0.5 })).toBe(false);
  expect(element.tearAcross(from, to)).toBe(true);
  // One that is torn is not torn again, nor crumpled.
  expect(element.tearAcross(from, to)).toBe(false);
  expect(element.crumple()).toBe(false);
  await clock.until(() => element.settled);
  vi.restoreAllMocks();
  expect(Math.abs(besideBook(element) / whole - 1)).toBeLessThan(0.1);
  expect([element.pageCount, element.tornLeaves]).toEqual([10, 1]);
  expect(await element.putBack()).toBe(true);
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([12, 0]);
  await expect.poll(() => besideBook(element)).toBe(0);
});

// It draws some hundreds of frames, which takes software half a minute on a quiet machine.
test("two fingers that pull a loose sheet apart tear it, and each carries its piece", async () => {
  const element = await opened();
  const clock = await tearOutByClock(element);
  expect(besideBook(element)).toBeGreaterThan(0.2);
  const pointer = new TestPointer(element);
  const finger = (pointerId: number, name: string, y: number) =>
    pointer.point(name, x, y, { pointerId, pointerType: "touch", buttons: 1 });
  const x = (element.bookBounds as DOMRect).right + 60;
  finger(1, "pointerdown", 110);
  finger(2, "pointerdown", 200);
  // A second out, and held there until it is torn through.
  for (let k = 1; k <= 150; k++) {
    const away = Math.min(4 * k, 240);
    finger(1, "pointermove", 110 - away);
    finger(2, "pointermove", 200 + away);
    clock.frames(1);
  }
  for (const [id, y] of [
    [1, 60],
    [2, 260],
  ] as const) {
    finger(id, "pointermove", y);
  }
  const atRest = () => clock.until(() => element.settled);
  await atRest();
  finger(1, "pointerup", 60);
  await atRest();
  const both = besideBook(element);
  // The other is still held; thrown out of sight it goes alone.
  finger(2, "pointermove", 1500);
  clock.frames(24);
  finger(2, "pointerup", 1500);
  await atRest();
  vi.restoreAllMocks();
  expect(besideBook(element)).toBeLessThan(0.75 * both);
  expect(element.zoom).toBe(1);
  expect(besideBook(element)).toBeGreaterThan(0.02);
  expect(await element.putBack()).toBe(true);
  expect(element.pageCount).toBe(12);
}, 120_000);

/** Area of a surface in space, m^2. */
function areaOf({ positions, columns, rows, creased }: Surface): number {
  const triangles: number[] = [...(creased?.triangles ?? [])];
  for (let row = 0; !creased && row + 1 < rows; row++) {
    for (let column = 0; column + 1 < columns; column++) {
      const here = row * columns + column;
      triangles.push(here, here + 1, here + columns);
      triangles.push(here + columns + 1, here + columns, here + 1);
    }
  }
  let area = 0;
  for (let k = 0; k < triangles.length; k += 3) {
    const [a, b, c] = triangles.slice(k, k + 3).map((point) => 3 * point);
    const [p, q] = [b, c].map((to) =>
      [0, 1, 2].map((axis) => positions[to + axis] - positions[a + axis]),
    );
    const across = [1, 2, 0].map((i, k) => p[i] * q[[2, 0, 1][k]] - p[[2, 0, 1][k]] * q[i]);
    area += Math.hypot(...across) / 2;
  }
  return area;
}

/** Returns u and v of the places on the rim along which a piece is torn, from where the tear began, and its length, metres. */
function tornRim({ creased }: Surface): { readonly places: UV[]; readonly long: number } {
  const { places, tears = new Float32Array() } = creased as CreasedMesh;
  const points = [...Array(places.length / 2).keys()].filter((point) => tears[3 * point] < 0);
  points.sort((a, b) => tears[3 * a + 1] - tears[3 * b + 1]);
  return {
    places: points.map((point) => [places[2 * point], places[2 * point + 1]]),
    long: Math.max(...points.map((point) => tears[3 * point + 1])),
  };
}

/**
 * Has two fingers take a loose sheet above and below the middle of its edge, and pull it apart until
 * it is torn through, along a way that swings by an angle meanwhile. Returns the drawn sheet
 * before and both pieces after that.
 */
async function tornBySwing(swing: number): Promise<{ whole: number; pieces: Surface[] }> {
  const element = await opened();
  const add = vi.spyOn(LooseSheetPile.prototype, "add");
  const clock = await tearOutByClock(element);
  const pile = add.mock.contexts[0] as LooseSheetPile;
  const whole = areaOf(pile.surfaces[0]);
  const pointer = new TestPointer(element);
  const finger = (pointerId: number, name: string, x: number, y: number) =>
    pointer.point(name, x, y, { pointerId, pointerType: "touch", buttons: 1 });
  const [x, y] = [(element.bookBounds as DOMRect).right + 50, 160];
  finger(1, "pointerdown", x, y - 40);
  finger(2, "pointerdown", x, y + 40);
  for (let k = 1; k <= 90; k++) {
    const away = 40 + Math.min(4 * k, 240);
    const angle = swing * Math.min(k / 45, 1);
    const [dx, dy] = [away * Math.sin(angle), away * Math.cos(angle)];
    finger(1, "pointermove", x + dx, y - dy);
    finger(2, "pointermove", x - dx, y + dy);
    clock.frames(1);
  }
  expect(pile.surfaces).toHaveLength(2);
  // Carried back from out of sight, and put down beside each other.
  for (let k = 1; k <= 60; k++) {
    const away = 280 - Math.min(4 * k, 220);
    finger(1, "pointermove", x, y - away);
    finger(2, "pointermove", x, y + away);
    clock.frames(1);
  }
  finger(1, "pointerup", x, y - 60);
  finger(2, "pointerup", x, y + 60);
  await clock.until(() => element.settled);
  const pieces = pile.surfaces.map((one) => ({ ...one, positions: one.positions.slice() }));
  vi.restoreAllMocks();
  expect([element.pageCount, element.tornLeaves]).toEqual([10, 1]);
  return { whole, pieces };
}

test.for([40, -40])(
  "two fingers that swing by %d degrees tear a loose sheet along a bend",
  async (degrees) => {
    const { whole, pieces } = await tornBySwing((degrees * Math.PI) / 180);
    const [foot, head] = pieces.map(tornRim);
    // Each is drawn a millimetre beyond the line, where its picture ends.
    const sum = areaOf(pieces[0]) + areaOf(pieces[1]) - 0.001 * (foot.long + head.long);
    expect(Math.abs(sum / whole - 1)).toBeLessThan(0.005);
    // It begins at the edge on the left and turns as the fingers do: clockwise, to the foot.
    const [from, to] = [foot.places[0], foot.places[foot.places.length - 1]];
    expect(from[0]).toBe(0);
    expect(Math.sign(degrees) * (from[1] - to[1])).toBeGreaterThan(0.05);
  },
);

/** Returns the height of a surface's highest point within 4 mm of a place in plan, metres. */
function heightAt({ positions }: Surface, [x, y]: readonly [number, number]): number {
  let highest = -Infinity;
  for (let at = 0; at < positions.length; at += 3) {
    const isNear = Math.hypot(positions[at] - x, positions[at + 1] - y) < 0.004;
    if (isNear) highest = Math.max(highest, positions[at + 2]);
  }
  return highest;
}

test("a loose sheet lies upon the one before it, and comes down when that is taken away", async () => {
  const element = await opened();
  const add = vi.spyOn(LooseSheetPile.prototype, "add");
  const clock = await tearOutByClock(element);
  const pile = add.mock.contexts[0] as LooseSheetPile;
  const torn = element.tearOut(5);
  await clock.until(() => element.tornLeaves === 2 && element.settled);
  expect(await torn).toBe(true);
  const heights = (): number[] => {
    const [first, second] = pile.surfaces;
    const middle = 3 * ((second.rows >> 1) * second.columns + (second.columns >> 1));
    const at = [second.positions[middle], second.positions[middle + 1]] as const;
    return [heightAt(first, at), heightAt(second, at)];
  };
  const [lower, upper] = heights();
  // Both were put aside, on one place: a tenth of a millimetre is what keeps them apart in a picture.
  expect(upper - lower).toBeGreaterThan(0.00005);
  expect(upper - lower).toBeLessThan(0.01);
  // Taken away, the lower one lets the other down.
  pile.remove(Number(add.mock.calls[0][0]));
  await clock.until(() => element.settled);
  const left = pile.surfaces[0].positions.filter((_, k) => k % 3 === 2);
  expect(Math.min(...left)).toBeLessThan(lower + 0.00005);
});
