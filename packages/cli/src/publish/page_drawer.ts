/** Books drawn page by page in a headless Chromium of its own. */

import { appFiles } from "../app_files.ts";
import type { ServedBook, ServedFile } from "../book.ts";
import { ChromiumPage } from "../chromium/devtools.ts";
import { Problem } from "../problem.ts";
import { type Serving, serve } from "../server.ts";
import type { DrawnPage, DrawOptions, OpenedBook, UnshownPart } from "./drawn_page.ts";

/** Milliseconds that a browser has to start or to leave a page. */
const startingTime = 60_000;

/**
 * Nothing but this machine is reached, and letters and pictures are drawn the
 * same on machines with other settings and without a graphics card.
 */
const flags = [
  "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
  "--font-render-hinting=none",
  "--disable-accelerated-2d-canvas",
  "--disable-gpu",
];

/** An operation that took longer than it may; the browser was ended. */
export class TookTooLong extends Problem {}

/** One browser, which has one book open at a time. */
export class PageDrawer {
  readonly #chromium: string;
  /** Milliseconds that drawing a page may take. */
  readonly #patience: number;
  #page: ChromiumPage | null = null;
  #serving: Serving | null = null;
  #count = 0;
  #isClosed = false;

  constructor(chromium: string, patience: number) {
    this.#chromium = chromium;
    this.#patience = patience;
  }

  /**
   * Opens a book.
   *
   * @param until wall-clock time at which it is given up: of text, all has to be laid out
   * @throws Problem if it cannot be opened
   */
  async open(book: ServedBook, name: string, until: number): Promise<OpenedBook> {
    await this.#closeBook();
    const app = await appFiles("publish/draw.html").catch(() => new Map<string, ServedFile>());
    if (!app.has("/")) throw new Problem("The reader is not built; run: npm run build");
    // The page's own address has no name that a book may have.
    this.#serving = await serve(new Map([...book.files, ...app]), 0);
    this.#page ??= await ChromiumPage.start(this.#chromium, 800, 600, flags);
    if (this.#isClosed) {
      // Closed while it started.
      await this.#end();
      throw new Problem("The browser has ended.");
    }
    const token = ++this.#count;
    const { url } = this.#serving;
    await this.#within(startingTime, "The browser", async (page) => {
      await page.goTo(`${url}?${token}`);
      await page.evaluate(`new Promise((resolve) => {
        const look = () => location.search === "?${token}" && globalThis.drawing ? resolve() : setTimeout(look, 10);
        look();
      })`);
    });
    const config = JSON.stringify({ src: book.src, name });
    const opened = await this.#within(Math.max(until - Date.now(), 0), name, (page) =>
      page.evaluate<OpenedBook | { readonly failed: string }>(`drawing.open(${config})`),
    );
    if ("failed" in opened) throw new Problem(opened.failed);
    return opened;
  }

  /**
   * Draws page `index` (from 0) of the open book.
   *
   * @throws TookTooLong, after which the book has to be opened again
   */
  async draw(index: number, options: DrawOptions): Promise<DrawnPage> {
    return await this.#within(this.#patience, `Page ${index + 1}`, (page) =>
      page.evaluate<DrawnPage>(`drawing.page(${index}, ${JSON.stringify(options)})`),
    );
  }

  /** Returns what the open book lists and cannot be shown, as far as its pages were drawn. */
  async warnings(): Promise<readonly UnshownPart[]> {
    return await this.#within(this.#patience, "The book", (page) =>
      page.evaluate<UnshownPart[]>("drawing.warnings()"),
    );
  }

  /** Ends the browser for good. Whatever is under way rejects. */
  async close(): Promise<void> {
    this.#isClosed = true;
    await this.#end();
  }

  /** Ends the browser; the next book gets another. */
  async #end(): Promise<void> {
    const page = this.#page;
    this.#page = null;
    await page?.close();
    await this.#closeBook();
  }

  async #closeBook(): Promise<void> {
    const serving = this.#serving;
    this.#serving = null;
    await serving?.close();
  }

  async #within<Result>(
    milliseconds: number,
    what: string,
    work: (page: ChromiumPage) => Promise<Result>,
  ): Promise<Result> {
    const page = this.#page;
    if (!page) throw new Problem("The browser has ended.");
    let timer: NodeJS.Timeout | undefined;
    const working = work(page);
    const late = new Promise<never>((_, reject) => {
      timer = setTimeout(() => {
        const seconds = Math.round(milliseconds / 1000);
        reject(new TookTooLong(`${what} took longer than ${seconds} s and was given up.`));
      }, milliseconds);
    });
    try {
      return await Promise.race([working, late]);
    } catch (error) {
      working.catch(() => {});
      // One that hangs or has crashed is of no further use.
      if (error instanceof TookTooLong || page.isGone) await this.#end();
      throw error;
    } finally {
      clearTimeout(timer);
    }
  }
}
