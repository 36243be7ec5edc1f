/** Turns the pages by itself, one after another. */

/** Seconds that a page is shown where nobody says; the shortest and the longest that are taken. */
const usual = 6;
const [least, most] = [1, 3600];

/** The element, as far as it is shown by itself. */
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

  /** @param changed hears that it began or ended */
  constructor(book: ShownBook, changed: () => void) {
    this.#book = book;
    this.#changed = changed;
  }

  get playing(): boolean {
    return this.#playing;
  }

  /** Begins, or goes on at another pace. */
  play(seconds: number = usual): void {
    this.#seconds = seconds >= least && seconds <= most ? seconds : usual;
    this.#wait();
    if (this.#playing) return;
    this.#playing = true;
    // Whoever turns a page has it for as long as any other.
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
    // Where nothing comes after, it is over.
    if (this.#playing && this.#book.page === page) this.pause();
  }
}
