/** Who wants to know when the book is seen otherwise than before. */

/** Listeners to the view of one book. */
export class ViewHistory {
  readonly #listeners = new Set<(rests: boolean) => void>();
  /** The view that they were told of last. */
  #last = "";

  /** Adds a listener, who is told whether the book rests; answers how to take it away. */
  add(listener: (rests: boolean) => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /** Tells of a view, once for each; "" stands for none, of a book that moves. */
  update(view: string): void {
    if (view === this.#last) return;
    this.#last = view;
    for (const listener of this.#listeners) listener(view !== "");
  }

  /** The next view is another one, whatever it is. */
  forget(): void {
    this.#last = "";
  }
}
