/** A page requested while no book is open. */

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
