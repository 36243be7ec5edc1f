/** page-flip 2.0.7 and the drop-in for it, side by side. */

import { PageFlip as Original } from "page-flip/dist/js/page-flip.module.js";
import { type FlipEvents, type FlipSetting, PageFlip } from "../page_flip/index.ts";
import { clock } from "./clock.ts";
import { eventually } from "./eventually.ts";

/** The interface that both have. */
export type Book = PageFlip;
export type BookClass = new (host: HTMLElement, options: Partial<FlipSetting>) => Book;
export const classes: readonly [name: string, made: BookClass][] = [
  ["page-flip", Original as unknown as BookClass],
  ["turnleaf", PageFlip],
];

const events: readonly (keyof FlipEvents)[] = [
  "flip",
  "changeOrientation",
  "changeState",
  "init",
  "update",
];
export const pageSize = { width: 100, height: 150 };

/** Returns elements as pages; the first and the last say that they are boards. */
export function htmlPages(count: number): HTMLElement[] {
  return Array.from({ length: count }, (_, k) => {
    const page = document.createElement("div");
    page.className = "page";
    page.textContent = `Page ${k + 1}`;
    if (k === 0 || k === count - 1) page.dataset.density = "hard";
    return page;
  });
}

/** A book, the host that it is in, the element around that, and what its events have said. */
export interface ShownBook {
  readonly around: HTMLElement;
  readonly host: HTMLElement;
  readonly book: Book;
  readonly log: [name: string, data: unknown][];
}

/** Empties the document of books. page-flip's own would have frames drawn for ever, removed or not. */
export function removeBooks(): void {
  document.body.replaceChildren();
  clock.dropRequests();
}

/** Makes a host of some style, with a book in it. */
export function make(
  made: BookClass,
  options: Partial<FlipSetting> = {},
  style = "width: 400px",
): ShownBook {
  const around = document.createElement("div");
  around.style.cssText = style;
  const host = document.createElement("div");
  around.append(host);
  document.body.append(around);
  const book = new made(host, { ...pageSize, flippingTime: 200, ...options });
  const log: ShownBook["log"] = [];
  for (const name of events) book.on(name, ({ data }) => log.push([name, data]));
  return { around, host, book, log };
}

/** Makes a book of HTML pages, and waits until it is open. */
export async function opened(
  made: BookClass,
  options: Partial<FlipSetting> = {},
  style?: string,
  count = 7,
): Promise<ShownBook & { readonly pages: HTMLElement[] }> {
  const shown = make(made, options, style);
  const pages = htmlPages(count);
  shown.book.loadFromHTML(pages);
  await eventually(() => shown.log.some(([name]) => name === "init")).toBe(true);
  return { ...shown, pages };
}

/**
 * Waits until the open book of the drop-in fills its rectangle at rest. The browser tells of new sizes in
 * its own time: laid out once, the book is measured and laid out anew.
 */
export const fillsRect = (book: PageFlip): Promise<void> =>
  eventually(() => {
    const { width, pageWidth } = book.getBoundsRect();
    const element = book.getBook();
    const shown = element?.settled ? (element.bookBounds?.width ?? 0) : 0;
    return Math.abs(shown - (book.getOrientation() === "portrait" ? pageWidth : width));
  }).toBeLessThan(2);

/** Waits until the last state of a log is `read` again, after others. */
export const hasRead = (
  log: readonly (readonly [string, unknown])[],
  from: number,
): Promise<void> =>
  eventually(() => {
    const states = log.slice(from).filter(([name]) => name === "changeState");
    return states.at(-1)?.[1];
  }).toBe("read");
