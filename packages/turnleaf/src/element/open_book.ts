/** A book that lies open in an element. */

import { attributeOf } from "../attributes.ts";
import { leftPage, rightPage } from "../book/spreads.ts";
import type { ElementPlane } from "../element_plane.ts";
import { Input } from "../input/input.ts";
import type { Gesture } from "../input/target.ts";
import { loadPart } from "../sources/load_part.ts";
import type { PageList } from "../sources/page_list.ts";
import type { NewIndex } from "../sources/page_source.ts";
import type { MovedPages } from "../viewer/moved_pages.ts";
import type { Viewer } from "../viewer/viewer.ts";
import { languageOf } from "../words/languages.ts";
import { allowsGesture } from "./attribute_options.ts";
import type { BookElements, GoTo } from "./book_elements.ts";
import type { DayPrint } from "./day_print.ts";
import { layoutLists, type PageLists } from "./page_lists.ts";
import { pageTap } from "./page_tap.ts";
import { ReadableBook } from "./readable_book.ts";
import type { RollView } from "./roll_view.ts";
import { watchTransformation } from "./watch_transformation.ts";

/** What an open book asks of its element. */
export interface OpenBookHooks {
  /** How the stage is seen in the window. */
  readonly plane: ElementPlane;
  /** Turns one leaf forward (1) or back (-1), as `InputTarget` has it. */
  readonly turn: (by: 1 | -1, isTap?: boolean) => Promise<boolean>;
  /** Announces to screen readers the zoom level to which a key leads. */
  readonly announceZoom: () => void;
  readonly goTo: GoTo;
  /** Returns whether the reader prefers reduced motion. */
  readonly calm: () => boolean;
  /** The pages of the open book, so many before, lie elsewhere: it is about to be bound anew. */
  renumbered(moved: NewIndex, pageCount: number): void;
  /** Returns what names pages. */
  readonly lists: () => PageLists;
  /** An optional part of the viewer could not be loaded. */
  readonly missingPart: (error: unknown) => void;
}

/** What an open book is made of. */
interface OpenBookParts {
  readonly canvas: HTMLCanvasElement;
  readonly source: PageList;
  readonly viewer: Viewer;
  readonly elements: BookElements;
  readonly roll: RollView | null;
}

/** A book that lies open in an element, with all that acts on it. */
export class OpenBook {
  readonly source: PageList;
  readonly viewer: Viewer;
  readonly canvas: HTMLCanvasElement;
  readonly reading: ReadableBook;
  readonly elements: BookElements;
  /** Its pages that are scrolled; null if all are turned. */
  readonly roll: RollView | null;
  readonly #element: HTMLElement;
  readonly #stage: HTMLElement;
  readonly #home: HTMLElement;
  readonly #input: Input;
  readonly #hooks: Pick<OpenBookHooks, "renumbered" | "lists">;
  readonly #plane: ElementPlane;
  readonly #ended = new AbortController();
  /** What is printed of it, once it is shown in a dark theme. */
  #dayPrint: Promise<DayPrint> | null = null;

