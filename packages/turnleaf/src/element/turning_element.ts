/** What turns the pages of the open book, and reports how they lie. */

import { directionOf, forward, leftPage, pageOf, rightPage, spreadOf } from "../book/spreads.ts";
import type { BookState } from "../book/turning.ts";
import type { Viewer } from "../viewer/viewer.ts";
import { turnSecondsOf } from "./attribute_options.ts";
import type { TurnDetail } from "./events.ts";
import { pageNumber } from "./page_numbers.ts";
import { ReaderElement } from "./reader_element.ts";

/** How pages change by a command. */
export interface TurnOptions {
  /** If false, they change at once, without motion. The default is true. */
  readonly motion?: boolean;
  /**
   * How far down the page, as a fraction of its height from its head, where the page is scrolled.
   * The default is 0.
   */
  readonly top?: number;
}

/** The turns of the element's books. A subclass opens these. */
export abstract class TurningElement extends ReaderElement {
  /**
   * Returns the page at which a book opens, or would.
   *
   * @internal
   */
  protected abstract firstPage(): number;
  /**
   * Has the book that is being opened lie at a page (from 1) first: resolves as `goTo` does. Null if none is
   * being opened and one is open, which then turns there.
   *
   * @internal
   */
  protected abstract openAt(page: number): Promise<boolean> | null;
  /**
   * Announces the open pages to screen readers.
   *
   * @internal
   */
  protected abstract describe(): void;

  /** The page that has been set in this task; null if none has. */
  #justSet: number | null = null;
  /** The page of the last `pagechange`, until a page is requested. */
  #reported: number | null = null;
  /** The state of the last `statechange`. */
  #state: BookState = "resting";

  /**
   * The first visible page, from 1. The attribute, the page at which the book
   * opens, overrides the book's own opening page. Setting either turns there,
   * as `goTo` does; a value that is not a number does nothing. Setting the page
   * of the last `pagechange`, with none requested since, does nothing either: a
   * page may keep its own state in step with the book, as frameworks do,
   * without calling a turn back.
   *
   * @attribute page
   * @default 1
   */
  get page(): number {
    const viewer = this.#viewer;
    return viewer ? pageOf(viewer.binding, viewer.turning.spread) : this.firstPage();
  }

