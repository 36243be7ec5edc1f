/** MOBI before KF8: one text in the HTML of its time, whose links are counted in bytes. */

import { cleanLanguage } from "../book_text.ts";
import { limits } from "../limits.ts";
import { cleanMarkup, type MarkupFiles } from "../markup/clean_markup.ts";
import { checkedData } from "../markup/data_address.ts";
import { parseMarkup } from "../markup/parse_markup.ts";
import {
  type FlowContent,
  type FlowOutline,
  type FlowSection,
  type FlowTarget,
  styleAttribute,
} from "../typeset/flow_book.ts";
import { coverSection } from "../typeset/lone_picture.ts";
import { linesIn } from "../typeset/page_estimate.ts";
import { isRightToLeft } from "../typeset/writing_direction.ts";
import { type KindleParts, type KindleText, outlineOf, plainText } from "./kindle_text.ts";

/** Where one section ends and the next begins. */
const pageBreak = /<\s*(?:mbp:)?pagebreak[^<>]*>/gi;

/** Where a link leads, or a line of the guide. */
const linked = /\bfilepos=["']?(\d{1,10})/gi;

/** Places of a book that are linked. */
const mostPlaces = 100_000;

/** Characters of a guide. */
const longestGuide = 20_000;

/** A length as MOBI writes it: a number of pixels, or with a unit. */
const length = /^(-?\d{0,4}(?:\.\d{0,4})?)(em|px|pt|%)?$/;

/** As Kindles have it: paragraphs without space between them, quotations indented a little. */
const style = `
p { margin: 0; }
blockquote { margin: 0 0 0 1em; }
img { max-width: 100%; }
`;

/** A part of the text in bytes. */
interface Part {
  readonly from: number;
  readonly to: number;
}

/** Reads the text of a MOBI. Rejects with a `BookError`. */
export async function openMobi6(book: KindleParts): Promise<KindleText> {
  const { text, header, name, resources } = book;
  // One letter a byte, so that places are counted alike.
  const letters = new TextDecoder("x-user-defined").decode(text);
  const parts = partsOf(letters);
  const table =
    header.contents === null ? null : await book.table(header.contents).catch(() => null);
  const places = new Set<number>();
  const add = (place: number | undefined): void => {
    if (place !== undefined && place <= text.length && places.size < mostPlaces) places.add(place);
  };
  for (const [, place] of letters.matchAll(linked)) add(Number(place));
  for (const { numbers } of table?.entries ?? []) add(numbers(1)[0]);
  const marks = [...places]
    .map((place): Mark => ({ place, at: betweenLetters(letters, place, header.encoding) }))
    .sort((a, b) => a.at - b.at);

  const first = header.cover === null ? 0 : 1;
  const targetOf = (place: number): FlowTarget | null => {
    const section = parts.findIndex(({ to }) => place < to);
    if (section < 0) return null;
    return { section: first + section, id: places.has(place) ? idOf(place) : "" };
  };
  const files: MarkupFiles = {
    data: async (address) => {
      const index = /^recindex:(\d{1,6})$/.exec(address)?.[1];
      return index === undefined
        ? await checkedData(address)
        : await resources.data(Number(index) - 1);
    },
    style: async () => [],
  };
  const decoder = new TextDecoder(header.encoding);
  const isReversed = isRightToLeft(cleanLanguage(header.language));
  const load = async (part: Part): Promise<FlowContent> => {
    const document = parseMarkup(markupOf(text, part, marks, decoder), "text/html");
    modernise(document);
    // It has no words for the direction of its text.
    if (isReversed && !document.querySelector("[dir]")) document.body.dir = "rtl";
    const content = await cleanMarkup(document, files, `A part of ${name}`);
    return { root: content.root, styles: [style, ...content.styles] };
  };
  const sections = parts.map((part): FlowSection => {
    return {
      length: part.to - part.from,
      isFixed: false,
      lines: async () => linesIn(decoder.decode(text.subarray(part.from, part.to))),
      load: () => load(part),
    };
  });
  const cover = coverSection(() => {
    const markup = `<html><body><img src="recindex:${(header.cover ?? 0) + 1}" alt=""></body></html>`;
    return cleanMarkup(parseMarkup(markup, "text/html"), files, `The cover of ${name}`);
  });
  const resolve = (href: string): FlowTarget | null => {
    const place = /^#filepos(\d{1,10})$/.exec(href)?.[1];
    return place === undefined ? null : targetOf(Number(place));
  };
  const outline = table
    ? outlineOf(table, (numbers) => targetOf(numbers(1)[0] ?? Number.POSITIVE_INFINITY))
    : guideOutline(letters, parts, decoder, text, resolve);
  const isCovered = header.cover !== null;
  return { sections: isCovered ? [cover, ...sections] : sections, outline, resolve, isCovered };
}

/** Returns the parts between breaks; one without anything to see belongs to the part before it. */
function partsOf(letters: string): Part[] {
  const breaks = [...letters.matchAll(pageBreak)].map(({ index }) => index).slice(0, limits.pages);
  const parts: Part[] = [];
  let at = 0;
  for (const to of [...breaks, letters.length]) {
    const last = parts.at(-1);
    const piece = letters.slice(at, to);
    // What comes before the first part belongs to it.
    if (/<img\b/i.test(piece) || hasText(piece)) parts.push({ from: last ? at : 0, to });
    else if (last) parts[parts.length - 1] = { from: last.from, to };
    at = to;
  }
  return parts;
}

function hasText(markup: string): boolean {
  // All but the last end with a head.
  const pieces = markup.split(/<\/head>/i);
  const last = pieces.pop() ?? "";
  const body = [...pieces.map((piece) => piece.split(/<head\b/i, 1)[0]), last].join("");
  return body.replace(/<[^<>]*>|&nbsp;|\s+/g, "") !== "";
}

const idOf = (place: number): string => `filepos${place}`;

/** Returns the address of the place to which a link leads. */
const linkTo = (link: Element): string => `#${idOf(Number(link.getAttribute("filepos")))}`;

/** A place that is linked, and where an anchor to it may stand. */
interface Mark {
  readonly place: number;
  readonly at: number;
}

/** Bytes before a place in which it is looked for what it lies within. */
const longestWithin = 1000;

/** The beginning of a tag, or of an entity, that has not ended. */
const within = /<[^<>]*$|&[#\w]{0,12}$/;

/** Returns a place, or where the tag, the entity or the letter begins that it lies within: some programs count so. */
function betweenLetters(letters: string, place: number, encoding: string): number {
  const before = letters.slice(Math.max(place - longestWithin, 0), place);
  const begun = within.exec(before);
  if (begun && /^[\w#]{0,12};|^[^<>&]*>/.test(letters.slice(place, place + longestWithin))) {
    return place - before.length + begun.index;
  }
  if (encoding !== "utf-8") return place;
  // The bytes of a letter after its first; each is a letter here, of its number or of one above it.
  const isInner = (at: number): boolean => ((letters.charCodeAt(at) || 0) & 0xc0) === 0x80;
  let at = place;
  while (at > 0 && place - at < 3 && isInner(at)) at -= 1;
  return at;
}

/** Returns a part's markup, with an anchor at each place that is linked. */
function markupOf(
  text: Uint8Array,
  { from, to }: Part,
  marks: readonly Mark[],
  decoder: TextDecoder,
): string {
  const pieces: string[] = [];
  let at = from;
  for (const { place, at: mark } of marks) {
    if (mark < from) continue;
    if (mark >= to) break;
    pieces.push(decoder.decode(text.subarray(at, mark)), `<a id="${idOf(place)}"></a>`);
    at = mark;
  }
  pieces.push(decoder.decode(text.subarray(at, to)));
  return pieces.join("").replace(pageBreak, "");
}

/** Writes what MOBI has its own words for as today's HTML does. */
function modernise(document: Document): void {
  for (const link of document.querySelectorAll("a[filepos]")) {
    link.setAttribute("href", linkTo(link));
  }
  // Some books have it in another resolution alone.
  for (const index of ["lorecindex", "hirecindex", "recindex"]) {
    for (const image of document.querySelectorAll(`img[${index}]`)) {
      image.setAttribute("src", `recindex:${Number(image.getAttribute(index))}`);
    }
  }
  // The space above a block, and the indent of its first line.
  for (const block of document.querySelectorAll("p[height], p[width], div[height], div[width]")) {
    const css = [
      ["margin-top", block.getAttribute("height")],
      ["text-indent", block.getAttribute("width")],
    ].flatMap(([property, value]) => {
      const [, number, unit = "px"] = length.exec(value?.trim() ?? "") ?? [];
      return number ? [`${property}: ${number}${unit};`] : [];
    });
    const own = block.getAttribute(styleAttribute) ?? "";
    block.setAttribute(styleAttribute, `${css.join(" ")} ${own}`);
    block.removeAttribute("height");
    block.removeAttribute("width");
  }
}

/** Returns the contents of a book without a table of them: the links of the page that its guide names. */
function guideOutline(
  letters: string,
  parts: readonly Part[],
  decoder: TextDecoder,
  text: Uint8Array,
  resolve: (href: string) => FlowTarget | null,
): FlowOutline[] {
  const start = letters.search(/<guide\b/i);
  const guide = letters.slice(start, start + longestGuide).split(/<\/guide>/i, 1)[0] ?? "";
  const line =
    start < 0
      ? undefined
      : guide.match(/<reference\b[^<>]*>/gi)?.find((one) => /type=["']?toc\b/i.test(one));
  const place = Number(/filepos=["']?(\d{1,10})/i.exec(line ?? "")?.[1] ?? Number.NaN);
  const part = parts.find(({ from, to }) => place >= from && place < to);
  if (!part) return [];
  const page = parseMarkup(decoder.decode(text.subarray(place, part.to)), "text/html");
  return [...page.querySelectorAll("a[filepos]")].slice(0, limits.outlineEntries).map((link) => ({
    title: plainText(link.textContent ?? "") || "–",
    target: resolve(linkTo(link)),
    children: [],
  }));
}
