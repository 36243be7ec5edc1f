/** Comics: archives of images, in the natural order of their names. */

import type { Archive } from "../archive/archive.ts";
import { type OpenInner, openInnerBook } from "../archive/inner_books.ts";
import { isLitter } from "../archive/litter.ts";
import { unreadArchive } from "../archive/unread_archives.ts";
import { cleanText } from "../book_text.ts";
import {
  archiveOfName,
  formatOfName,
  imageType,
  rareImageType,
  sniff,
  sniffLength,
  unshownFormat,
} from "../formats.ts";
import { claimedSize, typedImage } from "../image_header.ts";
import { ImageSource } from "../images.ts";
import { limits } from "../limits.ts";
import { loadPart } from "../load_part.ts";
import type { ImagePage, StoredImage } from "../manifest.ts";
import {
  BookError,
  type BookWarning,
  type OutlineEntry,
  type PageSize,
  type PageSource,
} from "../page_source.ts";
import {
  layOutStrips,
  type PageFormat,
  type PagesOfImage,
  type StripImage,
} from "../strip_pages.ts";
import { WarningList, warningOf } from "../warnings.ts";
import type { ComicMetadata } from "./comic_metadata.ts";
import { statedMetadata } from "./stated_metadata.ts";
import { withDigits } from "./written_numbers.ts";

/** Returns whether a name says that a file is an image. */
const isImageName = (name: string): boolean => formatOfName(name)?.kind === "image";

/** Files that are no pages, whatever is in them. */
const otherName = /\.(xml|txt|nfo|html?|json|md|db|ini|url|opf|ncx|css|js|sfv|acbf|zip|rar|7z)$/i;

/** Archives within an archive, which may hold pages. */
const isArchiveName = (name: string): boolean =>
  formatOfName(name)?.family === "comic" || archiveOfName(name) !== null;

/** The name of a front cover, in several languages, which stands before its first page in any order of names. */
const coverName =
  /^((front[ _.-]?)?cover([ _.-]?(front|0{0,3}1?))?|表紙|封面|표지|обложка|couverture|portada|copertina|capa|omslag|okładka|titelbild|umschlag)$/i;

/** The name of a back cover, which stands behind the last page. */
const backCoverName =
  /^(back[ _.-]?cover|cover[ _.-]?back|裏表紙|封底|뒤표지|contraportada|contracapa|quarta di copertina|quatrième de couverture)$/i;

/**
 * Bytes of an image in which its size is searched for, and then, if its camera wrote much before that; and
 * images that are searched at a time.
 */
const headerLength = 1 << 16;
const farHeaderLength = 1 << 20;
const atOnce = 4;

/**
 * Bytes that files claim which are unpacked to see what they are and how large. A few bytes can stand for any
 * number; images are about as long as they are packed, and those of larger comics are measured when they are drawn.
 */
const mostUnpacked = limits.archiveBytes / 2;

/**
 * A scan is of both pages of a spread if its proportions, width over height,
 * are those of about two of the book's usual pages.
 */
const [leastDouble, mostDouble] = [1.6, 2.5];

/**
 * Returns the book that an archive of images is, or the one that is packed in it. It closes the archive.
 * Rejects with a `BookError` if there is neither in it.
 *
 * @param file the archive as it came
 * @param name the archive's name in sentences
 * @param openInner opens a book that is packed in it
 */
