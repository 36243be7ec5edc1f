import { expect, test } from "vitest";
import type { BookPose, BookShape } from "../stage/book_pose.ts";
import { layOut } from "./canvas_layout.ts";

const shape: BookShape = {
  width: 0.14,
  height: 0.21,
  thickness: 0.01,
  leaves: 40,
  cover: "none",
  rim: 0,
  quarterTurned: false,
  alone: 0,
  cloth: "#6a2a26",
  shadows: 1,
  fromAbove: false,
  tilt: 0,
  margin: 0.03,
  kind: "scan",
};
const pose = (frontBoard: number): BookPose => ({
  left: null,
  right: null,
  leaves: [],
  lean: 0,
  frontBoard,
  backBoard: 0,
});

test("a closed book is in the middle, or from overhead where it lies when it is open", () => {
  const open = layOut(shape, pose(Math.PI), 800, 600);
  expect(layOut(shape, pose(0), 800, 600)).not.toEqual(open);
  expect(layOut({ ...shape, fromAbove: true }, pose(0), 800, 600)).toEqual(open);
});
