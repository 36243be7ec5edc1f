/** The width for which flowing text is set: that at which pages are shown, in steps. */

import { coverFor } from "../book/layout.ts";
import type { Layout } from "../book/spreads.ts";
import type { PageSource } from "../sources/page_source.ts";
import { isMiniature, mayFace, paperback } from "../sources/typeset/page_measures.ts";
import { layoutIn } from "../stage/page_width.ts";
import { bindingOptionsOf } from "./attributes.ts";
import type { ChosenTypography } from "./typography.ts";

/**
 * The fraction by which pages may be shown larger or smaller than they are set: of type of 16 px,
 * half a pixel. Within it a change of size sets nothing anew.
 */
const step = 1 / 32;

/** Milliseconds for which a size stays before text is set for it: an edge that is dragged moves with every frame. */
const settling = 200;

/**
 * Returns in which layout and about how wide pages of flowing text are about to be shown in an element, as
 * its attributes say; 0 if its place has no size.
 *
 * @param place in which the book is shown
 * @param source of the open book; null for one that is not open yet
 */
export function expectedWidth(
  element: Element,
  { clientWidth: width, clientHeight: height }: Element,
  source: Pick<PageSource, "cover" | "layout" | "pageCount"> | null,
  typography: ChosenTypography,
): { readonly layout: Layout; readonly width: number } {
  const { binding, cover: said, layout, margin } = bindingOptionsOf(element);
  const requested = layout === "auto" ? (source?.layout ?? "auto") : layout;
  const pageCount = source?.pageCount ?? Number.POSITIVE_INFINITY;
  const { cover } = coverFor(said, source?.cover, pageCount);
  const aspect = paperback.width / paperback.height;
  const quarterTurned = binding === "top" || binding === "bottom";
  const frame = { aspect, quarterTurned, cover, margin };
  return layoutIn({ width, height }, requested, null, frame, (...widths) =>
    mayFace(typography, ...widths),
  );
}

/** Follows the width at which pages are shown, and has their text set anew once it is clearly another. */
export class SetWidth {
  /** The width for which text is set, CSS pixels; 0 if it is unknown. */
  width = 0;
  readonly #shown: () => number;
  readonly #changed: () => Promise<void>;
  #timer: ReturnType<typeof setTimeout> | undefined;
  /** How many widths text is being set for. */
  #setting = 0;

  /**
   * @param shown returns how wide pages are shown; 0 while that is unknown
   * @param changed called once `width` is another; resolves once text is set for it
   */
  constructor(shown: () => number, changed: () => Promise<void>) {
    this.#shown = shown;
    this.#changed = changed;
  }

  /** Whether text is about to be set for another width. */
  get isPending(): boolean {
    return this.#timer !== undefined || this.#setting > 0;
  }

  /** Call it when pages may be shown in another size. */
  follow(): void {
    this.stop();
    if (this.#suits()) return;
    this.#timer = setTimeout(() => {
      this.#timer = undefined;
      if (this.#suits()) return;
      this.width = this.#shown();
      this.#setting++;
      void this.#changed().finally(() => this.#setting--);
    }, settling);
  }

  /** Call it when the book closes. */
  stop(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }

  #suits(): boolean {
    const shown = this.#shown();
    // Miniatures are set alike, however small they are.
    if (shown === 0 || (isMiniature(shown) && isMiniature(this.width))) return true;
    return Math.abs(shown / this.width - 1) <= step;
  }
}
