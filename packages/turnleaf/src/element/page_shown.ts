/** The size for which flowing text is set: that in which pages are shown, in steps. */

import { coverFor } from "../book/layout.ts";
import type { Layout } from "../book/spreads.ts";
import type { PageSize, PageSource } from "../sources/page_source.ts";
import { isMiniature, mayFace, paperback, wantedWidth } from "../sources/typeset/page_measures.ts";
import { aspectIn, layoutIn, type PageFrame } from "../stage/page_width.ts";
import { bindingOptionsOf } from "./attribute_options.ts";
import type { ChosenTypography } from "./typography.ts";

/**
 * The fraction by which pages may be shown larger or smaller than they are set, or in other proportions:
 * of type of 16 px, half a pixel. Within it a change of size sets nothing anew.
 */
const step = 1 / 32;

/** The fraction by which pages may be shown otherwise than is expected: how thick a book is, is not known then. */
const mostUnexpected = 1 / 8;

/** Milliseconds for which a size stays before text is set for it: an edge that is dragged moves with every frame. */
const settling = 200;

/** Width over height of the widest page: of one line or two. */
const widest = 4;

/** How pages of flowing text are about to be shown. */
export interface ExpectedPage extends PageSize {
  readonly layout: Layout;
}

/**
 * Returns in which layout and about how large pages of flowing text are about to be shown in an element, as
 * its attributes say, CSS pixels; 0 if its place has no size. They have a paperback's proportions, or are as much
 * wider as good lines need where the place is not high enough for that.
 *
 * @param place in which the book is shown
 * @param source of the open book; null for one that is not open yet
 * @param before the layout in which it is shown, null for one that is not open yet
 */
export function expectedPage(
  element: Element,
  { clientWidth: width, clientHeight: height }: Element,
  source: Pick<PageSource, "cover" | "layout" | "pageCount" | "leaf"> | null,
  before: Layout | null,
  typography: ChosenTypography,
): ExpectedPage {
  const { binding, cover: said, layout, margin } = bindingOptionsOf(element);
  const requested = layout === "auto" ? (source?.layout ?? "auto") : layout;
  const pageCount = source?.pageCount ?? Number.POSITIVE_INFINITY;
  const { cover } = coverFor(said, source?.cover, pageCount);
  const quarterTurned = binding === "top" || binding === "bottom";
  const frame = { aspect: paperback.width / paperback.height, quarterTurned, cover, margin };
  const place = { width, height };
  const isFree = source === null || source.leaf !== undefined;
  const shapedFor = (layout: Layout, line: "facing" | "alone"): PageFrame => {
    if (!isFree || height === 0) return frame;
    const wanted = wantedWidth(typography, line);
    return { ...frame, aspect: aspectIn(place, layout, frame, wanted, widest) };
  };
  const shown = (layout: "auto" | Layout, frame: PageFrame): ExpectedPage => {
    const { aspect } = frame;
    const found = layoutIn(place, layout, before, frame, (width, alone) =>
      mayFace(typography, width, { width: alone, height: alone / aspect }),
    );
    return { ...found, height: found.width / aspect };
  };
  const facing = shapedFor("spread", "facing");
  const each = shown("spread", facing);
  const isRoom = mayFace(typography, each.width, each);
  const single = shown("single", shapedFor("single", isRoom ? "facing" : "alone"));
  // Seen from afar.
  if (isMiniature(single)) return shown(requested, frame);
  const found = requested === "single" ? single : shown(requested, facing);
  return found.layout === "spread" ? found : single;
}

/** Follows the size in which pages are shown, and has their text set anew once it is clearly another. */
export class PageShown {
  /** The size for which text is set, CSS pixels; 0 if it is unknown. */
  size: PageSize = { width: 0, height: 0 };
  readonly #shown: () => PageSize | null;
  readonly #changed: () => Promise<void>;
  #timer: ReturnType<typeof setTimeout> | undefined;
  /** How many sizes text is being set for. */
  #setting = 0;

  /**
   * @param shown returns how large pages are shown, or are to be; null while that is unknown
   * @param changed called once `size` is another; resolves once text is set for it
   */
  constructor(shown: () => PageSize | null, changed: () => Promise<void>) {
    this.#shown = shown;
    this.#changed = changed;
  }

  /** Whether text is about to be set for another size. */
  get isPending(): boolean {
    return this.#timer !== undefined || this.#setting > 0;
  }

  /** Call it when pages may be shown in another size. */
  follow(): void {
    this.stop();
    if (this.#suits()) return;
    this.#timer = setTimeout(() => {
      this.#timer = undefined;
      if (!this.take()) return;
      this.#setting++;
      void this.#changed().finally(() => this.#setting--);
    }, settling);
  }

  /** Takes the size in which pages are shown, if it is clearly another; returns whether it is. */
  take(): boolean {
    if (this.#suits()) return false;
    this.size = this.#shown() ?? this.size;
    return true;
  }

  /** Call it when the book closes. */
  stop(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }

  #suits(): boolean {
    const [set, shown] = [this.size, this.#shown()];
    // Miniatures are set alike, however small they are.
    if (shown === null || (isMiniature(shown) && isMiniature(set))) return true;
    return !differs(shown.width, set.width) && !differs(shown.height, set.height);
  }
}

/** Returns whether pages may be shown in a size that they had before, though another is expected. */
export function mayBeShown(before: PageSize, expected: PageSize): boolean {
  const isOther = (a: number, b: number): boolean => differs(a, b, mostUnexpected);
  return !isOther(before.width, expected.width) && !isOther(before.height, expected.height);
}

/** Returns whether two lengths differ by more than a step, or another fraction. */
export function differs(a: number, b: number, by: number = step): boolean {
  return Math.abs(a / b - 1) > by;
}
