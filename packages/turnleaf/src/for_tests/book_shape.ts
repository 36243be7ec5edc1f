/** The shape of a book in hard covers, for tests. */

import type { BookShape } from "../stage/book_pose.ts";

/** A book of two hundred leaves, open at a spread and seen from its front. */
export const hardcover: BookShape = {
  width: 0.13,
  height: 0.2,
  thickness: 0.02,
  leaves: 200,
  cover: "hard",
  rim: 0.0032,
  cloth: "#6a2a26",
  shadows: 1,
  fromAbove: false,
  tilt: 0,
  margin: 0.03,
  kind: "typeset",
  quarterTurned: false,
  alone: 0,
};
