/** Notifies listeners of a change of the view. */

/** Listeners to the view of one book. */
export class ViewHistory {
  readonly #listeners = new Set<(rests: boolean) => void>();
  /** The view that was last reported. */
  #last = "";

  /** Adds a listener, called with whether the book rests. Returns a function that removes it. */
  add(listener: (rests: boolean) => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /** Reports a view, once for each; "" stands for none, while the book moves. */
  update(view: string): void {
    if (view === this.#last) return;
    this.#last = view;
    for (const listener of this.#listeners) listener(view !== "");
  }

  /** Reports the next view, whatever it is. */
  forget(): void {
    this.#last = "";
  }
}
