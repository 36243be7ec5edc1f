/** Which images of a book are strips that are scrolled, as of webtoons, or slices of one, and the pages that they take. */

import { sizeFromHeader, typedImage } from "./image_header.ts";
import { limits } from "./limits.ts";
import type { ImageBook, ImagePage, StripPage } from "./manifest.ts";
import type { OutlineEntry, PageLink, PageSize } from "./page_source.ts";
import { areSliced, goesOnAt, type Seam, type Slice } from "./strip_seams.ts";
import { countOfStrip, pagesOfStrip, placeOf, sizeOfSlices } from "./strips.ts";

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
function formatOf(sizes: readonly (PageSize | null)[]): PageFormat {
  const ratios = sizes.flatMap((size) => (size ? [size.width / size.height] : []));
  const paged = ratios.filter((ratio) => ratio >= printedRatio * leastWidth);
  if (2 * paged.length < ratios.length) return { ratio: printedRatio, isScrolled: true };
  const median = paged.sort((a, b) => a - b)[(paged.length - 1) >> 1];
  return { ratio: median ?? printedRatio, isScrolled: false };
}

/** An image of a book, as far as it may be a strip or a slice of one. */
export interface StripImage {
  readonly src: ImagePage["src"];
  /** In pixels; null if it is not known. */
  readonly size: PageSize | null;
  /** Whether it may be cut: it has neither text nor links, and is a whole image. */
  readonly isPlain: boolean;
  /** The folder in which images that follow each other may be slices of a strip; null if it is none. */
  readonly folder: string | null;
}

/** What an image takes of a book's pages. */
export interface PagesOfImage {
  /** The pages of a strip that begin in it; null if it is a page, and no strip. */
  readonly pages: readonly ImagePage[] | null;
  /** Whether its top is on the page before these, as a slice's may be. */
  readonly isOnPageBefore: boolean;
}

/** Which pages the images of a book are. */
export interface StripLayout {
  readonly format: PageFormat;
  /** For each image. */
  readonly images: readonly PagesOfImage[];
}

const onePage: PagesOfImage = { pages: null, isOnPageBefore: false };

/** Lays out images as pages: those that are strips, or slices of one, are cut between their pictures. */
export async function layOutStrips(images: readonly StripImage[]): Promise<StripLayout> {
  const runs = runsOf(images);
  const isSliced = await areSliced(runs.flatMap(seamsOf));
  const format = isSliced
    ? { ratio: printedRatio, isScrolled: true }
    : formatOf(images.map(({ size }) => size));
  const laid: PagesOfImage[] = [];
  let count = 0;
  for (const part of isSliced ? await withoutEnds(runs) : images.map((image) => [image])) {
    const most = limits.pages - count - (images.length - laid.length - part.length);
    const own = stripOf(part, format, most) ?? part.map(() => onePage);
    laid.push(...own);
    count += own.reduce((sum, { pages }) => sum + (pages?.length ?? 1), 0);
  }
  return { format, images: laid };
}

/**
 * Returns images in runs of those that may be slices of one strip: of one width, in one folder, and with
 * pages that can be put together of them.
 */
function runsOf(images: readonly StripImage[]): StripImage[][] {
  const runs: StripImage[][] = [];
  for (const image of images) {
    const run = runs.at(-1);
    const before = run?.at(-1);
    const isNext =
      image.folder !== null &&
      image.folder === before?.folder &&
      image.size !== null &&
      image.size.width === before.size?.width &&
      image.size.width ** 2 / printedRatio <= limits.pixels &&
      image.size.width * image.size.height <= limits.imagePixels &&
      image.isPlain &&
      before.isPlain;
    if (isNext) run?.push(image);
    else runs.push([image]);
  }
  return runs;
}

/** Returns the seams of a run. */
function seamsOf(run: readonly StripImage[]): Seam[] {
  const slices = run.map(({ src, size }) => ({
    size: size ?? { width: 0, height: 0 },
    read: async () => await blobOf(src),
  }));
  return slices.slice(1).map((below, k) => [slices[k] as Slice, below]);
}

