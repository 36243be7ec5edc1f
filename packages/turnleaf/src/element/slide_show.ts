/** Turns the pages by itself, one after another. */

/** Default of the seconds for which a page is shown, and the minimum and the maximum. */
const usual = 6;
const [least, most] = [1, 3600];

/** The part of the element that a slide-show needs. */
interface ShownBook extends HTMLElement {
  readonly page: number;
  readonly pageCount: number;
  next(): Promise<boolean>;
}

/** A slide-show of one book; while it does not play, no timer runs. */
export class SlideShow {
  readonly #book: ShownBook;
  readonly #changed: () => void;
  #timer = 0;
  #seconds = usual;
  #playing = false;

  /** @param changed called when it started or stopped */
  constructor(book: ShownBook, changed: () => void) {
    this.#book = book;
    this.#changed = changed;
  }

  get playing(): boolean {
    return this.#playing;
  }

  /** Starts, or changes the pace. */
  play(seconds: number = usual): void {
    this.#seconds = seconds >= least && seconds <= most ? seconds : usual;
    this.#wait();
    if (this.#playing) return;
    this.#playing = true;
    // A page turned to by the reader is shown as long as any other.
    this.#book.addEventListener("pagechange", this.#wait);
    this.#changed();
  }

  /** Ends. */
  pause(): void {
    clearTimeout(this.#timer);
    this.#book.removeEventListener("pagechange", this.#wait);
    if (!this.#playing) return;
    this.#playing = false;
    this.#changed();
  }

  readonly #wait = (): void => {
    clearTimeout(this.#timer);
    this.#timer = window.setTimeout(() => void this.#turn(), this.#seconds * 1000);
  };

  async #turn(): Promise<void> {
    const { page } = this.#book;
    await this.#book.next();
    // At the last page, it is over.
    if (this.#playing && this.#book.page === page) this.pause();
  }
}
