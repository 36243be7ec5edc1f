/**
 * The life of the book in an element: opened, fitted to the element's size,
 * read, closed.
 */

import { attributeOf } from "../attributes.ts";
import { leftPage, rightPage } from "../book/spreads.ts";
import type { ElementPlane } from "../element_plane.ts";
import { Input } from "../input/input.ts";
import type { Gesture } from "../input/target.ts";
import {
  checkPages,
  giveUpContext,
  openViewer,
  prepareViewer,
  type Showing,
} from "../open_viewer.ts";
import { loadPart } from "../sources/load_part.ts";
import type { BookInput } from "../sources/open.ts";
import type { PageList } from "../sources/page_list.ts";
import type { NewIndex, OutlineEntry, PageSource, Typography } from "../sources/page_source.ts";
import type { SearchHit } from "../text/searching.ts";
import type { Viewer, ViewerOptions } from "../viewer/viewer.ts";
import { elementTexts, fill, languageOf } from "../words/languages.ts";
import { allowsGesture } from "./attribute_options.ts";
import type { BookTextOverlay, TextTarget } from "./book_text_overlay.ts";
import type { LivePages } from "./live_pages.ts";
import { pageTap } from "./page_tap.ts";
import type { RollView } from "./roll_view.ts";
import { watchTransformation } from "./watch_transformation.ts";

/** The callbacks between an element and the life of its book. */
export interface LifecycleHooks {
  /** Loads what is needed before a book opens. Never rejects. */
  prepare(): Promise<void>;
  /**
   * Finds where a book was left, once it is read. Never rejects.
   *
   * @param src the element's address of it
   */
  restore(source: PageList, src: string): Promise<void>;
  /** The open book is about to close for another, which has been read. */
  replacing(): void;
  /** How the stage is seen in the window. */
  readonly plane: ElementPlane;
  /** How a book is shown. */
  options(source: PageList): ViewerOptions;
  /** Turns one leaf forward (1) or back (-1), as `InputTarget` has it. */
  readonly turn: (by: 1 | -1, isTap?: boolean) => Promise<boolean>;
  /** Announces to screen readers the zoom level to which a key leads. */
  readonly announceZoom: () => void;
  /** Turns the open book to a page (from 1), and to a place so far down it, as `top` of `LinkTarget`. */
  readonly goTo: (page: number, top?: number) => void;
  /** The open book is about to close, to be opened again where it lies. */
  leaving(): void;
  /** How the text of a book is set that is about to be read. */
  readonly typography: () => Typography;
  /** The password of a protected file; "" if none is known. */
  readonly password: () => string;
  /** Asks the reader for the password of a protected file; null if there is none, or once `signal` aborts. */
  readonly askPassword: (isWrong: boolean, signal: AbortSignal) => Promise<string | null>;
  /** Returns whether the reader prefers reduced motion. */
  readonly calm: () => boolean;
  /** A book lies open. */
  opened(book: OpenBook): void;
  /** The open book's source is about to change its pages, by calling `change`. */
  changing(change: () => NewIndex): void;
  /** The leaves of the open book have the size of its pages, which had to be guessed until now. */
  measured(): void;
  /** The pages of the open book, so many before, lie elsewhere: it is about to be bound anew. */
  renumbered(moved: NewIndex, pageCount: number): void;
  /** What cannot be shown of the open book may be another list. */
  warned(): void;
  /** An optional part of the viewer could not be loaded. */
  readonly missingPart: (error: unknown) => void;
  /** A book could not be opened; another may still be open. */
  failed(error: unknown): void;
}

/** Returns the absolute address in an attribute; undefined if there is none. */
function addressIn(element: Element, attribute: string): string | undefined {
  const address = element.getAttribute(attribute);
  return address ? new URL(address, element.baseURI).href : undefined;
}

/** Returns the absolute address in `pdf-worker`; undefined if there is none. */
export function pdfWorkerOf(element: Element): string | undefined {
  return addressIn(element, "pdf-worker");
}

