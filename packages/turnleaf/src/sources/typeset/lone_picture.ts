/** Pages that are one picture: covers, which have its proportions, and plates, which bleed. */

import { isPageSize } from "../limits.ts";
import type { PageSize } from "../page_source.ts";
import { type FlowContent, type FlowSection, styleAttribute } from "./flow_book.ts";
import { decodedSize } from "./natural_size.ts";
import { paperback } from "./page_measures.ts";

/** Elements that are seen without any text. */
const seen = "img, svg, video, audio, canvas, object, iframe, hr, table";

/**
 * Fraction of a picture's width or height that may be cut so that it bleeds on all sides, as a printer
 * trims it: less than a page is trimmed rather than given a margin.
 */
const mostTrimmed = 0.08;

/** Fraction of the type area that a picture fills in one direction if it is meant to fill its page. */
const leastFilled = 0.9;

/** Returns the picture that is all that a section shows; null if it shows anything else. */
export function lonePicture(root: Element): HTMLElement | SVGElement | null {
  const body = root.querySelector("body") ?? root;
  const [picture, ...others] = [...body.querySelectorAll(seen)].filter((element) => {
    const around = element.parentElement?.closest("svg, object, video, audio") ?? null;
    // Laid out, all of it is within a drawing.
    return around === null || !body.contains(around);
  });
  if (!picture || others.length > 0 || !/^(img|svg)$/.test(picture.localName)) return null;
  // What is styled may be seen too, by its background or border.
  const isPlain = (element: Element): boolean =>
    element.contains(picture) ||
    picture.contains(element) ||
    !(
      element.hasAttribute("class") ||
      element.hasAttribute(styleAttribute) ||
      element.hasAttribute("style")
    );
  if (![...body.querySelectorAll("*")].every(isPlain)) return null;
  const text = (body.textContent ?? "").trim();
  // A drawing's own text is a part of it.
  const own = (picture.textContent ?? "").trim();
  return text === own ? (picture as HTMLElement | SVGElement) : null;
}

/** Returns a section that is a book's cover, of what `load` returns: a picture alone. */
export function coverSection(load: () => Promise<FlowContent>): FlowSection {
  const loadCover = async (): Promise<FlowContent> => coverContent(await load());
  return { length: 0, isFixed: true, lines: async () => 0, load: loadCover };
}

/**
 * Returns a section whose only picture fills it as a page of the picture's proportions, as high as other
 * pages; the section as it is, with a page's size, if it is none or the picture has no size.
 */
async function coverContent(content: FlowContent): Promise<FlowContent> {
  const picture = lonePicture(content.root);
  const own = picture && (await pictureSize(picture));
  const { height } = paperback;
  const size = own && { width: Math.round((height * own.width) / own.height), height };
  if (!picture || !size || !isPageSize(size)) return { ...content, size: paperback };
  fill(picture, size, (element, rules) => {
    const style = rules.map(([name, value]) => `${name}: ${value} !important`).join("; ");
    element.setAttribute(styleAttribute, style);
  });
  return { ...content, size };
}

/**
 * Has a picture that is all of a section, and is as large as its type area lets it be, fill the whole
 * page, if it has about the page's proportions.
 *
 * @param html the section, laid out
 * @param area the type area, CSS pixels
 * @returns whether it does
 */
export async function bleed(html: Element, area: PageSize, page: PageSize): Promise<boolean> {
  const picture = lonePicture(html);
  const own = picture && (await pictureSize(picture));
  if (!picture || !own) return false;
  const drawn = picture.getBoundingClientRect();
  const filled = Math.max(drawn.width / area.width, drawn.height / area.height);
  const differs = Math.abs(Math.log(own.width / own.height / (page.width / page.height)));
  if (filled < leastFilled || differs > -Math.log(1 - mostTrimmed)) return false;
  fill(picture, page, (element, rules) => {
    for (const [name, value] of rules) element.style.setProperty(name, value, "important");
  });
  return true;
}

type Rules = readonly (readonly [name: string, value: string])[];

/** What is around a picture that fills its page, and the picture. */
const around: Rules = [
  ["position", "static"],
  ["transform", "none"],
  ["float", "none"],
  ["margin", "0"],
  ["padding", "0"],
];
const filling: Rules = [
  ["position", "absolute"],
  ["left", "0"],
  ["top", "0"],
  ["min-width", "0"],
  ["min-height", "0"],
  ["max-width", "none"],
  ["max-height", "none"],
  ["margin", "0"],
  ["padding", "0"],
  ["border", "0"],
  ["transform", "none"],
  ["object-fit", "cover"],
];

/** Has a picture fill a page, from its upper left corner on. */
function fill(
  picture: HTMLElement | SVGElement,
  { width, height }: PageSize,
  set: (element: HTMLElement | SVGElement, rules: Rules) => void,
): void {
  for (let element = picture.parentElement; element; element = element.parentElement) {
    if (element.localName === "html") break;
    set(element, around);
  }
  set(picture, [...filling, ["width", `${width}px`], ["height", `${height}px`]]);
  if (picture.localName === "svg") picture.setAttribute("preserveAspectRatio", "xMidYMid slice");
}

/** Returns the size of a picture in its own pixels or units; null if it has none. */
async function pictureSize(picture: Element): Promise<PageSize | null> {
  if (picture.localName === "svg") {
    const [, , width = 0, height = 0] = (picture.getAttribute("viewBox") ?? "")
      .split(/[\s,]+/)
      .map(Number);
    return isPageSize({ width, height }) ? { width, height } : null;
  }
  const size = await decodedSize(picture.getAttribute("src") ?? "");
  return isPageSize(size) ? size : null;
}
