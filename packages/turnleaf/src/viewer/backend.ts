/**
 * What a viewer's leaves are moved and drawn by. It names the parts that fold and tear leaves, which
 * in turn read the viewer's options: so the options are another file.
 */

import type { BookEngine, BookSize } from "../engine/book_engine.ts";
import type { LoadModels } from "../leaf_models/model_switch.ts";
import type { BookShape } from "../stage/book_pose.ts";
import type { BookStage } from "../stage/book_stage.ts";

/** What moves a book's leaves and what draws them; the two of a backend belong together. */
export interface Backend {
  engine(size: BookSize): Promise<BookEngine>;
  stage(canvas: HTMLCanvasElement, shape: BookShape): BookStage;
  /** Makes an engine whose leaves can be creased, torn and folded out; undefined if there is none. */
  readonly creasable?: (size: BookSize) => Promise<BookEngine>;
  /** Loads what folds pages; undefined if leaves cannot be creased. */
  readonly folds?: () => Promise<typeof import("./folds.ts")>;
  /** Loads what tears leaves out; undefined if they cannot be torn. */
  readonly tearing?: () => Promise<typeof import("./tearing.ts")>;
  /** Loads models other than the engine's; undefined if there are none. */
  readonly models?: LoadModels;
}
