/** A book in space: simulated paper, drawn by the graphics card. Loaded when a book opens where both are to be had. */

import { Stage } from "./draw/stage.ts";
import { EngineBook } from "./engine/engine.ts";
import type { Craft } from "./viewer.ts";

/** Paper that the engine bends and three.js draws. */
export const craft: Craft = {
  engine: (size) => EngineBook.create(size),
  stage: (canvas, shape) => new Stage(canvas, shape),
  models: () => import("./wear/wear.ts"),
};
