/** Selects text by whole words, as a finger does that rests on one and then moves. */

import { wordAround } from "./word_bounds.ts";

/** The greatest distance of a finger from the text on which it rests, CSS pixels: lines lie apart. */
const mostBeside = 12;

/** How much farther a line above or below is than the one beside a finger: one in the margin means its own line. */
const acrossLines = 4;

/** A place in the text of a layer. */
interface TextPlace {
  readonly node: Node;
  readonly offset: number;
}

/** A word as it is laid: it may have parts on several lines. */
interface LaidWord {
  readonly start: TextPlace;
  readonly end: TextPlace;
}

/**
 * Selects the word at a place of the window, CSS pixels. Returns what extends the selection by whole
 * words to another place; null if there is no text at the first.
 *
 * @param layer contains the pieces of the open pages, as `layText` lays them
 */
export function selectWord(
  layer: HTMLElement,
  x: number,
  y: number,
): ((x: number, y: number) => void) | null {
  const pieces = [...layer.querySelectorAll<HTMLElement>(".pieces > span:not([hidden])")];
  const under = nearest(pieces, x, y);
  if (under === null || distanceTo(under.getBoundingClientRect(), x, y) > mostBeside) return null;
  const first = wordAt(under, x, y);
  // The browser may have selected it already, and shows more around a selection of its own.
  if (getSelection()?.isCollapsed !== false) select(first.start, first.end);
  return (x, y) => {
    // The page may have been laid out anew since.
    const piece = under.isConnected ? nearest(pieces, x, y) : null;
    if (piece === null) return;
    const last = wordAt(piece, x, y);
    if (isBefore(last.start, first.start)) select(first.end, last.start);
    else select(first.start, last.end);
  };
}

function select(from: TextPlace, to: TextPlace): void {
  getSelection()?.setBaseAndExtent(from.node, from.offset, to.node, to.offset);
}

/** Returns the word of a piece that is nearest to a place. */
function wordAt(piece: HTMLElement, x: number, y: number): LaidWord {
  const node = piece.firstChild as Text;
  const letter = document.createRange();
  let [at, least] = [0, Number.POSITIVE_INFINITY];
  for (let from = 0; from < node.length; from++) {
    letter.setStart(node, from);
    letter.setEnd(node, from + 1);
    const distance = distanceTo(letter.getBoundingClientRect(), x, y);
    if (distance < least) [at, least] = [from, distance];
  }
  // Words that a line's end divides have their parts in pieces one after the other.
  const paragraph = piece.parentElement as HTMLElement;
  const texts = [...paragraph.childNodes].flatMap((one) => {
    const text = one instanceof Text ? one : one.firstChild;
    return text instanceof Text ? [text] : [];
  });
  const before = texts.slice(0, texts.indexOf(node)).reduce((sum, { length }) => sum + length, 0);
  const { from, to } = wordAround(texts.map(({ data }) => data).join(""), before + at);
  return { start: placeOf(texts, from, false), end: placeOf(texts, to, true) };
}

/** Returns where a place of the joined texts is; between two of them in the former if it is an end. */
function placeOf(texts: readonly Text[], place: number, isEnd: boolean): TextPlace {
  let rest = place;
  for (const node of texts) {
    if (rest < node.length || (isEnd && rest === node.length)) return { node, offset: rest };
    rest -= node.length;
  }
  const node = texts.at(-1) as Text;
  return { node, offset: node.length };
}

function isBefore(one: TextPlace, other: TextPlace): boolean {
  if (one.node === other.node) return one.offset < other.offset;
  const order = one.node.compareDocumentPosition(other.node);
  return (order & Node.DOCUMENT_POSITION_FOLLOWING) !== 0;
}

/** Returns the piece that is nearest to a place, along its line rather than across; null if there is none. */
function nearest(pieces: readonly HTMLElement[], x: number, y: number): HTMLElement | null {
  let [best, least]: [HTMLElement | null, number] = [null, Number.POSITIVE_INFINITY];
  for (const piece of pieces) {
    const weights: [number, number] = isLevel(piece) ? [1, acrossLines] : [acrossLines, 1];
    const distance = distanceTo(piece.getBoundingClientRect(), x, y, weights);
    if (distance < least) [best, least] = [piece, distance];
  }
  return best;
}

/** Returns whether a piece's line runs across the window rather than up or down. */
function isLevel({ style }: HTMLElement): boolean {
  const { a, b } = new DOMMatrix(style.transform);
  return Math.abs(a) > Math.abs(b) === (style.writingMode === "");
}

/** Returns how far a place is from a box, where lengths across and down count as often as the weights say. */
function distanceTo(box: DOMRect, x: number, y: number, [across = 1, down = 1] = [1, 1]): number {
  const left = Math.max(box.left - x, x - box.right, 0);
  const above = Math.max(box.top - y, y - box.bottom, 0);
  return Math.hypot(across * left, down * above);
}
