import type { PagePicture } from "../sources/page_source.ts";

/** A page that is wanted `width` device pixels wide. */
export interface WantedPage {
  /** From 0. */
  readonly index: number;
  readonly width: number;
  /** If true, that width is rough already: no rougher bitmap is drawn first. */
  readonly isRough?: boolean;
}

/** A bitmap that the pool holds. */
export interface HeldPage {
  readonly picture: PagePicture;
  /** The requested width; a source may draw narrower than that. */
  readonly asked: number;
  readonly bytes: number;
}

/** The maximum that may be held at once. */
export interface Bounds {
  readonly pages: number;
  readonly bytes: number;
  /** The first so many wanted pages are held whatever memory they take. */
  readonly always: number;
}

/** Height over width assumed for an unknown page. */
const usualRatio = 1.5;

/**
 * Returns whether a bitmap is as wide as is wanted of its page: just so, as its texels may be pixels
 * of the screen; a rough one may be wider.
 */
export function isAsWanted(page: WantedPage, held: HeldPage | undefined): boolean {
  const asked = held?.asked ?? 0;
  return page.isRough ? asked >= page.width : asked === page.width;
}

/** Returns the memory of a bitmap: 4 bytes per pixel. */
export function pictureBytes(picture: PagePicture): number {
  return 4 * picture.width * picture.height;
}

/**
 * Returns held pages in the order in which they are dropped: first the unwanted
 * ones, starting with the farthest from every wanted page; then the wanted
 * ones, starting with the least urgent.
 */
export function dropOrder(
  wanted: readonly WantedPage[],
  held: ReadonlyMap<number, HeldPage>,
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
 * Returns the wanted pages that can be held all at once, in their order:
 * drawing another would drop one of them, which would be drawn again, and so on
 * without end.
 *
 * @param ratios height over width of every page drawn so far
 */
export function withinBudget(
  wanted: readonly WantedPage[],
  held: ReadonlyMap<number, HeldPage>,
  bounds: Bounds,
  ratios: ReadonlyMap<number, number>,
): Set<number> {
  const fitting = new Set<number>();
  let bytes = 0;
  for (const page of wanted) {
    const have = held.get(page.index);
    const isSharp = have !== undefined && isAsWanted(page, have);
    const ratio = ratios.get(page.index) ?? usualRatio;
    bytes += isSharp ? have.bytes : 4 * page.width * page.width * ratio;
    const isOver = fitting.size >= bounds.pages || bytes > bounds.bytes;
    if (isOver && fitting.size >= bounds.always) break;
    fitting.add(page.index);
  }
  return fitting;
}
