/** Plain text and Markdown as books: set as an EPUB's chapters are. */

import type { Token, Tokens } from "marked";
import { bytesOf } from "../book_file.ts";
import { cleanText, decodeEscapes } from "../book_text.ts";
import { decodeText } from "../decode_text.ts";
import { limits } from "../limits.ts";
import { cleanMarkup } from "../markup/clean_markup.ts";
import { checkedData } from "../markup/data_address.ts";
import { parseMarkup } from "../markup/parse_markup.ts";
import type { PageSource, Typography } from "../page_source.ts";
import type { FlowBook, FlowContent, FlowOutline, FlowSection } from "../typeset/flow_book.ts";
import { FlowSource } from "../typeset/flow_source.ts";
import { linesIn } from "../typeset/page_estimate.ts";
import { isRightToLeft, mostlyRightToLeft } from "../typeset/writing_direction.ts";
import { Footnotes, idsOf, listOf } from "./footnotes.ts";
import { type FrontMatter, readFrontMatter } from "./front_matter.ts";
import { htmlOf, readMarkdown } from "./markdown.ts";
import { pagesOf } from "./plain_text.ts";

/** A chapter as markup, and the headings in it. */
interface Chapter {
  readonly html: string;
  readonly headings: readonly Heading[];
  /** The ids of its notes, and of what leads to them. */
  readonly ids?: readonly string[];
}

interface Heading {
  readonly title: string;
  readonly id: string;
  readonly depth: number;
}

/** Characters of plain text after which the next paragraph begins another chapter. */
const longestPart = 60_000;

/** A piece of a longer paragraph, to its last space if there is one. */
const piece = new RegExp(`[\\s\\S]{1,${longestPart}}(?=\\s|$)|[\\s\\S]{1,${longestPart}}`, "g");

/** What stands for the title of a heading without words. */
const noTitle = "–";

/** The depth of headings, from 1, beyond which they are no lines of the contents. */
const deepestLine = 3;

const style = `
p { margin: 0; text-indent: 1.4em; }
p:first-child, h1 + p, h2 + p, h3 + p, hr + p, pre + p, ul + p, ol + p, .lines { text-indent: 0; }
.lines { white-space: pre-wrap; text-align: start; margin: 0.7em 0; }
pre, code { font-family: monospace; font-size: 0.85em; }
blockquote { margin: 0.7em 1.4em; }
td, th { padding: 0 0.5em; text-align: start; vertical-align: top; }
img { display: block; margin: 0.7em auto; }
.notes { font-size: 0.85em; }
`;

/** Opens plain text or Markdown. Rejects with a `BookError`. */
export async function openText(
  file: Blob,
  name: string,
  type: string,
  typography?: Typography,
): Promise<PageSource> {
  const text = withoutControls(
    (await decodeText(await bytesOf(file, name))).replace(/\r\n?/g, "\n"),
  );
  // Both are text: a name may tell them apart where the media type does not.
  const isMarkdown = /markdown/.test(type) || /\.(md|markdown)$/i.test(name);
  const front = isMarkdown ? readFrontMatter(text) : null;
  const chapters = (front && markdownChapters(front.rest)) ?? plainChapters(text);
  return await FlowSource.open(bookOf(chapters, text, front, file, name), typography);
}

