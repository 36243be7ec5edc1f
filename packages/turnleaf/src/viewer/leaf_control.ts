/**
 * Moves the leaves for a reader, by dragging and by command, and decides which
 * of it begins a turn.
 */

import { faceOf } from "../book/faces.ts";
import { leftPage, rightPage } from "../book/spreads.ts";
import type { Flight, Turning } from "../book/turning.ts";
import { Side } from "../engine/phases.ts";
import type { Place } from "../stage/book_stage.ts";
import type { DragHit } from "./drag_state.ts";
import type { FoldOut } from "./fold_out.ts";
import type { Rebinder } from "./rebinder.ts";

/** The events of leaf control. */
export interface LeafControlEvents {
  /** A leaf whose corner was only lifted is turned from now on. */
  readonly started: (flight: Flight) => void;
  /** Something moves. */
  readonly moved: () => void;
}

/** The leaves of one book under the reader's control, however it is bound. */
export class LeafControl {
  readonly #rebinder: Pick<Rebinder, "bound">;
  readonly #foldOut: FoldOut;
  readonly #events: LeafControlEvents;
  #closed = false;

  constructor(rebinder: Pick<Rebinder, "bound">, foldOut: FoldOut, events: LeafControlEvents) {
    this.#rebinder = rebinder;
    this.#foldOut = foldOut;
    this.#events = events;
  }

  /** Returns what a pointer at a place on the canvas (CSS pixels) can grab, or null. */
  pick(x: number, y: number): DragHit | null {
    const { drag, peek } = this.#rebinder.bound;
    const hold = drag.pick(x, y);
    // Beside a lifted corner a pointer grabs that leaf, not the one under it.
    return hold && peek.flight && hold.on === peek.side ? { ...hold, on: peek.flight } : hold;
  }

  /**
   * Grabs what `pick` found; the leaf then follows `drag`.
   *
   * @param pull how far the pointer has moved since, CSS pixels
   */
  grab(found: DragHit, grab: number, pull: Place = { x: 0, y: 0 }): boolean {
    if (this.#closed) return false;
    const { bound } = this.#rebinder;
    const { drag, peek } = bound;
    const hold = bound.pulled(found, pull.x, pull.y);
    const taken = typeof hold.on === "number" ? null : peek.take(hold.on);
    const grabbed = drag.grab(hold, grab);
    peek.end();
    if (taken) this.#events.started(taken);
    // A listener may have taken the book away.
    return grabbed && !this.#closed;
  }

  /** Moves a grab to a place on the canvas, CSS pixels. */
  drag(grab: number, x: number, y: number): void {
    if (!this.#closed && this.#rebinder.bound.drag.drag(grab, x, y)) this.#events.moved();
  }

  /** Releases a grab. */
  release(grab: number): void {
    if (this.#closed) return;
    const { drag, turning } = this.#rebinder.bound;
    const way = turning.holds(grab) ? drag.carried(grab) : 0;
    if (way !== 0) void turning.press(way);
    drag.release(grab);
    this.#events.moved();
  }

  /**
   * Lifts the corner of a resting leaf a little, until called with null.
   * Returns whether it does.
   */
  peek(hold: DragHit | null): boolean {
    // An unfolded page keeps its corners.
    if (this.#closed || (hold !== null && this.#foldOut.parts !== null)) return false;
    const { peek, drag, turning } = this.#rebinder.bound;
    if (hold === null) peek.end();
    const lifts = hold !== null && peek.begin(hold, drag.floor(hold.on === Side.right ? 1 : -1));
    if (turning.moving) this.#events.moved();
    return lifts;
  }

  /** Returns whether a place found by `pick` is on a leaf with only its corner lifted. */
  isPeeked(hold: DragHit): boolean {
    return hold.on === this.#rebinder.bound.peek.flight;
  }

  /** Turns a leaf to the left (1) or the right (-1) by command. Resolves as `Turning.turn` does. */
  turn(way: 1 | -1): Promise<boolean> {
    return this.#turn(way, (turning) => turning.turn(way));
  }

  /**
   * Turns a leaf to the left (1) or the right (-1) for the reader. Resolves as
   * `Turning.press` does.
   */
  press(way: 1 | -1): Promise<boolean> {
    return this.#turn(way, (turning) => turning.press(way));
  }

  /** Turns to a spread. Resolves as `Turning.goTo` does. */
  goTo(spread: number): Promise<boolean> {
    return this.#command(
      () => this.#rebinder.bound.turning.goTo(spread),
      () => false,
    );
  }

  /**
   * Unfolds an open page (from 1) that is wider than the book. Resolves, once
   * it lies unfolded, to whether it does.
   */
  unfold(page: number): Promise<boolean> {
    const { binding, turning } = this.#rebinder.bound;
    const face = this.#closed || turning.moving ? null : faceOf(binding, turning.spread, page);
    if (face !== "left" && face !== "right") return Promise.resolve(false);
    return this.#foldOut.unfold(page, face === "right" ? 1 : -1);
  }

  /** Folds in the unfolded page. Resolves once it is folded in. */
  foldIn(): Promise<void> {
    const folded = this.#foldOut.foldIn();
    this.#events.moved();
    return folded;
  }

  /**
   * Handles a tap at a place on the canvas, CSS pixels: unfolds the fold-out
   * there, or folds it in again.
   */
  tap(x: number, y: number): void {
    const { binding, turning } = this.#rebinder.bound;
    if (this.#closed || turning.moving) return;
    if (this.#foldOut.page !== null) return void this.foldIn();
    const on = this.pick(x, y)?.on;
    if (typeof on !== "number") return;
    const page = (on === Side.right ? rightPage : leftPage)(binding, turning.spread);
    if (page !== null) void this.unfold(page);
  }

  /** Stops all control of the leaves. */
  close(): void {
    this.#closed = true;
  }

  #turn(way: 1 | -1, turn: (turning: Turning) => Promise<boolean>): Promise<boolean> {
    return this.#command(
      () => turn(this.#rebinder.bound.turning),
      (flight) => (flight.from === flight.low) === (way === 1),
    );
  }

  /**
   * Runs a command, after folding in an unfolded page. A leaf with its corner
   * lifted falls back, or is turned.
   *
   * @param turns whether the command is to turn that leaf
   */
  async #command(
    order: () => Promise<boolean>,
    turns: (flight: Flight) => boolean,
  ): Promise<boolean> {
    if (this.#closed) return false;
    if (this.#foldOut.page !== null) {
      await this.foldIn();
      return await this.#command(order, turns);
    }
    const { peek } = this.#rebinder.bound;
    const { flight } = peek;
    if (flight === null || !turns(flight)) peek.end();
    const done = order();
    // Whether the command meant that leaf or it only lay in the way, it is a turn from now on.
    const turned =
      flight !== null && (flight.to === Side.left) === (flight.from === flight.low)
        ? peek.take(flight)
        : null;
    if (turned) this.#events.started(turned);
    this.#events.moved();
    return await done;
  }
}