export async function openComic(
  archive: Archive,
  file: Blob,
  name: string,
  openInner: OpenInner,
): Promise<PageSource> {
  try {
    const rejection = unreadArchive(archive.names);
    if (rejection !== null)
      throw new BookError(`${name} ${rejection}`, { code: "unsupported", source: name });
    const inner = await openInnerBook(archive, name, openInner);
    if (inner) return inner;
    const warnings = new WarningList();
    const { damage } = archive;
    if (damage)
      warnings.add({ code: "page", message: damage.message, source: name, error: damage });
    const budget = { bytes: mostUnpacked };
    const leftOut = (path: string): void => warnings.add(warningOf("page", path, name));
    const files = await pagesIn(archive, budget, leftOut);
    if (files.length === 0) {
      const what = archive.names.length === 0 ? "it is empty" : noPages(warnings.all);
      throw new BookError(`${name} has no pages: ${what}; open another.`, {
        code: "empty",
        source: name,
      });
    }
    checkCount(files.length, name);
    const info = await statedMetadata(archive, files, (path) => {
      warnings.add(warningOf("contents", path, name));
    });
    await checkReadable(archive, files);
    const direction = info.direction ?? "ltr";
    const measured = await measureAll(archive, files, info, budget, name);
    const scans = info.order.length > 0 ? inStatedOrder(measured, info) : coversAtEnds(measured);
    const { format, images } = await layOutStrips(scans.map(stripImageOf));
    const pages: Page[] = [];
    for (const [k, scan] of scans.entries()) {
      const { pages: strip = null, isOnPageBefore = false } = images[k] ?? {};
      const own = pagesOf(scan, direction, format, strip);
      const before = isOnPageBefore ? pages.at(-1) : undefined;
      if (before) before.bookmark ||= scan.bookmark;
      else if (own[0]) own[0].bookmark = scan.bookmark;
      pages.push(...own);
    }
    if (pages.length === 0)
      throw new BookError(`${name} marks all its pages as deleted.`, {
        code: "empty",
        source: name,
      });
    return new ImageSource({
      name,
      title: info.title || name.replace(/\.(cb[rz7t]|rar|7z|tar)$/i, "") || name,
      language: info.language,
      direction,
      authors: info.authors,
      kind: "scan",
      pages: pages.map(({ page }) => page),
      outline: pages.flatMap(({ bookmark }, index) => lineOf(bookmark, index)),
      warnings: [
        ...warnings.all,
        ...pages.flatMap(({ damaged }, index) =>
          damaged === undefined ? [] : [{ ...warningOf("page", damaged, name), page: index + 1 }],
        ),
      ],
      file,
      close: () => archive.close(),
    });
  } catch (error) {
    archive.close();
    throw error;
  }
}

/** Returns why an archive has no pages, with the name of one of the files that are none. */
function noPages(leftOut: readonly BookWarning[]): string {
  const [first] = leftOut;
  return first
    ? `no file in it, such as ${first.source}, is a book or an image that can be shown`
    : "no file in it is a book or an image";
}

/** Throws a `BookError` if a comic has too many images. */
function checkCount(count: number, name: string): void {
  if (count <= limits.pages) return;
  throw new BookError(
    `${name} has ${count} images; split it into books of at most ${limits.pages}.`,
    { code: "tooLarge", source: name },
  );
}

/**
 * Rejects if none of the images in an archive can be read, for one reason: what is protected by a password,
 * or packed in a way that is not unpacked, is so throughout.
 */
async function checkReadable(archive: Archive, files: readonly string[]): Promise<void> {
  let first: unknown;
  for (const path of files) {
    const error = await archive.readStart(path, 1).then(
      () => null,
      (reason: unknown) => reason,
    );
    const isThroughout = error instanceof BookError && /^(locked|unsupported)$/.test(error.code);
    if (!isThroughout) return;
    first ??= error;
  }
  throw first;
}

/**
 * Returns the images in an archive, in the natural order of their paths.
 *
 * @param leftOut called with each other file that is none of those beside images
 */
async function pagesIn(
  archive: Archive,
  budget: Budget,
  leftOut: (path: string) => void,
): Promise<string[]> {
  const names = archive.names.filter((name) => !isLitter(name));
  const images = names.filter((name) => isImageName(name));
  // Where names say nothing, the bytes do.
  const unnamed = names.filter((name) => !isImageName(name) && !otherName.test(name));
  for (const name of unnamed.slice(0, limits.pages)) {
    const isRead = hasLeft(budget, archive.size(name));
    const start = isRead ? await archive.readStart(name, sniffLength).catch(() => null) : null;
    if (start !== null && (imageType(start) ?? rareImageType(start))) images.push(name);
    else if (/\.[^./]+$/.test(name) || isOther(start)) leftOut(name);
  }
  for (const name of names) if (isArchiveName(name)) leftOut(name);
  return inOrder(images);
}

/** Returns whether a file has something, and no text, as those have without an ending that programs leave. */
const isOther = (start: Uint8Array | null): boolean =>
  start !== null && start.length > 0 && sniff({ start, type: "" }) !== "text";

/** Returns paths in their natural order: by folders, and by names without their endings, numbers as they count in any script. */
export function inOrder(names: readonly string[]): string[] {
  const { compare } = new Intl.Collator("en", { numeric: true });
  const stepsOf = (name: string): string[] => withDigits(name.replace(/\.[^./]*$/, "")).split("/");
  const paths = names.map((name) => ({ name, steps: stepsOf(name) }));
  paths.sort((a, b) => {
    const other = a.steps.findIndex((step, index) => step !== b.steps[index]);
    const order = compare(a.steps[other] ?? "", b.steps[other] ?? "");
    return order || (a.name < b.name ? -1 : 1);
  });
  return paths.map(({ name }) => name);
}

