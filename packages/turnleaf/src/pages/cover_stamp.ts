/** The front of a book that has no cover of its own: its title and authors, stamped into the cloth. */

import type { PageSource, TitleFont } from "../sources/page_source.ts";
import { serif } from "../sources/typeset/serif.ts";
import { wrap } from "./stand_in.ts";

/** What is stamped. */
export type StampedWords = Pick<PageSource, "title" | "titleDirection" | "titleFont" | "authors">;

/** Width of the stamp, pixels: as sharp as a board is drawn. */
const across = 1024;

/** Foil on dark cloth, and ink on light cloth. */
const foil = { light: "#ecd39a", dark: "#caa25c" };
const ink = { light: "#3a2c20", dark: "#241a12" };

/** The face of a book that has none of its own. */
const usualFont: TitleFont = { style: "", family: serif };

/** Lines of a title, at most; of authors, and how many of these are named. */
const mostTitle = 6;
const mostAuthors = 4;

/**
 * Returns a stamp for a board: clear but for its letters and a frame of two rules.
 *
 * @param aspect the board's width over its height
 * @param cloth CSS colour of the cloth
 */
export function coverStamp(words: StampedWords, aspect: number, cloth: string): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = across;
  canvas.height = Math.round(across / aspect);
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  const { width, height } = canvas;
  // Sizes follow the shorter side, so that a wide book is not stamped with giant letters.
  const unit = Math.min(width, height) / 100;
  const { light, dark } = isLight(pen, cloth) ? ink : foil;
  const sheen = pen.createLinearGradient(0, 0, width, height);
  for (const [at, colour] of [
    [0, dark],
    [0.35, light],
    [0.65, dark],
    [1, light],
  ] as const) {
    sheen.addColorStop(at, colour);
  }
  pen.fillStyle = pen.strokeStyle = sheen;
  for (const [inset, line] of [
    [8, 0.5],
    [9.6, 0.22],
  ] as const) {
    pen.lineWidth = line * unit;
    pen.strokeRect(inset * unit, inset * unit, width - 2 * inset * unit, height - 2 * inset * unit);
  }
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  if (words.titleDirection === "rtl" || words.titleDirection === "ltr") {
    pen.direction = words.titleDirection;
  }
  const room = width - 30 * unit;
  const font = words.titleFont ?? usualFont;
  const title = fitted(pen, words.title, font, {
    size: 9 * unit,
    least: 4.5 * unit,
    room,
    most: mostTitle,
  });
  drawLines(pen, title, font, width / 2, 0.36 * height);
  const authors = [...(words.authors ?? [])].slice(0, mostAuthors).join(" · ");
  if (authors === "") return canvas;
  const end = 0.36 * height + (title.lines.length * title.size * leading) / 2;
  const rule = Math.min(end + 5 * unit, 0.7 * height);
  pen.fillRect(width / 2 - 6 * unit, rule, 12 * unit, 0.35 * unit);
  const names = fitted(pen, authors, font, {
    size: 4.6 * unit,
    least: 3 * unit,
    room,
    most: mostAuthors,
  });
  drawLines(pen, names, font, width / 2, 0.8 * height);
  return canvas;
}

/** Returns a CSS font of a size in pixels. */
function fontOf({ style, family }: TitleFont, size: number): string {
  return `${style} ${size}px ${family}`;
}

/** Distance of lines as a factor of their type's size. */
const leading = 1.22;

interface FittedText {
  readonly lines: readonly string[];
  readonly size: number;
}

/** Breaks a text into lines of the largest type in which it fits, and cuts what is longer. */
function fitted(
  pen: CanvasRenderingContext2D,
  text: string,
  font: TitleFont,
  { size, least, room, most }: { size: number; least: number; room: number; most: number },
): FittedText {
  const isIn = (line: string): boolean => pen.measureText(line).width <= room;
  for (let at = size; ; at *= 0.9) {
    pen.font = fontOf(font, at);
    const lines = wrap(text, isIn);
    if (lines.length <= most && lines.every(isIn)) return { lines, size: at };
    if (at * 0.9 < least) return { lines: [...lines.slice(0, most - 1), "…"], size: at };
  }
}

function drawLines(
  pen: CanvasRenderingContext2D,
  { lines, size }: FittedText,
  font: TitleFont,
  x: number,
  middle: number,
): void {
  pen.font = fontOf(font, size);
  lines.forEach((line, k) => {
    const y = middle + (k - (lines.length - 1) / 2) * size * leading;
    pen.fillText(line, x, y, pen.canvas.width * 0.72);
  });
}

/** Returns whether dark letters are better seen on a colour than light ones. */
function isLight(pen: CanvasRenderingContext2D, colour: string): boolean {
  pen.fillStyle = colour;
  pen.fillRect(0, 0, 1, 1);
  const [red = 0, green = 0, blue = 0] = pen.getImageData(0, 0, 1, 1).data;
  pen.clearRect(0, 0, 1, 1);
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue > 140;
}
