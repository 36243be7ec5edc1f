/** Lays a section of a book out in a frame: its columns are pages. */

import { limits } from "../limits.ts";
import type { PageSize, Typography } from "../page_source.ts";
import { alignText, alignUnsaid } from "./align_text.ts";
import { honourBreaks, resolveVariables } from "./asked_breaks.ts";
import { closeBlankPages } from "./blank_pages.ts";
import { setStyles } from "./box_styles.ts";
import { fitBoxes, fixCrossed } from "./fit_boxes.ts";
import { fitDrawings } from "./fit_drawings.ts";
import { fitFormulas } from "./fit_formulas.ts";
import { fitPictures } from "./fit_pictures.ts";
import { fitType } from "./fit_type.ts";
import { type FlowContent, type LostPart, lostAttribute, sourceAttribute } from "./flow_book.ts";
import { drawControls } from "./form_controls.ts";
import {
  applyInlineStyles,
  fontRule,
  isMoved,
  type LayoutFrame,
  loadedIn,
  ownStyle,
  unmoved,
} from "./frame.ts";
import { hideUnseen } from "./hide_unseen.ts";
import { divideWords } from "./hyphenation/divide_words.ts";
import { initialLetters } from "./initial_letters.ts";
import { keepWords } from "./keep_words.ts";
import { applyLetterForms } from "./letter_forms.ts";
import { bleed } from "./lone_picture.ts";
import { type MarginStyle, Markup } from "./markup.ts";
import { blankIds, isNoteLink } from "./notes.ts";
import { leafOf, measuresOf, type PageMeasures } from "./page_measures.ts";
import { mostNanoseconds, paintingOf } from "./paint_cost.ts";
import { placeBoxes } from "./place_boxes.ts";
import { StyleMentions } from "./style_mentions.ts";
import { type InitialLetter, type PageFlow, pageOfRect, TextMap } from "./text_map.ts";
import { trimHeights } from "./trim_heights.ts";
import { isTypeface, typefaceRules } from "./typefaces/typefaces.ts";
import { baseStyle, columnStyle, fixedStyle, readerStyle, rollStyle } from "./typography.ts";
import { uncoverText } from "./uncover_text.ts";
import { writingOf } from "./writing_direction.ts";

/** The root's type size, from which the book's own is reckoned. */
const rootSize = 16;

/** Size of the running head and of the page's number, CSS pixels, whatever size is chosen for the text. */
const marginSize = 12;

/** The class of what is read aloud, where the book names none, and its style. */
export const spokenClass = "turnleaf-read-aloud";
const spokenStyle = `.${spokenClass} { background-color: #ffe27a; color: #000; }`;

/** What is kept of a section once its frame is gone. */
export interface SectionMap {
  readonly pageCount: number;
  /** How many pages it fills: `pageCount`, but for what is empty on the last. */
  readonly extent: number;
  /** The characters before each page. */
  readonly starts: readonly number[];
  /** The characters in it. */
  readonly length: number;
  /** The page (from 0) of each element that has an id. */
  readonly ids: ReadonlyMap<string, number>;
  /**
   * How far down its page each of these begins, as a fraction of the page's height, if the
   * section is scrolled; otherwise empty. Less than 0 if that is on the page before.
   */
  readonly tops: ReadonlyMap<string, number>;
  readonly size: PageSize;
  /** What it names and cannot be shown. */
  readonly lost: readonly LostPart[];
  /** Its links to notes, as the book writes them. */
  readonly noteLinks: readonly NoteLink[];
  /** The ids of elements that mark no text, as that of a note would be. */
  readonly blankIds: ReadonlySet<string>;
}

/** A link to a note, and its page (from 0). */
export interface NoteLink {
  readonly href: string;
  readonly page: number;
}

/** What rejects a section that takes more than a page may, as is seen once it is laid out: it says what does. */
export class OverspentError extends Error {}

/** A section as it is laid out. */
export interface LaidParts {
  readonly map: SectionMap;
  readonly flow: PageFlow;
  readonly text: TextMap;
  /** Returns the section as it is now. */
  readonly markup: () => Markup;
  /** Returns the rules of the fonts in which it is set. */
  readonly fontRules: () => readonly string[];
  readonly html: HTMLElement;
  readonly layoutSize: PageSize;
}

/**
 * Lays a section out in a frame. Rejects with any error of the browser, and with an `OverspentError`.
 *
 * @param isScrolled whether its pages hang together, so that a line may be cut where one ends
 */
