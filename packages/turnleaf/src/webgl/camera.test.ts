import { expect, test } from "vitest";
import { hardcover } from "../for_tests/book_shape.ts";
import type { BookShape } from "../stage/book_pose.ts";
import { axesOf, type Framing, fitPoints, frameBook, type View, widestLens } from "./camera.ts";

const shape = hardcover;
const rim = 0.0032;
const framing = (part: Partial<Framing>): Framing => ({
  closedRight: 0,
  closedLeft: 0,
  middle: 0,
  boardEdges: [],
  flapEdge: [],
  ...part,
});

/** Returns a point's place in the picture: -1 to 1 both ways. */
function seen(view: View, aspect: number, point: [number, number, number]): [number, number] {
  const away = point.map((p, k) => p - view.position[k]);
  const dot = (axis: number[]): number => axis.reduce((sum, a, k) => sum + a * away[k], 0);
  const half = view.lens;
  const depth = -dot(view.back);
  return [dot(view.right) / (depth * half * aspect), dot(view.up) / (depth * half)];
}

const corners: [number, number, number][] = [-1, 1].flatMap((side) =>
  [-rim, shape.height + rim].flatMap((y) =>
    [0, shape.thickness / 2].map((z): [number, number, number] => [
      side * (shape.width + rim + shape.thickness / 2),
      y,
      z,
    ]),
  ),
);

test("the open book is in the picture and fills it one way, at any shape of canvas", () => {
  for (const aspect of [0.4, 0.75, 1, 1.6, 2.4, 4]) {
    const view = frameBook(shape, framing({}), aspect, rim);
    const places = corners.map((corner) => seen(view, aspect, corner));
    for (const [x, y] of places) {
      expect(Math.abs(x)).toBeLessThan(1);
      expect(Math.abs(y)).toBeLessThan(1);
    }
    const wide = Math.max(...places.map(([x]) => Math.abs(x)));
    const low = Math.min(...places.map(([, y]) => y));
    expect(Math.max(wide, -low)).toBeCloseTo(0.94, 9);
  }
});

test("an open book stands in the middle from side to side", () => {
  for (const middle of [-0.01, 0, 0.01]) {
    const view = frameBook(shape, framing({ middle }), 1.6, rim);
    expect(view.position[0]).toBeCloseTo(middle, 9);
  }
});

/** Returns how far a point is from the middle of the picture: 1 at its edge. */
const outward = (view: View, aspect: number, point: [number, number, number]): number =>
  Math.max(...seen(view, aspect, point).map(Math.abs));

test("a leaf that swings stays in the picture, and so does a board, at any shape of canvas and of leaf", () => {
  for (const height of [0.09, 0.13, 0.2]) {
    for (const aspect of [0.4, 1, 1.6, 2.4]) {
      for (const tilt of [0, 5, 12]) {
        const of: BookShape = { ...shape, height, tilt };
        for (let k = 0; k <= 12; k++) {
          const angle = (k * Math.PI) / 12;
          const edge = (reach: number) =>
            [reach * Math.cos(angle), reach * Math.sin(angle)] as const;
          const [x, z] = edge(0.96 * shape.width);
          const view = frameBook(of, framing({}), aspect, rim);
          for (const y of [0, height])
            expect(outward(view, aspect, [x, y, z])).toBeLessThan(1 + 1e-9);
          const [u, w] = edge(shape.width + rim);
          const opening = frameBook(of, framing({ boardEdges: [u, w] }), aspect, rim);
          for (const y of [-rim, height + rim]) {
            expect(outward(opening, aspect, [u, y, w])).toBeLessThan(1 + 1e-9);
          }
        }
      }
    }
  }
});

test("a book fills 0.94 of the height or of the width of a window, whole or one page of it", () => {
  const paperback: Partial<BookShape> = { width: 0.138, height: 0.213, thickness: 0.012 };
  for (const [width, height] of [
    [1280, 800],
    [1920, 1080],
    [820, 1180],
    [390, 844],
  ]) {
    for (const cover of ["hard", "none"] as const) {
      for (const alone of [0, 1, -1] as const) {
        const of: BookShape = {
          ...shape,
          ...paperback,
          cover,
          rim: cover === "hard" ? rim : 0,
          alone,
        };
        const aspect = width / height;
        const view = frameBook(of, framing({}), aspect, of.rim);
        const far = of.width + of.rim + (alone === 0 ? of.thickness / 2 : 0);
        const [from, to] = alone === 0 ? [-far, far] : [0, alone * far];
        const high = alone === 0 ? of.thickness / 2 : of.thickness;
        const [x0, y0] = seen(view, aspect, [from, -of.rim, high]);
        const [x1, y1] = seen(view, aspect, [to, of.height + of.rim, high]);
        const most = Math.max(Math.abs(x1 - x0), Math.abs(y1 - y0)) / 2;
        expect(most).toBeCloseTo(0.94, 9);
      }
    }
  }
});

