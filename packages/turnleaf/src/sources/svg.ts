/**
 * SVG images as pages. They are drawn through an <img>, in which no script runs
 * and nothing else is loaded; the address is a data: URL, because blob: taints
 * a canvas in WebKit.
 */

import { checkSvg } from "./budget.ts";
import { decodeText } from "./decode_text.ts";
import { loadPart } from "./load_part.ts";
import { errorIn, parseMarkup } from "./markup/parse_markup.ts";
import { BookError, type BookErrorDetail, type PageBox, type PageSize } from "./page_source.ts";

/** What the root's tag begins with. */
const rootStart = /<(?:[\w-]+:)?svg(?=[\s/>])/i;

/** The namespace of its elements, without which browsers draw nothing. */
const namespace = "http://www.w3.org/2000/svg";

/** A tag from where the next match is to be; quoted values may contain anything. */
const wholeTag = /<(?:[^>"']|"[^"]*"|'[^']*')*>/y;

/** An attribute of a tag. */
const attributePattern = /\s([\w:-]+)\s*=\s*(?:"([^"]*)"|'([^']*)')/g;

/** The text of an image and its root's tag in it. */
interface Drawing {
  readonly before: string;
  readonly tag: string;
  readonly after: string;
}

/** CSS pixels per unit of length. */
const units: Readonly<Record<string, number>> = {
  "": 1,
  px: 1,
  pt: 4 / 3,
  pc: 16,
  in: 96,
  cm: 96 / 2.54,
  mm: 96 / 25.4,
  q: 96 / 101.6,
};

/** Images as they are drawn, which were counted against the budget. */
const drawings = new WeakMap<Blob, Promise<Drawing>>();

/** Size of an image without any, as CSS defines. */
const usualSize: PageSize = { width: 300, height: 150 };

async function textOf(image: Blob): Promise<string> {
  return await decodeText(new Uint8Array(await image.arrayBuffer()));
}

/** Finds the root's tag. Throws if there is none. */
function drawingOf(text: string): Drawing {
  wholeTag.lastIndex = rootStart.exec(text)?.index ?? text.length;
  const found = wholeTag.exec(text);
  if (found === null) throw new Error("There is no <svg>.");
  const [tag] = found;
  return { before: text.slice(0, found.index), tag, after: text.slice(found.index + tag.length) };
}

/**
 * Returns an image as it can be drawn: its root in the namespace of SVG, and repaired if it is not well-formed.
 * Rejects if it cannot be, and with a `BookError` if it is beyond the budget.
 */
async function drawable(image: Blob, name: string): Promise<Drawing> {
  let drawing = withNamespace(drawingOf(await textOf(image)));
  let text = whole(drawing);
  let document = parseMarkup(text, "image/svg+xml");
  if (errorIn(document)) {
    // What is repaired has no entities of its own, which multiply.
    if (/<!ENTITY/i.test(text)) throw new Error("It is not well-formed.");
    const { readMarkup } = await loadPart(import("./markup/read_markup.ts"));
    ({ text, document } = await readMarkup(text, "image/svg+xml"));
    drawing = drawingOf(text);
  }
  const { localName, namespaceURI } = document.documentElement;
  if (errorIn(document) || localName !== "svg" || namespaceURI !== namespace) {
    throw new Error("It is no SVG.");
  }
  await checkSvg(text, name);
  return drawing;
}

const whole = ({ before, tag, after }: Drawing): string => before + tag + after;

/** Returns a drawing whose root is in the namespace of SVG, by its prefix if it has one. */
function withNamespace({ before, tag, after }: Drawing): Drawing {
  const [start = "", prefix] = /^<(?:([\w-]+):)?\w+/.exec(tag) ?? [];
  const declaration = prefix === undefined ? "xmlns" : `xmlns:${prefix}`;
  if (attribute(tag, declaration)) return { before, tag, after };
  const bare = tag.replace(/\sxmlns\s*=\s*(""|'')/, "").slice(start.length);
  return { before, tag: `${start} ${declaration}="${namespace}"${bare}`, after };
}

function attribute(tag: string, name: string): string | undefined {
  for (const [, found, double, single] of tag.matchAll(attributePattern)) {
    if (found === name) return double ?? single;
  }
  return undefined;
}

/** Returns a length in CSS pixels; null if there is none, or it is relative. */
function length(text: string | undefined): number | null {
  const [, number, unit] = /^([\d.]+(?:e[+-]?\d+)?)\s*([a-z]*)$/i.exec(text?.trim() ?? "") ?? [];
  const scale = units[unit?.toLowerCase() ?? "none"];
  const pixels = Number(number) * (scale ?? Number.NaN);
  return pixels > 0 ? pixels : null;
}

/** Returns the size in the root's tag: its lengths, completed by the proportions of its viewBox. */
function sizeOf(tag: string): PageSize {
  const [width, height] = [length(attribute(tag, "width")), length(attribute(tag, "height"))];
  const box = attribute(tag, "viewBox")
    ?.trim()
    .split(/[\s,]+/)
    .map(Number);
  const [, , across, down] = box ?? [];
  const ratio = across > 0 && down > 0 ? across / down : null;
  if (width !== null && height !== null) return { width, height };
  if (ratio === null)
    return { width: width ?? usualSize.width, height: height ?? usualSize.height };
  if (width !== null) return { width, height: width / ratio };
  if (height !== null) return { width: height * ratio, height };
  return { width: across, height: down };
}

/** Returns an SVG's size in CSS pixels. Rejects if it is not an SVG. */
export async function sizeOfSvg(image: Blob): Promise<PageSize> {
  return sizeOf(drawingOf(await textOf(image)).tag);
}

/**
 * Draws a part of an SVG, in its own pixels, so that it has `pixels`. Rejects if it is not an SVG; with a
 * `BookError` that begins with its `name` if it is beyond the budget, and if the page's policy does not
 * allow images as data.
 *
 * @param about what errors are about
 */
export async function drawSvg(
  image: Blob,
  part: PageBox,
  pixels: PageSize,
  name: string,
  about: BookErrorDetail,
): Promise<ImageBitmap> {
  const drawing = drawings.get(image) ?? drawable(image, name);
  drawings.set(image, drawing);
  const { before, tag, after } = await drawing;
  const picture = new Image();
  picture.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(before + sized(tag) + after)}`;
  await picture.decode().catch((cause: unknown) => {
    const remedy = "if this page has a Content-Security-Policy, allow data: in its img-src";
    const message = `${name} cannot be drawn by this browser; ${remedy}.`;
    throw new BookError(message, { ...about, code: "failed", cause });
  });
  // In Chromium embedded fonts are ready one task later.
  await new Promise((resolve) => setTimeout(resolve));
  const canvas = new OffscreenCanvas(pixels.width, pixels.height);
  const pen = canvas.getContext("2d") as OffscreenCanvasRenderingContext2D;
  const { x, y, width, height } = part;
  pen.drawImage(picture, x, y, width, height, 0, 0, pixels.width, pixels.height);
  return canvas.transferToImageBitmap();
}

/**
 * Returns the root's tag with its size in pixels, without which Firefox draws
 * nothing, and a viewBox, without which nothing scales.
 */
function sized(tag: string): string {
  const { width, height } = sizeOf(tag);
  const bare = tag.replace(/\s(width|height)\s*=\s*("[^"]*"|'[^']*')/g, "");
  const box = attribute(tag, "viewBox") === undefined ? ` viewBox="0 0 ${width} ${height}"` : "";
  return bare.replace(/^<[^\s/>]+/, `$& width="${width}" height="${height}"${box}`);
}
