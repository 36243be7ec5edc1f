import type { PDFDocumentProxy, PDFPageProxy } from "pdfjs-dist";
import { cleanRun } from "./book_text.ts";
import { isPageSize, limits } from "./limits.ts";
import type { TextRun } from "./page_source.ts";
import { type Letter, placeLetters } from "./pdf_letters.ts";

/** A pdf.js piece of text, or where a mark begins or ends; a file can contain anything. */
interface Item {
  readonly str?: string;
  readonly type?: string;
  /** Of a mark, by the changed worker: the layer on which what follows lies, and the words for which it stands. */
  readonly layer?: unknown;
  readonly actualText?: string;
  readonly transform: readonly number[];
  readonly width: number;
  readonly height: number;
  readonly fontName: string;
  readonly hasEOL: boolean;
}

/** A mark that has begun: whether what it holds is not shown, the words for it, and its first piece. */
interface Mark {
  readonly isHidden: boolean;
  readonly words: string | undefined;
  readonly from: number;
}

/** Which layers of a document are shown. */
type Layers = Awaited<ReturnType<PDFDocumentProxy["getOptionalContentConfig"]>>;

interface Style {
  readonly ascent: number;
  readonly descent: number;
  readonly vertical: boolean;
}

interface Chunk {
  readonly items: readonly Item[];
  readonly styles: Readonly<Record<string, Style>>;
}

/** A piece of text, and its font's size along the line in the unit of the page. */
interface Piece {
  readonly run: TextRun;
  readonly em: number;
}

/**
 * Returns the text of a page in the order of its file, which is the reading
 * order, without what lies on layers that are not shown. Rejects as pdf.js does.
 *
 * @param letters finds the place of each letter
 */
export async function textOfPage(
  document: PDFDocumentProxy,
  page: PDFPageProxy,
  signal: AbortSignal,
  letters?: () => Promise<readonly Letter[]>,
): Promise<TextRun[]> {
  const pieces = await readPieces(page, await document.getOptionalContentConfig(), signal);
  const isLevel = ({ run }: Piece): boolean => !run.vertical;
  if (letters === undefined || !pieces.some(isLevel)) return pieces.map(({ run }) => run);
  const lines = pieces.map(({ run, em }) => ({ text: run.text, width: run.width, em }));
  const places = placeLetters(lines, await letters());
  return pieces.map((piece, k) => {
    const found = places[k];
    return found && isLevel(piece) ? { ...piece.run, places: found } : piece.run;
  });
}

async function readPieces(
  page: PDFPageProxy,
  layers: Layers,
  signal: AbortSignal,
): Promise<Piece[]> {
  const view = page.getViewport({ scale: 1 });
  const pieces: Piece[] = [];
  const styles: Record<string, Style> = Object.create(null);
  const marks: Mark[] = [];
  let letters = 0;
  let read = 0;
  const content = page.streamTextContent({ includeMarkedContent: true });
  const reader = (content as ReadableStream<Chunk>).getReader();
  try {
    for (;;) {
      const { value, done } = await reader.read();
      signal.throwIfAborted();
      if (done) return pieces;
      Object.assign(styles, value.styles);
      for (const item of value.items) {
        // What lies beside the page counts too, where it goes on for ever.
        if (++read > limits.textLength) return pieces;
        if (item.str === undefined) {
          const around = marks.at(-1);
          if (item.type !== "endMarkedContent")
            marks.push(markOf(item, layers, pieces.length, around));
          else putWords(pieces, marks.pop());
          continue;
        }
        if (marks.at(-1)?.isHidden) continue;
        const piece = pieceOf(item, styles[item.fontName], view.transform);
        if (piece && isWithin(piece.run, view)) {
          letters += piece.run.text.length;
          if (pieces.length >= limits.runs || letters > limits.textLength) return pieces;
          pieces.push(piece);
        } else follow(pieces, item);
      }
    }
  } finally {
    // Also ends the worker's reading, if this stops before the page does.
    reader.cancel(new Error("The text is not wanted any more.")).catch(() => {});
  }
}

