/** Keys of the book itself: they turn one leaf, unfold a page, zoom, and pan while zoomed. */

import { turnOfKey } from "../book/layout.ts";
import { pagesAt } from "../book/spreads.ts";
import type { Place } from "../stage/book_stage.ts";
import { keepsKeys } from "./own_pointers.ts";
import type { InputTarget } from "./target.ts";
import { columnInSight, type NextView, nextView, viewOf } from "./zoomed_reading.ts";

/**
 * Duration of a zoom or pan by key, seconds, and the zoom of one key: that of
 * the controls' buttons.
 */
const glide = 0.28;
const zoomStep = 1.5;

/** How far an arrow key pans, as a fraction of the stage. */
const panStep = 0.15;

/** The keys over one book. */
export class Keys {
  readonly #element: HTMLElement;
  readonly #stage: HTMLElement;
  readonly #target: InputTarget;

  /**
   * @param element whose keys they are
   *
   * @param stage contains the canvas and the text over it
   */
  constructor(element: HTMLElement, stage: HTMLElement, target: InputTarget) {
    this.#element = element;
    this.#stage = stage;
    this.#target = target;
  }

  /** Handles a key that goes down. Keys with Ctrl, Alt or Meta belong to the browser. */
  press(event: KeyboardEvent): void {
    if (event.defaultPrevented || event.altKey || event.ctrlKey || event.metaKey) return;
    if (!this.#isBook(event.composedPath()[0]) && !this.#isOnPage(event.composedPath()[0])) return;
    const done =
      this.#zoom(event.key) ||
      this.#pan(event.key) ||
      this.#readOn(event) ||
      this.#toggleFoldOut(event);
    const by = done ? 0 : turnOfKey(event.key, this.#target.viewer.binding.edge);
    if (!done && by === 0) return;
    event.preventDefault();
    if (by !== 0) this.#target.turn(by, !event.repeat);
  }

  /** Returns whether the book itself has the focus. */
  #isBook(target: EventTarget | undefined): boolean {
    // The frame around the stage and the controls takes the focus for the book.
    return target === this.#element || target === this.#stage.parentElement;
  }

  /**
   * Returns whether a key pressed on a page is the book's: not a field's, nor one of the controls
   * beside it.
   */
  #isOnPage(target: EventTarget | undefined): boolean {
    if (keepsKeys(target)) return false;
    // Elements that are pages are children of the element itself.
    return this.#stage.contains(target as Node) || this.#element.contains(target as Node);
  }

  #zoom(key: string): boolean {
    const factor = { "+": zoomStep, "=": zoomStep, "-": 1 / zoomStep, "0": 0 }[key];
    if (factor === undefined) return false;
    const level = Math.max(this.#target.viewer.zoomLevel * factor, 1);
    this.#glide(level, this.#middle);
    this.#target.announceZoom();
    return true;
  }

  /** Unfolds the open page that is a fold-out, or folds it in: on a page the key is for what is there. */
  #toggleFoldOut(event: KeyboardEvent): boolean {
    if (event.key !== "Enter" || event.repeat || !this.#isBook(event.composedPath()[0]))
      return false;
    return this.#target.viewer.commands.toggleFoldOut();
  }

  /** Pans a zoomed book: the view goes where the arrows point. */
  #pan(key: string): boolean {
    const { zoomLevel } = this.#target.viewer;
    if (zoomLevel <= 1) return false;
    const way = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[
      key
    ];
    if (way === undefined) return false;
    const { x, y } = this.#middle;
    const step = 2 * panStep;
    this.#glide(zoomLevel, { x: x * (1 + step * way[0]), y: y * (1 + step * way[1]) });
    return true;
  }

  /** Goes on in a zoomed book: down the page or column, then to the head of the next one, turning a leaf for it. */
  #readOn({ key, shiftKey }: KeyboardEvent): boolean {
    const { viewer, turn, columnsOf } = this.#target;
    const by = key === "PageUp" || (key === " " && shiftKey) ? -1 : 1;
    if (viewer.zoomLevel <= 1 || !(key === "PageDown" || key === "PageUp" || key === " "))
      return false;
    const { clientWidth: width, clientHeight: height } = this.#stage;
    const book = { viewer, columnsOf, width, height };
    const read = columnInSight(book);
    const view = read && nextView(book, read, by);
    if (view) this.#show(view);
    else {
      const open = pagesAt(viewer.binding, viewer.turning.spread);
      const here = by === 1 ? open.at(-1) : open[0];
      const x = here === undefined ? undefined : viewer.project(here, 0, 0)?.x;
      void turn(by).then((isTurned) => {
        const pages = pagesAt(viewer.binding, viewer.turning.spread);
        const page = by === 1 ? pages[0] : pages.at(-1);
        if (!isTurned || page === undefined || viewer.zoomLevel <= 1) return;
        const next = viewOf(book, page, read, by, x);
        if (next) this.#show(next);
      });
    }
    return true;
  }

  #show({ from, to }: NextView): void {
    const { viewer, calm } = this.#target;
    viewer.zoom(viewer.zoomLevel, from, to, calm() ? 0 : glide);
  }

  /** Moves the point in the middle to a place, at a level. */
  #glide(level: number, to: Place): void {
    const { viewer, calm } = this.#target;
    viewer.zoom(level, this.#middle, to, calm() ? 0 : glide);
  }

  get #middle(): Place {
    const { clientWidth, clientHeight } = this.#stage;
    return { x: clientWidth / 2, y: clientHeight / 2 };
  }
}
