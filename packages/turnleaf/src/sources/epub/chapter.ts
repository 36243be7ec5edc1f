/** One chapter of an EPUB: its file, read and cleaned. */

import { cleanText } from "../book_text.ts";
import { isPageSize } from "../limits.ts";
import { cleanMarkup } from "../markup/clean_markup.ts";
import { parseMarkup } from "../markup/parse_markup.ts";
import { readMarkup } from "../markup/read_markup.ts";
import { BookError, type PageSize } from "../page_source.ts";
import { type FlowContent, styleAttribute } from "../typeset/flow_book.ts";
import { decodedSize, naturalSize } from "../typeset/natural_size.ts";
import type { EpubFiles } from "./epub_files.ts";

/** The size of a page of fixed layout that does not say it. */
const usualSize: PageSize = { width: 768, height: 1024 };

/** Types of what is shown in a frame of a chapter. */
const framedTypes = /^(application\/xhtml\+xml|text\/html|image\/svg\+xml)$/;

/** How the sentence about a damaged chapter is set; on a page of fixed layout it takes no place. */
const noticeStyle =
  "border: 1px solid; margin-bottom: 1em; padding: 0.4em 0.6em; font: italic 13px/1.3 sans-serif";
const fixedNoticeStyle = "position: absolute; left: 0; top: 0; background: #fff; color: #000";

/** Types of chapters that are pictures, and how one of fixed layout is set: it is all of its page. */
const pictureTypes = /^image\/(?!svg)/;
const pictureStyle = "position: absolute; left: 0; top: 0; width: 100%; height: 100%";

/** A chapter as the spine names it. */
export interface Chapter {
  readonly href: string;
  readonly mediaType: string;
  readonly isFixed: boolean;
  /** Which page of its file it is, from 0, if it is a picture. */
  readonly page?: number;
}

/**
 * Returns what is in a chapter. Rejects with a `BookError`.
 *
 * @param name the book's name in sentences
 *
 * @param usual the size that the book gives its pages of fixed layout, if it does
 */
export async function loadChapter(
  files: EpubFiles,
  { href, mediaType, isFixed, page = 0 }: Chapter,
  name: string,
  usual: PageSize | null = null,
): Promise<FlowContent> {
  const picture = pictureTypes.test(mediaType) ? await pictureOf(files, href, page, name) : null;
  const document = picture
    ? pictureDocument(picture.data, isFixed)
    : await parseChapter(files, href, mediaType, isFixed);
  const named = isFixed ? namedSize(document) : null;
  const what = `A chapter of ${name}`;
  const framed = async (address: string): Promise<FlowContent | null> => {
    const path = files.resolve(address.split("#", 1)[0] ?? "", href);
    const type = path === null ? "" : files.typeOf(path);
    if (path === null || !framedTypes.test(type)) return null;
    // Frames within it are left out.
    return await cleanMarkup(await parseChapter(files, path, type, false), files.about(path), what);
  };
  const plays = (address: string): boolean => {
    const path = files.resolve(address, href);
    return path !== null && isPlayed(files.typeOf(path));
  };
  const content = await cleanMarkup(document, { ...files.about(href), framed, plays }, what);
  if (!isFixed) return content;
  const size = picture?.size ?? named ?? usual ?? (await naturalSize(content, usualSize));
  return { ...content, size: size ?? usualSize };
}

/**
 * Returns the picture that a chapter is, as `data:`, with its size in pixels, null if that is none of a page.
 * Rejects with a `BookError` if it cannot be shown.
 */
async function pictureOf(
  files: EpubFiles,
  path: string,
  page: number,
  name: string,
): Promise<{ readonly data: string; readonly size: PageSize | null }> {
  const place = `${cleanText(path, 80)}, a chapter of ${name},`;
  const data = await files.picture(path, page, place);
  const size = await decodedSize(data ?? "");
  if (data !== null && size.width > 0) return { data, size: isPageSize(size) ? size : null };
  throw new BookError(`${place} is damaged or no image; get the book again.`, {
    code: "damaged",
    source: path,
  });
}

/** Returns whether the browser plays sounds or films of a media type. */
function isPlayed(type: string): boolean {
  const [kind] = /^(?:audio|video)(?=\/)/.exec(type) ?? [];
  return kind !== undefined && document.createElement(kind as "audio").canPlayType(type) !== "";
}

