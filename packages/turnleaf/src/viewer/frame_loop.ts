/**
 * The frames of a viewer: asks for them while something moves, and in each steps what moves, has it
 * drawn, and decides how sharply. At rest it asks for none.
 */

import type { Turning } from "../book/turning.ts";
import type { ModelSwitch } from "../leaf_models/model_switch.ts";
import type { PageBitmaps } from "../pages/page_bitmaps.ts";
import type { BookStage } from "../stage/book_stage.ts";
import type { BookExtent } from "./book_extent.ts";
import type { BoundBook } from "./bound_book.ts";
import { type CameraMotion, ViewHistory } from "./camera_motion.ts";
import type { CrossFade } from "./cross_fade.ts";
import type { FoldOut } from "./fold_out.ts";
import { FrameQuality, firstFrameWait } from "./frame_timing.ts";
import type { Rebinder } from "./rebinder.ts";
import type { Sharpness } from "./sharpness.ts";
import type { SheetCommands } from "./sheet_commands.ts";
import type { ViewerOptions } from "./viewer_options.ts";

/** What is stepped and drawn in a frame. */
export interface FrameParts {
  /** The window that shows the canvas: another window's frames stop when that one is hidden. */
  readonly window: Window;
  readonly options: Pick<ViewerOptions, "filmFrames" | "foldsByHand" | "onMotion" | "onPress">;
  readonly stage: BookStage;
  readonly bitmaps: PageBitmaps;
  readonly camera: CameraMotion;
  readonly crossFade: CrossFade;
  readonly sharpness: Sharpness;
  readonly foldOut: FoldOut;
  readonly modelSwitch: ModelSwitch;
  readonly rebinder: Rebinder;
  readonly sheets: SheetCommands;
  /** Applies the changes of the binding that wait for the book's rest. */
  readonly bindAnew: () => void;
  /** How large the book is shown. */
  readonly extent: Pick<BookExtent, "canvas">;
}

/** Draws the frames of one viewer. */
export class FrameLoop {
  /** For listeners to views of the book at rest, by the open spread and where it is seen; "" while anything moves. */
  readonly viewHistory: ViewHistory = new ViewHistory();
  /** The same, with views while only the camera moves. */
  readonly stillHistory: ViewHistory = new ViewHistory();
  readonly #parts: FrameParts;
  readonly #frameQuality: FrameQuality;
  #frame = 0;
  #handled = false;
  /** Time of the first animation frame, milliseconds, until one is drawn; then long ago. */
  #waitsSince = Number.NaN;
  /** Whether the last frame has fewer pixels than at rest, as pictures of it are missing. */
  #isPlain = false;
  /** Whether no leaf is in flight and no flap open, so that elements may lie over their pages. */
  #isStill = false;
  #isClosed = false;

  constructor(parts: FrameParts) {
    this.#parts = parts;
    this.#frameQuality = new FrameQuality(parts.stage.isSoftware);
  }

  /** Requests a frame, unless one is already requested. */
  request(): void {
    if (this.#isClosed || this.#frame !== 0) return;
    this.#frame = this.#parts.window.requestAnimationFrame((now) => this.#draw(now));
  }

  /** Whether a frame is requested. */
  get isRequested(): boolean {
    return this.#frame !== 0;
  }

  /** Whether fingers move the view: the frames that they ask for are drawn as in motion, and none between. */
  set handled(handled: boolean) {
    this.#handled = handled;
    this.request();
  }

  /** Whether the last frame had fewer pixels than it will have once its pictures are there, as now. */
  get isOutdated(): boolean {
    return this.#isPlain && this.#parts.bitmaps.settled;
  }

  /** Whether no leaf is in flight and no flap open, so that elements may lie over their pages. */
  get isStill(): boolean {
    return this.#isStill;
  }

  /** Returns whether page `page` (from 1) is an element that may lie over its place now. */
  isElement(page: number): boolean {
    return this.#isStill && this.#parts.bitmaps.under(page) !== null;
  }

  /** Draws the book as it lies, at once, with the bitmaps of pages that are elements. */
  drawAtOnce(): void {
    this.#setStill(false);
    this.#parts.stage.draw({ resting: true, steady: true });
  }

  /** Call it when the book was bound anew: listeners hear of its next view even if it is the same. */
  bound(): void {
    this.viewHistory.forget();
    this.stillHistory.forget();
  }

  /** Ends the frames. */
  close(): void {
    this.#isClosed = true;
    this.#cancel();
  }

  #cancel(): void {
    this.#parts.window.cancelAnimationFrame(this.#frame);
    this.#frame = 0;
  }

