/**
 * Boxes that are larger than the type area. A browser scrolls what does not fit; a page cannot, and what
 * lies beyond it is lost. So boxes that do not break from page to page are made to, and lines, tables and
 * boxes that are too wide are made narrower, or, if tables, turned onto pages of their own.
 */

import {
  lengthsOf,
  opened,
  type Styles,
  setStyles,
  tableParts,
  tolerance,
  widthOf,
} from "./box_styles.ts";
import { isMoved } from "./frame.ts";
import { splitCrossed } from "./split_crossed.ts";
import { splitTable } from "./split_table.ts";
import { boxesIn } from "./style_mentions.ts";
import { type PageFlow, pageOfRect } from "./text_map.ts";

/** Rounds of measuring and changing: a box that is opened shows those within it, at most so deep. */
const rounds = 8;

/** The smallest size of a table that is too wide, over its own; narrower still, it is turned, or its words are broken. */
const smallestTable = 0.6;

/** From one size of a turned table that is tried to the next. */
const sizeStep = 0.1;

/** Pictures. */
const replaced = /^(img|video|canvas|object)$/;

/** Controls that are drawn whole. */
const drawnControl = /^(input|meter|progress)$/;

/** How the pages of a section lie, and where the type area is on each: CSS pixels. */
export interface PageArea {
  readonly flow: PageFlow;
  /** How long its lines are, and how much there is across them: of no end in a roll. */
  readonly line: number;
  readonly page: number;
  /** Where lines begin, from the edge of the page at the left or, if they are vertical, at its head. */
  readonly margin: number;
}

/**
 * Changes the styles of the boxes in a section that is set in columns, so that all of them fit.
 *
 * @param body the section's body, laid out
 * @param writingMode of the section: a box of another one does not break
 * @param known boxes that have been changed, which stay as they are
 */
export function fitBoxes(
  body: Element,
  area: PageArea,
  writingMode: string,
  known: WeakSet<Element>,
): void {
  const { line, page, flow } = area;
  const { isVertical } = flow;
  const view = body.ownerDocument.defaultView as Window & typeof globalThis;
  const range = body.ownerDocument.createRange();
  for (let round = 0; round < rounds; round++) {
    const changes: [HTMLElement, Styles][] = [];
    let done: Element | null = null;
    for (const element of [body as HTMLElement, ...boxesIn(body)]) {
      if (!(element instanceof view.HTMLElement) || known.has(element)) continue;
      // What is within a box that changes is looked at once that has changed.
      if (done?.contains(element)) continue;
      // One rectangle for each page that it is on.
      const rects = [...element.getClientRects()];
      if (rects.length === 0) continue;
      const isWhole = rects.length === 1;
      const isHigh = isWhole && extentOf(rects[0] as DOMRect, isVertical).down > page + tolerance;
      const isOverrun = !isWhole && hasItemsBeyond(element, rects, view, isVertical);
      const isPast = isBeyond(element, rects, area);
      const isWide =
        isOverrun ||
        isPast ||
        isLongerThan(line, element, rects, isVertical) ||
        (isWhole && isOverlong(element, isVertical));
      const isLined =
        isWhole || !/^(?:pre|nowrap)$/.test(view.getComputedStyle(element).whiteSpace);
      if (isBesideFloat(element, rects, isVertical)) {
        known.add(element);
        changes.push([element, { clear: "both" }]);
        done = element;
        continue;
      }
      // Where it has all of a line it may have room for them; it is looked at again.
      if (isOverrun && view.getComputedStyle(element).clear === "none") {
        changes.push([element, { clear: "both" }]);
        done = element;
        continue;
      }
      if (!isHigh && !isWide && isLined && !isOverfull(element, rects, range)) continue;
      known.add(element);
      // What is not seen would only take room.
      if (view.getComputedStyle(element).visibility === "hidden") continue;
      // The items of a grid are as wide as its tracks.
      const grid = isWide ? element.parentElement : null;
      const isItem = grid !== null && view.getComputedStyle(grid).display.endsWith("grid");
      const box = isItem ? grid : element;
      const style = view.getComputedStyle(box);
      const room = isPast ? Math.min(line, roomFrom(rects, area)) : line;
      const type = { line: room, page, isVertical };
      const isNarrowed = isWide || !isLined;
      changes.push([
        box,
        crossedChange(box, style, type) ??
          wholeChange(box, style, { isWide, isHigh }, type) ?? {
            ...opened(style, writingMode),
            ...(isNarrowed ? narrowed(box, style, type) : {}),
          },
      ]);
      done = box;
    }
    if (changes.length === 0) return;
    for (const [element, change] of changes) setStyles(element, change);
  }
}

