/** A page asked for while no book is open. */

/** The page at which the next book is to open, and the calls that wait for it. */
export class RequestedPage {
  #page: number | null = null;
  #waiting: { page: number; resolve: (lies: boolean) => void }[] = [];

  /** The page (from 1) that was asked for last; null where none was. */
  get page(): number | null {
    return this.#page;
  }

  /** Asks for a page. Resolves, once a book is open or could not be opened, to whether it lies open there. */
  ask(page: number): Promise<boolean> {
    this.#page = page;
    return new Promise((resolve) => this.#waiting.push({ page, resolve }));
  }

  /** A book is open; `liesAt` tells whether at the spread of a page. */
  opened(liesAt: (page: number) => boolean): void {
    this.#page = null;
    this.#resolve(liesAt);
  }

  /** No book will open for now. The page stays asked for. */
  failed(): void {
    this.#resolve(() => false);
  }

  #resolve(lies: (page: number) => boolean): void {
    const waiting = this.#waiting;
    this.#waiting = [];
    for (const { page, resolve } of waiting) resolve(lies(page));
  }
}
