import { cleanText } from "../book_text.ts";
import { isPageSize, limits } from "../limits.ts";
import type { PageBox, PageColours, PageSize, TextRun, Typography } from "../page_source.ts";
import { orAborted } from "../shared_tasks.ts";
import { alignText, alignUnsaid } from "./align_text.ts";
import { honourBreaks } from "./asked_breaks.ts";
import { setStyles } from "./box_styles.ts";
import { fitBoxes, fixCrossed } from "./fit_boxes.ts";
import { fitFormulas } from "./fit_formulas.ts";
import {
  type FlowContent,
  type LostPart,
  lostAttribute,
  mediumAttribute,
  mediumKindAttribute,
  sourceAttribute,
} from "./flow_book.ts";
import {
  applyInlineStyles,
  drawingOf,
  fontRule,
  isMoved,
  type LayoutFrame,
  loadedIn,
  openFrame,
  ownStyle,
  unmoved,
} from "./frame.ts";
import { hideUnseen } from "./hide_unseen.ts";
import { divideWords } from "./hyphenation/divide_words.ts";
import { bleed } from "./lone_picture.ts";
import { type MarginStyle, Markup, type PageMargins } from "./markup.ts";
import { blankIds, isNoteLink, noteText } from "./notes.ts";
import { leafOf, measuresOf, type PageMeasures } from "./page_measures.ts";
import { mostNanoseconds, paintingOf } from "./paint_cost.ts";
import { placeBoxes } from "./place_boxes.ts";
import { type PageFlow, pageOfRect, TextMap } from "./text_map.ts";
import { type TitleFace, titleFaceIn } from "./title_font.ts";
import { trimHeights } from "./trim_heights.ts";
import { isTypeface, typefaceRules } from "./typefaces/typefaces.ts";
import {
  baseStyle,
  columnStyle,
  fixedStyle,
  readerStyle,
  rollStyle,
  spokenAttribute,
} from "./typography.ts";
import { writingOf } from "./writing_direction.ts";

/** The root's type size, from which the book's own is reckoned. */
const rootSize = 16;

/** Size of the running head and of the page's number, CSS pixels, whatever size is chosen for the text. */
const marginSize = 12;

/** The class of what is read aloud, where the book names none, and its style. */
const spokenClass = "turnleaf-read-aloud";
const spokenStyle = `.${spokenClass} { background-color: #ffe27a; color: #000; }`;

/** A link as the book writes it, and its box on its page. */
export interface LaidLink extends PageBox {
  readonly href: string;
  readonly title: string;
  /** Whether it leads to a note. */
  readonly isNote: boolean;
}

/** A sound or a film as the book writes it, and its box on its page. */
export interface LaidMedium extends PageBox {
  readonly address: string;
  readonly kind: "audio" | "video";
  readonly title: string;
}

/** What is read aloud in a section now. */
export interface SpokenMark {
  /** The id of the element that is read. */
  readonly id: string;
  /** Its class, and that of the section's root; "" for none. */
  readonly activeClass: string;
  readonly playbackClass: string;
}

/** The text of an element of a section. */
export interface Passage {
  readonly text: string;
  /** The pages (from 0) on which it stands, and the fraction of it before each. */
  readonly pages: readonly { readonly page: number; readonly from: number }[];
}

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

/** What rejects a section of which too much lies upon each other on a page to be painted. */
export class OverpaintedError extends Error {}

/** A section set into pages, in a frame of its own. */
export class LaidSection {
  readonly map: SectionMap;
  /** The size of `svg()`. */
  readonly layoutSize: PageSize;
  readonly #frame: LayoutFrame;
  readonly #flow: PageFlow;
  readonly #text: TextMap;
  readonly #makeMarkup: () => Markup;
  readonly #fontRules: () => readonly string[];
  /** The section as it is drawn, with what is read aloud marked in it; made when it is first drawn. */
  #markup: Markup | null = null;
  readonly #html: HTMLElement;
  #spoken: SpokenMark | null = null;
  /** The page's own unit over the frame's CSS pixels. */
  readonly #scale: number;

  private constructor(frame: LayoutFrame, flow: PageFlow, map: SectionMap, parts: LaidParts) {
    this.#frame = frame;
    this.#flow = flow;
    this.map = map;
    this.#text = parts.text;
    this.#makeMarkup = parts.markup;
    this.#fontRules = parts.fontRules;
    this.layoutSize = parts.layoutSize;
    this.#html = parts.html;
    this.#scale = map.size.width / this.layoutSize.width;
  }

