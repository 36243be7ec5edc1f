/** The life of the book in an element: read, shown, replaced, closed. */

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
import type { NewIndex, PageSource, Typography } from "../sources/page_source.ts";
import type { Viewer, ViewerOptions } from "../viewer/viewer.ts";
import { BookElements, hasElements } from "./book_elements.ts";
import { OpenBook, type OpenBookHooks } from "./open_book.ts";
import type { RollView } from "./roll_view.ts";

/** The callbacks between an element and the life of its book. */
export interface LifecycleHooks extends OpenBookHooks {
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
  /** How a book is shown. */
  options(source: PageList): ViewerOptions;
  /** The open book is about to close, to be opened again where it lies. */
  leaving(): void;
  /** How the text of a book is set that is about to be read. */
  readonly typography: () => Typography;
  /** The password of a protected file; "" if none is known. */
  readonly password: () => string;
  /** Asks the reader for the password of a protected file; null if there is none, or once `signal` aborts. */
  readonly askPassword: (isWrong: boolean, signal: AbortSignal) => Promise<string | null>;
  /** A book lies open. */
  opened(book: OpenBook): void;
  /** The open book's source is about to change its pages, by calling `change`. */
  changing(change: () => NewIndex): void;
  /** The leaves of the open book have the size of its pages, which had to be guessed until now. */
  measured(): void;
  /** What cannot be shown of the open book may be another list. */
  warned(): void;
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
  readonly #home: HTMLElement;
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
   * @param home has the size of the place where no panel lies beside it
   */
  constructor(element: HTMLElement, stage: HTMLElement, home: HTMLElement, hooks: LifecycleHooks) {
    this.#element = element;
    this.#stage = stage;
    this.#home = home;
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
      this.#book = new OpenBook(this.#element, this.#stage, this.#home, parts, this.#hooks);
      this.#book.keepOpen();
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

function hasRolls(source: PageSource): boolean {
  for (let index = 0; index < source.pageCount; index++) {
    if ((source.roll?.(index) ?? null) !== null) return true;
  }
  return false;
}
