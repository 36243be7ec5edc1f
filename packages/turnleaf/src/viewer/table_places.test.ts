import { expect, test } from "vitest";
import type { Vec3 } from "../engine/shapes.ts";
import { hardcover } from "../for_tests/book_shape.ts";
import type { BookShape } from "../stage/book_pose.ts";
import { frameBook, openFraming } from "../webgl/camera.ts";
import {
  bookOnTable,
  placeAside,
  reachOf,
  seenTable,
  type TableArea,
  viewWith,
} from "./table_places.ts";

const paperback: BookShape = {
  ...hardcover,
  ...{ width: 0.138, height: 0.213, thickness: 0.024, leaves: 300 },
};

/** Returns what is seen of the table on a canvas of some size that shows a whole book. */
function seenOf(shape: BookShape, [width, height]: readonly [number, number]): TableArea {
  const view = frameBook(shape, openFraming, width / height, shape.rim);
  const seen = (point: Vec3) => {
    const away = point.map((p, k) => p - view.position[k]);
    const along = (axis: readonly number[]) => axis.reduce((sum, a, k) => sum + a * away[k], 0);
    const half = -along(view.back) * view.lens;
    const [x, y] = [along(view.right) / (half * (width / height)), along(view.up) / half];
    return { x: ((1 + x) / 2) * width, y: ((1 - y) / 2) * height };
  };
  return seenTable(shape, seen, { width, height });
}

/** Returns what of the table a view shows. */
function shownBy(
  { level, x, y }: { level: number; x: number; y: number },
  seen: TableArea,
): TableArea {
  if (level === 1) return seen;
  const [across, along] = [0, 1].map((axis) => (seen.high[axis] - seen.low[axis]) / level / 2);
  return { low: [x - across, y - along], high: [x + across, y + along] };
}

function holds(outer: TableArea, { low, high }: TableArea): boolean {
  return [0, 1].every(
    (axis) => low[axis] > outer.low[axis] - 1e-9 && high[axis] < outer.high[axis] + 1e-9,
  );
}

const stages = [
  [1280, 800],
  [1920, 1080],
  [820, 1180],
  [390, 844],
  [844, 390],
  [640, 400],
  [1040, 800],
] as const;

const books: Record<string, Partial<BookShape>> = {
  "two pages": {},
  "one page": { alone: 1 },
  "a left page": { alone: -1 },
  "bound at the top": { quarterTurned: true, width: 0.213, height: 0.138 },
  leaning: { tilt: 12 },
  "without boards": { cover: "none", rim: 0, margin: 0 },
};

test.for(Object.keys(books))(
  "sheets and balls put aside are seen whole beside the book, and stay within reach: %s",
  (name) => {
    const shape: BookShape = { ...paperback, ...books[name] };
    const { width, height, alone } = shape;
    for (const stage of stages) {
      const seen = seenOf(shape, stage);
      expect(holds(seen, bookOnTable(shape)), `${stage}`).toBe(true);
      for (const size of [[width, height] as const, [0.45 * width, 0.45 * width] as const]) {
        for (const at of [-1, 1].map((side) => [(alone || side) * 0.5 * width, height / 2])) {
          const areas: TableArea[] = [];
          for (let count = 0; count < 3; count++) {
            const area = placeAside(shape, size, areas, at, seen);
            const overlaps = [0, 1].every(
              (axis) =>
                area.low[axis] < bookOnTable(shape).high[axis] &&
                area.high[axis] > bookOnTable(shape).low[axis],
            );
            expect(overlaps).toBe(false);
            areas.push(area);
          }
          const whole = viewWith(shape, areas, seen);
          for (const one of [...areas, bookOnTable(shape)]) {
            expect(holds(shownBy(whole, seen), one), `${stage}: ${JSON.stringify(one)}`).toBe(true);
          }
          const near = areas.map((area) => reachOf(shape, area));
          const reading = viewWith(shape, near, seen);
          for (const one of [...near, bookOnTable(shape)]) {
            expect(holds(shownBy(reading, seen), one), `${stage}`).toBe(true);
          }
          // The book stays nearly as large while it is read.
          expect(reading.level).toBeGreaterThanOrEqual(0.84);
          expect(reading.level).toBeGreaterThanOrEqual(whole.level);
        }
      }
    }
  },
);

test("where there is room for what lies beside it, the book stays as it is", () => {
  const seen = seenOf(paperback, [3000, 800]);
  const area = placeAside(paperback, [paperback.width, paperback.height], [], [0.05, 0.1], seen);
  expect(area.low[0]).toBeGreaterThan(paperback.width);
  expect(viewWith(paperback, [area], seen)).toEqual({ level: 1, x: 0, y: 0 });
  expect(viewWith(paperback, [], seen).level).toBe(1);
});