  /**
   * Lays a section out. Rejects with any error of the browser, with an `OverpaintedError`, and with the
   * signal's reason, as soon as that aborts: its frame is gone then.
   *
   * @param isScrolled whether its pages hang together, so that a line may be cut
   * where one ends
   */
  static async lay(
    content: FlowContent,
    typography: Typography,
    isScrolled = false,
    signal?: AbortSignal,
  ): Promise<LaidSection> {
    const size = content.size ?? measuresOf(typography);
    const frame = await openFrame(size.width, size.height, signal);
    const abandon = (): void => frame.close();
    signal?.addEventListener("abort", abandon);
    try {
      const made = (...parts: MadeParts): LaidSection => new LaidSection(...parts);
      const laying = layIn(frame, content, typography, isScrolled, made);
      return await (signal ? orAborted(laying, signal) : laying);
    } catch (error) {
      frame.close();
      throw error;
    } finally {
      signal?.removeEventListener("abort", abandon);
    }
  }

  /**
   * Returns a page as an SVG, in colours of the reader's if there are any.
   *
   * @param margins what stands in its margins
   */
  svg(page: number, margins: PageMargins, colours: PageColours | null): string {
    const { stepX, stepY } = this.#flow;
    this.#markup ??= this.#makeMarkup();
    return this.#markup.svg(page, { x: -page * stepX, y: -page * stepY }, margins, colours);
  }

  /** Returns the text of a page. */
  runs(page: number, exact: boolean): TextRun[] {
    return this.#text.runs(page, exact).map((run) => ({ ...run, ...this.#scaled(run) }));
  }

