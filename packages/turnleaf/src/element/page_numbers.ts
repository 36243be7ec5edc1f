/** Page numbers: as pages and frameworks give them, as lists, and requested while no book is open. */

/**
 * Returns the number that a value stands for as a page: a number, or text that
 * writes one, as attributes and fields do. Null for anything else, such as NaN,
 * undefined and text without a number. It may lie outside the book.
 */
export function pageNumber(value: unknown): number | null {
  const isNumber = typeof value === "number" || (typeof value === "string" && value.trim() !== "");
  const number = isNumber ? Number(value) : Number.NaN;
  return Number.isNaN(number) ? null : number;
}

const mostListed = 500;
const highestPage = 1_000_000;

/** Returns the valid page numbers of a list: whole, from 1, each once, in order, at most 500. */
export function cleanPages(value: unknown): readonly number[] {
  if (!Array.isArray(value)) return [];
  const pages = value.slice(0, 10_000).filter(isPage);
  return [...new Set(pages)].sort((a, b) => a - b).slice(0, mostListed);
}

/** Returns whether a value is the number of a page. */
export function isPage(value: unknown): value is number {
  return Number.isInteger(value) && (value as number) >= 1 && (value as number) <= highestPage;
}

/** The page at which the next book is to open, and the pending calls. */
export class RequestedPage {
  #page: number | null = null;
  #waiting: { page: number; resolve: (lies: boolean) => void }[] = [];

  /** The page (from 1) requested last, or null. */
  get page(): number | null {
    return this.#page;
  }

  /**
   * Requests a page. Resolves, once a book is open or could not be opened, to
   * whether it lies open there.
   */
  ask(page: number): Promise<boolean> {
    this.#page = page;
    return new Promise((resolve) => this.#waiting.push({ page, resolve }));
  }

  /** Call it when a book is open; `liesAt` returns whether it is at the spread of a page. */
  opened(liesAt: (page: number) => boolean): void {
    this.#page = null;
    this.#resolve(liesAt);
  }

  /** Call it when no book will open for now. The request stays. */
  failed(): void {
    this.#resolve(() => false);
  }

  #resolve(lies: (page: number) => boolean): void {
    const waiting = this.#waiting;
    this.#waiting = [];
    for (const { page, resolve } of waiting) resolve(lies(page));
  }
}