/**
 * Returns whether a table begins beside a float that ends before it. A browser gives its rows the heights of
 * that narrow beginning, and where they go on wider leaves pages empty.
 */
function isBesideFloat(
  element: HTMLElement,
  rects: readonly DOMRect[],
  isVertical: boolean,
): boolean {
  if (rects.length < 2 || element.localName !== "table") return false;
  const width = widthOf(rects, isVertical);
  return rects.some((rect) => width > extentOf(rect, isVertical).across + tolerance);
}

/**
 * Returns whether items of a flexible box or a grid on several pages go on beyond it at the ends of its lines, as
 * where a float leaves it less room than they need.
 */
function hasItemsBeyond(
  element: HTMLElement,
  rects: readonly DOMRect[],
  view: Window,
  isVertical: boolean,
): boolean {
  const { display, direction } = view.getComputedStyle(element);
  if (!/(?:flex|grid)$/.test(display)) return false;
  const isReversed = direction === "rtl";
  const startOf = (rect: DOMRect): number =>
    isVertical ? (isReversed ? -rect.bottom : rect.top) : isReversed ? -rect.right : rect.left;
  const endOf = (rect: DOMRect): number => startOf(rect) + extentOf(rect, isVertical).across;
  for (const item of element.children) {
    if (view.getComputedStyle(item).position === "absolute") continue;
    for (const rect of item.getClientRects()) {
      const apart = (one: DOMRect): number => Math.abs(startOf(one) - startOf(rect));
      // The one on its page is the nearest.
      const own = rects.reduce((near, one) => (apart(one) < apart(near) ? one : near));
      if (rect.width > 0 && endOf(rect) > endOf(own) + tolerance) return true;
    }
  }
  return false;
}

/** Returns where the type area of a rectangle's page begins and ends along lines. */
function edgesOf(rect: DOMRect, { flow, line, margin }: PageArea): readonly [number, number] {
  const step = flow.isVertical ? flow.stepY : flow.stepX;
  const start = pageOfRect(flow, rect) * step + margin;
  return [start, start + line];
}

/** Returns where a rectangle begins and ends along lines. */
function endsOf(rect: DOMRect, isVertical: boolean): readonly [number, number] {
  return isVertical ? [rect.top, rect.bottom] : [rect.left, rect.right];
}

/**
 * Returns whether a box begins or ends beyond the type area and what it is in, as one of a width of its own does
 * that is indented. What is meant to stand in the margin has negative margins, or is moved.
 */
function isBeyond(element: HTMLElement, rects: readonly DOMRect[], area: PageArea): boolean {
  const { isVertical } = area.flow;
  const isPast = (rect: DOMRect): boolean => {
    const [[from, to], [start, end]] = [endsOf(rect, isVertical), edgesOf(rect, area)];
    // One that is for the most part elsewhere is put back as a whole.
    const within = Math.min(to, end) - Math.max(from, start);
    const isPartOf = within > (to - from) / 2;
    return isPartOf && (from < start - tolerance || to > end + tolerance);
  };
  const past = rects.filter(isPast);
  if (past.length === 0) return false;
  const view = element.ownerDocument.defaultView as Window;
  const style = view.getComputedStyle(element);
  const isMeant =
    style.position !== "static" ||
    isMovedWithin(element) ||
    lengthsOf(style, "margin-inline-start", "margin-inline-end").some((margin) => margin < 0);
  if (isMeant || /^(?:inline|contents|table-.*)$/.test(style.display)) return false;
  const around = [...(element.parentElement?.getClientRects() ?? [])];
  return past.some((rect) => {
    const [from, to] = endsOf(rect, isVertical);
    return !around.some((one) => {
      const [start, end] = endsOf(one, isVertical);
      return from > start - tolerance && to < end + tolerance;
    });
  });
}

