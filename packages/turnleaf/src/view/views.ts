/** Who wants to know when the book is seen otherwise than before. */

/** Listeners to the view of one book. */
export class Views {
  readonly #listeners = new Set<(rests: boolean) => void>();
  /** The view that they were told of last. */
  #told = "";

  /** Adds a listener, who is told whether the book rests; answers how to take it away. */
  add(listener: (rests: boolean) => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /** Tells of a view, once for each; "" stands for none, of a book that moves. */
  tell(view: string): void {
    if (view === this.#told) return;
    this.#told = view;
    for (const listener of this.#listeners) listener(view !== "");
  }

  /** The next view is another one, whatever it is. */
  forget(): void {
    this.#told = "";
  }
}