export async function laySection(
  frame: LayoutFrame,
  content: FlowContent,
  typography: Typography,
  isScrolled: boolean,
): Promise<LaidParts> {
  const leaf = leafOf(typography);
  let page = measuresOf(typography);
  let size = content.size ?? { width: page.width, height: page.height };
  const html = frame.document.importNode(content.root, true) as HTMLElement;
  applyInlineStyles(html);
  shortenTexts(html);
  const sheet = frame.document.createElement("div");
  sheet.style.cssText = ownStyle(
    `display: block; position: absolute; left: 0; top: 0; width: ${size.width}px; height: ${size.height}px; font-size: ${rootSize}px`,
  );
  sheet.append(html);
  frame.root.append(sheet);
  const body = html.querySelector("body") ?? html;
  const view = frame.document.defaultView as Window;
  const reader = readerStyle(typography);
  const { font } = typography;
  const own = [baseStyle, ...content.styles];
  if (!content.size && isTypeface(font)) own.unshift(await typefaceRules(font));
  let flow: PageFlow = { stepX: 0, stepY: 0, isVertical: false };
  const mentions = new StyleMentions(content.styles, html);
  frame.adopt([...own, reader]);
  const { writingMode, direction, isMixed } = writingOf(body, view, mentions);
  const isVertical = !writingMode.startsWith("horizontal");
  // Lines that stand upright are scrolled page by page.
  const isSliced = isScrolled && !isVertical && !content.size;
  if (content.size) own.push(fixedStyle(content.size));
  else if (isSliced) own.push(reader, rollStyle(page));
  else {
    flow = isVertical
      ? { stepX: 0, stepY: page.height, isVertical }
      : { stepX: direction === "rtl" ? -page.width : page.width, stepY: 0, isVertical };
    for (const element of [html, body as HTMLElement])
      setStyles(element, { "writing-mode": writingMode });
    if (isVertical) setStyles(body as HTMLElement, { direction });
  }
  // Columns of lines that stand upright follow each other down the frame, wherever the lines begin.
  const columns = columnStyle(page, isVertical, isVertical ? "ltr" : direction);
  const inColumns = content.size || isSliced ? [] : [reader, columns];
  const area = { width: page.width - 2 * page.sides, height: page.height - 2 * page.ends };
  // What the book calls the root's size is that of its own <html>.
  const rem = view.getComputedStyle(html).fontSize;
  html.style.setProperty("font-size", rem, "important");
  frame.drawing.style.setProperty("font-size", rem, "important");
  // Columns are made as far as boxes reach, which a number of nine digits takes to gigabytes.
  if (inColumns.length > 0 && columnsReached(html, area, isVertical) > limits.elements) {
    throw new OverspentError("its boxes are too high");
  }
  frame.adopt([...own, ...inColumns]);
  if (!content.size) {
    alignText(body, typography.align);
    alignUnsaid(body, typography);
    if (typography.hyphens !== "none") await divideWords(body);
  }
  applyLetterForms(body, mentions);
  await loadedIn(frame, html);
  let initials: ReadonlyMap<Node, InitialLetter> = new Map();
  if (inColumns.length > 0 && (await bleed(html, area, page))) {
    page = { ...page, sides: 0, ends: 0 };
    own.push(reader, columnStyle(page, isVertical, isVertical ? "ltr" : direction));
    frame.adopt(own);
  } else if (!content.size) {
    own.push(...inColumns);
    const [line, across] = isVertical ? [area.height, area.width] : [area.width, area.height];
    // A roll has no ends that anything could be cut at.
    const ends = isSliced ? { height: Number.POSITIVE_INFINITY } : {};
    const type = { line, page: isSliced ? Number.POSITIVE_INFINITY : across };
    const fitted = new WeakSet<Element>();
    const margin = isVertical ? page.ends : page.sides;
    const fit = (): void => {
      fitPictures(body, flow, line);
      fitBoxes(body, { flow, ...type, margin }, writingMode, fitted);
      fitPictures(body, flow, line);
    };
    drawControls(body);
    fitDrawings(body);
    resolveVariables(body, mentions);
    fitType(body as HTMLElement, type, mentions.sheets);
    initials = initialLetters(body, type, mentions);
    hideUnseen(body, flow, mentions);
    if (!isSliced) honourBreaks(body, writingMode, mentions);
    keepWords(body, flow, line, mentions);
    fit();
    fitFormulas(body, isVertical);
    if (uncoverText(body, flow, mentions)) fit();
    if (placeBoxes(frame, body, flow, { ...page, ...ends }, mentions, fitted)) fit();
    if (!isSliced) {
      trimHeights(body, flow, area);
      closeBlankPages(body, flow, across);
    }
    if (isMixed) fixCrossed(body);
  }
  if (isSliced) {
    size = { width: page.width, height: sliceHeight(html, page) };
    flow = { stepX: 0, stepY: size.height, isVertical };
  }
  const extent = content.size
    ? 1
    : isSliced
      ? sliceCount(html, page)
      : extentOf(frame, html, flow, page);
  const pageCount = Math.ceil(extent);
  const map = {
    pageCount,
    extent,
    ...mapOf(html, flow, pageCount, isSliced),
    ...notesIn(html, flow, pageCount),
    lost: [...(content.lost ?? []), ...lostIn(frame, html, flow, pageCount)],
    size: content.size ?? {
      ...leaf,
      ...(isSliced && { height: (size.height * leaf.width) / page.width }),
    },
  };
  if (paintingOf(html, mentions.sheets, size, flow) > mostNanoseconds) {
    throw new OverspentError("too much is painted upon each other");
  }
  const text = new TextMap(body, flow, pageCount, { mentions, initials });
  const styles = withUsedFonts([spokenStyle, ...own], frame);
  const margins: MarginStyle | null =
    content.size || isSliced
      ? null
      : {
          size: marginSize / typography.size,
          ends: page.ends,
          line: page.width - 2 * page.sides,
        };
  const markup = (): Markup => new Markup(html, { styles, size, rem, flow, margins });
  return {
    map: { ...map, starts: text.starts, length: text.length },
    flow,
    text,
    markup,
    fontRules: () => styles.flatMap((css) => css.match(fontRule) ?? []),
    html,
    layoutSize: size,
  };
}