/** Returns a chapter that is a picture. */
function pictureDocument(data: string, isFixed: boolean): Document {
  const style = isFixed ? `style="${pictureStyle}"` : "";
  const picture = `<img src="${data}" alt="" ${style}/>`;
  return parseMarkup(`<html><body>${picture}</body></html>`, "text/html");
}

/** Reads a chapter; one that breaks off says so. */
async function parseChapter(
  files: EpubFiles,
  path: string,
  mediaType: string,
  isFixed: boolean,
): Promise<Document> {
  const text = await files.text(path);
  const type = mediaType === "image/svg+xml" ? mediaType : "application/xhtml+xml";
  const { document, damagedLine } = await readMarkup(text, type);
  const body = document.querySelector("body");
  // Web pages need have no end.
  if (damagedLine !== undefined && body && mediaType !== "text/html") {
    body.prepend(noticeOf(document, damagedLine, isFixed));
  }
  resolveBase(document, files, path);
  return document;
}

/** Attributes that are addresses of files, or of places in them. */
const addressAttributes = ["href", "src", "data", "poster", "xlink:href"];

/**
 * Has the addresses in a chapter lead where they do from the base that it names for them, from the archive's root.
 * What is not there stays an address from the chapter's own file, as does all where the base is a web site's.
 *
 * @param path of the chapter
 */
function resolveBase(document: Document, files: EpubFiles, path: string): void {
  const base = document.querySelector("base[href]")?.getAttribute("href") ?? "";
  if (base === "" || /^(?:[a-z][a-z\d+.-]*:|[/\\]{2})/i.test(base)) return;
  const folder = base.slice(0, base.lastIndexOf("/") + 1);
  for (const element of document.querySelectorAll("*")) {
    if (element.localName === "base") continue;
    for (const name of addressAttributes) {
      const address = element.getAttribute(name) ?? "";
      const target = /^(?:$|#)/.test(address) ? null : files.resolve(`${folder}${address}`, path);
      if (target === null) continue;
      const fragment = /#.*$/s.exec(address)?.[0] ?? "";
      const whole = target.split("/").map(encodeURIComponent).join("/");
      element.setAttribute(name, `/${whole}${fragment}`);
    }
  }
}

/** Returns a sentence about an error in a chapter, to be shown above it. */
function noticeOf(document: Document, line: number | null, isFixed: boolean): Element {
  const notice = document.createElementNS("http://www.w3.org/1999/xhtml", "aside") as HTMLElement;
  const where = line === null ? "" : ` in line ${line}`;
  notice.textContent = `This chapter is damaged${where}; something in it may be missing.`;
  notice.lang = "en";
  notice.dir = "ltr";
  notice.setAttribute("role", "note");
  const style = isFixed ? `${noticeStyle}; ${fixedNoticeStyle}` : noticeStyle;
  notice.setAttribute(styleAttribute, style);
  return notice;
}

/** Returns the size that a page of fixed layout names: in its viewport or for its makers' readers, or as its drawing has it; null if it names none. */
function namedSize(document: Document): PageSize | null {
  for (const meta of document.querySelectorAll("meta[name][content]")) {
    if (!/^(viewport|original-resolution)$/i.test(meta.getAttribute("name") ?? "")) continue;
    const size = sizeIn(meta.getAttribute("content") ?? "");
    if (size) return size;
  }
  const svg = document.querySelector("svg");
  const [, , width = 0, height = 0] = (svg?.getAttribute("viewBox") ?? "")
    .split(/[\s,]+/)
    .map(Number);
  if (isPageSize({ width, height })) return { width, height };
  const own = {
    width: Number.parseFloat(svg?.getAttribute("width") ?? ""),
    height: Number.parseFloat(svg?.getAttribute("height") ?? ""),
  };
  return isPageSize(own) ? own : null;
}

/** Returns the size in a text such as "width=600, height=800" or "600x800"; null if there is none. */
export function sizeIn(text: string): PageSize | null {
  const number = (named: RegExp): number => Number.parseFloat(named.exec(text)?.[1] ?? "");
  const [, across = "", down = ""] = /^\s*(\d{1,5})\s*[x×]\s*(\d{1,5})\s*$/i.exec(text) ?? [];
  const size = {
    width: Number(across) || number(/\bwidth\s*=\s*([\d.]+)/i),
    height: Number(down) || number(/\bheight\s*=\s*([\d.]+)/i),
  };
  return isPageSize(size) ? size : null;
}