test("an open book is seen from right above, and leans back as far as it is tilted", () => {
  expect(frameBook(shape, framing({}), 1.6, rim).back).toEqual([0, expect.closeTo(0), 1]);
  const { back } = frameBook({ ...shape, tilt: 12 }, framing({}), 1.6, rim);
  expect(Math.atan2(-back[1], back[2])).toBeCloseTo((12 * Math.PI) / 180, 9);
});

test("a closed book leans only if it has boards and is not seen from overhead", () => {
  const lean = (of: Partial<BookShape>) =>
    frameBook({ ...shape, ...of }, framing({ closedRight: 1 }), 1.6, rim).back[2];
  expect(lean({})).toBeLessThan(0.99);
  expect(lean({ cover: "none" })).toBeCloseTo(1, 12);
  expect(lean({ fromAbove: true })).toBeCloseTo(1, 12);
});

test("a closed book is in the middle of the picture", () => {
  for (const [part, sign] of [
    [{ closedRight: 1 }, 1],
    [{ closedLeft: 1 }, -1],
  ] as const) {
    const view = frameBook(shape, framing(part), 1.6, rim);
    const [x, y] = seen(view, 1.6, [(sign * shape.width) / 2, shape.height / 2, 0.01]);
    expect(Math.abs(x)).toBeLessThan(0.1);
    expect(Math.abs(y)).toBeLessThan(0.15);
  }
});

test("both closed sides mirror each other", () => {
  const right = frameBook(shape, framing({ closedRight: 0.7 }), 1.3, rim);
  const left = frameBook(shape, framing({ closedLeft: 0.7 }), 1.3, rim);
  expect(left.position[0]).toBeCloseTo(-right.position[0], 9);
  expect(left.position[1]).toBeCloseTo(right.position[1], 9);
  expect(left.position[2]).toBeCloseTo(right.position[2], 9);
});

test("nothing jumps while a board swings", () => {
  let before: View | undefined;
  for (let k = 0; k <= 1000; k++) {
    const closedRight = k / 1000;
    const angle = Math.PI * (1 - closedRight);
    const boardEdges = [0.127 * Math.cos(angle), 0.127 * Math.sin(angle)];
    const view = frameBook(shape, framing({ closedRight, boardEdges }), 1.6, rim);
    if (before) {
      const step = Math.hypot(...view.position.map((p, i) => p - before!.position[i]));
      // Of its distance.
      expect(step / view.distance).toBeLessThan(0.004);
    }
    before = view;
  }
});

test("the fit touches its bounds and passes none", () => {
  const axes = axesOf(1.2, 0.3);
  const points = [0, 0, 0, 0.3, 0.1, 0.02, -0.1, 0.25, 0.1, 0.05, -0.2, 0];
  const groups = [
    { points: points.slice(0, 6), margin: 0.05 },
    { points: points.slice(6), margin: 0.02 },
  ];
  const [across, along, distance] = fitPoints(groups, axes, 1.5, widestLens);
  const position = [0, 1, 2].map(
    (k) => axes.right[k] * across + axes.up[k] * along + axes.back[k] * distance,
  ) as [number, number, number];
  const view: View = { position, ...axes, distance, lens: widestLens };
  const room: number[] = [];
  for (let k = 0; k < points.length; k += 3) {
    const [x, y] = seen(view, 1.5, [points[k], points[k + 1], points[k + 2]]);
    const free = k < 6 ? 0.9 : 0.96;
    room.push(free - Math.abs(x), free - Math.abs(y));
  }
  expect(Math.min(...room)).toBeCloseTo(0, 9);
});

test("from overhead the closed book is seen as the open one is, its edges upright", () => {
  const above = { ...shape, fromAbove: true };
  const open = frameBook(above, framing({}), 1.6, rim);
  for (const closed of [{ closedRight: 1 }, { closedLeft: 0.4 }]) {
    expect(frameBook(above, framing(closed), 1.6, rim)).toEqual(open);
  }
  expect(open.back).toEqual([0, expect.closeTo(0), 1]);
});
