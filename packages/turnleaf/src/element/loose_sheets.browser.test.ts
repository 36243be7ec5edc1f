/** Loose sheets, torn out of a book: crumpled, torn across, and lying upon each other. */

import { afterEach, expect, test, vi } from "vitest";
import type { TurnleafBook } from "../element.ts";
import type { UV } from "../engine/book_engine.ts";
import { meanTornDepth } from "../engine/part_outlines.ts";
import type { PaperMesh, Surface, Vec3 } from "../engine/shapes.ts";
import { clock } from "../for_tests/clock.ts";
import { tearableBook, tearOutPage5 } from "../for_tests/tearable_books.ts";
import { TestPointer } from "../for_tests/test_pointer.ts";
import { LooseSheetPile } from "../viewer/loose_sheets.ts";
import { WebGLStage } from "../webgl/webgl_stage.ts";

afterEach(() => {
  vi.restoreAllMocks();
  document.body.replaceChildren();
});

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
  const { places, tears = new Float32Array() } = creased as PaperMesh;
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
  const element = await tearableBook();
  const add = vi.spyOn(LooseSheetPile.prototype, "add");
  clock.hold();
  await tearOutPage5(element);
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
    // Each is drawn a millimetre beyond the line, about which its picture ends: at most so far off it.
    const beyond = 0.001;
    const sum = areaOf(pieces[0]) + areaOf(pieces[1]) - beyond * (foot.long + head.long);
    expect(Math.abs(sum / whole - 1)).toBeLessThan(0.005);
    expect(meanTornDepth).toBeLessThan(beyond);
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
  const element = await tearableBook();
  const add = vi.spyOn(LooseSheetPile.prototype, "add");
  clock.hold();
  await tearOutPage5(element);
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

/** Returns whether all of a sheet or a ball is seen, and the book with it, by places on the canvas. */
function areSeen(element: TurnleafBook, { positions }: Surface): boolean {
  const [stage] = vi.mocked(WebGLStage.prototype.project).mock.contexts as WebGLStage[];
  const places = [...Array(positions.length / 3).keys()].map((point) =>
    stage.project([...positions.slice(3 * point, 3 * point + 3)] as unknown as Vec3),
  );
  const { clientWidth, clientHeight } = element;
  const { left, right, top, bottom } = element.bookBounds as DOMRect;
  return (
    places.every(({ x, y }) => x > 0 && y > 0 && x < clientWidth && y < clientHeight) &&
    [left, top, clientWidth - right, clientHeight - bottom].every((room) => room > 0)
  );
}

test.for([
  [640, 400],
  [195, 422],
])(
  "what is torn out and crumpled is seen until the reader goes on, at %d by %d",
  async ([width, height]) => {
    vi.spyOn(WebGLStage.prototype, "project");
    const element = await tearableBook();
    element.style.cssText = `width: ${width}px; height: ${height}px`;
    await clock.until(() => element.ready);
    const rested = element.bookBounds as DOMRect;
    const add = vi.spyOn(LooseSheetPile.prototype, "add");
    clock.hold();
    await tearOutPage5(element);
    const pile = add.mock.contexts[0] as LooseSheetPile;
    expect(areSeen(element, pile.surfaces[0])).toBe(true);
    expect(element.crumple()).toBe(true);
    await clock.until(() => element.settled);
    expect(areSeen(element, pile.surfaces[0])).toBe(true);
    expect(element.zoom).toBe(1);
    const turned = element.next();
    await clock.until(() => element.settled);
    expect(await turned).toBe(true);
    // Read on, the book is about as large as before.
    expect((element.bookBounds as DOMRect).height).toBeGreaterThan(0.84 * rested.height);
    const back = element.putBack();
    await clock.until(() => element.settled);
    expect(await back).toBe(true);
    expect((element.bookBounds as DOMRect).height).toBeCloseTo(rested.height, 6);
  },
);