const nameOf = (path: string): string =>
  (path.split("/").pop() ?? "").replace(/\.[^.]*$/, "").normalize("NFC");

const folderOf = (path: string): string => path.slice(0, path.lastIndexOf("/") + 1);

/** Returns whether a scan's own name says that it is the front cover. */
const isNamedCover = ({ path }: Scan): boolean => coverName.test(nameOf(path));

/** Returns whether a scan's own name says that it is the back cover. */
const isNamedBack = ({ path }: Scan): boolean => backCoverName.test(nameOf(path));

/**
 * Returns scans with the front cover before all others, if it is stated or its own name says that it is one,
 * and with other covers at the ends of their folders.
 */
function coversAtEnds(scans: readonly Scan[]): readonly Scan[] {
  const covers = scans.filter((scan) => isNamedCover(scan) || isNamedBack(scan));
  /** The first and the last of all in each folder that has a cover, by their numbers. */
  const ends = new Map<string, [first: number, last: number]>();
  for (const { path } of covers) ends.set(folderOf(path), [scans.length, 0]);
  for (const [k, { path }] of scans.entries()) {
    for (let length = 0; length >= 0; length = path.indexOf("/", length) + 1 || -1) {
      const found = ends.get(path.slice(0, length));
      if (found) found.splice(0, 2, Math.min(found[0], k), Math.max(found[1], k));
    }
  }
  // An outer folder's covers are before and behind those of the folders in it.
  const placed = scans.map((scan, k) => {
    const folder = folderOf(scan.path);
    const [first = k, last = k] = ends.get(folder) ?? [];
    if (isNamedCover(scan)) return { scan, at: first - 0.5, depth: folder.length };
    if (isNamedBack(scan)) return { scan, at: last + 0.5, depth: -folder.length };
    return { scan, at: k, depth: 0 };
  });
  placed.sort((a, b) => a.at - b.at || a.depth - b.depth);
  const ordered = placed.map(({ scan }) => scan);
  const cover = scans.find(({ isFront }) => isFront) ?? ordered.find(isNamedCover);
  const all = cover ? [cover, ...ordered.filter((scan) => scan !== cover)] : ordered;
  return withCovers(all);
}

/** Returns scans with the front cover first, then in the order that is stated, and last those of which nothing is. */
function inStatedOrder(scans: readonly Scan[], { order }: ComicMetadata): readonly Scan[] {
  const places = new Map([...order.entries()].reverse().map(([place, path]) => [path, place]));
  const placeOf = ({ path, isFront }: Scan): number =>
    isFront ? -1 : (places.get(path) ?? order.length);
  return withCovers([...scans].sort((a, b) => placeOf(a) - placeOf(b)));
}

const withCovers = (scans: readonly Scan[]): readonly Scan[] =>
  scans.map((scan, k) => ({ ...scan, isCover: k === 0 || k === scans.length - 1 }));

/** An image of the archive. */
interface Scan {
  readonly path: string;
  readonly image: StoredImage;
  /** Null if its header does not say. */
  readonly size: PageSize | null;
  /** Whether its bytes are none of an image. */
  readonly isDamaged: boolean;
  /** Whether ComicInfo.xml says that it is of two pages; null if it does not say. */
  readonly double: boolean | null;
  readonly bookmark: string;
  /** Whether it is stated that it is the front cover. */
  readonly isFront: boolean;
  /** Whether it is the first or the last, which are covers. */
  readonly isCover: boolean;
}

/** Bytes that may still be unpacked before the book is open. */
interface Budget {
  bytes: number;
}

/** Takes bytes from a budget, and returns whether it had as many. */
function hasLeft(budget: Budget, bytes: number): boolean {
  budget.bytes -= bytes;
  return budget.bytes >= 0;
}

async function measureAll(
  archive: Archive,
  files: readonly string[],
  info: ComicMetadata,
  budget: Budget,
  name: string,
): Promise<Scan[]> {
  const found: (readonly Scan[])[] = [];
  let count = 0;
  const waiting = files.keys();
  const work = async (): Promise<void> => {
    for (const index of waiting) {
      const path = files[index] as string;
      const page = info.pages.get(index);
      if (page?.deleted) continue;
      const about = {
        double: page?.double ?? null,
        bookmark: page?.bookmark ?? "",
        isFront: page?.isCover ?? path === info.cover,
      };
      const scans = await measureFile(archive, path, about, budget);
      found[index] = scans;
      count += scans.length;
      checkCount(count, name);
    }
  };
  await Promise.all(Array.from({ length: atOnce }, work));
  return found.flat();
}

