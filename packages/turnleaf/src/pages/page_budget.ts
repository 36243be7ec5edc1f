import type { PagePicture } from "../sources/page_source.ts";

/** A page that is wanted `width` device pixels wide. */
export interface WantedPage {
  /** From 0. */
  readonly index: number;
  readonly width: number;
  /** That width is rough already: it is not drawn more roughly before. */
  readonly isRough?: boolean;
}

/** A picture that the pool holds. */
export interface Held {
  readonly picture: PagePicture;
  /** The width that was asked for; a source may draw narrower than that. */
  readonly asked: number;
  readonly bytes: number;
}

/** How much may be held at once. */
export interface Bounds {
  readonly pages: number;
  readonly bytes: number;
  /** The first so many wanted pages are held whatever they take. */
  readonly always: number;
}

/** Height over width of a page of which nothing is known yet. */
const usualRatio = 1.5;

/** What a picture takes in memory: 4 bytes a pixel. */
export function pictureBytes(picture: PagePicture): number {
  return 4 * picture.width * picture.height;
}

/**
 * Held pages in the order in which they are dropped: first those that are not
 * wanted, the farthest from every wanted page foremost; then the wanted ones,
 * the least urgent foremost.
 */
export function dropOrder(
  wanted: readonly WantedPage[],
  held: ReadonlyMap<number, Held>,
): readonly number[] {
  const rank = (index: number): number => {
    const place = wanted.findIndex((page) => page.index === index);
    if (place >= 0) return place;
    const distances = wanted.map((page) => Math.abs(page.index - index));
    return wanted.length + Math.min(...distances);
  };
  const ranked = [...held.keys()].map((index) => ({ index, rank: rank(index) }));
  return ranked.sort((a, b) => b.rank - a.rank).map(({ index }) => index);
}

/**
 * The wanted pages that can be held all at once, taken in their order: drawing
 * another would drop one of them, which would be drawn again, and so on without
 * end.
 * @param ratios height over width of every page that was drawn before
 */
export function withinBudget(
  wanted: readonly WantedPage[],
  held: ReadonlyMap<number, Held>,
  bounds: Bounds,
  ratios: ReadonlyMap<number, number>,
): Set<number> {
  const fitting = new Set<number>();
  let bytes = 0;
  for (const page of wanted) {
    const have = held.get(page.index);
    const isSharp = have !== undefined && have.asked >= page.width;
    const ratio = ratios.get(page.index) ?? usualRatio;
    bytes += isSharp ? have.bytes : 4 * page.width * page.width * ratio;
    const isOver = fitting.size >= bounds.pages || bytes > bounds.bytes;
    if (isOver && fitting.size >= bounds.always) break;
    fitting.add(page.index);
  }
  return fitting;
}