function bookOf(
  chapters: readonly Chapter[],
  text: string,
  front: FrontMatter | null,
  file: Blob,
  name: string,
): FlowBook {
  const places = new Map<string, number>();
  const addPlaces = (idsOf: (chapter: Chapter) => Iterable<string>): void =>
    chapters.forEach((chapter, section) => {
      for (const id of idsOf(chapter)) if (!places.has(id)) places.set(id, section);
    });
  addPlaces(({ headings, ids = [] }) => [...headings.map(({ id }) => id), ...ids]);
  // Links may lead to what has its place by HTML.
  if (front) addPlaces(({ html }) => placesIn(html));
  const [first] = chapters[0]?.headings ?? [];
  const language = front?.language ?? "";
  const isReversed = language === "" ? mostlyRightToLeft(text) : isRightToLeft(language);
  const direction = isReversed ? "rtl" : "ltr";
  return {
    name,
    title: front?.title || (first?.depth === 1 && first.title !== noTitle && first.title) || name,
    language,
    direction,
    cover: "none",
    details: (front?.authors ?? []).map((value) => ({ label: "", value })),
    sections: chapters.map((chapter) => sectionOf(chapter, direction, name)),
    outline: outlineOf(chapters),
    resolve: (_section, href) => {
      const id = decodeEscapes(/^#(.+)/.exec(href)?.[1] ?? "");
      const section = places.get(id);
      return section === undefined ? null : { section, id };
    },
    file: async () => file,
    close: () => {},
  };
}

function sectionOf({ html }: Chapter, direction: FlowBook["direction"], name: string): FlowSection {
  const load = async (): Promise<FlowContent> => {
    const body = direction === "rtl" ? `<body dir="rtl">` : "<body>";
    const document = parseMarkup(`<html>${body}${html}</body></html>`, "text/html");
    for (const anchor of document.querySelectorAll("a[name]:not([id])")) {
      anchor.id = anchor.getAttribute("name") ?? "";
    }
    const files = { data: checkedData, style: async () => [] };
    const content = await cleanMarkup(document, files, name);
    return { root: content.root, styles: [style, ...content.styles] };
  };
  return { length: html.length, isFixed: false, lines: async () => linesIn(html), load };
}

/** An element's beginning, and what names it. */
const tag = /<[a-z][^<>]*>/gi;
const naming = /\s(?:id|name)\s*=\s*["']?([^\s"'<>]{1,200})/i;

/** Returns the names by which links lead to elements of a chapter. */
function placesIn(html: string): string[] {
  return (html.match(tag) ?? []).flatMap((one) => {
    const [, id] = naming.exec(one) ?? [];
    return id === undefined ? [] : [id];
  });
}

/** Splits plain text where paragraphs end. */
function plainChapters(text: string): Chapter[] {
  const chapters: Chapter[] = [];
  let html: string[] = [];
  let length = 0;
  const end = (): void => {
    if (html.length > 0) chapters.push({ html: html.join("\n"), headings: [] });
    [html, length] = [[], 0];
  };
  for (const blocks of pagesOf(text)) {
    end();
    for (const { text, isSet } of blocks) {
      for (const words of piecesOf(text)) {
        if (length > longestPart) end();
        if (words.trim() === "") continue;
        const escaped = escapeText(isSet ? words : words.trim());
        html.push(isSet ? `<p class="lines">${escaped}</p>` : `<p>${escaped}</p>`);
        length += words.length;
      }
    }
  }
  end();
  return chapters.length > 0
    ? chapters.slice(0, limits.pages)
    : [{ html: "<p></p>", headings: [] }];
}

/** Returns a paragraph in pieces that are not too long. */
function piecesOf(text: string): readonly string[] {
  return text.length > longestPart ? (text.match(piece) ?? []) : [text];
}

/**
 * Splits Markdown into chapters: at the highest headings of which there are
 * several. Returns null if its marks are nested too deeply to be read.
 */
function markdownChapters(text: string): Chapter[] | null {
  try {
    return chaptersIn(text);
  } catch (error) {
    if (error instanceof RangeError) return null;
    throw error;
  }
}

function chaptersIn(text: string): Chapter[] {
  const notes = new Footnotes();
  const tokens = notes.take(readMarkdown(text));
  const depths = [1, 2].filter((depth) => tokens.filter(isHeading(depth)).length > 1);
  const [depth = 0] = depths;
  const parts: Token[][] = [[]];
  for (const token of tokens) {
    if (isHeading(depth)(token) && parts.at(-1)?.some(isSeen)) parts.push([]);
    parts.at(-1)?.push(token);
  }
  const ids = new HeadingIds();
  return parts.slice(0, limits.pages).map((part, index, shown) => {
    const own = notes.of(part, index === shown.length - 1);
    const idOf = new Map<Token, string>();
    const headings = headingsIn(part).map((heading) => {
      const own = takeOwnId(heading);
      const title = cleanText(textOf(heading)) || noTitle;
      const id = ids.take(own || slugOf(title));
      idOf.set(heading, id);
      return { title, depth: heading.depth, id };
    });
    const html = (one: Token[]): string => htmlOf(one, idOf, notes);
    return { html: html(part) + listOf(own, html), headings, ids: own.flatMap(idsOf) };
  });
}

/** Returns whether something of a token is seen: no page begins for blank lines, addresses of links and comments. */
function isSeen({ type, raw }: Token): boolean {
  return !/^(space|def)$/.test(type) && !(type === "html" && /^\s*<!--[^<>]*-->\s*$/.test(raw));
}

const isHeading =
  (depth: number) =>
  (token: Token): boolean =>
    token.type === "heading" && token.depth === depth;

/** Returns headings in the order in which they stand, within quotations and lists too. */
function headingsIn(tokens: readonly Token[]): Tokens.Heading[] {
  return tokens.flatMap((token) => {
    if (token.type === "heading") return [token as Tokens.Heading];
    if (token.type === "list") return headingsIn((token as Tokens.List).items);
    const inner = token.type === "blockquote" || token.type === "list_item";
    return inner ? headingsIn((token as Tokens.Blockquote).tokens) : [];
  });
}

function textOf(heading: Tokens.Heading): string {
  const html = htmlOf([{ ...heading, type: "paragraph" } as Token]);
  return parseMarkup(html, "text/html").body.textContent ?? "";
}

/** What many programs let stand behind a heading, as `{#id .class}` or `{-}`. */
const attributes = /[ \t]\{[ \t]*(?:[#.][^\s{}]+|-)(?:[ \t][^{}\n]*)?\}[ \t]*$/;

/** Takes what stands behind a heading from it, and returns the id that it is given there; "" if none is. */
function takeOwnId({ tokens }: Tokens.Heading): string {
  const last = tokens.at(-1) as Tokens.Text | undefined;
  const [all] = last?.type === "text" ? (attributes.exec(last.text) ?? []) : [];
  if (!last || all === undefined) return "";
  last.text = last.text.slice(0, -all.length).trimEnd();
  return /#([\p{Letter}\p{Number}_.:-]{1,200})/u.exec(all)?.[1] ?? "";
}

/** Returns a heading's words as links name it: in lower case, with hyphens between them. */
function slugOf(title: string): string {
  return title
    .toLowerCase()
    .replace(/[^\p{Letter}\p{Number}\s_-]/gu, "")
    .trim()
    .replace(/\s/g, "-");
}

/** The ids of headings: of those that would have the same, all but the first are numbered. */
class HeadingIds {
  /** How many there are by each. */
  readonly #counts = new Map<string, number>();

  /** Returns the id of a heading that would have `wanted`. */
  take(wanted: string): string {
    let id = wanted;
    let count = this.#counts.get(wanted) ?? 0;
    while (this.#counts.has(id)) id = `${wanted}-${++count}`;
    this.#counts.set(wanted, count);
    this.#counts.set(id, this.#counts.get(id) ?? 0);
    return id;
  }
}

function outlineOf(chapters: readonly Chapter[]): FlowOutline[] {
  const root: Line = { depth: 0, children: [] };
  const path: Line[] = [root];
  chapters.forEach(({ headings }, section) => {
    for (const { title, id, depth } of headings) {
      if (depth > deepestLine) continue;
      while ((path.at(-1)?.depth ?? 0) >= depth) path.pop();
      const line = { title, target: { section, id }, depth, children: [] };
      path.at(-1)?.children.push(line);
      path.push(line);
    }
  });
  return root.children;
}

/** A line of the contents while they are made. */
interface Line {
  readonly depth: number;
  readonly children: (Line & FlowOutline)[];
}

function escapeText(text: string): string {
  return text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
}

/** Colours and the like of terminals, and a letter that is printed over another. */
// biome-ignore lint/suspicious/noControlCharactersInRegex: they are what is removed
const terminal = /\u001b\[[\d;?]*[ -/]*[@-~]|[^\n]\u0008/g;

/** Control characters that mean nothing in text; a form feed begins another page. */
// biome-ignore lint/suspicious/noControlCharactersInRegex: they are what is removed
const controls = /[\u0000-\u0008\u000b\u000e-\u001f\u007f]/g;

/** Returns text without what was meant for terminals, printers and systems. */
function withoutControls(text: string): string {
  return text.replace(terminal, "").replace(controls, "");
}
