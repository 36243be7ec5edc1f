/** What a book says of pages by variables, and pages that it begins where no browser breaks a column: at the break of a line, at a picture in one, and in boxes that do not break. */

import { pagedStyles, variableMark } from "../markup/paged_css.ts";
import { isUnbroken, opened, setStyles } from "./box_styles.ts";
import type { StyleMentions } from "./style_mentions.ts";

/** What stands in a line and is no text: a page is begun at it as at a box. */
const inLine = /^(img|svg|video|object)$/;

/**
 * Has what a section says of pages by variables hold in columns, as what it says by itself does.
 *
 * @param body the section's body, laid out
 * @param mentions of the section's own style
 */
export function resolveVariables(body: Element, mentions: StyleMentions): void {
  if (!mentions.has([variableMark])) return;
  const view = body.ownerDocument.defaultView as Window;
  for (const element of body.querySelectorAll<HTMLElement | SVGElement>("*")) {
    setStyles(element, pagedStyles(view.getComputedStyle(element)));
  }
}

/**
 * Has all page breaks that a section asks for begin a page.
 *
 * @param body the section's body, laid out in columns
 * @param writingMode of the section
 * @param mentions of the section's own style
 */
export function honourBreaks(body: Element, writingMode: string, mentions: StyleMentions): void {
  if (!mentions.has(["break-before", "break-after"])) return;
  const view = body.ownerDocument.defaultView as Window;
  for (const element of body.querySelectorAll<HTMLElement>("*")) {
    const parent = element.parentElement;
    const { breakBefore, breakAfter, display } = view.getComputedStyle(element);
    if (breakBefore !== "column" && breakAfter !== "column") continue;
    if (element.localName === "br") {
      element.replaceWith(blockFor(element, { breakBefore, breakAfter }));
    } else if (display.startsWith("inline") && inLine.test(element.localName)) {
      setStyles(element, { display: "block" });
    } else if (display === "inline") continue;
    if (breakBefore === "column") moveBreak(element, "before", body, view);
    if (breakAfter === "column") moveBreak(element, "after", body, view);
    for (let box = parent; box && box !== body; box = box.parentElement) {
      const style = view.getComputedStyle(box);
      if (isUnbroken(style)) setStyles(box, opened(style, writingMode));
    }
  }
}

/**
 * Has the page that begins at the first item in a flexible box or a grid, or ends at the last, do so at the box.
 * A browser does that of blocks alone, and leaves the part of a page empty that is above the item.
 */
function moveBreak(item: HTMLElement, part: "before" | "after", body: Element, view: Window): void {
  const isOut = (box: Element | null): boolean => {
    if (box === null) return false;
    const { display, position } = view.getComputedStyle(box);
    return display === "none" || position === "absolute";
  };
  let from = item;
  for (let box = from.parentElement; box && from !== body; box = from.parentElement) {
    if (!/(?:flex|grid)$/.test(view.getComputedStyle(box).display)) break;
    const next = (one: Element): Element | null =>
      part === "before" ? one.previousElementSibling : one.nextElementSibling;
    let other = next(from);
    while (other && isOut(other)) other = next(other);
    if (other) break;
    from = box;
  }
  if (from === item) return;
  setStyles(item, { [`break-${part}`]: "auto" });
  setStyles(from, { [`break-${part}`]: "column" });
}

/** Returns a box that breaks pages as the break of a line asks for, which itself is no box. */
function blockFor(
  br: Element,
  { breakBefore, breakAfter }: { readonly breakBefore: string; readonly breakAfter: string },
): HTMLElement {
  const block = br.ownerDocument.createElement("span");
  if (br.id !== "") block.id = br.id;
  setStyles(block, {
    display: "block",
    "break-before": breakBefore,
    "break-after": breakAfter,
  });
  return block;
}
