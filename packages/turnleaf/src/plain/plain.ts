/** A book on the flat: leaves that are peeled, drawn with a 2D canvas. Loaded where a book in space cannot be had. */

import type { Craft } from "../viewer.ts";
import { PlainBook } from "./plain_book.ts";
import { PlainStage } from "./plain_stage.ts";

/** Needs neither WebGL nor WebAssembly. */
export const craft: Craft = {
  engine: async (size) => new PlainBook(size),
  stage: (canvas, shape) => new PlainStage(canvas, shape),
};
