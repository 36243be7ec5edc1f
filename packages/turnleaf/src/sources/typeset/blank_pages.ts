/**
 * Pages on which nothing would be seen: those between two breaks about an empty box, and those of blank
 * lines and paragraphs alone.
 */

import { type Styles, setStyles } from "./box_styles.ts";
import { boxesIn } from "./style_mentions.ts";
import { type PageFlow, pageOfRect } from "./text_map.ts";

/** What is seen without any text in it. */
const shown = "img, svg, math, video, canvas, object, input, meter, progress, textarea, select, hr";

/** The largest room above what comes first, of a page: the more would leave its page empty. */
const mostRoom = 1 / 3;

/** Lines of a text of which fewer fill no page. */
const fewLines = 10;

/**
 * Takes away what leaves pages empty and is nothing itself: breaks about boxes that have neither content nor a
 * height, blank lines and paragraphs that go on over a whole page, and room above the first words that is as
 * high as a page. A page stays where a book breaks pages about a blank line: it is to be one.
 *
 * @param body of a section that is set in columns, laid out
 * @param page the length of a page across lines, CSS pixels
 */
export function closeBlankPages(body: Element, flow: PageFlow, page: number): void {
  const view = body.ownerDocument.defaultView as Window;
  const { empty, painted } = emptyIn(body, view);
  hideBlankLines(body, page);
  hideLineEnds(body, empty, page);
  const nothings = new Map<HTMLElement, number>();
  for (const element of empty) {
    const [rect] = element.getClientRects();
    if (rect) nothings.set(element, pageOfRect(flow, rect));
  }
  const blank = new Set([...nothings.values(), 0]);
  const first = takeFilled(body, flow, blank, painted);
  if (blank.size === 0) return;
  const changes: [HTMLElement, Styles][] = [];
  const isAsked = new Set<number>();
  for (const [element, on] of nothings) {
    if (!blank.has(on)) continue;
    if (!hasBreak(element, view)) continue;
    if (element.getClientRects()[0]?.height) isAsked.add(on);
    else changes.push([element, { "break-before": "auto", "break-after": "auto" }]);
  }
  for (const [element, on] of nothings) {
    const isLine = blank.has(on) && !isAsked.has(on) && element.getClientRects()[0]?.height;
    // What links may lead to has a place.
    if (isLine && element.id === "") changes.push([element, { display: "none" }]);
  }
  for (let box = first; blank.has(0) && box && box !== body; box = box.parentElement) {
    const room = Number.parseFloat(view.getComputedStyle(box).marginBlockStart);
    if (room > page / 2) changes.push([box, { "margin-block-start": `${mostRoom * page}px` }]);
  }
  for (const [element, change] of changes) setStyles(element, change);
}

/**
 * Hides blank lines of text whose lines end where it says so, of more than fill a page: they would be pages of
 * nothing. Its characters are counted as before.
 */
function hideBlankLines(body: Element, page: number): void {
  const view = body.ownerDocument.defaultView as Window;
  const nodes = body.ownerDocument.createTreeWalker(body, NodeFilter.SHOW_TEXT);
  const excess: Range[] = [];
  for (let node = nodes.nextNode(); node !== null; node = nodes.nextNode()) {
    const lines = (node as Text).data.split("\n");
    if (lines.length < fewLines) continue;
    const parent = node.parentElement as Element;
    if (!/pre|break/.test(view.getComputedStyle(parent).whiteSpace)) continue;
    const most = Math.max(Math.floor(page / lineOf(parent, view)) - 1, 1);
    for (const [from, to] of blankRuns(lines, most)) {
      const range = body.ownerDocument.createRange();
      range.setStart(node, from);
      range.setEnd(node, to);
      excess.push(range);
    }
  }
  // From the end, as each divides the text before it.
  for (const range of excess.reverse()) {
    const hidden = body.ownerDocument.createElement("span");
    range.surroundContents(hidden);
    setStyles(hidden, { display: "none" });
  }
}

/** Yields where the blank lines of each run begin and end that are more than some, as characters of the lines' text. */
function* blankRuns(
  lines: readonly string[],
  most: number,
): Generator<readonly [from: number, to: number]> {
  let [at, from, count] = [0, 0, 0];
  for (const line of lines) {
    const isBlank = line.trim() === "";
    if (!isBlank && count > most) yield [from, at];
    count = isBlank ? count + 1 : 0;
    at += line.length + 1;
    if (count <= most) from = at;
  }
}

/**
 * Hides ends of lines between which nothing is, of more than fill a page.
 *
 * @param empty elements in which nothing is
 */
