/** The options of a viewer. */

import type { DogEar } from "../book/dog_ears.ts";
import type { Paper } from "../book/paper.ts";
import type { ModelChoice } from "../leaf_models/model_choice.ts";
import type { BookError, NewIndex } from "../sources/page_source.ts";
import type { BookPose } from "../stage/book_pose.ts";
import type { BindingOptions } from "./bound_book.ts";
import type { TakenPages } from "./moved_pages.ts";

/** What tearing leaves out asks of the owner of the book's pages. */
export interface TearOwner {
  /** Returns whether the leaf with these pages (from 1) may be torn out, as it begins to tear. */
  mayTear(pages: readonly number[]): boolean;
  /**
   * Takes the pages of a leaf that is off out of the book's source; the viewer binds the book
   * without them once this returns. Returns null if they cannot be taken out.
   *
   * @param pages their numbers (from 1) when the leaf came off
   *
   * @param moved where the pages of then lie now, as changes have been made that waited for it
   */
  takeOut(pages: readonly number[], moved: NewIndex): TakenPages | null;
  /** Work was done in tearing, J. */
  heard(work: number): void;
}

/** The frames of a film, whose clock waits for each. */
export interface FilmFrames {
  /** Whether the film does not show the current frame. */
  readonly isSkipped: boolean;
}

/** How a book is shown. */
export interface ViewerOptions extends Partial<BindingOptions> {
  /** Returns the paper of the leaves; called when the book lies open. */
  readonly paper: () => Paper;
  /** Returns the page (from 1) at which the book first lies open; called when it does. */
  readonly page: () => number;
  /**
   * Returns whether a book whose front board has no page first lies shut, rather than open at its first
   * page; called likewise. The default is no.
   */
  readonly opensShut?: () => boolean;
  /** Returns the length of a played turn in seconds; called likewise. */
  readonly turnSeconds: () => number;
  /**
   * The film that is made of the book, or null: its frames are drawn as those at rest are, however
   * long that takes, and those that it skips are not drawn.
   */
  readonly filmFrames?: FilmFrames | null;
  /** Returns the model that turns the leaves; called likewise. The default is sheets. */
  readonly model?: () => ModelChoice;
  /** A turn begins between two spreads. */
  readonly onStart: (low: number, high: number, forward: boolean) => void;
  /** The book has come to rest at a spread, and nothing more is planned. */
  readonly onRest: (from: number, to: number) => void;
  /** A page (from 1) cannot be shown, whether it lies open or not. */
  readonly onFailure: (page: number, error: BookError, isOpen: boolean) => void;
  /**
   * Returns the sentence for a page that takes long to draw, from its label.
   * The default is the label alone.
   */
  readonly slowText?: (label: string) => string;
  /** Returns the sentence for a page (from 1) that cannot be shown. The default is the error's own. */
  readonly failureText?: (error: BookError, page: number) => string;
  /** Returns whether corners may be folded by hand; asked while one is held. The default is no. */
  readonly foldsByHand?: () => boolean;
  /**
   * A corner was drawn in over its page and held still there: it is to be folded, and is
   * released once the promise resolves.
   */
  readonly onPress?: (ear: DogEar) => Promise<unknown>;
  /** Who owns the pages of leaves that are torn out. The default is that none are. */
  readonly tearing?: TearOwner;
  /** Returns whether the reader prefers reduced motion: the camera then moves by itself at once. The default is no. */
  readonly calm?: () => boolean;
  /** The zoom level has changed: the current one, or the one the camera is moving to. */
  readonly onZoom?: (level: number) => void;
  /** An optional part of the viewer could not be loaded. */
  readonly onMissingPart?: (error: unknown) => void;
  /** The graphics card failed for good: the book is no longer visible. */
  readonly onContextLost?: () => void;
  /**
   * A frame: where the book's parts are, seconds since the previous one, and
   * whether leaves are in flight.
   */
  readonly onMotion?: (pose: BookPose, seconds: number, moving: boolean) => void;
  /** Pages may be shown in another width. */
  readonly onPageWidth?: () => void;
  /** The layout or the binding has changed. */
  readonly onLayout?: () => void;
  /** Bound anew, the book at rest has another first visible page (from 1), of the same pages. */
  readonly onPage?: (from: number, to: number) => void;
}

/** The default binding. */
export const defaultBinding: BindingOptions = {
  cover: "auto",
  cloth: "#6a2a26",
  theme: "light",
  shadows: 1,
  camera: "reader",
  tilt: 0,
  margin: 0.03,
  binding: "auto",
  layout: "auto",
  offset: 1,
  hardPages: "",
  shifts: [],
  stocks: "",
};
