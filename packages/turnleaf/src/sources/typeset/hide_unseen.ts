/** Boxes of which a book shows nothing, as of words for screen readers alone: none of their text is on paper. */

import { setStyles } from "./box_styles.ts";
import type { StyleMentions } from "./style_mentions.ts";
import type { PageFlow } from "./text_map.ts";

/** A box of at most so many CSS pixels shows nothing of what is cut at its edges. */
const nothing = 1;

/** Cuts that leave nothing of a box. */
const emptyClip = /^inset\((?:50|100)%(?: (?:50|100)%)*\)$/;

/** Properties by which a box may show nothing. */
const hiding = [
  "overflow",
  "overflow-x",
  "overflow-y",
  "clip",
  "clip-path",
  "position",
  "content-visibility",
  "visibility",
];

/**
 * Hides the boxes in a section's body, laid out, of which nothing is seen: as their edges cut it, or as they lie
 * before the first page, where no browser scrolls to.
 */
export function hideUnseen(body: Element, flow: PageFlow, mentions: StyleMentions): void {
  const view = body.ownerDocument.defaultView as Window & typeof globalThis;
  const range = body.ownerDocument.createRange();
  const liesBefore = (element: Element): boolean => {
    range.selectNodeContents(element);
    // What is in a box may be seen though the box is not.
    return [element, range].every((one) => isBefore(one.getBoundingClientRect(), flow));
  };
  const hidden: HTMLElement[] = [];
  const collapsed: HTMLElement[] = [];
  for (const element of mentions.boxesWith(body, hiding)) {
    if (!(element instanceof view.HTMLElement)) continue;
    const style = view.getComputedStyle(element);
    const { overflowX, overflowY, clip, clipPath, display, position } = style;
    const { contentVisibility, visibility } = style;
    // In columns a browser keeps the room of such rows.
    if (visibility === "collapse" && /^table-(?:row|(?:row|header|footer)-group)$/.test(display)) {
      collapsed.push(element);
    }
    const isShort =
      (overflowX !== "visible" && element.offsetWidth <= nothing) ||
      (overflowY !== "visible" && element.offsetHeight <= nothing);
    const isCut =
      (isShort && display !== "inline") ||
      isEmpty(clip) ||
      emptyClip.test(clipPath) ||
      // The browser tells where the text in such a box would be.
      contentVisibility === "hidden";
    const isAway = /^(?:absolute|fixed)$/.test(position) && liesBefore(element);
    if (isCut || isAway) hidden.push(element);
  }
  for (const element of collapsed) setStyles(element, { display: "none" });
  for (const element of hidden) setStyles(element, { visibility: "hidden" });
}

/** Returns whether a rectangle lies before the first page. */
function isBefore({ left, right, bottom }: DOMRect, { stepX }: PageFlow): boolean {
  return bottom < 0 || (stepX < 0 ? left > -stepX : right < 0);
}

/** Returns whether the rectangle that a box is cut to has no area. */
function isEmpty(clip: string): boolean {
  if (!clip.startsWith("rect(") || clip.includes("auto")) return false;
  const sides = clip.slice("rect(".length).split(",");
  const [top = 0, right = 0, bottom = 0, left = 0] = sides.map((side) => Number.parseFloat(side));
  return right <= left || bottom <= top;
}
