/**
 * SVG images as pages. They are drawn through an <img>, in which no script runs
 * and nothing else is loaded; the address is a data: URL, because blob: taints
 * a canvas in WebKit.
 */

import { checkSvg } from "./budget.ts";
import { decodeText } from "./decode_text.ts";
import type { PageBox, PageSize } from "./page_source.ts";

/** What the root's tag begins with. */
const rootStart = /<(?:[\w-]+:)?svg(?=[\s/>])/i;

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

/** Images that were counted against the budget. */
const checked = new WeakMap<Blob, Promise<void>>();

/** Size of an image without any, as CSS defines. */
const usualSize: PageSize = { width: 300, height: 150 };

/** Reads an image. Rejects if it has no root. */
async function read(image: Blob): Promise<Drawing> {
  const text = await decodeText(new Uint8Array(await image.arrayBuffer()));
  wholeTag.lastIndex = rootStart.exec(text)?.index ?? text.length;
  const found = wholeTag.exec(text);
  if (found === null) throw new Error("There is no <svg>.");
  const [tag] = found;
  return { before: text.slice(0, found.index), tag, after: text.slice(found.index + tag.length) };
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
  const { tag } = await read(image);
  return sizeOf(tag);
}

/**
 * Draws a part of an SVG, in its own pixels, so that it has `pixels`. Rejects
 * if it is not an SVG, and if the page's policy does not allow images as data;
 * with a `BookError` that begins with its `name` if it is beyond the budget.
 */
export async function drawSvg(
  image: Blob,
  part: PageBox,
  pixels: PageSize,
  name: string,
): Promise<ImageBitmap> {
  const { before, tag, after } = await read(image);
  const checking = checked.get(image) ?? checkSvg(before + tag + after, name);
  checked.set(image, checking);
  await checking;
  const picture = new Image();
  picture.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(before + sized(tag) + after)}`;
  await picture.decode();
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