/**
 * Returns the images of a file: one, or each page of a TIFF.
 *
 * @param about what is known of the first
 */
async function measureFile(
  archive: Archive,
  path: string,
  about: Pick<Scan, "double" | "bookmark" | "isFront">,
  budget: Budget,
): Promise<Scan[]> {
  const whole = async (): Promise<Blob> => new Blob([await archive.read(path, limits.imageBytes)]);
  const isRead = hasLeft(budget, archive.size(path));
  const start = isRead ? await startOf(archive, path) : null;
  const isDamaged = isRead && (start === null || start.type === "");
  const name = cleanText(path, 80);
  const first = { path, isDamaged, isCover: false, ...about };
  if (start?.type === "image/tiff" && hasLeft(budget, archive.size(path))) {
    const { pagesOfTiff } = await loadPart(import("../rare_images/tiff_pages.ts"));
    const pages = await whole().then(pagesOfTiff, () => []);
    if (pages.length > 1) {
      return pages.map(({ size }, k) => {
        const read = async (): Promise<Blob> => {
          const file = await whole();
          return (await pagesOfTiff(file))[k]?.image ?? file;
        };
        return { ...first, image: { name, read }, size, bookmark: k === 0 ? about.bookmark : "" };
      });
    }
  }
  const size = start && !isDamaged ? await sizeOf(start, archive, path, budget) : null;
  return [{ ...first, image: { name, read: whole }, size }];
}

/** Returns the start of an image, of its type, "" for none; null if it cannot be read. */
async function startOf(archive: Archive, path: string): Promise<Blob | null> {
  try {
    return await typedImage(new Blob([await archive.readStart(path, headerLength)]));
  } catch {
    return null;
  }
}

/** Returns an image's size by its header; null if that does not say, or is damaged. */
async function sizeOf(
  start: Blob,
  archive: Archive,
  path: string,
  budget: Budget,
): Promise<PageSize | null> {
  try {
    let size = await claimedSize(start);
    if (size === null && hasLeft(budget, archive.size(path))) {
      const isRare = unshownFormat(start.type) !== undefined;
      const more = isRare
        ? archive.read(path, limits.imageBytes)
        : archive.readStart(path, farHeaderLength);
      size = await claimedSize(await typedImage(new Blob([await more])));
    }
    return size && size.width > 0 && size.height > 0
      ? { width: size.width, height: size.height }
      : null;
  } catch {
    return null;
  }
}

/** Returns a scan as it may be a slice of a strip. */
function stripImageOf(scan: Scan): StripImage {
  const { path, image, size } = scan;
  const isCover = scan.isFront || isNamedCover(scan) || isNamedBack(scan);
  return { src: image, size, isPlain: true, folder: isCover ? null : folderOf(path) };
}

interface Page {
  readonly page: ImagePage;
  /** What is wrong with it, if anything is: its path. */
  readonly damaged?: string;
  bookmark: string;
}

/**
 * Returns a scan as a page, or as two that face each other if it is of a spread.
 *
 * @param strip the pages that it is as a strip, in place of these
 */
function pagesOf(
  scan: Scan,
  direction: "ltr" | "rtl",
  format: PageFormat,
  strip: PagesOfImage["pages"],
): Page[] {
  const { image: src, size } = scan;
  const ratio = size ? size.width / size.height / format.ratio : 1;
  const damaged = scan.isDamaged ? { damaged: scan.path } : {};
  if (strip) return strip.map((page) => ({ page, bookmark: "" }));
  const looksDouble = !format.isScrolled && ratio > leastDouble && ratio < mostDouble;
  const isDouble = scan.double === null ? looksDouble : scan.double && ratio > 1;
  if (!isDouble || scan.isCover) {
    return [{ page: { src, ...(size ? { size } : {}) }, bookmark: "", ...damaged }];
  }
  const half = size ? { size: { width: size.width / 2, height: size.height } } : {};
  const [first, second] = direction === "rtl" ? [0.5, 0] : [0, 0.5];
  const part = (x: number) => ({ x, y: 0, width: 0.5, height: 1 });
  return [
    { page: { src, ...half, part: part(first), inSpread: "first" }, bookmark: "" },
    { page: { src, ...half, part: part(second), inSpread: "second" }, bookmark: "" },
  ];
}

function lineOf(title: string, index: number): OutlineEntry[] {
  return title === "" ? [] : [{ title, page: index + 1, children: [] }];
}
