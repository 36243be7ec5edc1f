import { expect, test } from "vitest";
import type { Turning } from "../book/turning.ts";
import type { BookEngine } from "../engine/book_engine.ts";
import { decodeTurn } from "../key_frames/decode.ts";
import type { BookShape } from "../stage/book_pose.ts";
import type { ModelledBook } from "./leaf_model.ts";
import { Recording } from "./recording.ts";
import { ReplayModel } from "./replay.ts";
import shell from "./turns/shell_turn.tlkf";

const columns = Float32Array.from({ length: 9 }, (_, k) => k / 8);
const rows = 5;
const [width, height] = [0.14, 0.21];

/** Returns a book with one leaf in flight: a board at an angle, a fraction of the turn. */
function bookAt(fraction: number, from: "left" | "right") {
  const points = new Float32Array(3 * columns.length * rows);
  for (let row = 0; row < rows; row++) {
    for (const [column, u] of columns.entries()) {
      const [x, z] = [Math.cos(fraction * Math.PI), Math.sin(fraction * Math.PI)];
      points.set(
        [width * u * x, (height * row) / 4, width * u * z],
        3 * (row * columns.length + column),
      );
    }
  }
  const flight = { part: "leaf", low: 4, high: 5, from: from === "right" ? 4 : 5, grip: [1, 0] };
  const book = {
    engine: { columns, overrideSurface: () => points } as unknown as BookEngine,
    turning: { flights: [flight] } as unknown as Turning,
    shape: { width, height } as BookShape,
    peek: { flight: null },
  } satisfies ModelledBook;
  return { book, points };
}

test.for(["right", "left"] as const)(
  "a leaf from the %s is where the recording was",
  async (from) => {
    const model = await ReplayModel.ofOwn("shell");
    const bytes = Uint8Array.from(atob(shell), (c) => c.charCodeAt(0));
    const recording = new Recording(decodeTurn(bytes), "it");
    const v = Array.from({ length: rows }, (_, row) => row / 4);
    for (const fraction of [0.2, 0.5, 0.7]) {
      const { book, points } = bookAt(fraction, from);
      const wanted = new Float32Array(points.length);
      const isMirrored = from === "left";
      const leaf = { u: columns, v, width, height, isMirrored, isUpsideDown: false };
      recording.write(leaf, isMirrored ? 1 - fraction : fraction, wanted);
      const board = points.slice();
      model.show(book);
      expect(Math.max(...points.map((x, i) => Math.abs(x - wanted[i])))).toBeLessThan(1e-4);
      expect(Math.max(...points.map((x, i) => Math.abs(x - board[i])))).toBeGreaterThan(0.005);
    }
    model.close();
  },
);

test("a leaf that lies is where the sheet is", async () => {
  const model = await ReplayModel.ofOwn("sheet");
  const { book, points } = bookAt(0.002, "right");
  const board = points.slice();
  model.show(book);
  expect(points).toEqual(board);
});
