/** How flowing text is set: by the element's attributes, for the size in which pages are shown. */

import type { PageList } from "../sources/page_list.ts";
import type { PageSize, Typography } from "../sources/page_source.ts";
import { paperback } from "../sources/typeset/page_measures.ts";
import type { OpenBook } from "./open_book.ts";
import { differs, type ExpectedPage, expectedPage, mayBeShown, PageShown } from "./page_shown.ts";
import { type ChosenTypography, typographyOf } from "./typography.ts";

/** Sets the text of one element's books. */
export class TextSetting {
  readonly #element: Element;
  readonly #place: HTMLElement;
  readonly #book: () => OpenBook | null;
  readonly #failed: (error: unknown) => void;
  /** The size for which text is set. */
  readonly #pageShown = new PageShown(
    () => this.#shownPage(),
    () => this.setAnew(),
  );
  /** What was chosen as the last book was read, as text. */
  #taken = "";
  /** Whether a reader's choices are being restored to the attributes. */
  #isRestoring = false;

  /**
   * @param place in which books are shown where no panel lies beside them
   * @param book returns the open book
   * @param failed called where text could not be set anew
   */
  constructor(
    element: Element,
    place: HTMLElement,
    book: () => OpenBook | null,
    failed: (error: unknown) => void,
  ) {
    this.#element = element;
    this.#place = place;
    this.#book = book;
    this.#failed = failed;
  }

  /** Whether text is about to be set for another size. */
  get isPending(): boolean {
    return this.#pageShown.isPending;
  }

  /** Whether attributes say otherwise than when the last book was read. */
  get isOutdated(): boolean {
    return this.#chosen !== this.#taken;
  }

  /** The size for which text is set, CSS pixels; 0 if it is unknown. */
  get size(): PageSize {
    const { width, height } = this.#pageShown.size;
    return { width, height };
  }

  /**
   * Returns how the text of a book is set that is about to be read.
   *
   * @param kept the size for which it was set when its reader left it: its pages end where they did, unless
   * they are about to be shown in clearly another one
   * @param source of the book, if that is open already
   */
  take(kept?: PageSize, source: PageList | null = null): Typography {
    const typography = typographyOf(this.#element);
    this.#taken = JSON.stringify(typography);
    const expected = expectedPage(this.#element, this.#place, source, null, typography);
    this.#pageShown.size = kept && mayBeShown(kept, expected) ? kept : expected;
    return this.#setFor(typography);
  }

  /**
   * Has a function restore a reader's choices to the attributes, before a book is shown: its text is
   * set anew once, by all of them. Resolves to what that resolves to.
   */
  async restore<Found>(
    source: PageList,
    restore: (typography: (kept?: PageSize) => Typography) => Promise<Found>,
  ): Promise<Found> {
    const before = this.#chosen;
    let size: PageSize | undefined;
    this.#isRestoring = true;
    try {
      return await restore((kept) => {
        size = kept;
        return this.take(kept, source);
      });
    } finally {
      this.#isRestoring = false;
      if (this.#chosen !== before) this.take(size, source);
    }
  }

  /** Call it when an attribute of the text has changed. */
  attributeChanged(): void {
    if (!this.#isRestoring) void this.setAnew();
  }

  /** Sets the text of the open book anew, by what the attributes say. */
  async setAnew(): Promise<void> {
    const typography = typographyOf(this.#element);
    // Larger type may have one page shown instead of two, or wider ones.
    const expected = this.#expectedPage(typography);
    if (expected.layout === (this.#book()?.viewer.binding.layout ?? "spread"))
      this.#pageShown.take();
    else this.#pageShown.size = expected;
    try {
      await this.#book()?.source.typeset?.(this.#setFor(typography));
    } catch (error) {
      this.#failed(error);
    }
  }

  /** Call it when pages may be shown in another size. */
  follow(): void {
    this.#pageShown.follow();
  }

  /** Call it when the book closes. */
  stop(): void {
    this.#pageShown.stop();
  }

  get #chosen(): string {
    return JSON.stringify(typographyOf(this.#element));
  }

  #setFor(typography: ChosenTypography): Typography {
    const { width, height } = this.#pageShown.size;
    return { ...typography, width, height };
  }

  #expectedPage(typography: ChosenTypography): ExpectedPage {
    const book = this.#book();
    const [source, layout] = [book?.source ?? null, book?.viewer.binding.layout ?? null];
    return expectedPage(this.#element, this.#place, source, layout, typography);
  }

  /**
   * Returns how large pages of flowing text are shown, or are to be if that is of another shape; null while
   * it is unknown.
   */
  #shownPage(): PageSize | null {
    const book = this.#book();
    const width = book?.source.typeset ? book.viewer.extent.pageWidth : 0;
    if (width === 0) return null;
    const leaf = book?.source.leaf ?? paperback;
    const expected = this.#expectedPage(typographyOf(this.#element));
    const height = (width * leaf.height) / leaf.width;
    const isOther = differs(expected.width / expected.height, width / height);
    return isOther ? expected : { width, height };
  }
}
