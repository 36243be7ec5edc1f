/** Which images of a book are strips that are scrolled, as of webtoons, and the pages that they take. */

import { sizeFromHeader, typedImage } from "./image_header.ts";
import { limits } from "./limits.ts";
import type { ImageBook, ImagePage } from "./manifest.ts";
import type { OutlineEntry, PageLink, PageSize } from "./page_source.ts";
import { countOfStrip, pagesOfStrip } from "./strips.ts";

/** The proportions of a page of a comic that is printed, where a book has no pages: some 170 by 255 mm. */
const printedRatio = 2 / 3;

/** An image is a strip if, whole on a page of the book, it is less wide than so much of it. */
const leastWidth = 1 / 2;

/** Bytes of an image at hand in which its size is looked for, and images that are looked at at a time. */
const headerLength = 1 << 16;
const atOnce = 8;

/** What a book's pages are. */
export interface PageFormat {
  /** Their usual proportions, width over height. */
  readonly ratio: number;
  /** Whether most images are strips: then a wide one is a wide picture, and no spread. */
  readonly isScrolled: boolean;
}

/** Returns the usual format of images, by their sizes as far as these are known. */
export function formatOf(sizes: readonly (PageSize | null)[]): PageFormat {
  const ratios = sizes.flatMap((size) => (size ? [size.width / size.height] : []));
  const paged = ratios.filter((ratio) => ratio >= printedRatio * leastWidth);
  if (2 * paged.length < ratios.length) return { ratio: printedRatio, isScrolled: true };
  const median = paged.sort((a, b) => a - b)[(paged.length - 1) >> 1];
  return { ratio: median ?? printedRatio, isScrolled: false };
}

/**
 * Returns the pages that an image takes as a strip; null if it is none.
 *
 * @param most pages that it may take; one of more is shown whole
 */
export function stripPages(
  src: ImagePage["src"],
  size: PageSize | null,
  { ratio }: PageFormat,
  most: number,
): ImagePage[] | null {
  if (!size || size.width / size.height / ratio >= leastWidth) return null;
  if (countOfStrip(size, 1 / ratio) > most) return null;
  const page = { width: size.width, height: size.width / ratio };
  return pagesOfStrip(size, 1 / ratio).map((strip) => ({ src, size: page, strip }));
}

/**
 * Returns a book whose strips are pages: those of known size, or at hand, with neither text nor links, which
 * would have to be cut with them. What leads to a page leads to the same picture.
 */
export async function withStrips(book: ImageBook): Promise<ImageBook> {
  const sizes = await sizesOf(book.pages);
  const format = formatOf(sizes);
  const firsts: number[] = [];
  const pages: ImagePage[] = [];
  for (const [k, page] of book.pages.entries()) {
    firsts.push(pages.length + 1);
    const most = limits.pages - pages.length - (book.pages.length - k - 1);
    const isPlain = !page.text && !page.links && !page.part;
    const strip = isPlain ? stripPages(page.src, sizes[k] ?? null, format, most) : null;
    const { label, alt } = page;
    const about = { ...(label ? { label } : {}), ...(alt ? { alt } : {}) };
    pages.push(...(strip?.map((one, at) => (at === 0 ? { ...one, ...about } : one)) ?? [page]));
  }
  if (pages.length === book.pages.length) return book;
  const pageOf = (page: number): number => firsts[page - 1] ?? page;
  return {
    ...book,
    pages: pages.map((page) =>
      page.links ? { ...page, links: linksTo(page.links, pageOf) } : page,
    ),
    ...(book.outline ? { outline: linesTo(book.outline, pageOf) } : {}),
  };
}

/** Returns the sizes of images that are known, or that the headers of those at hand say, and of one alone. */
async function sizesOf(pages: readonly ImagePage[]): Promise<(PageSize | null)[]> {
  const sizes: (PageSize | null)[] = [];
  const waiting = pages.entries();
  const work = async (): Promise<void> => {
    for (const [k, { src, size }] of waiting) {
      const stored = pages.length === 1 && typeof src !== "string" && !(src instanceof Blob);
      const image = stored
        ? await src.read()
        : src instanceof Blob
          ? src.slice(0, headerLength)
          : null;
      sizes[k] = size ?? (image && (await headerSize(image)));
    }
  };
  await Promise.all(Array.from({ length: atOnce }, work));
  return sizes;
}

async function headerSize(image: Blob): Promise<PageSize | null> {
  return await typedImage(image)
    .then(sizeFromHeader)
    .catch(() => null);
}

function linksTo(links: readonly PageLink[], pageOf: (page: number) => number): PageLink[] {
  return links.map((link) =>
    "page" in link.to ? { ...link, to: { ...link.to, page: pageOf(link.to.page) } } : link,
  );
}

function linesTo(lines: readonly OutlineEntry[], pageOf: (page: number) => number): OutlineEntry[] {
  return lines.map((line) => ({
    ...line,
    page: line.page && pageOf(line.page),
    children: linesTo(line.children, pageOf),
  }));
}
