/** Marks upon pages of a PDF that say how they look only by what they are: notes, stamps, files. */

import type { PDFPageProxy } from "pdfjs-dist";
import { cleanText } from "./book_text.ts";
import { limits } from "./limits.ts";
import type { PageLink } from "./page_source.ts";
import { type Annotation, annotationsOf, boxOf, isSeen } from "./pdf_annotations.ts";

/** Marks whose text is read beside them. */
const withText = /^(Text|Stamp|Caret|FileAttachment)$/;

/** Sounds, films and models, which are not played. */
const played = /^(Sound|Movie|Screen|RichMedia|3D)$/;

/** A side of the sign of a note, as programs draw it, points. */
const signSize = 22;

/** The usual colours of a note and of a stamp. */
const noteColour = "#ffd54d";
const stampColour = "#b3261e";

/** Returns marks with text as links that show it, with the replies to each. Rejects as pdf.js does. */
export async function notesOfPage(page: PDFPageProxy): Promise<PageLink[]> {
  const all = await annotationsOf(page, isSeen);
  return all.filter(isMark).flatMap((one) => {
    const replies = all.filter(({ inReplyTo }) => inReplyTo === one.id);
    const note = [one, ...replies].map(textOf).filter((text) => text !== "");
    const box = boxOf(page, one);
    if (!box || note.length === 0) return [];
    const title = cleanText(one.titleObj?.str, limits.labelLength);
    return [{ ...box, title, to: { page: page.pageNumber }, note: note.join("\n") }];
  });
}

/** Returns what a page is to play. Rejects as pdf.js does. */
export async function playedOnPage(page: PDFPageProxy): Promise<string[]> {
  const all = await annotationsOf(page, (one) => isSeen(one) && played.test(one.subtype ?? ""));
  return all.map((one) => cleanText(one.richMedia?.filename) || textOf(one) || (one.subtype ?? ""));
}

/** Returns the marks of a page that have no appearance. Rejects as pdf.js does. */
export async function bareMarksOf(page: PDFPageProxy): Promise<readonly Annotation[]> {
  return await annotationsOf(page, (one) => isSeen(one) && isMark(one) && !one.hasAppearance);
}

/**
 * Draws such marks.
 *
 * @param toCanvas the transformation from the page's unit, from its upper left corner, to the canvas
 */
export function drawMarks(
  pen: OffscreenCanvasRenderingContext2D,
  page: PDFPageProxy,
  marks: readonly Annotation[],
  toCanvas: DOMMatrixReadOnly,
): void {
  for (const mark of marks) {
    const box = boxOf(page, mark);
    if (!box) continue;
    pen.setTransform(toCanvas);
    pen.translate(box.x, box.y);
    if (mark.subtype === "Stamp") drawStamp(pen, box, textOf(mark) || "Stamp", colourOf(mark));
    else drawSign(pen, colourOf(mark) ?? noteColour);
  }
  pen.resetTransform();
}

/** Draws a slip of paper with lines on it. */
function drawSign(pen: OffscreenCanvasRenderingContext2D, colour: string): void {
  const [from, to] = [0.1 * signSize, 0.9 * signSize];
  pen.fillStyle = colour;
  pen.strokeStyle = "#5c4a10";
  pen.lineWidth = 1;
  pen.beginPath();
  pen.rect(from, from, to - from, to - from);
  pen.fill();
  for (const line of [0.35, 0.5, 0.65]) {
    pen.moveTo(2 * from, line * signSize);
    pen.lineTo(signSize - 2 * from, line * signSize);
  }
  pen.stroke();
}

/** Draws words in a frame, as large as the frame allows. */
function drawStamp(
  pen: OffscreenCanvasRenderingContext2D,
  { width, height }: { readonly width: number; readonly height: number },
  words: string,
  colour = stampColour,
): void {
  const line = Math.min(height / 10, 2);
  pen.fillStyle = pen.strokeStyle = colour;
  pen.lineWidth = line;
  pen.strokeRect(line, line, width - 2 * line, height - 2 * line);
  pen.font = "bold 10px sans-serif";
  const size = Math.min(0.6 * height, (10 * 0.9 * width) / pen.measureText(words).width);
  pen.font = `bold ${size}px sans-serif`;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillText(words, width / 2, height / 2);
}

const isMark = ({ subtype = "", inReplyTo }: Annotation): boolean =>
  withText.test(subtype) && !inReplyTo;

/** Returns what a mark says, or the name of the file that it is. */
function textOf({ contentsObj, file }: Annotation): string {
  return cleanText(contentsObj?.str, limits.noteLength) || cleanText(file?.filename);
}

function colourOf({ color }: Annotation): string | undefined {
  return color && color.length === 3 ? `rgb(${[...color].join(" ")})` : undefined;
}
