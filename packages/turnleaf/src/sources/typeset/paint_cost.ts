/**
 * How much painting the pages of a section, or a drawing, are, by what covers them once it is laid out: thousands
 * of gradients, shadows and filters upon each other are few bytes, and minutes of a processor.
 */

import type { PageSize } from "../page_source.ts";
import { applyInlineStyles, openFrame } from "./frame.ts";
import { type PageFlow, pageOfRect } from "./text_map.ts";

/**
 * Nanoseconds of a pixel of a colour, of a shape of SVG, of a picture, of a layer that is put upon others, of a
 * gradient, and of a step of a filter or the blur of a shadow.
 */
const [plain, shape, picture, layer, gradient, step] = [0.1, 1, 3, 5, 10, 25];

/** Pixels of a tile of a background: of smaller ones, the tiles themselves take the time. */
const smallTile = 64;

/** Nanoseconds that a pixel of a page may take: of a page as large as a screen, some two seconds. */
export const mostNanoseconds = 2000;

/** What takes longer than a colour. */
const effects =
  /gradient\(|filter|shadow|mask|opacity|blend|clip-path|border-image|url\(#|position:\s*(?:absolute|fixed)/;

const svg = "http://www.w3.org/2000/svg";

/** The region of what may reach over all of a page. */
const unbounded = Number.POSITIVE_INFINITY;

/** Arguments of a function, such as a colour's. */
const functionArguments = /\([^()]*\)/g;

/** A number of CSS pixels. */
const pixels = /(\d{1,9}(?:\.\d{1,9})?)px/g;

/**
 * Returns the nanoseconds of a pixel on the page of a section that takes most, on average.
 *
 * @param root the section's element, or a drawing's, in its frame
 * @param sheets its style sheets
 */
export function paintingOf(
  root: Element,
  sheets: readonly string[],
  size: PageSize,
  flow: PageFlow,
): number {
  const all = [root, ...root.querySelectorAll("*")];
  const isDrawn = root.querySelectorAll(":scope svg *").length > mostNanoseconds;
  const hasEffects =
    sheets.some((css) => effects.test(css)) || all.some((one) => effects.test(ownText(one)));
  if (!isDrawn && !hasEffects) return 0;
  const view = root.ownerDocument.defaultView as Window;
  const taken = new Map<number, number>();
  let most = 0;
  for (const element of all) {
    const style = view.getComputedStyle(element);
    const paint = paintOf(element, style);
    const spread = spreadOf(style);
    const layers = layersOf(element, style);
    // What is in a layer may reach farther than its box, but that of a drawing's part.
    const isOpen = element.childElementCount > 0 && element.namespaceURI !== svg;
    const region = isOpen ? unbounded : regionOf(element, style);
    const rects = [...element.getClientRects()];
    if (rects.length === 0) continue;
    for (const rect of rects.slice(0, mostRects)) {
      const page = pageOfRect(flow, rect);
      const width = Math.min(rect.width + 2 * spread, size.width);
      const height = Math.min(rect.height + 2 * spread, size.height);
      const fraction = (width * height) / (size.width * size.height);
      const cost =
        paint * fraction + layers * (region < unbounded ? Math.min(region * fraction, 1) : 1);
      const sum = (taken.get(page) ?? 0) + cost;
      taken.set(page, sum);
      most = Math.max(most, sum);
    }
  }
  return most;
}

/** Rectangles of an element that are counted: a paragraph has one on each of its pages. */
const mostRects = 100;

/** Returns what an element says of its own style. */
function ownText(element: Element): string {
  if (!element.hasAttributes()) return "";
  return [...element.attributes]
    .map(({ name, value }) => `${name}:${value.slice(0, 2000)}`)
    .join(";");
}

/** Returns what a pixel of an element's own box takes. */
function paintOf(element: Element, style: CSSStyleDeclaration): number {
  const { backgroundImage, backgroundColor, boxShadow, textShadow, borderImageSource } = style;
  const background = imagesIn(backgroundImage) * tilesOf(style.backgroundSize);
  const border = 4 * imagesIn(borderImageSource);
  const hasText = [...element.childNodes].some(({ nodeType }) => nodeType === Node.TEXT_NODE);
  const shadows = shadowsIn(boxShadow) + (hasText ? shadowsIn(textShadow) : 0);
  const colour = backgroundColor === "rgba(0, 0, 0, 0)" ? 0 : plain;
  const paints = [style.fill, style.stroke].filter((one) => one.includes("url("));
  const drawn = element.namespaceURI === svg ? shape + gradient * paints.length : 0;
  const own = /^(img|image)$/.test(element.localName) ? picture : 0;
  return background + border + step * shadows + colour + own + drawn;
}

/** Returns what a pixel takes of the layers on which an element and all in it are drawn. */
function layersOf(element: Element, style: CSSStyleDeclaration): number {
  const { filter, opacity, mixBlendMode, clipPath } = style;
  const backdrop = style.backdropFilter ?? "none";
  const mask = style.maskImage ?? style.mask ?? "none";
  const masks = mask === "none" || mask === "" ? 0 : layer + imagesIn(mask);
  // A box alone is drawn with its opacity, without a layer; a shape of SVG is not.
  const isOne = element.childNodes.length === 0 && element.namespaceURI !== svg;
  const isBlended = !isOne && (opacity !== "1" || mixBlendMode !== "normal");
  const isLayer = isBlended || clipPath !== "none";
  return (
    step * (stepsIn(filter, element) + 2 * stepsIn(backdrop, element)) +
    masks +
    (isLayer ? layer : 0)
  );
}

/**
 * Returns how many usual steps a filter of SVG takes: octaves of noise less than one each, a matrix more the
 * larger it is.
 */
export function stepsOf(filter: Element): number {
  const number = (element: Element, name: string): number =>
    Number.parseFloat(element.getAttribute(name) ?? "") || 1;
  return [...filter.children].reduce((sum, element) => {
    if (element.localName === "feTurbulence") return sum + 1 + number(element, "numOctaves") / 10;
    if (element.localName !== "feConvolveMatrix") return sum + 1;
    return sum + 1 + number(element, "order") ** 2 / 25;
  }, 0);
}

/** Returns how much larger than an element's box the region is on which its filter works. */
function regionOf(element: Element, { filter }: CSSStyleDeclaration): number {
  const named = filterNamed(filter, element);
  if (named === null) return 1;
  if (named.getAttribute("filterUnits") === "userSpaceOnUse") return unbounded;
  const side = (name: string): number => {
    const value = named.getAttribute(name) ?? "120%";
    return (Number.parseFloat(value) || 1) / (value.includes("%") ? 100 : 1);
  };
  return side("width") * side("height");
}

/** Returns the filter of SVG that a value names; null if there is none. */
function filterNamed(filter: string, { ownerDocument }: Element): Element | null {
  const id = /url\("?#([^")]{1,200})/.exec(filter)?.[1];
  return id === undefined ? null : ownerDocument.getElementById(id);
}