/** Returns whether a box is longer than a line, but for what it is to reach into the margins. */
function isLongerThan(
  line: number,
  element: HTMLElement,
  rects: readonly DOMRect[],
  isVertical: boolean,
): boolean {
  const width = widthOf(rects, isVertical);
  if (width <= line + tolerance) return false;
  const view = element.ownerDocument.defaultView as Window;
  const style = view.getComputedStyle(element);
  const margins = lengthsOf(style, "margin-inline-start", "margin-inline-end");
  return margins.reduce((sum, margin) => sum + Math.min(margin, 0), width) > line + tolerance;
}

/** Returns whether a box, or one that it is in, is moved after it is laid out. */
function isMovedWithin(element: Element): boolean {
  for (
    let box: Element | null = element;
    box && box.localName !== "body";
    box = box.parentElement
  ) {
    if (isMoved(box)) return true;
  }
  return false;
}

/** Returns how much room there is from where a box begins to where lines end. */
function roomFrom(rects: readonly DOMRect[], area: PageArea): number {
  return rects.reduce((most, rect) => {
    const [[from, to], [start, end]] = [endsOf(rect, area.flow.isVertical), edgesOf(rect, area)];
    // From right to left it ends where it begins.
    return Math.max(most, from < start - tolerance ? to - start : end - from);
  }, Number.NEGATIVE_INFINITY);
}

/** Returns how long a rectangle is along lines and across them. */
function extentOf(
  { width, height }: DOMRect,
  isVertical: boolean,
): { across: number; down: number } {
  return isVertical ? { across: height, down: width } : { across: width, down: height };
}

/** Returns whether a line in a box that is on one page is longer than the box. */
function isOverlong(element: HTMLElement, isVertical: boolean): boolean {
  // Only a box has one: a part of a line has no width of its own.
  const inner = isVertical ? element.clientHeight : element.clientWidth;
  if (inner === 0) return false;
  return (isVertical ? element.scrollHeight : element.scrollWidth) > inner + tolerance;
}

/**
 * Returns whether what is in a box ends beyond it. By the place of what is last in it, as a browser does
 * not measure what goes on in the next column.
 */
function isOverfull(element: HTMLElement, rects: readonly DOMRect[], range: Range): boolean {
  const last = element.lastChild;
  if (element.clientHeight === 0 || last === null) return false;
  const own = rects.at(-1);
  range.selectNode(last);
  const end = [...range.getClientRects()].findLast(({ width, height }) => width > 0 && height > 0);
  if (!own || !end) return false;
  const isBelow = end.bottom > own.bottom + tolerance || end.top > own.bottom;
  return isBelow || end.left > own.right + tolerance || end.right < own.left - tolerance;
}

/** The type area as lines lie in it: how long they are, and how much there is across them. */
interface TypeArea {
  readonly line: number;
  readonly page: number;
  readonly isVertical: boolean;
}

/** Returns the styles by which a box that stays whole is smaller, or none; null for one whose content may be laid out anew. */
function wholeChange(
  box: HTMLElement,
  style: CSSStyleDeclaration,
  { isWide, isHigh }: { readonly isWide: boolean; readonly isHigh: boolean },
  area: TypeArea,
): Styles | null {
  // The legend of a fieldset is whole whatever its style is.
  if (isHigh && box.localName === "legend") return { display: "contents" };
  if (drawnControl.test(box.localName)) {
    const [inline, block] = [`${area.line}px`, `${area.page}px`];
    return {
      ...{ "min-inline-size": "0", "min-block-size": "0", "max-inline-size": inline },
      ...(isHigh && { "max-block-size": block }),
    };
  }
  // The section's own style has pictures fit, unless they may not be smaller.
  if (replaced.test(box.localName)) return { "min-inline-size": "0", "min-block-size": "0" };
  if (isWide && isPlacing(box, style)) return scaledDown(box, area);
  return isBare(box) ? bareBox(style, area) : null;
}

/**
 * Returns the styles by which a box whose lines stand across those around it fits on a page as it is, with lines
 * no longer than there is room for, or on several, into which it is split; null for others, and for one that has
 * no room even so.
 */
