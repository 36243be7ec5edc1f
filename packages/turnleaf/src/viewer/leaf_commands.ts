/** What a book is commanded besides drags: turns, a corner to lift, pages to unfold. */

import { faceOf } from "../book/faces.ts";
import { sideBefore } from "../book/leaf_order.ts";
import { leftPage, pagesAt, rightPage } from "../book/spreads.ts";
import type { Flight, Turning } from "../book/turning.ts";
import { Side } from "../engine/phases.ts";
import { pileHeight } from "../engine/shapes.ts";
import type { DragHit } from "./drag.ts";
import type { FoldOut } from "./fold_out.ts";
import type { Rebinder } from "./rebinder.ts";

/** The commands to one book, however it is bound. */
export class LeafCommands {
  readonly #rebinder: Pick<Rebinder, "bound">;
  readonly #foldOut: FoldOut;
  readonly #moved: () => void;
  #closed = false;

  /** @param moved called when something moves */
  constructor(rebinder: Pick<Rebinder, "bound">, foldOut: FoldOut, moved: () => void) {
    this.#rebinder = rebinder;
    this.#foldOut = foldOut;
    this.#moved = moved;
  }

  /**
   * Lifts the corner of a resting leaf a little, until called with null.
   * Returns whether it does.
   */
  peek(hit: DragHit | null): boolean {
    // An unfolded page keeps its corners, and one that is about to be.
    if (this.#closed || (hit !== null && (this.#foldOut.isVisible || this.#foldOut.isMaking)))
      return false;
    const { peek, engine, turning } = this.#rebinder.bound;
    if (hit === null) peek.end();
    const lifts =
      typeof hit?.on === "number" && peek.begin(hit.on, hit.v, pileHeight(engine.pile(hit.on)));
    if (turning.moving) this.#moved();
    return lifts;
  }

  /** Turns a leaf to the left (1) or the right (-1) by command. Resolves as `Turning.turn` does. */
  turn(way: 1 | -1): Promise<boolean> {
    return this.#turn(way, (turning) => turning.turn(way));
  }

  /**
   * Turns a leaf to the left (1) or the right (-1) for the reader. `isTap` is, and it resolves, as
   * `Turning.press` has it.
   */
  press(way: 1 | -1, isTap: boolean): Promise<boolean> {
    return this.#turn(way, (turning) => turning.press(way, isTap));
  }

  /** Turns to a spread. Resolves as `Turning.goTo` does. */
  goTo(spread: number): Promise<boolean> {
    return this.#command(
      () => this.#rebinder.bound.turning.goTo(spread),
      () => false,
    );
  }

  /**
   * Lets a corner that is only lifted fall back. Resolves, once it lies, to whether all leaves lie
   * at rest: at once if no corner is lifted.
   */
  async dropCorner(): Promise<boolean> {
    const { peek, turning } = this.#rebinder.bound;
    if (!this.#closed && peek.flight !== null) {
      peek.end();
      this.#moved();
      await turning.goTo(turning.spread);
    }
    return !this.#closed && !this.#rebinder.bound.turning.moving;
  }

  /**
   * Unfolds an open page (from 1) that is wider than the book. Resolves, once
   * it lies unfolded, to whether it does.
   */
  async unfold(page: number): Promise<boolean> {
    if (!(await this.dropCorner())) return false;
    const { binding, turning } = this.#rebinder.bound;
    const face = faceOf(binding, turning.spread, page);
    if (face !== "left" && face !== "right") return false;
    return await this.#foldOut.unfold(page, face === "right" ? Side.right : Side.left);
  }

  /** Whether a page that lies open is a fold-out, and is unfolded. */
  get foldOut(): "none" | "shut" | "open" {
    if (this.#foldOut.page !== null) return "open";
    return this.#foldOutPage === null ? "none" : "shut";
  }

  /** Unfolds the open page that is a fold-out, or folds it in. Returns whether there is one. */
  toggleFoldOut(): boolean {
    if (this.#closed) return false;
    const page = this.#foldOutPage;
    if (this.#foldOut.isVisible) void this.foldIn();
    else if (page === null) return false;
    else void this.unfold(page);
    return true;
  }

  /** The first open page (from 1) that is a fold-out; null if none is. */
  get #foldOutPage(): number | null {
    const { binding, turning } = this.#rebinder.bound;
    const pages = pagesAt(binding, turning.spread);
    return pages.find((page) => this.#foldOut.unfolds(page)) ?? null;
  }

  /** Folds in the unfolded page. Resolves once it is folded in. */
  foldIn(): Promise<void> {
    return this.#foldOut.foldIn();
  }

  /**
   * Handles a tap at a place on the canvas, CSS pixels: unfolds the fold-out
   * there, or folds it in again.
   */
  tap(x: number, y: number): void {
    const { binding, turning } = this.#rebinder.bound;
    if (this.#closed || turning.moving) return;
    if (this.#foldOut.isVisible) return void this.foldIn();
    const on = this.#rebinder.bound.drags.pick(x, y)?.on;
    if (typeof on !== "number") return;
    const page = (on === Side.right ? rightPage : leftPage)(binding, turning.spread);
    if (page !== null) void this.unfold(page);
  }

  /** Ignores every command from now on. */
  close(): void {
    this.#closed = true;
  }

  #turn(way: 1 | -1, turn: (turning: Turning) => Promise<boolean>): Promise<boolean> {
    return this.#command(
      () => turn(this.#rebinder.bound.turning),
      (flight) => sideBefore(flight) === (way === 1 ? Side.right : Side.left),
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
    if (this.#foldOut.isVisible) {
      await this.foldIn();
      return await this.#command(order, turns);
    }
    const { peek } = this.#rebinder.bound;
    const { flight } = peek;
    if (flight === null || !turns(flight)) peek.end();
    const done = order();
    // Whether the command meant that leaf or it only lay in the way, it is a turn from now on.
    if (flight !== null && flight.to !== sideBefore(flight)) peek.becomeTurn(flight);
    this.#moved();
    return await done;
  }
}
