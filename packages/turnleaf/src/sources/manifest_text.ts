import { cleanAddress, cleanRun, cleanText } from "./book_text.ts";
import { isPageBox, limits } from "./limits.ts";
import { fault, isRecord, listOf, textOf } from "./manifest_checks.ts";
import type { LinkTarget, OutlineEntry, PageBox, PageLink, TextRun } from "./page_source.ts";

/** A line or word of a page, as a manifest writes it; its box in the pixels of the page's width and height. */
export interface ManifestText extends PageBox {
  /** Its text. */
  readonly text: string;
  /** Degrees, clockwise. The default is 0. */
  readonly angle?: number;
  /** Whether a line ends here. The default is true. */
  readonly end?: boolean;
  /** Whether its letters stand below each other; `height` is then along the line. */
  readonly vertical?: boolean;
}

/** A link, as a manifest writes it; `page` (from 1) or `href` is its target. */
export interface ManifestLink extends PageBox {
  /** A page of this book. */
  readonly page?: number;
  /** An address of the web or of mail. */
  readonly href?: string;
  /** Its title. */
  readonly title?: string;
}

/** A line of the contents, as a manifest writes it. */
export interface ManifestOutline {
  /** Its title. */
  readonly title: string;
  /** The page it leads to, from 1. */
  readonly page?: number;
  /** An address of the web that it leads to instead. */
  readonly href?: string;
  /** The lines beneath it. */
  readonly children?: readonly ManifestOutline[];
}

/**
 * Parses the text of a page.
 *
 * @throws BookError naming `place` and the piece at fault
 */
export function parseText(fields: Record<string, unknown>, place: string): TextRun[] {
  let letters = 0;
  return listOf(fields, "text", limits.runs, place).map((value, index) => {
    const here = `${place}: text ${index + 1}`;
    const piece = isRecord(value) ? value : {};
    const text = cleanRun(piece.text);
    if (text.trim() === "") throw fault(here, 'has no "text"', "write what stands there");
    letters += text.length;
    if (letters > limits.textLength) {
      throw fault(
        here,
        "makes the text of the page too long",
        `write at most ${limits.textLength} characters`,
      );
    }
    const degrees =
      typeof piece.angle === "number" && Number.isFinite(piece.angle) ? piece.angle : 0;
    return {
      ...boxOf(piece, here),
      text,
      angle: ((degrees % 360) * Math.PI) / 180,
      end: piece.end !== false,
      ...(piece.vertical === true ? { vertical: true } : {}),
    };
  });
}

/**
 * Parses the links of a page.
 *
 * @param pages number of pages in the book
 * @throws BookError naming `place` and the link at fault
 */
export function parseLinks(
  fields: Record<string, unknown>,
  pages: number,
  place: string,
): PageLink[] {
  return listOf(fields, "links", limits.annotations, place).map((value, index) => {
    const here = `${place}: link ${index + 1}`;
    const link = isRecord(value) ? value : {};
    const to = targetOf(link, pages, here);
    if (to === null) throw fault(here, "leads nowhere", 'give it a "page" or an "href"');
    return { ...boxOf(link, here), title: textOf(link, "title", limits.titleLength, here), to };
  });
}

/**
 * Parses the contents of a book.
 *
 * @throws BookError naming `name` and the entry at fault
 */
export function parseOutline(
  fields: Record<string, unknown>,
  pages: number,
  name: string,
): OutlineEntry[] {
  let left: number = limits.outlineEntries;
  const read = (from: Record<string, unknown>, key: string, depth: number): OutlineEntry[] => {
    const entries = listOf(from, key, left, name);
    if (entries.length > 0 && depth >= limits.outlineDepth) {
      throw fault(name, `has contents deeper than ${limits.outlineDepth}`, "make them flatter");
    }
    left -= entries.length;
    return entries.map((value) => {
      const entry = isRecord(value) ? value : {};
      const title = textOf(entry, "title", limits.titleLength, name);
      if (title === "")
        throw fault(name, "has an entry without a title in its contents", "give it one");
      const here = `${name}: contents "${cleanText(title, 40)}"`;
      const to = targetOf(entry, pages, here);
      const children = read(entry, "children", depth + 1);
      return to && "href" in to
        ? { title, page: null, href: to.href, children }
        : { title, page: to?.page ?? null, children };
    });
  };
  return read(fields, "outline", 0);
}

function targetOf(
  fields: Record<string, unknown>,
  pages: number,
  place: string,
): LinkTarget | null {
  const { page, href } = fields;
  if (href !== undefined && href !== null) {
    const address = cleanAddress(href);
    if (address === "")
      throw fault(place, "has an address that is none", "use http, https or mailto");
    return { href: address };
  }
  if (page === undefined || page === null) return null;
  if (Number.isInteger(page) && (page as number) >= 1 && (page as number) <= pages) {
    return { page: page as number };
  }
  throw fault(place, "leads to a page that the book does not have", `write 1 to ${pages}`);
}

function boxOf(fields: Record<string, unknown>, place: string): PageBox {
  const { x, y, width, height } = fields;
  const box = { x, y, width, height } as PageBox;
  if ([x, y, width, height].every((side) => typeof side === "number") && isPageBox(box)) return box;
  throw fault(place, "has no usable place", "give x, y, width and height in pixels of the page");
}
