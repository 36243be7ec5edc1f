/**
 * Boxes that a book puts upon its text, as at the foot of a view or of a page that was larger: neither could be read.
 */

import { setStyles } from "./box_styles.ts";
import type { StyleMentions } from "./style_mentions.ts";
import { type PageFlow, pageOfRect } from "./text_map.ts";

/** Letters more than so many times as high as others are a decoration of these: numbers behind titles. */
const decoration = 2;

/** What is fainter lies upon text as a watermark does. */
const faint = 0.5;

/** Pairs of lines that are compared in a section, at most. */
const mostPairs = 2_000_000;

/**
 * Has boxes that lie upon the text of a section, and have text of like size, stand where that would have them.
 *
 * @param body the section's body, laid out
 * @param mentions of the section's own style
 * @returns whether there were any
 */
export function uncoverText(body: Element, flow: PageFlow, mentions: StyleMentions): boolean {
  if (!mentions.has(["position"])) return false;
  const { flowing, put } = linesIn(body, flow);
  let pairs = 0;
  const liesOnText = (line: DOMRect): boolean => {
    const others = flowing.get(pageOfRect(flow, line)) ?? [];
    pairs += others.length;
    return pairs < mostPairs && others.some((other) => covers(line, other, flow.isVertical));
  };
  const covering = [...put].filter(([, lines]) => lines.some(liesOnText));
  for (const [box] of covering) setStyles(box, { position: "static", margin: "0" });
  return covering.length > 0;
}

/** The lines of a section's text: those that follow each other, by their pages, and those in boxes that are put somewhere. */
interface Lines {
  readonly flowing: ReadonlyMap<number, readonly DOMRect[]>;
  readonly put: ReadonlyMap<HTMLElement, readonly DOMRect[]>;
}

function linesIn(body: Element, flow: PageFlow): Lines {
  const view = body.ownerDocument.defaultView as Window & typeof globalThis;
  const range = body.ownerDocument.createRange();
  const flowing = new Map<number, DOMRect[]>();
  const put = new Map<HTMLElement, DOMRect[]>();
  const collect = (parent: Element, around: HTMLElement | null): void => {
    const style = view.getComputedStyle(parent);
    const isPut = around === null && style.position === "absolute" && parent !== body;
    const box = isPut && parent instanceof view.HTMLElement ? parent : around;
    for (const node of parent.childNodes) {
      if (node instanceof view.Element) collect(node, box);
      else if (style.visibility === "visible" && node.nodeValue?.trim()) {
        range.selectNodeContents(node);
        for (const line of range.getClientRects()) {
          if (line.width === 0 || line.height === 0) continue;
          const page = pageOfRect(flow, line);
          const lines = (box ? put.get(box) : flowing.get(page)) ?? [];
          lines.push(line);
          if (box) put.set(box, lines);
          else flowing.set(page, lines);
        }
      }
    }
  };
  collect(body, null);
  for (const box of put.keys()) if (isMeantSo(box, view)) put.delete(box);
  return { flowing, put };
}

/** Returns whether a box lies where it does on purpose: beneath text, faintly upon it, or as a part of the line in which it is put. */
function isMeantSo(box: HTMLElement, view: Window): boolean {
  const { opacity, zIndex } = view.getComputedStyle(box);
  const { offsetParent } = box;
  const isInLine =
    offsetParent !== null && view.getComputedStyle(offsetParent).display.startsWith("inline");
  return isInLine || Number(zIndex) < 0 || Number(opacity) < faint;
}

/** Returns whether a line lies upon another of like size: on most of its height, and of a letter's width. */
function covers(line: DOMRect, other: DOMRect, isVertical: boolean): boolean {
  const across = Math.min(line.right, other.right) - Math.max(line.left, other.left);
  const down = Math.min(line.bottom, other.bottom) - Math.max(line.top, other.top);
  const sizes = [line, other].map(({ width, height }) => (isVertical ? width : height));
  const [least, most] = [Math.min(...sizes), Math.max(...sizes)];
  return Math.min(across, down) > least / 2 && most < decoration * least;
}