  /** Returns the links on a page. */
  links(page: number): LaidLink[] {
    const links: LaidLink[] = [];
    for (const link of this.#frame.root.querySelectorAll("a[href]")) {
      const href = link.getAttribute("href") ?? "";
      const title = cleanText(link.getAttribute("title") ?? link.textContent, limits.labelLength);
      for (const rect of link.getClientRects()) {
        if (rect.width === 0 || rect.height === 0) continue;
        if (pageOfRect(this.#flow, rect) !== page) continue;
        if (links.length >= limits.annotations) return links;
        links.push({ ...this.#onPage(rect, page), href, title, isNote: isNoteLink(link) });
      }
    }
    return links;
  }

  /** Returns the sounds and films on a page. */
  media(page: number): LaidMedium[] {
    const media: LaidMedium[] = [];
    for (const element of this.#frame.root.querySelectorAll(`[${mediumAttribute}]`)) {
      const [rect] = element.getClientRects();
      if (!rect || rect.width === 0 || rect.height === 0) continue;
      if (pageOfRect(this.#flow, rect) !== page || media.length >= limits.annotations) continue;
      const address = element.getAttribute(mediumAttribute) ?? "";
      const name = element.getAttribute("title") || address.split("/").pop();
      media.push({
        ...this.#onPage(rect, page),
        address,
        kind: element.getAttribute(mediumKindAttribute) === "video" ? "video" : "audio",
        title: cleanText(name, limits.labelLength),
      });
    }
    return media;
  }

  /** Returns the text of the note that has an id; empty if there is none. */
  note(id: string): string {
    const target = id === "" ? null : this.#element(id);
    return target ? noteText(target) : "";
  }

  /** Returns the text of the element that has an id, and the pages on which it stands; null if there is none. */
  passage(id: string): Passage | null {
    const element = this.#element(id);
    if (element === null) return null;
    const text = cleanText(element.textContent, limits.passageLength);
    const { offset, length } = this.#text.extentOf(element);
    if (length === 0) return { text, pages: [{ page: this.map.ids.get(id) ?? 0, from: 0 }] };
    const first = this.#text.pageAt(offset);
    const count = this.#text.pageAt(offset + length - 1) - first + 1;
    const pages = Array.from({ length: count }, (_, k) => {
      const before = (this.map.starts[first + k] ?? offset) - offset;
      return { page: first + k, from: Math.max(before / length, 0) };
    });
    return { text, pages };
  }

  /** Returns the face of its first heading; null if the book chose none. */
  titleFace(): TitleFace | null {
    return titleFaceIn(this.#html, this.#fontRules);
  }

  /** Marks what is read aloud, in what is drawn from now on; null removes the mark. */
  mark(spoken: SpokenMark | null): void {
    if (spoken?.id === this.#spoken?.id) return;
    for (const [mark, isOn] of [
      [this.#spoken, false],
      [spoken, true],
    ] as const) {
      if (mark === null) continue;
      if (mark.playbackClass !== "") this.#html.classList.toggle(mark.playbackClass, isOn);
      const element = this.#element(mark.id);
      element?.classList.toggle(mark.activeClass || spokenClass, isOn);
      element?.toggleAttribute(spokenAttribute, isOn);
    }
    this.#spoken = spoken;
    this.#markup = null;
  }

  #element(id: string): Element | null {
    // Without an id it is all of the section.
    return id === "" ? this.#html : this.#html.querySelector(`[id="${CSS.escape(id)}"]`);
  }

  /** Returns what the pictures on a page show, in words. */
  alt(page: number): string {
    const said = [...this.#frame.root.querySelectorAll("img[alt], svg > title")]
      .filter((element) => {
        const [rect] = drawingOf(element, this.#html).getClientRects();
        return rect !== undefined && pageOfRect(this.#flow, rect) === page;
      })
      .map((element) => element.getAttribute("alt") ?? element.textContent);
    return cleanText(said.join(" "), limits.altLength);
  }

  close(): void {
    this.#frame.close();
  }

  #onPage(rect: DOMRect, page: number): PageBox {
    const { stepX, stepY } = this.#flow;
    const { width, height } = rect;
    return this.#scaled({ x: rect.left - page * stepX, y: rect.top - page * stepY, width, height });
  }

  #scaled({ x, y, width, height }: PageBox): PageBox {
    const scale = this.#scale;
    return { x: x * scale, y: y * scale, width: width * scale, height: height * scale };
  }
}

interface LaidParts {
  readonly text: TextMap;
  /** Returns the section as it is now. */
  readonly markup: () => Markup;
  /** Returns the rules of the fonts in which it is set. */
  readonly fontRules: () => readonly string[];
  readonly html: HTMLElement;
  readonly layoutSize: PageSize;
}

type MadeParts = [frame: LayoutFrame, flow: PageFlow, map: SectionMap, parts: LaidParts];

async function layIn<T>(
  frame: LayoutFrame,
  content: FlowContent,
  typography: Typography,
  isScrolled: boolean,
  done: (...parts: MadeParts) => T,
): Promise<T> {
  const leaf = leafOf(typography);
  let page = measuresOf(typography);
  let size = content.size ?? { width: page.width, height: page.height };
  const html = frame.document.importNode(content.root, true) as HTMLElement;
  applyInlineStyles(html);
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
  frame.adopt([...own, reader]);
  const { writingMode, direction, isMixed } = writingOf(body, view);
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
  // What the book calls the root's size is that of its own <html>.
  const rem = view.getComputedStyle(html).fontSize;
  html.style.setProperty("font-size", rem, "important");
  frame.drawing.style.setProperty("font-size", rem, "important");
  frame.adopt([...own, ...inColumns]);
  if (!content.size) {
    alignText(body, typography.align);
    alignUnsaid(body, typography);
    if (typography.hyphens !== "none") await divideWords(body);
  }
  await loadedIn(frame, html);
  const area = { width: page.width - 2 * page.sides, height: page.height - 2 * page.ends };
  if (inColumns.length > 0 && (await bleed(html, area, page))) {
    page = { ...page, sides: 0, ends: 0 };
    own.push(reader, columnStyle(page, isVertical, isVertical ? "ltr" : direction));
    frame.adopt(own);
  } else if (!content.size) {
    own.push(...inColumns);
    // A roll has no ends that anything could be cut at.
    const ends = isSliced ? { height: Number.POSITIVE_INFINITY } : {};
    const fitted = new WeakSet<Element>();
    const fit = (): void => fitBoxes(body, { ...area, ...ends }, writingMode, fitted);
    hideUnseen(body, flow);
    if (!isSliced) honourBreaks(body, writingMode);
    fit();
    fitFormulas(body, isVertical);
    if (placeBoxes(frame, body, flow, { ...page, ...ends })) fit();
    if (!isSliced) trimHeights(body, flow, area);
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
  if (paintingOf(html, content.styles, size, flow) > mostNanoseconds) throw new OverpaintedError();
  const text = new TextMap(body, flow, pageCount);
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
  return done(
    frame,
    flow,
    { ...map, starts: text.starts, length: text.length },
    {
      text,
      markup,
      fontRules: () => styles.flatMap((css) => css.match(fontRule) ?? []),
      html,
      layoutSize: size,
    },
  );
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

/** Returns whether a page's size is usable for a page of fixed layout. */
export function isUsableSize(size: PageSize): boolean {
  return isPageSize(size) && size.width >= 1 && size.height >= 1;
}
