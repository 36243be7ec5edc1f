/**
 * Pictures that are wider than what they stand in, as those of no size of their own in a quotation or a list: a
 * browser lets them go on beyond it, and on paper they would end in the margin or be cut.
 */

import { boxAround, lengthsOf, setStyles, tolerance } from "./box_styles.ts";
import { drawingOf } from "./frame.ts";
import { type PageFlow, pageOfRect } from "./text_map.ts";

/** Pictures. */
const pictures = "img, svg, video, canvas, object";

/**
 * Makes pictures no wider than what they stand in, and those that are to reach into the margins as wide as they
 * do: they are no wider than a line before.
 *
 * @param body the section's body, laid out
 * @param line the length of its lines, CSS pixels
 */
export function fitPictures(body: Element, flow: PageFlow, line: number): void {
  const wide: { picture: HTMLElement | SVGElement; room: number; rect: DOMRect }[] = [];
  for (const picture of body.querySelectorAll<HTMLElement | SVGElement>(pictures)) {
    if (drawingOf(picture, body) !== picture) continue;
    const [rect] = picture.getClientRects();
    if (!rect || rect.width === 0 || rect.height === 0) continue;
    const room = roomFor(picture, rect, flow);
    const length = flow.isVertical ? rect.height : rect.width;
    const isCapped = length > line - tolerance && room > line + tolerance;
    if (room > 0 && (length > room + tolerance || isCapped)) wide.push({ picture, room, rect });
  }
  for (const { picture, room, rect } of wide) {
    if (picture.localName === "svg" && !picture.hasAttribute("viewBox")) {
      picture.setAttribute("viewBox", `0 0 ${rect.width} ${rect.height}`);
    }
    setStyles(picture, {
      "min-inline-size": "0",
      "max-inline-size": `${room}px`,
      // It keeps its proportions.
      "block-size": "auto",
    });
  }
}

/** Returns how much room a picture has along its line, CSS pixels; 0 for one that is put elsewhere. */
function roomFor(picture: Element, rect: DOMRect, flow: PageFlow): number {
  const view = picture.ownerDocument.defaultView as Window;
  const own = view.getComputedStyle(picture);
  const margins = lengthsOf(own, "margin-inline-start", "margin-inline-end");
  if (own.position === "absolute") return 0;
  const box = boxAround(picture);
  const page = pageOfRect(flow, rect);
  const around = [...box.getClientRects()].find((one) => pageOfRect(flow, one) === page);
  if (!around) return 0;
  const edges = lengthsOf(
    view.getComputedStyle(box),
    ...["padding-inline-start", "padding-inline-end"],
    ...["border-inline-start-width", "border-inline-end-width"],
  );
  const within = [...margins, ...edges].reduce((sum, length) => sum + length, 0);
  return (flow.isVertical ? around.height : around.width) - within;
}