  set page(page: number) {
    const asked = pageNumber(page);
    if (asked === null) return;
    // Frameworks set properties one after the other: `pages` may follow.
    this.#justSet = asked;
    queueMicrotask(() => {
      this.#justSet = null;
    });
    if (asked !== this.#reported) void this.goTo(asked);
  }

  /**
   * The page that has been set in this task; null if none has.
   *
   * @internal
   */
  protected get justSet(): number | null {
    return this.#justSet;
  }

  /** The open pages, by the side they are seen on: left, or above the spine; right, or below it. */
  get spread(): { left: number | null; right: number | null } {
    const viewer = this.#viewer;
    if (!viewer) return { left: null, right: null };
    const { binding, turning } = viewer;
    return { left: leftPage(binding, turning.spread), right: rightPage(binding, turning.spread) };
  }

  /** The reading direction: by the binding, otherwise by its source. */
  get direction(): "ltr" | "rtl" {
    const edge = this.#viewer?.binding.edge ?? this.getAttribute("binding");
    return edge === "right" ? "rtl" : "ltr";
  }

  /**
   * What happens to the leaves: nothing (`resting`); a corner is lifted under a
   * mouse, or falls back (`lifting`); a pointer holds a leaf (`dragged`); one
   * turns or falls (`turning`), or pages cross-fade.
   */
  get state(): BookState {
    return this.#viewer?.state ?? "resting";
  }

  /** The current layout: the requested one, or the one that fits the space. */
  get shownLayout(): "spread" | "single" {
    return this.#viewer?.binding.layout ?? "spread";
  }

  /**
   * Turns one leaf forward from where the book will lie when all earlier
   * requests are done: every call counts, and many in a row become one jump.
   * Resolves, once the book is at rest, to whether it lies there or farther on;
   * to false at the end of the book, and while no book is open.
   */
  next(): Promise<boolean> {
    return this.#turn(1, "command");
  }

  /**
   * Turns one leaf back, as `next` turns forward. Resolves to whether the book
   * lies there or farther back.
   */
  previous(): Promise<boolean> {
    return this.#turn(-1, "command");
  }

  /**
   * Turns one leaf forward (1) or back (-1) for the reader, as by a key of the
   * controls.
   *
   * @param isTap whether the reader presses something once: what a held key repeats ends soon
   *
   * @internal
   */
  press(by: 1 | -1, isTap = false): Promise<boolean> {
    return this.#turn(by, isTap ? "tap" : "press");
  }

  /**
   * Returns whether a leaf or a cover can be turned forward (1) or back (-1) from where the book will lie when all
   * earlier requests are done, as when it is closed over its last page.
   *
   * @internal
   */
  canTurn(by: 1 | -1): boolean {
    const viewer = this.#viewer;
    if (viewer === undefined) return false;
    return viewer.turning.turned((by * forward(viewer.binding)) as 1 | -1) !== null;
  }

  /**
   * Turns to a page (from 1, clamped to the book), or changes to it at once.
   * Resolves, once the book is at rest, to whether it lies there. While a book
   * is opening, that book opens there: resolves once it has, to false if it
   * cannot be opened, or is given up without another in its place. After a book that could not be opened
   * it resolves to false. Rejects with
   * a `TypeError` if the page is not a number.
   *
   * @param options whether the book turns there with motion
   */
  goTo(page: number, options?: TurnOptions): Promise<boolean> {
    const asked = pageNumber(page);
    if (asked === null) {
      return Promise.reject(new TypeError(`goTo takes the number of a page; ${page} is none.`));
    }
    this.#reported = null;
    return this.openAt(asked) ?? this.turnTo(asked, options);
  }

  /**
   * Turns to a page of the open book, as `goTo` does, even while another book
   * opens: for its reader, as by a link on its pages or a line of its contents.
   * Resolves to false while no book is open.
   *
   * @param options `jump` for a jump from which the reader may come back
   *
   * @internal
   */
  turnTo(page: number, options?: TurnOptions & { readonly jump?: boolean }): Promise<boolean> {
    this.#reported = null;
    const viewer = this.#viewer;
    if (viewer === undefined) return Promise.resolve(false);
    const isOpen = spreadOf(viewer.binding, page) === viewer.turning.spread;
    if (options?.jump && !isOpen) this.jump();
    // Of a jump that is called off nothing leads back.
    else if (this.state !== "resting") this.jumps.forget();
    const top = options?.top;
    if (top !== undefined && Number.isFinite(top)) this.book?.roll?.aim(page, top);
    viewer.seek(page);
    const spread = spreadOf(viewer.binding, page);
    const motion = options?.motion === false ? "none" : this.motion;
    if (motion === "turn") return viewer.commands.goTo(spread);
    const changed = viewer.change(spread, motion === "fade");
    this.updateState();
    return changed;
  }

  /**
   * Unfolds an open page (from 1) that is clearly wider than the book, as a
   * click on it does, or opens the folds of a page, its folded corner too, whose bookmark it
   * removes. Resolves, once it is unfolded, to whether it is.
   */
  unfold(page: number): Promise<boolean> {
    const opened = this.openFolds(page) ?? this.#viewer?.commands.unfold(page);
    return opened ?? Promise.resolve(false);
  }

  /** Folds in the unfolded page, as any turn does first. Resolves once it is folded in. */
  foldIn(): Promise<void> {
    return this.#viewer?.commands.foldIn() ?? Promise.resolve();
  }

  /**
   * Whether a page that lies open is a fold-out, and is unfolded.
   *
   * @internal
   */
  get foldOut(): "none" | "shut" | "open" {
    return this.#viewer?.commands.foldOut ?? "none";
  }

  /**
   * Unfolds the open page that is a fold-out, or folds it in. Returns whether there is one.
   *
   * @internal
   */
  toggleFoldOut(): boolean {
    return this.#viewer?.commands.toggleFoldOut() ?? false;
  }

  /**
   * Call it when a book is open.
   *
   * @internal
   */
  protected turnsOpened(): void {
    this.#reported = null;
    this.updateState();
  }

  /**
   * Reports a turn that starts, as `ViewerOptions.onStart` is called.
   *
   * @internal
   */
  protected turnStarted(low: number, high: number, toLeft: boolean): void {
    const binding = this.#viewer?.binding;
    if (binding === undefined) return;
    const [from, to] = toLeft ? [low, high] : [high, low];
    const direction = directionOf(binding, from, to);
    this.emit("turnstart", { from: pageOf(binding, from), to: pageOf(binding, to), direction });
  }

  /**
   * Reports that the book lies elsewhere after turns, as `ViewerOptions.onRest` is called.
   *
   * @internal
   */
  protected turnEnded(from: number, to: number): void {
    const binding = this.#viewer?.binding;
    if (binding === undefined || from === to) return;
    this.jumps.rested();
    const direction = directionOf(binding, from, to);
    this.pageChanged(pageOf(binding, from), pageOf(binding, to), direction);
  }

  /**
   * Reports that other pages lie open.
   *
   * @internal
   */
  protected pageChanged(from: number, to: number, direction: TurnDetail["direction"]): void {
    this.describe();
    this.book?.keepOpen();
    this.#reported = to;
    this.emit("pagechange", { from, to, direction });
  }

  /**
   * Whether the reader prefers reduced motion.
   *
   * @internal
   */
  protected get isCalm(): boolean {
    const view = this.ownerDocument.defaultView ?? window;
    return view.matchMedia("(prefers-reduced-motion: reduce)").matches;
  }

  /**
   * How pages change: leaves turn, pages cross-fade, or neither.
   *
   * @internal
   */
  protected get motion(): "turn" | "fade" | "none" {
    if (turnSecondsOf(this) === 0 || this.scrolled) return "none";
    return this.isCalm ? "fade" : "turn";
  }

  /** @param how whether a page's script asks for it, or the reader: by one press, or by what may be held */
  #turn(by: 1 | -1, how: "command" | "tap" | "press"): Promise<boolean> {
    const viewer = this.#viewer;
    if (viewer === undefined) return Promise.resolve(false);
    const { commands } = viewer;
    const way = (by * forward(viewer.binding)) as 1 | -1;
    if (this.motion === "turn")
      return how === "command" ? commands.turn(way) : commands.press(way, how === "tap");
    // A corner that only lifts is not a turn to go on from.
    commands.peek(null);
    const spread = viewer.turning.turned(way);
    if (spread === null) return Promise.resolve(false);
    const changed = viewer.change(spread, this.motion === "fade", way);
    this.updateState();
    return changed;
  }

  /**
   * Reports the state if it has changed.
   *
   * @internal
   */
  protected updateState(): void {
    const { state } = this;
    if (state === this.#state) return;
    this.#state = state;
    this.emit("statechange", { state });
  }

  get #viewer(): Viewer | undefined {
    return this.book?.viewer;
  }
}
