/**
 * Measures text in the layer's one font, so that it can be fitted over printed
 * text of any other.
 */

import type { TextRun } from "../sources/page_source.ts";

/** The layer's font size, CSS pixels; text laid out in it is scaled to the page. */
export const fontSize = 20;

/** The layer's font, as CSS and a canvas write it. */
export const font: string = `${fontSize}px serif`;

let pen: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D | null = null;

/** Returns the width of `text` on one line, CSS pixels; never 0. */
export function widthOf(text: string): number {
  pen ??= new OffscreenCanvas(1, 1).getContext("2d");
  if (pen === null) return text.length * fontSize * 0.5;
  pen.font = font;
  return Math.max(pen.measureText(text).width, 0.01);
}

/**
 * Returns the fraction of a run's line before its character `at`: from its
 * source, or measured in the layer's font.
 */
export function fractionBefore(
  { text, places }: Pick<TextRun, "text" | "places">,
  at: number,
): number {
  const whole = text.trimEnd();
  if (at >= whole.length) return 1;
  return places?.[at] ?? Math.min(widthOf(whole.slice(0, at)) / widthOf(whole), 1);
}
