/** Long chapters in pieces: a page is drawn with all of its piece, so that a piece has to be bounded. */

/**
 * Characters of a piece: some 130 pages, more than chapters have, and drawn in a
 * tenth of a second or two.
 */
const longestPiece = 200_000;

/** Characters that an element counts, by the time that it takes to lay it out. */
const elementLength = 50;

/**
 * Lines that end by themselves in one paragraph of a piece: set in columns, a paragraph takes a time that
 * grows with their square, a twentieth of a second for as many.
 */
const mostLines = 1000;

/** Text that runs to the left, and words of scripts that run to the right. */
const rightToLeft = /[\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefc]/;
const directed =
  /[\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefc]+|[\p{sc=Latin}\p{sc=Greek}\p{sc=Cyrillic}]+/gu;

/** Elements that are not divided, however much is in them. */
const whole = /^(svg|math|ruby|tr|select|object|figure|img)$/;

/** Elements before which a piece rather ends than elsewhere. */
const beginning = /^(h[1-6]|hr|section|article)$/;

/** What is before a piece in its container, for selectors that look back. */
const beforeClass = "turnleaf-before";

/** The class of a copy of an element that goes on with what is in that: it does not begin anew. */
export const continuedClass = "turnleaf-continued";

/** The style sheet for pieces. */
export const pieceStyle: string = `
.${beforeClass} { display: none !important; }
.${continuedClass} {
  text-indent: 0 !important; break-before: auto !important;
  margin-block-start: 0 !important; padding-block-start: 0 !important; border-block-start: 0 !important;
}
.${continuedClass}::before { content: none !important; }
li.${continuedClass} { list-style: none !important; }
`;

/** Returns a chapter's root, or copies of it each of which has a bounded part of its content, in order. */
export function divide(root: Element): readonly Element[] {
  const body = root.querySelector("body");
  if (body === null) return [root];
  const lengths = new Map<Node, number>();
  if (lengthOf(body, lengths) <= longestPiece) return [root];
  const divider = new Divider(lengths, root, body);
  divider.divide(body);
  return divider.pieces;
}

/** Returns how much a node counts; remembers it for all elements in it. */
function lengthOf(node: Node, lengths: Map<Node, number>): number {
  if (node instanceof Text) {
    const turns = turnsIn(node.data);
    const length = node.data.length + turns * elementLength;
    if (turns > 0) lengths.set(node, length);
    return length;
  }
  let length = elementLength;
  const ends: Node[] = [];
  for (let child = node.firstChild; child; child = child.nextSibling) {
    length += lengthOf(child, lengths);
    if ((child as Partial<Element>).localName === "br") ends.push(child);
  }
  if (ends.length > mostLines) {
    length += ends.length * (longestPiece / mostLines - elementLength);
    for (const end of ends) lengths.set(end, longestPiece / mostLines);
  }
  lengths.set(node, length);
  return length;
}

/** Returns how often a text changes its direction: a browser sets each part of a line by itself. */
function turnsIn(text: string): number {
  if (!rightToLeft.test(text)) return 0;
  let [turns, wasLeft] = [0, false];
  for (const [word] of text.matchAll(directed)) {
    const isLeft = rightToLeft.test(word);
    if (isLeft !== wasLeft) turns++;
    wasLeft = isLeft;
  }
  return turns;
}

class Divider {
  readonly pieces: Element[] = [];
  readonly #lengths: ReadonlyMap<Node, number>;
  /** The elements that are being divided, outermost first, and their copies in the last piece. */
  readonly #open: { readonly source: Element; copy: Element }[] = [];
  #length = 0;

  constructor(lengths: ReadonlyMap<Node, number>, root: Element, body: Element) {
    this.#lengths = lengths;
    for (const source of [root, body]) {
      this.#open.push({ source, copy: source.cloneNode() as Element });
    }
    this.#begin(body.firstChild);
  }

  /** Divides what is in the innermost open element. */
  divide(container: Element): void {
    for (let child = container.firstChild; child; child = child.nextSibling) {
      const length = this.#lengths.get(child) ?? child.nodeValue?.length ?? 0;
      if (length > longestPiece && child instanceof Text) this.#divideText(child, length);
      else if (length > longestPiece && child instanceof Element && !whole.test(child.localName)) {
        if (beginning.test(child.localName) && this.#isHalf) this.#begin(child);
        const copy = child.cloneNode() as Element;
        this.#append(copy, elementLength);
        this.#open.push({ source: child, copy });
        this.divide(child);
        this.#open.pop();
      } else {
        const isFull = this.#length > 0 && this.#length + length > longestPiece;
        const isHead = child instanceof Element && beginning.test(child.localName);
        if (isFull || (isHead && this.#isHalf)) this.#begin(child);
        this.#append(child.cloneNode(true), length);
      }
    }
  }

  get #isHalf(): boolean {
    return this.#length > longestPiece / 2;
  }

  #append(node: Node, length: number): void {
    this.#open.at(-1)?.copy.append(node);
    this.#length += length;
  }

  /** Divides a text between words, or within one that is too long. */
  #divideText(text: Text, length: number): void {
    const { data } = text;
    /** What a character counts. */
    const each = length / data.length;
    for (let from = 0; from < data.length; ) {
      if (this.#length >= longestPiece) this.#begin(text);
      const most = from + Math.ceil(longestPiece / each);
      const space = data.lastIndexOf(" ", most);
      let to = most >= data.length ? data.length : space > from ? space + 1 : most;
      // Not between the halves of a character.
      if (/[\udc00-\udfff]/.test(data[to] ?? "")) to += 1;
      this.#append(document.createTextNode(data.slice(from, to)), (to - from) * each);
      from = to;
    }
  }

  /** Begins a piece with the open elements, of which `next` comes first in the innermost. */
  #begin(next: Node | null): void {
    const isFirst = this.pieces.length === 0;
    this.#open.forEach((one, k) => {
      const parent = this.#open[k - 1];
      const copy = one.source.cloneNode() as Element;
      const child = this.#open[k + 1]?.source ?? next;
      if (k > 1) copy.classList.add(continuedClass);
      // The body's own place is that of its beginning.
      if (!isFirst && k > 0) copy.removeAttribute("id");
      if (!isFirst && k > 0) this.#lookBack(one.source, copy, child);
      parent?.copy.append(copy);
      one.copy = copy;
    });
    this.pieces.push(this.#open[0]?.copy as Element);
    this.#length = 0;
  }

  /** Puts into a copy what stands for what is before `next`: selectors and numbers follow from it. */
  #lookBack(source: Element, copy: Element, next: Node | null): void {
    const last = (next as Element | Text | null)?.previousElementSibling;
    if (!last) return;
    const before = last.cloneNode() as Element;
    for (const name of ["id", "name", "src", "href"]) before.removeAttribute(name);
    before.classList.add(beforeClass);
    copy.append(before);
    if (source.localName === "ol") copy.setAttribute("start", String(numberAfter(source, last)));
  }
}

/** Returns the number of the item of a list that follows another. */
export function numberAfter(list: Element, last: Element): number {
  const isReversed = list.hasAttribute("reversed");
  const first = Number.parseInt(list.getAttribute("start") ?? "", 10);
  const step = isReversed ? -1 : 1;
  let number = Number.isNaN(first) ? (isReversed ? list.childElementCount : 1) : first;
  for (let item: Element | null = list.firstElementChild; item; item = item.nextElementSibling) {
    const own = Number.parseInt(item.getAttribute("value") ?? "", 10);
    if (item.localName === "li") number = (Number.isNaN(own) ? number : own) + step;
    if (item === last) break;
  }
  return number;
}