function hideLineEnds(body: Element, empty: ReadonlySet<Element>, page: number): void {
  const ends = [...body.querySelectorAll<HTMLElement>("br")];
  if (ends.length < fewLines) return;
  const view = body.ownerDocument.defaultView as Window;
  const nodes = body.ownerDocument.createTreeWalker(
    body,
    NodeFilter.SHOW_TEXT | NodeFilter.SHOW_ELEMENT,
  );
  // A browser does not tell on which page an end is that has no width.
  const excess: HTMLElement[] = [];
  let count = 0;
  for (let node = nodes.nextNode(); node !== null; node = nodes.nextNode()) {
    if (node.nodeType === Node.TEXT_NODE) {
      if (node.nodeValue?.trim()) count = 0;
      continue;
    }
    const element = node as HTMLElement;
    if (element.localName === "br") {
      count += 1;
      if (count > fewLines && count * lineOf(element, view) > page) excess.push(element);
    } else if (!empty.has(element) || hasBreak(element, view)) count = 0;
  }
  for (const element of excess) setStyles(element, { display: "none" });
}

/** Returns how high a line is in an element, CSS pixels. */
function lineOf(element: Element, view: Window): number {
  const { lineHeight, fontSize } = view.getComputedStyle(element);
  return Number.parseFloat(lineHeight) || Number.parseFloat(fontSize);
}

/** Returns whether an element begins a page, or ends one. */
function hasBreak(element: Element, view: Window): boolean {
  const { breakBefore, breakAfter } = view.getComputedStyle(element);
  return breakBefore === "column" || breakAfter === "column";
}

/** Returns the elements in a body in which nothing is: those that show nothing, and those whose own style does. */
function emptyIn(
  body: Element,
  view: Window,
): { readonly empty: ReadonlySet<HTMLElement>; readonly painted: ReadonlySet<Element> } {
  const empty = new Set<HTMLElement>();
  const painted = new Set<Element>();
  // What is in an element comes before it.
  for (const element of [...boxesIn(body)].reverse()) {
    const isEmpty = [...element.childNodes].every((node) =>
      node.nodeType === Node.ELEMENT_NODE
        ? empty.has(node as HTMLElement) || /^w?br$/.test((node as Element).localName)
        : !/\S/.test(node.nodeValue ?? "") || node.nodeType === Node.COMMENT_NODE,
    );
    if (!isEmpty || element.matches(shown)) continue;
    if (isPainted(element, view)) painted.add(element);
    else empty.add(element);
  }
  return { empty, painted };
}

/** Takes the pages on which anything is seen out of a set, and returns the element that is seen first. */
function takeFilled(
  body: Element,
  flow: PageFlow,
  blank: Set<number>,
  painted: ReadonlySet<Element>,
): HTMLElement | null {
  const range = body.ownerDocument.createRange();
  const nodes = body.ownerDocument.createTreeWalker(
    body,
    NodeFilter.SHOW_TEXT | NodeFilter.SHOW_ELEMENT,
  );
  let first: HTMLElement | null = null;
  for (let node = nodes.nextNode(); node !== null && blank.size > 0; node = nodes.nextNode()) {
    const isText = node.nodeType === Node.TEXT_NODE;
    const element = (isText ? node.parentElement : node) as HTMLElement;
    if (isText ? !node.nodeValue?.trim() : !element.matches(shown) && !painted.has(element)) {
      continue;
    }
    range.selectNode(node);
    for (const rect of range.getClientRects()) {
      if (rect.width === 0 && rect.height === 0) continue;
      first ??= element;
      blank.delete(pageOfRect(flow, rect));
    }
  }
  return first;
}

/** Returns whether the style of an element shows anything where nothing is in it. */
function isPainted(element: HTMLElement, view: Window): boolean {
  return [null, "::before", "::after"].some((part) => {
    const style = view.getComputedStyle(element, part);
    const { backgroundColor, backgroundImage, boxShadow, outlineStyle, content } = style;
    if (part !== null && /^(?:none|normal)$/.test(content)) return false;
    const hasBorder = ["top", "right", "bottom", "left"].some(
      (side) => Number.parseFloat(style.getPropertyValue(`border-${side}-width`)) > 0,
    );
    const isPlain = /^(?:transparent|rgba\(\d+, \d+, \d+, 0\))$/.test(backgroundColor);
    return (
      !isPlain ||
      backgroundImage !== "none" ||
      boxShadow !== "none" ||
      outlineStyle !== "none" ||
      hasBorder ||
      // What ends floats is of no letters.
      (part !== null && content !== '""')
    );
  });
}