/** Holds at most one book that is shown, and one that is being read to take its place. */
export class BookLifecycle {
  readonly #element: HTMLElement;
  readonly #stage: HTMLElement;
  readonly #hooks: LifecycleHooks;
  #book: OpenBook | null = null;
  /** Ends the book that is shown, or is about to be. */
  #showing: AbortController | null = null;
  /** Settles once the viewer of that book is there, or failed. */
  #shown: Promise<unknown> = Promise.resolve();
  /** Ends the reading of the next book. */
  #reading: AbortController | null = null;
  #canvas: HTMLCanvasElement | null = null;
  /** Whether the canvas is that of a book that was closed, for the one that is opening. */
  #isSpare = false;
  #elements: BookElements | null = null;

  /**
   * @param element whose keys turn pages
   *
   * @param stage the place for the canvas, which has its size
   */
  constructor(element: HTMLElement, stage: HTMLElement, hooks: LifecycleHooks) {
    this.#element = element;
    this.#stage = stage;
    this.#hooks = hooks;
  }

  /** The open book, if there is one. */
  get book(): OpenBook | null {
    return this.#book;
  }

  /** Whether no book is open or opening. */
  get isIdle(): boolean {
    return this.#showing === null && !this.isReading;
  }

  /** Whether a book is being read, or about to be shown. */
  get isOpening(): boolean {
    return this.isReading || (this.#showing !== null && this.#book === null);
  }

  /** Whether a book is being read that is to replace the open one, if there is one. */
  get isReading(): boolean {
    return this.#reading !== null;
  }

  /**
   * Opens a book. The open one stays until it can be replaced; one that is
   * still being read is given up.
   *
   * @param src the element's address of the book
   */
  open(input: BookInput, src: string): void {
    this.#reading?.abort();
    const reading = new AbortController();
    this.#reading = reading;
    this.#run(reading, this.#read(input, src, reading));
  }

  /** Closes the open or opening book, and frees its resources. */
  close(): void {
    this.#reading?.abort();
    this.#reading = null;
    this.#end(false);
  }

  /** Reports the failure of a book, unless it was given up. */
  #run(controller: AbortController, opening: Promise<void>): void {
    opening.catch((error: unknown) => {
      if (controller.signal.aborted) return;
      if (this.#reading === controller) this.#reading = null;
      // Without another book the canvas that waits for this one goes too.
      if (this.#showing === controller || this.isIdle) this.#end(false);
      this.#hooks.failed(error);
    });
  }

  /** Ends the book that is shown or about to be, and closes its source. */
  #end(keepCanvas: boolean): void {
    const source = this.#book?.source;
    this.#endViewer(keepCanvas);
    this.#elements?.destroy();
    this.#elements = null;
    source?.close();
  }

  /**
   * Ends the open book except its source and elements, or the opening of its viewer.
   *
   * @param keepCanvas whether the next book may be drawn on its canvas
   */
  #endViewer(keepCanvas = false): void {
    this.#showing?.abort();
    this.#showing = null;
    if (this.#canvas && this.#isSpare) giveUpContext(this.#canvas);
    this.#isSpare = this.#book?.destroy(keepCanvas) ?? false;
    this.#book = null;
    if (this.#isSpare) this.#canvas?.removeAttribute("aria-label");
    else this.#removeCanvas();
  }

  /** Reads a book, and shows it in place of the open one. */
  async #read(input: BookInput, src: string, reading: AbortController): Promise<void> {
    const { signal } = reading;
    // An element that shows no book yet does not need the code that reads one.
    const opening = loadPart(import("../sources/open.ts"));
    const [{ openList }] = await Promise.all([opening, this.#hooks.prepare()]);
    const listing = openList(input, {
      signal,
      pdfWorker: pdfWorkerOf(this.#element),
      typography: this.#hooks.typography(),
      password: this.#hooks.password(),
      askPassword: (isWrong) => this.#hooks.askPassword(isWrong, signal),
    });
    // A context makes the page wait for the process that draws: once what reads the book is under way.
    if (!signal.aborted && this.#canvas === null) this.#prepareCanvas();
    const source = await listing;
    try {
      // Another book may have been asked for since.
      signal.throwIfAborted();
      // The open book is given up only for one that has a page; elements have none before they are laid out.
      if (this.#book && !hasElements(source)) await checkPages(source, signal);
      await this.#hooks.restore(source, src);
      // One that is replacing another already is shown before it is replaced itself.
      await this.#shown;
      signal.throwIfAborted();
    } catch (error) {
      source.close();
      throw error;
    }
    this.#reading = null;
    if (this.#book) this.#hooks.replacing();
    // Otherwise the canvas waits for this book.
    if (this.#showing) this.#end(true);
    this.#showing = reading;
    this.#elements = new BookElements(this.#element, this.#stage, source, this.#hooks.goTo);
    await this.#show(source, false, signal);
  }

  /** Shows the book whose graphics card failed with the canvas backend, at the same page. */
  #flatten({ source }: OpenBook): void {
    this.#hooks.leaving();
    this.#endViewer();
    const showing = new AbortController();
    this.#showing = showing;
    this.#run(showing, this.#show(source, true, showing.signal));
  }

  /** As `#openViewer`; what is read meanwhile waits for it. */
  #show(source: PageList, isFlat: boolean, signal: AbortSignal): Promise<void> {
    const shown = this.#openViewer(source, isFlat, signal);
    this.#shown = shown.catch(() => {});
    return shown;
  }

  /**
   * Shows a book, which is then this one's to close.
   *
   * @param isFlat whether to use the canvas backend
   */
  async #openViewer(source: PageList, isFlat: boolean, signal: AbortSignal): Promise<void> {
    try {
      // Another book may be open by now, on the canvas that this one would remove.
      signal.throwIfAborted();
      const elements = this.#elements as BookElements;
      await elements.adopt(source);
      signal.throwIfAborted();
      const options: ViewerOptions = {
        ...this.#hooks.options(source),
        onContextLost: () => this.#book && this.#flatten(this.#book),
      };
      const fresh = (): HTMLCanvasElement => this.#freshCanvas();
      const showing = { ...this.#how, isFlat };
      const viewer = await openViewer(fresh, source, options, signal, showing);
      if (signal.aborted) viewer.destroy();
      signal.throwIfAborted();
      const canvas = this.#canvas as HTMLCanvasElement;
      const roll = await this.#rollOver(source, viewer).catch((error: unknown) => {
        viewer.destroy();
        throw error;
      });
      if (signal.aborted) {
        roll?.destroy();
        viewer.destroy();
      }
      signal.throwIfAborted();
      const parts = { canvas, source, viewer, elements, roll };
      this.#book = new OpenBook(this.#element, this.#stage, parts, this.#hooks);
      // Only now: the element asks for this book when its first layout is reported.
      this.#book.fit();
    } catch (error) {
      source.close();
      throw error;
    }
    this.#hooks.opened(this.#book);
    source.watchPages((change) => {
      const book = this.#book;
      if (book?.source === source) this.#hooks.changing(change);
    });
    source.watchSizes(() => {
      const book = this.#book;
      if (book?.source !== source) return;
      book.measure().then(() => this.#hooks.measured(), this.#hooks.missingPart);
    });
    const warned = (): void => {
      if (this.#book?.source === source) this.#hooks.warned();
    };
    source.watchWarnings(warned);
    warned();
    source.watchDrawings((index) => {
      if (this.#book?.source !== source) return;
      this.#book.viewer.redraw(index + 1);
      this.#book.roll?.redraw(index + 1);
    });
  }

  /** Lays out the pages of a book that are scrolled; null if all are turned. */
  async #rollOver(source: PageList, viewer: Viewer): Promise<RollView | null> {
    if (!hasRolls(source)) return null;
    const { RollView } = await loadPart(import("./roll_view.ts"));
    return new RollView({
      ...{ host: this.#element, stage: this.#stage, source, viewer, plane: this.#hooks.plane },
    });
  }

  /** How a book is shown, if its graphics card does not fail. */
  get #how(): Showing {
    return { engineSrc: addressIn(this.#element, "engine-src") ?? "" };
  }

  /** Makes the first canvas, and loads what will draw on it, while the book is read. */
  #prepareCanvas(): void {
    prepareViewer(() => this.#freshCanvas(), this.#how);
    this.#isSpare = true;
  }

  /**
   * The canvas of the book before, whose context is as good as new and costs nothing: a
   * context that is given up leaves memory in the process that draws (in Chromium).
   * One whose context was released cannot be used again, and another takes its place.
   *
   * @csspart canvas The picture of the book.
   */
  #freshCanvas(): HTMLCanvasElement {
    if (this.#canvas && this.#isSpare) {
      this.#isSpare = false;
      return this.#canvas;
    }
    this.#removeCanvas();
    const canvas = document.createElement("canvas");
    canvas.setAttribute("part", "canvas");
    canvas.setAttribute("role", "img");
    // Before everything that lies on it.
    this.#stage.prepend(canvas);
    this.#canvas = canvas;
    return canvas;
  }

  #removeCanvas(): void {
    this.#canvas?.remove();
    this.#canvas = null;
  }
}

/** Pages of a book that are elements: the code that lays them out is loaded when there is one. */
export class BookElements {
  readonly #element: HTMLElement;
  readonly #stage: HTMLElement;
  readonly #source: PageList;
  readonly #goTo: LifecycleHooks["goTo"];
  #live: LivePages | null = null;
  #isEnded = false;
  #viewer: Viewer | null = null;

  constructor(
    element: HTMLElement,
    stage: HTMLElement,
    source: PageList,
    goTo: LifecycleHooks["goTo"],
  ) {
    this.#element = element;
    this.#stage = stage;
    this.#source = source;
    this.#goTo = goTo;
  }

  /** Lays out the pages of a source that are elements: the book's own, or one to be added. */
  async adopt(source: PageSource): Promise<void> {
    if (!hasElements(source)) return;
    const { LivePages } = await loadPart(import("./live_pages.ts"));
    if (this.#isEnded) return;
    this.#live ??= this.#lay(LivePages);
    this.#live.adopt(source, source === this.#source);
  }

  /** Makes a change of the pages, and follows it. */
  after(change: () => NewIndex): NewIndex {
    const moved = change();
    this.refresh();
    return moved;
  }

  /** Lays out the elements that are pages now, and no others. */
  refresh(): void {
    this.#live?.adopt(this.#source);
  }

  /** Shows them over the pages of a viewer. */
  follow(viewer: Viewer): void {
    this.#viewer = viewer;
    this.#live?.follow(viewer, this.#source);
  }

  /** Removes their places. */
  destroy(): void {
    this.#isEnded = true;
    this.#live?.destroy();
  }

  #lay(Live: typeof LivePages): LivePages {
    const source = this.#source;
    const live = new Live(this.#element, this.#stage, {
      name: (page) => {
        const { pageNamed } = elementTexts(languageOf(this.#element));
        return fill(pageNamed, { label: source.label(page - 1) });
      },
      pageOf: (element) => {
        for (let index = 0; index < source.pageCount; index++) {
          if (source.element(index) === element) return index + 1;
        }
        return 0;
      },
      goTo: this.#goTo,
    });
    if (this.#viewer) live.follow(this.#viewer, source);
    return live;
  }
}

function hasElements(source: PageSource): boolean {
  for (let index = 0; index < source.pageCount; index++) if (source.element?.(index)) return true;
  return false;
}

function hasRolls(source: PageSource): boolean {
  for (let index = 0; index < source.pageCount; index++) {
    if ((source.roll?.(index) ?? null) !== null) return true;
  }
  return false;
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
  readonly #input: Input;
  readonly #renumbered: LifecycleHooks["renumbered"];
  readonly #plane: ElementPlane;
  readonly #ended = new AbortController();

  constructor(
    element: HTMLElement,
    stage: HTMLElement,
    { canvas, source, viewer, elements, roll }: OpenBookParts,
    hooks: LifecycleHooks,
  ) {
    const { turn, announceZoom, calm, goTo, missingPart, plane } = hooks;
    this.#renumbered = (moved, pageCount) => hooks.renumbered(moved, pageCount);
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
      tapped: () => stage.dispatchEvent(new Event(pageTap)),
    });
    const language = (): string => languageOf(element);
    this.reading = new ReadableBook({ source, viewer, canvas, roll, goTo, language }, missingPart);
    this.#element = element;
    this.#stage = stage;
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
    const isMade = await this.viewer.changePages(() => {
      const { pageCount } = this.source;
      const moved = this.elements.after(change);
      // Changes that wait for the same rest are made one after the other, and then reported.
      this.#renumbered(moved, pageCount);
      followed?.();
      return moved;
    });
    if (isMade) this.reading.changed();
    return isMade;
  }

  /**
   * Makes a change of the pages that their source asks for, as `changePages` does: the open pages
   * keep their sides, however many are counted before them.
   */
  followSource(change: () => NewIndex): Promise<boolean> {
    return this.changePages(() => {
      this.#keepSide();
      return change();
    });
  }

  #keepSide(): void {
    const { binding, turning } = this.viewer;
    if (binding.layout !== "spread") return;
    const sides = [leftPage(binding, turning.spread), rightPage(binding, turning.spread)];
    const [first = null, second = null] = binding.reversed ? sides.reverse() : sides;
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
    const stage = this.#stage;
    const view = this.#element.ownerDocument.defaultView ?? window;
    const plane = this.#plane;
    // As it was measured last: a change of style says nothing of it.
    let pixels: ResizeObserverSize | undefined;
    const resize = (): void => {
      const { clientWidth, clientHeight } = stage;
      if (clientWidth > 0 && clientHeight > 0) {
        // Printed, it is as on the screen, scaled.
        stage.style.setProperty("--screen-width", `${clientWidth}px`);
        stage.style.setProperty("--screen-height", `${clientHeight}px`);
        const ratio = view.devicePixelRatio;
        // Whole pixels of the screen, so that those of the canvas are these.
        const width = wholePixels(clientWidth * ratio, pixels?.inlineSize);
        const height = wholePixels(clientHeight * ratio, pixels?.blockSize);
        this.viewer.resize(width / ratio, height / ratio, ratio, rounded(plane.scale));
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

/** The text and the contents of an open book. */
export class ReadableBook {
  readonly #under: TextTarget;
  readonly #ended = new AbortController();
  /** Rejects with a `BookError` if it cannot be loaded. */
  readonly #text: Promise<BookTextOverlay>;
  /** It, once it is loaded. */
  #overlay: BookTextOverlay | null = null;

  /** @param failed called once if there will be no text */
  constructor(under: TextTarget, failed: (error: unknown) => void) {
    this.#under = under;
    const { signal } = this.#ended;
    this.#text = loadPart(import("./book_text_overlay.ts")).then(({ BookTextOverlay }) => {
      signal.throwIfAborted();
      this.#overlay = new BookTextOverlay(under, signal);
      return this.#overlay;
    });
    this.#text.catch((error: unknown) => signal.aborted || failed(error));
  }

  /** As the element's own. */
  async search(
    query: string,
    signal?: AbortSignal,
    found?: (hits: readonly SearchHit[]) => void,
  ): Promise<readonly SearchHit[]> {
    const ended = this.#ended.signal;
    const either = signal ? AbortSignal.any([signal, ended]) : ended;
    return (await this.#text).search(query, either, found);
  }

  /**
   * Marks a hit and every other place of its query when they become visible;
   * null removes the marks.
   */
  mark(hit: SearchHit | null): void {
    this.#withText((text) => text.mark(hit));
  }

  /** As `BookTextOverlay` has it; null while that is not loaded. */
  columnAt(
    ...place: Parameters<BookTextOverlay["columnAt"]>
  ): ReturnType<BookTextOverlay["columnAt"]> {
    return this.#overlay?.columnAt(...place) ?? null;
  }

  /** Reads the pages again after a change of the book. */
  changed(): void {
    this.#withText((text) => text.changed());
  }

  /** As the element's own. */
  async outline(): Promise<readonly OutlineEntry[]> {
    return (await this.#under.source.outline?.(this.#ended.signal)) ?? [];
  }

  /** Removes the text and ends every search. */
  destroy(): void {
    this.#ended.abort();
  }

  /** Calls `act` once the text is loaded. If it cannot be loaded, `failed` has reported that. */
  #withText(act: (text: BookTextOverlay) => void): void {
    this.#text.then(
      (text) => this.#ended.signal.aborted || act(text),
      () => {},
    );
  }
}