/** Characters of a text: of one on many lines a browser takes long to tell where a letter of it is. */
const longestText = 4000;

/** Divides long texts into several, between words where there are any, which are laid out as one. */
function shortenTexts(root: Element): void {
  const texts = root.ownerDocument.createTreeWalker(root, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const { data } = texts.currentNode as Text;
    if (data.length <= longestText) continue;
    const blank = data.lastIndexOf(" ", longestText);
    const end = blank > longestText / 2 ? blank + 1 : longestText;
    // Not between a letter and its marks, nor between the halves of one.
    const letter = /[^\p{M}\udc00-\udfff]/gu;
    letter.lastIndex = end;
    (texts.currentNode as Text).splitText(letter.exec(data)?.index ?? data.length);
  }
}

/**
 * Returns into how many parts the boxes of a section, laid out in one piece, would be divided by columns, one of
 * each at least. Where they are sure to be few they are not counted, and 0 is returned.
 */
function columnsReached(html: HTMLElement, area: PageSize, isVertical: boolean): number {
  const sheet = html.parentElement as HTMLElement;
  const page = isVertical ? area.width : area.height;
  const all = html.querySelectorAll("*");
  const reach = (isVertical ? sheet.scrollWidth : sheet.scrollHeight) / page;
  if (reach <= limits.pages && reach * all.length <= limits.elements) return 0;
  if (reach > limits.pages) return Number.POSITIVE_INFINITY;
  let parts = 0;
  for (const element of all) {
    const { width, height } = element.getBoundingClientRect();
    parts += Math.max((isVertical ? width : height) / page, 1);
  }
  return parts;
}

/** Returns style sheets without the fonts that nothing in a frame is set in. */
function withUsedFonts(sheets: readonly string[], frame: LayoutFrame): readonly string[] {
  // The faces of rules are in the order of these.
  const faces = frame.fonts();
  const rules = sheets.flatMap((css) => css.match(fontRule) ?? []);
  if (rules.length !== faces.length) return sheets;
  let next = 0;
  return sheets.map((css) =>
    css.replace(fontRule, (rule) => (faces[next++]?.status === "unloaded" ? "" : rule)),
  );
}

/** Returns how many pages a section fills, from how far its columns reach: more than 0. */
function extentOf(
  frame: LayoutFrame,
  html: HTMLElement,
  flow: PageFlow,
  page: PageMeasures,
): number {
  const body = html.querySelector("body") ?? html;
  // What is moved within the body leaves the columns of that as they are, and need not be laid out without.
  const isInPlace = ![html, body].some(isMoved) && columnsOf(body).length > 1;
  const measure = (): number => reachOf(html, body, flow, page);
  return isInPlace ? measure() : unmoved(frame, measure);
}

/** Returns the rectangles of a section's body: one a column, where the browser tells them. */
function columnsOf(body: Element): readonly DOMRect[] {
  return [...body.getClientRects()].filter(({ width, height }) => width > 0 && height > 0);
}