/** Returns runs of slices with the first image and the last apart if they are seen to be none, as a cover and credits. */
async function withoutEnds(runs: readonly StripImage[][]): Promise<StripImage[][]> {
  const seams = runs.map(seamsOf);
  const isApart = async (seam: Seam | undefined): Promise<boolean> =>
    seam !== undefined && (await goesOnAt(seam)) === false;
  const isFirstApart = await isApart(seams[0]?.[0]);
  const isLastApart = await isApart(seams.at(-1)?.at(-1));
  const parted = runs.map((run) => [...run]);
  const cover = isFirstApart ? parted[0]?.splice(0, 1) : undefined;
  const credits = isLastApart ? parted.at(-1)?.splice(-1) : undefined;
  return [...(cover ? [cover] : []), ...parted, ...(credits ? [credits] : [])].filter(
    ({ length }) => length > 0,
  );
}

/**
 * Returns the pages of a strip that is one image or several, for each of them; null if it is none.
 *
 * @param most pages that it may take; what takes more is shown whole
 */
function stripOf(
  images: readonly StripImage[],
  { ratio }: PageFormat,
  most: number,
): PagesOfImage[] | null {
  const slices = images.flatMap(({ src, size, isPlain }) =>
    size && isPlain ? [{ src, size }] : [],
  );
  if (slices.length < images.length) return null;
  const size = sizeOfSlices(slices);
  if (slices.length === 1 && size.width / size.height / ratio >= leastWidth) return null;
  if (countOfStrip(size, 1 / ratio) > most) return null;
  const page = { width: size.width, height: size.width / ratio };
  const strips = pagesOfStrip(size, 1 / ratio);
  const topOf = (strip: StripPage | undefined): number =>
    strip ? placeOf(size, strip, strip.index) : Number.POSITIVE_INFINITY;
  let [top, next] = [0, 0];
  return slices.map(({ src, size: { height } }) => {
    const isOnPageBefore = topOf(strips[next]) > top;
    const pages: ImagePage[] = [];
    top += height;
    for (; topOf(strips[next]) < top; next++) {
      const strip = strips[next] as StripPage;
      pages.push({ src, size: page, strip: slices.length > 1 ? { ...strip, slices } : strip });
    }
    return { pages, isOnPageBefore };
  });
}

/**
 * Returns a book whose strips are pages: those of known size, or at hand, with neither text nor links, which
 * would have to be cut with them. What leads to a page leads to the same picture.
 */
export async function withStrips(book: ImageBook): Promise<ImageBook> {
  const sizes = await sizesOf(book.pages);
  const { images } = await layOutStrips(
    book.pages.map(({ src, text, links, part, label, alt }, k) => ({
      ...{ src, size: sizes[k] ?? null, isPlain: !text && !links && !part },
      folder: src instanceof Blob && !label && !alt ? "" : null,
    })),
  );
  if (images.every(({ pages }) => pages === null)) return book;
  const firsts: number[] = [];
  const pages: ImagePage[] = [];
  for (const [k, page] of book.pages.entries()) {
    const { pages: strip, isOnPageBefore } = images[k] ?? onePage;
    firsts.push(pages.length + (isOnPageBefore ? 0 : 1));
    const { label, alt } = page;
    const about = { ...(label ? { label } : {}), ...(alt ? { alt } : {}) };
    pages.push(...(strip?.map((one, at) => (at === 0 ? { ...one, ...about } : one)) ?? [page]));
  }
  const pageOf = (page: number): number => firsts[page - 1] ?? page;
  return {
    ...book,
    pages: pages.map((page) =>
      page.links ? { ...page, links: linksTo(page.links, pageOf) } : page,
    ),
    ...(book.outline ? { outline: linesTo(book.outline, pageOf) } : {}),
  };
}

/** Returns the bytes of an image that is at hand. */
async function blobOf(src: ImagePage["src"]): Promise<Blob> {
  if (typeof src === "string") throw new Error("not at hand");
  return src instanceof Blob ? src : await src.read();
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
