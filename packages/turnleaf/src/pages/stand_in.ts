/**
 * Stand-ins for pages that are being drawn, or that cannot be. Never a blank
 * page: the reader sees which page it is, or what went wrong.
 */

import type { PageBox } from "../sources/page_source.ts";
import { lookOf, type ThemeLook } from "../themes.ts";

/** Opacity of ink fainter than the text of real pages, and of ink that is easily read without drawing attention. */
const faint = 0.28;
const pale = 0.66;

/** Width of a sentence to be read, and of a mere label, of which a riffle shows two dozen. */
const sentenceWidth = 640;
const labelWidth = 320;
const serif = "'EB Garamond', 'Iowan Old Style', Palatino, Georgia, serif";

function sheet(
  aspect: number,
  width: number,
  { paper, ink }: ThemeLook,
): { canvas: HTMLCanvasElement; pen: CanvasRenderingContext2D } {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = Math.round(width / aspect);
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.fillStyle = paper;
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.fillStyle = ink;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  return { canvas, pen };
}

/** Returns a page still being drawn: its label in faint ink between two short rules. */
export function waitingPage(label: string, aspect: number, look: ThemeLook): HTMLCanvasElement {
  const { canvas, pen } = sheet(aspect, labelWidth, look);
  const { width } = canvas;
  const [x, y] = [width / 2, canvas.height / 2];
  pen.globalAlpha = faint;
  pen.font = `${width * 0.06}px ${serif}`;
  pen.fillText(label, x, y, width * 0.8);
  pen.fillRect(x - width * 0.06, y - width * 0.06, width * 0.12, width / 400);
  pen.fillRect(x - width * 0.06, y + width * 0.06, width * 0.12, width / 400);
  return canvas;
}

/** Returns a page that cannot be drawn: the sentence that gives the reason. */
export function failedPage(sentence: string, aspect: number, look: ThemeLook): HTMLCanvasElement {
  return sentencePage(sentence, aspect, look, 1);
}

/** Returns a page that takes long to draw: the sentence that says so, in paler ink. */
export function slowPage(sentence: string, aspect: number, look: ThemeLook): HTMLCanvasElement {
  return sentencePage(sentence, aspect, look, pale);
}

function sentencePage(
  sentence: string,
  aspect: number,
  look: ThemeLook,
  opacity: number,
): HTMLCanvasElement {
  const { canvas, pen } = sheet(aspect, sentenceWidth, look);
  const { width } = canvas;
  const size = width * 0.042;
  pen.globalAlpha = opacity;
  pen.font = `italic ${size}px ${serif}`;
  const lines = wrap(sentence, (line) => pen.measureText(line).width <= width * 0.74);
  const top = canvas.height / 2 - ((lines.length - 1) * size * 1.5) / 2;
  lines.forEach((line, i) => {
    pen.fillText(line, canvas.width / 2, top + i * size * 1.5, width * 0.9);
  });
  return canvas;
}

/** Returns blank paper: the back of a last page without one. */
export function barePage(aspect: number, look: ThemeLook): HTMLCanvasElement {
  return sheet(aspect, labelWidth, look).canvas;
}

/** Returns white paper on a part of a leaf, in fractions of it; the rest of the leaf is clear. */
export function whitePage(aspect: number, part: PageBox): HTMLCanvasElement {
  const { canvas, pen } = sheet(aspect, labelWidth, lookOf({}));
  const { width, height } = canvas;
  pen.clearRect(0, 0, width, height);
  pen.fillStyle = "#fff";
  pen.fillRect(part.x * width, part.y * height, part.width * width, part.height * height);
  return canvas;
}

/** Breaks text into lines at its spaces, as many words a line as `fits` allows. */
export function wrap(text: string, fits: (line: string) => boolean): string[] {
  const lines: string[] = [];
  for (const word of text.split(/\s+/)) {
    const longer = `${lines.at(-1) ?? ""} ${word}`.trim();
    if (lines.length > 0 && fits(longer)) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}