/** Returns the steps of a filter, of CSS or SVG. */
function stepsIn(filter: string, element: Element): number {
  if (filter === "none" || filter === "") return 0;
  const named = filterNamed(filter, element);
  const functions = filter.split("(").length - 1 - (filter.split("url(").length - 1);
  return functions + (named ? stepsOf(named) : 0);
}

/** Returns what a pixel of images takes. */
function imagesIn(value: string): number {
  if (value === "none" || value === "") return 0;
  const gradients = value.match(/gradient\(/g)?.length ?? 0;
  const conic = value.match(/conic-gradient\(/g)?.length ?? 0;
  return gradient * (gradients + conic) + picture * (value.match(/url\(/g)?.length ?? 0);
}

/** Returns how much longer a background takes for its tiles are small. */
function tilesOf(size: string): number {
  const lengths = [...size.matchAll(pixels)].map(([, number]) => Math.max(Number(number), 0.1));
  if (lengths.length === 0) return 1;
  const [width = 1, height = width] = lengths;
  return Math.max(smallTile / (width * height), 1);
}

/** Returns how many shadows a value has. */
function shadowsIn(value: string): number {
  return value === "none" ? 0 : value.replace(functionArguments, "").split(",").length;
}

/** Returns how far the shadows of an element reach beyond it, CSS pixels. */
function spreadOf({ boxShadow, textShadow }: CSSStyleDeclaration): number {
  if (boxShadow === "none" && textShadow === "none") return 0;
  const lengths = [...`${boxShadow} ${textShadow}`.matchAll(pixels)];
  return lengths.reduce((most, [, number]) => Math.max(most, Number(number)), 0);
}

/** The size at which drawings are measured, CSS pixels: any, as they are drawn at that of their page. */
const drawingSize: PageSize = { width: 600, height: 800 };

/**
 * Returns the nanoseconds of a pixel of a drawing, on average; 0 if that cannot be known.
 *
 * @param root the drawing's root, as it was parsed; nothing of it runs or is loaded
 * @param sheets its style sheets
 */
export async function paintingOfDrawing(root: Element, sheets: readonly string[]): Promise<number> {
  const { width, height } = drawingSize;
  const frame = await openFrame(width, height);
  try {
    // What is not clean has no place in the page's own document.
    if (frame.document === document) return 0;
    const drawing = frame.document.importNode(root, true) as HTMLElement;
    applyInlineStyles(drawing);
    drawing.setAttribute("width", String(width));
    drawing.setAttribute("height", String(height));
    frame.root.append(drawing);
    return paintingOf(frame.root, sheets, drawingSize, { stepX: 0, stepY: 0, isVertical: false });
  } finally {
    frame.close();
  }
}