  /** Returns whether the first frame waits for its bitmaps. */
  #waits(now: number): boolean {
    if (!this.#parts.stage.isSoftware || this.#turning.moving || this.#parts.bitmaps.settled)
      return false;
    if (Number.isNaN(this.#waitsSince)) this.#waitsSince = now;
    return now - this.#waitsSince < firstFrameWait;
  }

  #draw(now: number): void {
    this.#frame = 0;
    if (this.#waits(now)) {
      this.request();
      return;
    }
    this.#waitsSince = Number.NEGATIVE_INFINITY;
    const { stage, bitmaps, camera, crossFade, sharpness, foldOut, modelSwitch, sheets } =
      this.#parts;
    const { ticks, engine } = this.#bound;
    const rested = ticks.rested(now);
    if (rested > 0) engine.creases?.wait(rested);
    const passed = ticks.count(now);
    const seconds = passed * engine.tick;
    const isPressed = sheets.stepFolds(seconds);
    // Else nothing in the engine has moved since the book was laid open.
    const turned = this.#turning.moving || this.#turning.isSettling;
    if (turned) this.#turning.step(passed);
    // A listener of a turn may destroy the viewer at once.
    if (this.#isClosed) return;
    if (turned) modelSwitch.update(this.#bound, seconds);
    const tearing = sheets.stepLoose(passed);
    if (this.#isClosed) return;
    const turning = this.#turning.moving;
    if (!turning) this.#parts.bindAnew();
    if (this.#isClosed) return;
    const { peek } = this.#bound;
    peek.step(seconds);
    const isHeldStill = this.#pressCorner(seconds);
    if (this.#isClosed) return;
    const folding = foldOut.step(passed);
    const stepping = camera.step(seconds) || folding;
    // What has asked for a frame since this one began, such as a leaf that landed, is seen in it.
    this.#cancel();
    const posed = this.#bound.pose();
    const modelled = { ...modelSwitch.pose(posed), flap: foldOut.surface };
    const pose = sheets.pose(modelled);
    if (stepping) this.#bound.drags.follow();
    // A leaf held still takes no more frames until its pointer moves.
    const still =
      turning && this.#turning.isHeld && this.#bound.engine.isAsleep && modelSwitch.isAsleep;
    const isSettling = this.#turning.isSettling;
    const isInMotion = (turning && !still) || tearing || isSettling;
    const moving = isInMotion || isHeldStill || stepping || isPressed;
    const resting = !moving && !this.#handled;
    // While fingers move the view, the next frame comes with their next event.
    if (moving) this.#frameQuality.frame(now);
    else this.#frameQuality.rest();
    const isFlat = !foldOut.isVisible;
    this.#setStill(!turning && isFlat && !crossFade.isOn);
    const { pixels, roughly } = this.#frameQuality.quality;
    const { filmFrames = null } = this.#parts.options;
    const isFull = resting || filmFrames !== null;
    stage.pose(pose, roughly && !isFull);
    this.#parts.options.onMotion?.(posed, seconds, (turning && !still) || tearing);
    // Where the processor draws, a frame that is soon drawn again is not worth all its pixels.
    this.#isPlain = resting && stage.isSoftware && !bitmaps.settled;
    const steady = !stepping && !this.#handled;
    if (!filmFrames?.isSkipped) {
      stage.draw({ resting: isFull && !this.#isPlain, steady, pixels });
    }
    bitmaps.paused = !resting;
    crossFade.step(now, this.#turning.spread);
    if (this.#isClosed) return;
    if (this.#isStill) this.stillHistory.update(this.#viewKey);
    else if (!turning && isFlat && !crossFade.isOn) this.request();
    if (moving || crossFade.isOn) this.request();
    else this.#bound.ticks.stop();
    if (!resting) sharpness.pause();
    else if (!turning) {
      const drawn = this.#bound.faceTextures.open.filter(({ page }) => !this.isElement(page));
      sharpness.look(drawn, this.#parts.extent.canvas);
    }
    const isMoving = stepping || this.#handled || crossFade.isOn || (turning && !peek.flight);
    this.viewHistory.update(isMoving ? "" : this.#viewKey);
  }

  /** Folds a corner that is held still over its page for long enough. Returns whether one is, or may be. */
  #pressCorner(seconds: number): boolean {
    const { foldsByHand, onPress } = this.#parts.options;
    const { drags, engine } = this.#bound;
    // The book is bound by an engine that creases once it rests, which a leaf that is pressed does not.
    const mayFold = foldsByHand?.() && engine.creases !== undefined;
    const ear = mayFold && onPress ? drags.step(seconds) : false;
    if (typeof ear === "boolean") return ear;
    void onPress?.(ear).finally(() => drags.letGo());
    return true;
  }

  get #viewKey(): string {
    return `${this.#turning.spread} ${this.#parts.stage.viewKey}`;
  }

  /** Shows the bitmaps of pages that are elements, or the paper under these. */
  #setStill(isStill: boolean): void {
    if (isStill === this.#isStill) return;
    this.#isStill = isStill;
    if (!isStill) this.stillHistory.update("");
    this.#bound.faceTextures.show(this.#parts.foldOut.parts, isStill);
  }

  get #bound(): BoundBook {
    return this.#parts.rebinder.bound;
  }

  get #turning(): Turning {
    return this.#bound.turning;
  }
}
