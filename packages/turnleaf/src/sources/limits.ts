import type { PageBox, PageSize } from "./page_source.ts";

/**
 * Bounds on everything that comes from a file, so that no book, broken or
 * hostile, exhausts the reader's machine.
 */
export const limits = {
  /** Longest side of a drawn page in pixels, supported by every WebGL 2 device. */
  side: 4096,
  /** Pixels of a drawn page, 64 MB as RGBA. */
  pixels: 16_000_000,
  /** Pixels of an encoded image before it is drawn smaller. */
  imagePixels: 120_000_000,
  /** Milliseconds in which an image is decoded that the browser does not show. */
  decodingTime: 60_000,
  /** Bytes of one encoded image. */
  imageBytes: 100_000_000,
  /** Bytes of a PDF; more does not fit in one array in every browser. */
  pdfBytes: 2_000_000_000,
  /**
   * Of a PDF's page, or of all that is read to open one: milliseconds of a processor for which its worker is at
   * it by itself, and steps of drawing, of which a million take half a gigabyte in the page and its workers.
   */
  pdfTime: 6000,
  pdfSteps: 1_000_000,
  /** Bytes of a manifest. */
  manifestBytes: 32_000_000,
  /** Bytes of an archive, its files, and bytes of one of them unpacked. */
  archiveBytes: 1_000_000_000,
  archiveEntries: 40_000,
  archivedBytes: 100_000_000,
  /** Of an archive that is unpacked whole: bytes of all its files, of a path in it, and milliseconds. */
  unpackedBytes: 1_000_000_000,
  archivePath: 4096,
  unpackingTime: 300_000,
  /** Bytes of a chapter or a style sheet, unpacked. */
  markupBytes: 16_000_000,
  /** Elements of a chapter, and bytes of the pictures and fonts in it. */
  elements: 200_000,
  chapterBytes: 200_000_000,
  /** Passages of a book that are read aloud, and characters of one. */
  clips: 200_000,
  passageLength: 20_000,
  pages: 20_000,
  /** Longest side a source may claim for a page, in its own unit. */
  pageSide: 200_000,
  titleLength: 300,
  /** Names of authors that a book is said to have. */
  authors: 20,
  labelLength: 40,
  urlLength: 4096,
  /** Length of an image written into a manifest as a data: URL. */
  dataUrlLength: 4_000_000,
  /** Pieces of a page's text, characters of one, and of all. */
  runs: 8000,
  runLength: 4000,
  textLength: 200_000,
  /** Characters of the description of a page's pictures. */
  altLength: 2000,
  /** Characters of a note that is shown over a page. */
  noteLength: 4000,
  /** Links or fields of a page. */
  annotations: 2000,
  /** Characters of a field's value, and the options of a choice. */
  fieldLength: 20_000,
  options: 500,
  /** Lines of the contents, and their depth. */
  outlineEntries: 5000,
  outlineDepth: 8,
  /** What of a book is listed as not shown. */
  warnings: 200,
} as const;

/** All of a page, in fractions of its size. */
export const wholePage: PageBox = { x: 0, y: 0, width: 1, height: 1 };

/**
 * Returns the pixels at which a page of `size` is drawn to be `width` wide:
 * whole numbers of at least 1, within `limits.side` and `limits.pixels`, in the
 * page's own proportions.
 */
export function fitPixels(size: PageSize, width: number): PageSize {
  const asked = Number.isFinite(width) ? Math.max(1, width) : 1;
  const ratio = size.height / size.width;
  const most = Math.min(limits.side, limits.side / ratio, Math.sqrt(limits.pixels / ratio));
  const fitted = Math.min(asked, most);
  return {
    width: Math.max(1, Math.floor(fitted)),
    height: Math.max(1, Math.min(limits.side, Math.floor(fitted * ratio))),
  };
}

/** Returns whether `size` is valid for a page: finite, positive and within `limits.pageSide`. */
export function isPageSize(size: PageSize): boolean {
  return isSide(size.width) && isSide(size.height);
}

/** Returns whether `box` lies somewhere about a page and has some size. */
export function isPageBox({ x, y, width, height }: PageBox): boolean {
  return (
    Math.abs(x) <= limits.pageSide &&
    Math.abs(y) <= limits.pageSide &&
    isPageSize({ width, height })
  );
}

function isSide(value: number): boolean {
  return Number.isFinite(value) && value > 0 && value <= limits.pageSide;
}