function crossedChange(
  box: HTMLElement,
  style: CSSStyleDeclaration,
  { line, page, isVertical }: TypeArea,
): Styles | null {
  const isAcross = ({ writingMode }: CSSStyleDeclaration): boolean =>
    writingMode.startsWith("horizontal") === isVertical;
  const view = box.ownerDocument.defaultView as Window;
  const isWithin = isAcross(view.getComputedStyle(box.parentElement as Element));
  // A roll has no pages.
  if (!isAcross(style) || isWithin || !Number.isFinite(page) || tableParts.test(style.display)) {
    return null;
  }
  const shorter = {
    "max-inline-size": `${page}px`,
    "min-inline-size": "0",
    "break-inside": "avoid",
  };
  const own = box.style.cssText;
  setStyles(box, shorter);
  const [rect, ...others] = box.getClientRects();
  const { across, down } = extentOf(rect ?? new DOMRect(), isVertical);
  const isFull =
    isOverlong(box, isVertical) ||
    isOverlong(box, !isVertical) ||
    isOverfull(box, [rect ?? new DOMRect()], box.ownerDocument.createRange());
  const fits = across <= line + tolerance && down <= page + tolerance;
  if (rect && others.length === 0 && fits && !isFull) {
    box.style.cssText = own;
    return shorter;
  }
  const paged = { ...shorter, "break-before": "column", "break-after": "column" };
  setStyles(box, paged);
  if (/^(?:block|flow-root)$/.test(style.display) && splitCrossed(box, line, paged)) return paged;
  box.style.cssText = own;
  return null;
}

/** Returns whether nothing is in a box, which shows its background alone. */
function isBare(box: HTMLElement): boolean {
  const shown = "img, svg, math, video, canvas, object, input, meter, progress, hr";
  return !box.textContent?.trim() && !box.matches(shown) && !box.querySelector(shown);
}

/** Returns the styles by which a box in which nothing is fits, with its own height where there is room for it. */
function bareBox({ display }: CSSStyleDeclaration, { page }: TypeArea): Styles | null {
  if (tableParts.test(display) || display.endsWith("table")) return null;
  return {
    ...{ "max-inline-size": "100%", "min-inline-size": "0", "box-sizing": "border-box" },
    ...{ "max-block-size": `${page - tolerance}px`, "min-block-size": "0", overflow: "hidden" },
  };
}

/** Returns whether all that a box shows is put somewhere in it, as on a page of fixed layout. */
function isPlacing(box: HTMLElement, { position }: CSSStyleDeclaration): boolean {
  const view = box.ownerDocument.defaultView as Window;
  const shown = [...box.childNodes].filter(
    (node) => (node as Partial<Element>).getClientRects || node.nodeValue?.trim(),
  );
  const isPut = (node: Node): boolean =>
    node.nodeType === Node.ELEMENT_NODE &&
    view.getComputedStyle(node as Element).position === "absolute";
  return position !== "static" && shown.length > 0 && shown.every(isPut);
}

/** Returns the styles by which a box that is too wide is smaller, with all that is in it. */
function scaledDown(box: HTMLElement, { line, isVertical }: TypeArea): Styles {
  const width = widthOf([...box.getClientRects()], isVertical);
  const content = isVertical ? box.scrollHeight : box.scrollWidth;
  return { zoom: zoomOf(line / Math.max(width, content)), "break-inside": "avoid" };
}

/** Returns the styles by which a box is no wider than a line. */
function narrowed(element: HTMLElement, style: CSSStyleDeclaration, area: TypeArea): Styles {
  const { display, whiteSpace } = style;
  if (tableParts.test(display)) return {};
  const view = element.ownerDocument.defaultView as Window;
  const row = element.querySelector("tr");
  // A table that was made a box to be scrolled.
  const isBoxed =
    element.localName === "table" &&
    display === "block" &&
    row !== null &&
    view.getComputedStyle(row).display === "table-row";
  if (isBoxed) setStyles(element, { display: "table", overflow: "visible" });
  if (isBoxed || display === "table" || display === "inline-table") {
    return fittedTable(element, area);
  }
  const change: Record<string, string> = {
    ...{ "max-inline-size": `min(100%, ${roomWithin(style, area)}px)`, "min-inline-size": "0" },
    ...{ "overflow-wrap": "break-word", "word-break": "normal" },
  };
  if (whiteSpace === "pre") change["white-space"] = "pre-wrap";
  else if (whiteSpace === "nowrap") change["white-space"] = "normal";
  if (display.endsWith("flex")) change["flex-wrap"] = "wrap";
  if (display.endsWith("grid")) change.display = "block";
  return change;
}