/** @param around the mark within which it begins: what that hides is hidden here too */
function markOf(
  { layer, actualText }: Item,
  layers: Layers,
  from: number,
  around: Mark | undefined,
): Mark {
  const isOff = layer !== undefined && !layers.isVisible(layer);
  return { isHidden: around?.isHidden === true || isOff, words: actualText, from };
}

/** Has the pieces of a mark say the words for which they stand. */
function putWords(pieces: Piece[], mark: Mark | undefined): void {
  if (mark?.words === undefined) return;
  const drawn = pieces.splice(mark.from);
  const words = cleanRun(mark.words);
  const all = drawn.reduce((sum, { run }) => sum + run.width, 0);
  let [passed, at] = [0, 0];
  for (const piece of drawn) {
    passed += piece.run.width;
    // A line ends between words.
    const about = Math.round((words.length * passed) / all);
    const end = about < words.length ? words.lastIndexOf(" ", about) + 1 : about;
    const text = words.slice(at, end);
    at = Math.max(at, end);
    if (text !== "") pieces.push({ ...piece, run: { ...piece.run, text } });
    else follow(pieces, { str: "", hasEOL: piece.run.end });
  }
}

/** Appends spaces and ends of lines that come as items of their own to the run before them. */
function follow(pieces: Piece[], item: Pick<Item, "str" | "hasEOL">): void {
  const last = pieces.at(-1);
  if (last === undefined) return;
  const { text, end } = last.run;
  const isGap = item.str !== "" && item.str?.trim() === "" && !/\s$/.test(text);
  const run = { ...last.run, text: isGap ? `${text} ` : text, end: end || item.hasEOL };
  pieces[pieces.length - 1] = { ...last, run };
}

function pieceOf(item: Item, style: Style | undefined, view: readonly number[]): Piece | null {
  const text = cleanRun(item.str);
  if (text.trim() === "") return null;
  const [a, b, c, d, e, f] = item.transform;
  // Where the baseline begins, and the direction of the letters, on a page seen
  // from its top left corner.
  const x = view[0] * e + view[2] * f + view[4];
  const y = view[1] * e + view[3] * f + view[5];
  const along = { x: view[0] * a + view[2] * b, y: view[1] * a + view[3] * b };
  const size = Math.hypot(view[0] * c + view[2] * d, view[1] * c + view[3] * d);
  const angle = Math.atan2(along.y, along.x) || 0;
  const unit = Math.hypot(view[0], view[1]);
  const em = Math.hypot(along.x, along.y);
  const end = item.hasEOL;
  if (style?.vertical) {
    const across = { x: Math.cos(angle) * (size / 2), y: Math.sin(angle) * (size / 2) };
    const height = item.height * unit;
    const box = { x: x - across.x, y: y - across.y, width: size, height };
    return { run: { ...box, text, angle, end, vertical: true }, em };
  }
  const ascent = size * between(style?.ascent, 0.5, 1.2, 0.8);
  const descent = size * between(style?.descent && -style.descent, 0.05, 0.5, 0.2);
  const box = {
    x: x + ascent * Math.sin(angle),
    y: y - ascent * Math.cos(angle),
    // A font may say that its letters have no width; they are half as wide as high, as usual.
    width: item.width * unit || (em * text.length) / 2,
    height: ascent + descent,
  };
  return { run: { ...box, text, angle, end }, em };
}

function between(value: number | undefined, low: number, high: number, otherwise: number): number {
  return value !== undefined && value >= low && value <= high ? value : otherwise;
}

/** Returns whether part of the run is visible on its page: a file's text may lie anywhere. */
function isWithin(
  run: TextRun,
  page: { readonly width: number; readonly height: number },
): boolean {
  const { x, y, width, height, angle } = run;
  if (!Number.isFinite(x + y + angle) || !isPageSize({ width, height })) return false;
  const middle = {
    x: x + (width * Math.cos(angle) - height * Math.sin(angle)) / 2,
    y: y + (width * Math.sin(angle) + height * Math.cos(angle)) / 2,
  };
  return middle.x > 0 && middle.y > 0 && middle.x < page.width && middle.y < page.height;
}
