/** What a flat book keeps as a picture while a leaf turns follows the pages. */

import { expect, test } from "vitest";
import { Side } from "../engine/phases.ts";
import type { BookShape } from "../stage/book_pose.ts";
import { Canvas2DStage } from "./canvas2d_stage.ts";
import { PeeledBook } from "./peeled_book.ts";

const size = { width: 0.1, height: 0.14, leaves: 10, thickness: 0.001 };

const shapeOf = (quarterTurned: boolean): BookShape => ({
  ...size,
  cover: "none",
  rim: 0,
  quarterTurned,
  alone: 0,
  cloth: "#552222",
  shadows: 1,
  fromAbove: false,
  tilt: 0,
  margin: 0.03,
  kind: "typeset",
});

/** Returns a page of one colour. */
function page(color: string): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 16;
  fill(canvas, color);
  return canvas;
}

function fill(canvas: HTMLCanvasElement, color: string): void {
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = color;
  pen.fillRect(0, 0, 16, 16);
}

/** A book of 400 x 300 pixels with a leaf half turned, its pages red, green, blue and yellow. */
function turned(quarterTurned = false) {
  const canvas = document.createElement("canvas");
  const stage = new Canvas2DStage(canvas, shapeOf(quarterTurned));
  stage.resize(400, 300, 1);
  const book = new PeeledBook(size);
  book.lay(5);
  const id = book.pickUp(Side.right, 5, 6);
  book.grab(id, 0, 1, 0.4);
  book.hold(id, 0, 0.05, 0.05);
  for (let k = 0; k < 120; k++) book.stepFrame(1);
  const pages = {
    left: page("red"),
    right: page("lime"),
    recto: page("blue"),
    verso: page("yellow"),
  };
  stage.setFace("left", pages.left);
  stage.setFace("right", pages.right);
  stage.setLeaf(0, "recto", pages.recto);
  stage.setLeaf(0, "verso", pages.verso);
  const [left, right] = [book.pile(Side.left), book.pile(Side.right)];
  const closed = { lean: 0, frontBoard: Math.PI, backBoard: 0 };
  stage.pose({ left, right, leaves: [book.surface(0)], ...closed });
  /** Returns the colour at a place of the pages, metres: red, green, blue, each 0 to 255. */
  const seen = (x: number, y: number): number[] => {
    const at = stage.project([x, y, 0]);
    const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
    return [...pen.getImageData(at.x, at.y, 1, 1).data.slice(0, 3)];
  };
  return { canvas, stage, pages, seen };
}

/** Whether a colour is that of a page in shade and light: its strong parts far above its weak ones. */
const isLike = (strong: readonly number[]) => (colour: number[]) => {
  const of = (wanted: boolean) => colour.filter((_, k) => strong.includes(k) === wanted);
  return Math.min(...of(true)) - Math.max(...of(false)) > 80;
};
const [isRed, isGreen, isBlue, isYellow] = [[0], [1], [2], [0, 1]].map(isLike);

test.each([false, true])(
  "a frame in motion is that at rest, pixel for pixel but where the leaf is folded over (spine across: %s)",
  (quarterTurned) => {
    const { canvas, stage, seen } = turned(quarterTurned);
    const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
    const pixels = () => pen.getImageData(0, 0, canvas.width, canvas.height).data;
    stage.draw({ resting: true });
    const resting = pixels();
    stage.draw();
    const moving = pixels();
    expect(canvas.width).toBe(400);
    expect(isRed(seen(-0.08, 0.13))).toBe(true);
    expect(isGreen(seen(0.092, 0.02))).toBe(true);
    expect(isBlue(seen(0.02, 0.13))).toBe(true);
    expect(isYellow(seen(0.066, 0.05))).toBe(true);
    const apart = moving.filter((value, k) => Math.abs(value - resting[k]) > 2).length;
    // Its edges alone, which are smoothed otherwise.
    expect(apart / moving.length).toBeLessThan(0.01);
  },
);

test("a page that changes while a leaf is in flight is seen at once", () => {
  const { stage, pages, seen } = turned();
  stage.draw();
  expect(isRed(seen(-0.08, 0.13))).toBe(true);
  stage.setFace("left", page("blue"));
  stage.setLeaf(0, "verso", page("lime"));
  stage.draw();
  expect(isBlue(seen(-0.08, 0.13))).toBe(true);
  expect(isGreen(seen(0.066, 0.05))).toBe(true);
  // A canvas that is drawn on stays the same object.
  fill(pages.right, "red");
  fill(pages.recto, "lime");
  stage.refresh();
  stage.draw();
  expect(isRed(seen(0.092, 0.02))).toBe(true);
  expect(isGreen(seen(0.02, 0.13))).toBe(true);
});

test("a leaf whose page has no picture any more is blank", () => {
  const { stage, seen } = turned();
  stage.draw();
  stage.setLeaf(0, "recto", null);
  stage.draw();
  const [red, green, blue] = seen(0.02, 0.13);
  expect(Math.min(red, green, blue)).toBeGreaterThan(150);
});