/** Returns how long the lines in a box may be, CSS pixels, or the box itself if its size is that of all of it. */
function roomWithin(style: CSSStyleDeclaration, { line }: TypeArea): number {
  if (style.boxSizing === "border-box") return line;
  const edges = lengthsOf(
    style,
    ...["padding-inline-start", "padding-inline-end"],
    ...["border-inline-start-width", "border-inline-end-width"],
  );
  const room = line - edges.reduce((sum, length) => sum + length, 0);
  // What is wider than that by its edges has these taken away.
  return room > 0 ? room : line;
}

/** Returns the styles of a table that is as wide as a line: smaller, or turned, and else with broken words. */
function fittedTable(table: HTMLElement, area: TypeArea): Styles {
  const { line, isVertical } = area;
  const cells = [...table.querySelectorAll<HTMLElement>("th, td, th *, td *, col")];
  const setAll = (name: string, value: string): void => {
    for (const cell of cells) cell.style.setProperty(name, value, "important");
  };
  for (const name of ["inline-size", "min-inline-size"]) setAll(name, "auto");
  setAll("white-space", "normal");
  // By a fixed layout its columns would be as narrow as nothing, whatever is in them.
  table.style.setProperty("table-layout", "auto", "important");
  table.style.setProperty("inline-size", "min-content", "important");
  const least = widthOf([...table.getClientRects()], isVertical);
  const size = Math.max(Math.min(line / least, 1), smallestTable);
  if (least * size > line) {
    const turned = turnedTable(table, least, area);
    if (turned) return turned;
    // By an element's own style sheet words are broken where a line has no room, not to make it narrower.
    setAll("overflow-wrap", "anywhere");
  }
  const change = { "inline-size": "auto", "max-inline-size": "100%" };
  return size < 1 ? { ...change, zoom: zoomOf(size) } : change;
}

const zoomOf = (size: number): string => String(Math.floor(size * 1000) / 1000);

/**
 * Returns the styles by which a table that is too wide lies sideways on a page of its own, as large as it
 * can; or on several, between whose rows it is split. Null if it has no room there either.
 *
 * @param least its width where its columns are as narrow as their words
 */
function turnedTable(table: HTMLElement, least: number, area: TypeArea): Styles | null {
  const { line, page, isVertical } = area;
  // A roll has no pages, and lines that stand upright are not turned.
  if (isVertical || !Number.isFinite(page)) return null;
  const largest = Math.min(page / least, 1);
  const own = table.style.cssText;
  for (let size = largest; size >= smallestTable; size -= sizeStep) {
    const styles = turnedStyles(page, size);
    setStyles(table, styles);
    const { width, height } = table.getBoundingClientRect();
    table.style.cssText = own;
    if (width <= line + tolerance && height <= page + tolerance) return styles;
  }
  if (largest < smallestTable || table.localName !== "table") return null;
  const styles = turnedStyles(page, largest);
  setStyles(table, styles);
  const isHigh = table.getBoundingClientRect().height > page + tolerance;
  const parts = isHigh ? null : splitTable(table as HTMLTableElement, line, Number(styles.zoom));
  if (parts) return styles;
  table.style.cssText = own;
  return null;
}

/** Returns the styles by which a table lies sideways, as long as the page is high. */
function turnedStyles(page: number, size: number): Styles {
  return {
    "writing-mode": "vertical-rl",
    "text-orientation": "sideways",
    "inline-size": `${Math.floor(page / size)}px`,
    "max-inline-size": "none",
    "block-size": "auto",
    "break-before": "column",
    "break-after": "column",
    "break-inside": "avoid",
    margin: "0",
    zoom: zoomOf(size),
  };
}

/**
 * Fixes how long the lines are in boxes where they stand across those around them, as they are laid out. By
 * themselves they are as long as the view lets them be, which is another where a section is drawn.
 *
 * @param body the section's body, laid out
 */
export function fixCrossed(body: Element): void {
  const view = body.ownerDocument.defaultView as Window & typeof globalThis;
  const isUpright = (element: Element): boolean =>
    !view.getComputedStyle(element).writingMode.startsWith("horizontal");
  const lengths = new Map<HTMLElement, string>();
  for (const element of body.querySelectorAll<HTMLElement>("*")) {
    if (isUpright(element) === isUpright(element.parentElement as Element)) continue;
    lengths.set(element, view.getComputedStyle(element).inlineSize);
  }
  for (const [element, length] of lengths) setStyles(element, { "inline-size": length });
}