/** Returns what `extentOf` does, of a section in which nothing is moved that it is measured by. */
function reachOf(html: HTMLElement, body: Element, flow: PageFlow, page: PageMeasures): number {
  const columns = columnsOf(body);
  const last = columns.at(-1);
  const reached =
    columns.length > 1 && last ? pageOfRect(flow, last) + 1 : overflowOf(html, flow, page);
  const pages = Math.min(Math.max(reached, 1), limits.pages);
  const height = page.height - 2 * page.ends;
  const isFull = flow.isVertical || !last || pages < reached;
  return isFull ? pages : pages - 1 + Math.min(Math.max(last.height / height, 0.01), 1);
}

/** Returns over how many pages all that is in a section reaches. */
function overflowOf(html: HTMLElement, flow: PageFlow, page: PageMeasures): number {
  const sheet = html.parentElement as HTMLElement;
  // Columns in the direction of the text count as overflow.
  sheet.style.overflow = "hidden";
  sheet.style.direction = flow.stepX < 0 ? "rtl" : "ltr";
  const [length, step] = flow.isVertical
    ? [sheet.scrollHeight, page.height]
    : [sheet.scrollWidth, page.width];
  sheet.style.overflow = "visible";
  return Math.ceil((length - 1) / step);
}

/** Returns the number of slices of a section that is scrolled: each about as high as a page. */
function sliceCount(html: HTMLElement, page: PageMeasures): number {
  return Math.min(Math.max(Math.round(heightOf(html, page) / page.height), 1), limits.pages);
}

/** Returns the height of a section's slices, so that the last is as high as the others. */
function sliceHeight(html: HTMLElement, page: PageMeasures): number {
  return Math.ceil(heightOf(html, page) / sliceCount(html, page));
}

/** Returns the height of a section that is scrolled, with the margins at its head and foot. */
function heightOf(html: HTMLElement, { ends }: PageMeasures): number {
  return html.offsetHeight + 2 * ends;
}

function mapOf(
  html: HTMLElement,
  flow: PageFlow,
  pageCount: number,
  isScrolled: boolean,
): Pick<SectionMap, "ids" | "tops"> {
  const ids = new Map<string, number>();
  const tops = new Map<string, number>();
  for (const element of html.querySelectorAll("[id], a[name]")) {
    const [rect] = element.getClientRects();
    const id = element.id || (element.getAttribute("name") ?? "");
    if (ids.size >= limits.elements || ids.has(id)) continue;
    const page = pageOf(element, flow, pageCount);
    ids.set(id, page);
    if (rect && isScrolled) tops.set(id, rect.top / flow.stepY - page);
  }
  return { ids, tops };
}

/** Returns what a section names and cannot be shown: what is marked so, damaged pictures, and fonts. */
function lostIn(
  frame: LayoutFrame,
  html: HTMLElement,
  flow: PageFlow,
  pageCount: number,
): LostPart[] {
  const lost: LostPart[] = [];
  for (const element of html.querySelectorAll<HTMLElement>(`[${sourceAttribute}]`)) {
    if (lost.length >= limits.warnings) break;
    const source = element.getAttribute(sourceAttribute) ?? "";
    const isDamaged = element.localName === "img" && isUndecodable(element as HTMLImageElement);
    const code = isDamaged ? "image" : (element.getAttribute(lostAttribute) as LostPart["code"]);
    if (code !== null) lost.push({ code, source, page: pageOf(element, flow, pageCount) });
  }
  const failed = frame.fonts().filter(({ status }) => status === "error");
  const families = new Set(failed.map(({ family }) => family.replace(/^["']|["']$/g, "")));
  const fonts = [...families].slice(0, limits.warnings);
  return [...lost, ...fonts.map((source): LostPart => ({ code: "font", source }))];
}

/** Returns whether a picture has come and is none; a drawing need not have a size. */
function isUndecodable(image: HTMLImageElement): boolean {
  const isPicture = image.src !== "" && !image.src.startsWith("data:image/svg");
  return isPicture && image.complete && image.naturalWidth === 0;
}

/** Returns the page on which an element begins, of so many. */
function pageOf(element: Element, flow: PageFlow, pageCount: number): number {
  const [rect] = element.getClientRects();
  return Math.min(Math.max(rect ? pageOfRect(flow, rect) : 0, 0), pageCount - 1);
}

/** Returns a section's links to notes, and which of its elements have no text that a note could be. */
function notesIn(
  html: HTMLElement,
  flow: PageFlow,
  pageCount: number,
): Pick<SectionMap, "noteLinks" | "blankIds"> {
  const noteLinks: NoteLink[] = [];
  for (const link of html.querySelectorAll("a[href]")) {
    if (noteLinks.length >= limits.annotations) break;
    if (!isNoteLink(link)) continue;
    noteLinks.push({ href: link.getAttribute("href") ?? "", page: pageOf(link, flow, pageCount) });
  }
  return { noteLinks, blankIds: blankIds(html) };
}