  constructor(
    element: HTMLElement,
    stage: HTMLElement,
    home: HTMLElement,
    { canvas, source, viewer, elements, roll }: OpenBookParts,
    hooks: OpenBookHooks,
  ) {
    const { turn, announceZoom, calm, goTo, missingPart, plane } = hooks;
    this.#hooks = hooks;
    this.source = source;
    this.viewer = viewer;
    this.canvas = canvas;
    this.elements = elements;
    this.roll = roll;
    elements.follow(viewer);
    const allows = (gesture: Gesture): boolean => allowsGesture(element, gesture);
    const swipeDistance = (): number => attributeOf(element, "swipeDistance");
    this.#input = new Input(canvas, stage, element, {
      ...{ viewer, plane, turn, announceZoom, calm, allows, swipeDistance },
      columnAt: (page, at) => this.reading.columnAt(page, at),
      columnsOf: (page) => this.reading.columnsOf(page),
      selectWord: ({ x, y }) => this.reading.selectWord(x, y),
      tapped: () => stage.dispatchEvent(new Event(pageTap)),
    });
    const language = (): string => languageOf(element);
    this.reading = new ReadableBook({ source, viewer, canvas, roll, goTo, language }, missingPart);
    this.#element = element;
    this.#stage = stage;
    this.#home = home;
    this.#plane = plane;
  }

  /**
   * Changes the pages as soon as the book is at rest: at once if it is. Resolves to whether the
   * change was made: false if the book was closed before. Rejects with what `change` throws.
   *
   * @param change changes the source and returns where its pages lie now
   *
   * @param followed called once what names pages has followed them, before the book is bound anew
   */
  async changePages(change: () => NewIndex, followed?: () => void): Promise<boolean> {
    const isMade = await this.viewer.changePages(() => this.#change(change, followed));
    if (isMade) this.reading.changed();
    return isMade;
  }

  /**
   * Changes the pages at once, as `changePages` does: call it where the viewer, which is at rest, asks
   * for it and binds the book by what this returns. Throws what `change` throws.
   */
  changeNow(change: () => NewIndex, followed: () => void): MovedPages {
    const pages = this.#change(change, followed);
    this.reading.changed();
    return pages;
  }

  #change(change: () => NewIndex, followed?: () => void): MovedPages {
    const { pageCount } = this.source;
    const moved = this.elements.after(change);
    // Changes that wait for the same rest are made one after the other, and then reported.
    this.#hooks.renumbered(moved, pageCount);
    followed?.();
    const lists = this.#hooks.lists();
    const folds = [...lists.dogEars, ...lists.folds];
    return { moved, lists: layoutLists(lists), folds };
  }

  /**
   * Makes a change of the pages that their source asks for, as `changePages` does: the open pages
   * keep their sides, however many are counted before them.
   */
  followSource(change: () => NewIndex): Promise<boolean> {
    return this.changePages(() => {
      this.keepOpen();
      this.#keepSide();
      return change();
    });
  }

  /** Has the open pages printed by day with the web page, where they are seen in a dark theme. */
  async printByDay(): Promise<void> {
    if (this.#dayPrint === null && !this.source.colours?.isDark) return;
    const { source, viewer, canvas } = this;
    const isScrolled = (): boolean => this.roll?.isShown ?? false;
    const { signal } = this.#ended;
    this.#dayPrint ??= loadPart(import("./day_print.ts")).then(
      ({ DayPrint }) => new DayPrint({ source, viewer, canvas, isScrolled }, signal),
    );
    const print = await this.#dayPrint;
    if (!signal.aborted) print.update();
  }

  /** Has the source keep what the reader sees at the head of the open pages. */
  keepOpen(): void {
    this.source.keepOpen(this.#openPages.flatMap((page) => (page === null ? [] : [page - 1])));
  }

  /** The open pages in the order of reading, null for a bare side. */
  get #openPages(): readonly (number | null)[] {
    const { binding, turning } = this.viewer;
    const sides = [leftPage(binding, turning.spread), rightPage(binding, turning.spread)];
    return binding.reversed ? sides.reverse() : sides;
  }

  #keepSide(): void {
    if (this.viewer.binding.layout !== "spread") return;
    const [first = null, second = null] = this.#openPages;
    if (first !== null) this.source.keepSide(first - 1, "first");
    else if (second !== null) this.source.keepSide(second - 1, "second");
  }

  /** Gives the leaves the size of their pages, which had to be guessed until now. */
  async measure(): Promise<void> {
    const { signal } = this.#ended;
    try {
      await this.changePages(await this.viewer.measure(signal));
    } catch (error) {
      if (!signal.aborted) throw error;
    }
  }

  /**
   * Frees everything but the source of the pages.
   *
   * @param keepCanvas whether another book will be drawn on its canvas
   * @returns whether one can be
   */
  destroy(keepCanvas: boolean): boolean {
    this.#ended.abort();
    this.#input.destroy();
    this.reading.destroy();
    this.roll?.destroy();
    return this.viewer.destroy(keepCanvas);
  }

  /** Makes the book as large as its stage, as sharp as the screen shows it, and keeps it so. */
  fit(): void {
    const { signal } = this.#ended;
    const [stage, home] = [this.#stage, this.#home];
    const view = this.#element.ownerDocument.defaultView ?? window;
    const plane = this.#plane;
    // As it was measured last: a change of style says nothing of it.
    let pixels: ResizeObserverSize | undefined;
    const resize = (): void => {
      const { clientWidth, clientHeight } = stage;
      if (clientWidth > 0 && clientHeight > 0) {
        // Printed, it is as on the screen, scaled.
        for (const { style, clientWidth, clientHeight } of [home, stage]) {
          style.setProperty("--screen-width", `${clientWidth}px`);
          style.setProperty("--screen-height", `${clientHeight}px`);
        }
        const ratio = view.devicePixelRatio;
        // Whole pixels of the screen, so that those of the canvas are these.
        const width = wholePixels(clientWidth * ratio, pixels?.inlineSize);
        const height = wholePixels(clientHeight * ratio, pixels?.blockSize);
        const room = { width: home.clientWidth, height: home.clientHeight };
        this.viewer.resize(width / ratio, height / ratio, ratio, rounded(plane.scale), room);
      }
    };
    const observer = new view.ResizeObserver(([entry]) => {
      pixels = entry?.devicePixelContentBoxSize?.[0];
      resize();
    });
    try {
      observer.observe(stage, { box: "device-pixel-content-box" });
    } catch {
      // Not in WebKit.
      observer.observe(stage);
    }
    signal.addEventListener("abort", () => observer.disconnect(), { once: true });
    watchRatio(view, resize, signal);
    watchTransformation(this.#element, resize, signal);
    resize();
  }
}

/** Returns a scale without what lengths that are measured differ by from place to place. */
function rounded(scale: number): number {
  return Math.round(1000 * scale) / 1000;
}

/**
 * Returns a length in whole pixels of the screen: as it was measured, unless that is another length, as
 * where lines of text run downward, or where a browser emulates a screen.
 */
function wholePixels(length: number, measured: number = Number.NaN): number {
  return Math.abs(measured - length) < 1 + window.devicePixelRatio ? measured : Math.round(length);
}

/** Follows the pixel ratio of a window's screen, which changes with the zoom and from screen to screen. */
function watchRatio(view: Window, changed: () => void, signal: AbortSignal): void {
  const media = view.matchMedia(`(resolution: ${view.devicePixelRatio}dppx)`);
  const again = (): void => {
    changed();
    watchRatio(view, changed, signal);
  };
  media.addEventListener("change", again, { once: true, signal });
}
