/** How a book is shown, and by what. */

import type { Paper } from "../book/paper.ts";
import type { BookEngine, BookSize } from "../engine/book_engine.ts";
import type { ModelChoice } from "../leaf_models/model_choice.ts";
import type { BookPose, BookShape } from "../stage/book_pose.ts";
import type { BookStage } from "../stage/book_stage.ts";
import type { BindingOptions } from "./bound_book.ts";
import type { LoadModels } from "./model_switch.ts";

/** What moves a book's leaves and what draws them; the two of a backend are made for each other. */
export interface Backend {
  engine(size: BookSize): Promise<BookEngine>;
  stage(canvas: HTMLCanvasElement, shape: BookShape): BookStage;
  /** Loads other models than the engine's own; left out where there are none. */
  readonly models?: LoadModels;
}

/** How a book is shown. */
export interface ViewerOptions extends Partial<BindingOptions> {
  /** What the leaves are made of, asked for when the book lies open. */
  readonly paper: () => Paper;
  /** The page (from 1) at which the book lies open first, asked for when it does. */
  readonly page: () => number;
  /** Length of a played turn, seconds, asked for likewise. */
  readonly turnSeconds: () => number;
  /** How leaves are turned, asked for likewise: as sheets where nothing is said. */
  readonly model?: () => ModelChoice;
  /** A turn begins between two spreads. */
  readonly onStart: (low: number, high: number, forward: boolean) => void;
  /** The book came to rest at a spread, and nothing more is planned. */
  readonly onRest: (from: number, to: number) => void;
  /** A page (from 1) cannot be shown, whether it lies open or not; the sentence says why. */
  readonly onFailure: (page: number, sentence: string, isOpen: boolean) => void;
  /** The sentence for a page, by its label, that takes long to draw; its label alone where nothing is said. */
  readonly slowText?: (label: string) => string;
  /** The book is seen from nearer or farther: the level that is shown, or on the way to being. */
  readonly onZoom?: (level: number) => void;
  /** A part of the viewer that the book shows without could not be loaded. */
  readonly onMissingPart?: (error: unknown) => void;
  /** The graphics card failed for good: nothing of the book is seen any more. */
  readonly onContextLost?: () => void;
  /** A frame: where the book's parts are, seconds since the one before, and whether leaves are in flight. */
  readonly onMotion?: (pose: BookPose, seconds: number, moving: boolean) => void;
  /** The book is laid out or bound in another way than before. */
  readonly onLayout?: () => void;
}

/** How a book is bound where nothing is said. */
export const defaultBinding: BindingOptions = {
  cover: "hard",
  cloth: "#6a2a26",
  binding: "auto",
  layout: "auto",
  offset: 1,
  hardPages: "",
};
