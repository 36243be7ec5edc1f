/** Elements of small books, for tests in a browser. */

import "../index.ts";
import type { TurnleafBook } from "../element.ts";
import { clock } from "./clock.ts";
import { hookContexts } from "./webgl_contexts.ts";

/** Returns a scan of a page: its number in black on paper. */
export function scan(number: number, width = 90, height = 120): string {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = "#f4ead2";
  pen.fillRect(0, 0, width, height);
  pen.fillStyle = "#000";
  pen.font = "40px serif";
  pen.fillText(String(number), 20, 70);
  return canvas.toDataURL("image/png");
}

/** Returns some scans. */
export const scans = (count: number): { src: string }[] =>
  Array.from({ length: count }, (_, i) => ({ src: scan(i + 1) }));

/** Adds an element to the document that shows them. */
export function book(
  pages: TurnleafBook["pages"],
  attributes: Record<string, string> = {},
): TurnleafBook {
  const element = document.createElement("turnleaf-book");
  element.style.cssText = "width: 300px; height: 220px";
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.pages = pages;
  document.body.append(element);
  return element;
}

let shown: TurnleafBook | null = null;

/**
 * Adds an element that shows a book, or has the one of the last call show this one: what draws the one
 * before is compiled already, which takes software as long as some hundred frames. Resolves once it rests.
 */
export async function bookInPlace(
  pages: TurnleafBook["pages"],
  attributes: Record<string, string>,
  [width, height]: readonly number[],
): Promise<TurnleafBook> {
  if (!shown?.isConnected) shown = book(null);
  const loaded = happens(shown, "load");
  shown.pages = pages;
  for (const name of shown.getAttributeNames()) if (name !== "style") shown.removeAttribute(name);
  for (const [name, value] of Object.entries(attributes)) shown.setAttribute(name, value);
  shown.style.cssText = `width: ${width}px; height: ${height}px`;
  await loaded;
  await settled(shown);
  return shown;
}

/** Resolves to the next event of a name. */
export const happens = <T>(element: TurnleafBook, name: string): Promise<T> =>
  new Promise((resolve) =>
    element.addEventListener(name, (event) => resolve((event as CustomEvent<T>).detail), {
      once: true,
    }),
  );

/** Returns twelve scans of which the seventh, under the leaf of the fifth and sixth, is dark. */
function scansOverDark(): { src: string }[] {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [90, 120];
  canvas.getContext("2d")?.fillRect(0, 0, 90, 120);
  const all = scans(12);
  all[6] = { src: canvas.toDataURL("image/png") };
  return all;
}

/** Resolves to a book at rest whose right page is the fifth, over a dark one: what is folded off it is seen. */
export async function bookOverDark(attributes: Record<string, string> = {}): Promise<TurnleafBook> {
  const given = { page: "5", cover: "none", duration: "300", ...attributes };
  const element = book(scansOverDark(), given);
  await happens(element, "load");
  await settled(element);
  return element;
}

/** Waits until nothing moves. */
export const settled = (element: TurnleafBook): Promise<void> => clock.until(() => element.settled);

/**
 * Makes what a WebGL canvas shows readable at any time, not only within its
 * frame, for the tests of a file.
 */
export function keepWhatIsDrawn(): void {
  hookContexts((_, options, next) => next({ ...options, preserveDrawingBuffer: true }));
}

/**
 * Has books drawn at a quarter of the sharpness, for the tests of a file that draw hundreds of frames and look
 * at areas alone: software draws pixel by pixel.
 */
export function drawRoughly(): void {
  Object.defineProperty(globalThis, "devicePixelRatio", { value: 0.25 });
}
