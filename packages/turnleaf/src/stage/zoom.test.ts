import { expect, test } from "vitest";
import { hardcover } from "../for_tests/book_shape.ts";
import { type Framing, sightOf } from "../webgl/camera.ts";
import { type CanvasFraction, overheadAt, ZoomState, zoomBetween } from "./zoom.ts";

const shape = hardcover;

function zoomingOver(framing: Partial<Framing> = {}, aspect = 1.6) {
  const whole = {
    closedRight: 0,
    closedLeft: 0,
    middle: 0,
    boardEdges: [],
    flapEdge: [],
    room: 0.5,
    ...framing,
  };
  const sightAt = (level: number) => sightOf(shape, whole, aspect, 0.0032, level);
  const zooming = new ZoomState(sightAt);
  /** Returns where a point is on the canvas. */
  const seen = (x: number, y: number): CanvasFraction => {
    const { level } = zooming.zoom;
    const middle = zooming.show(zooming.zoom);
    const [sx, sy] = sightAt(level).seen(x, y);
    return [(sx - middle[0]) * level + 0.5, (sy - middle[1]) * level + 0.5];
  };
  /** Returns the point at a place on the canvas. */
  const pointAt = ([x, y]: CanvasFraction): CanvasFraction => {
    const { level } = zooming.zoom;
    const middle = zooming.show(zooming.zoom);
    return sightAt(level).point([middle[0] + (x - 0.5) / level, middle[1] + (y - 0.5) / level]);
  };
  return { zooming, seen, pointAt, sightAt };
}

test("at level 1 the whole picture is shown, wherever it was pushed", () => {
  for (const aspect of [0.5, 1.6]) {
    for (const framing of [{}, { closedRight: 1 }, { closedLeft: 0.4 }]) {
      const { zooming } = zoomingOver(framing, aspect);
      const [x, y] = zooming.show({ level: 1, x: 0.3, y: -2 });
      expect(x).toBeCloseTo(0.5, 12);
      expect(y).toBeCloseTo(0.5, 12);
    }
  }
});

test("what is under the pointer stays there, from any level to any other", () => {
  const at: CanvasFraction = [0.62, 0.45];
  for (const levels of [
    [1, 4],
    [1, 2.2, 8],
    [8, 5, 3.2],
  ]) {
    const { zooming, seen, pointAt } = zoomingOver();
    zooming.show({ level: levels[0], x: 0.03, y: 0.11 });
    for (const level of levels.slice(1)) {
      const [x, y] = pointAt(at);
      zooming.show(zooming.zoomed(level, at, at));
      expect(zooming.zoom.level).toBe(level);
      const now = seen(x, y);
      expect(now[0]).toBeCloseTo(at[0], 6);
      expect(now[1]).toBeCloseTo(at[1], 6);
    }
  }
});

test("a pan moves what is seen with the finger, and ends at the book's edge", () => {
  const { zooming, seen, pointAt } = zoomingOver();
  zooming.show({ level: 4, x: 0.03, y: 0.1 });
  const [x, y] = pointAt([0.5, 0.5]);
  zooming.show(zooming.zoomed(4, [0.5, 0.5], [0.6, 0.4]));
  expect(seen(x, y)[0]).toBeCloseTo(0.6, 9);
  expect(seen(x, y)[1]).toBeCloseTo(0.4, 9);
  for (const way of [
    [1, 0],
    [-1, 0],
    [0, 1],
    [0, -1],
  ] as const) {
    for (let k = 0; k < 40; k++) {
      zooming.show(zooming.zoomed(4, [0.5, 0.5], [0.5 + 0.5 * way[0], 0.5 + 0.5 * way[1]]));
    }
    // The book's edge is on the canvas, near its rim: no farther in than the margin.
    const edges = [seen(-0.14, 0.1)[0], seen(0.14, 0.1)[0], seen(0, 0)[1], seen(0, 0.2)[1]];
    const edge =
      way[0] === 1 ? edges[0] : way[0] === -1 ? edges[1] : way[1] === 1 ? edges[3] : edges[2];
    const inside = way[0] + way[1] === 1 ? edge : 1 - edge;
    expect(inside).toBeGreaterThan(-0.05);
    expect(inside).toBeLessThan(0.15);
  }
});

test("the way between two zooms ends exactly at the second", () => {
  const to = { level: 1, x: 0, y: 0.1 };
  for (let level = 1.01; level < 8; level *= 1.03) {
    expect(zoomBetween({ level, x: 0.03, y: 0 }, to, 1)).toEqual(to);
  }
});

test("where the book does not fill the canvas it stands in its middle", () => {
  const { zooming, seen } = zoomingOver({}, 0.5);
  zooming.show({ level: 1.7, x: 0, y: 5 });
  const [top, bottom] = [seen(0, 0.2032)[1], seen(0, -0.0032)[1]];
  expect(top).toBeGreaterThan(0);
  expect(top + bottom).toBeCloseTo(1, 6);
});

test("the book is seen from right over it before it is twice as large", () => {
  expect(overheadAt(1)).toBe(0);
  expect(overheadAt(2)).toBe(1);
  expect(overheadAt(8)).toBe(1);
  const { sightAt } = zoomingOver();
  const sight = sightAt(2);
  const [a, b] = [sight.seen(0.1, 0), sight.seen(0.1, 0.2)];
  const [c, d] = [sight.seen(0.02, 0.1), sight.seen(0.12, 0.1)];
  // Straight, and as wide as high: 0.2 m along, 0.1 m across on a canvas 1.6 times as wide as high.
  expect(a[0]).toBeCloseTo(b[0], 9);
  expect((a[1] - b[1]) / 2).toBeCloseTo((d[0] - c[0]) * 1.6, 9);
});

test("on the way between two zooms, what both show in one place stays there", () => {
  const { zooming, pointAt } = zoomingOver();
  const at: CanvasFraction = [0.7, 0.3];
  zooming.show({ level: 2, x: 0.02, y: 0.1 });
  const from = zooming.zoom;
  const [x, y] = pointAt(at);
  const to = zooming.zoomed(6, at, at);
  for (const fraction of [0, 0.3, 0.7, 1]) {
    zooming.show(zoomBetween(from, to, fraction));
    const [px, py] = pointAt(at);
    expect(px).toBeCloseTo(x, 6);
    expect(py).toBeCloseTo(y, 6);
  }
  expect(zoomBetween(from, { ...from, x: 0.04 }, 0.5).x).toBeCloseTo((from.x + 0.04) / 2, 9);
});
