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
import { Footnotes, idsOf, listOf } from "./footnotes.ts";
import { htmlOf, readMarkdown } from "./markdown.ts";

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

/** Settings of the program that makes a site of the file, before its text: in YAML or TOML. */
const frontMatter =
  /^(?:---\n(?:[\w"'.-]+ *:|#)[\s\S]*?\n(?:---|\.\.\.)|\+\+\+\n(?:[\w"'-]+ *[.=]|[#[])[\s\S]*?\n\+\+\+)[ \t]*(?:\n|$)/;

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
  const chapters = (isMarkdown ? markdownChapters(text) : null) ?? plainChapters(text);
  return await FlowSource.open(bookOf(chapters, file, name), typography);
}

function bookOf(chapters: readonly Chapter[], file: Blob, name: string): FlowBook {
  const places = new Map<string, number>();
  chapters.forEach(({ headings, ids = [] }, section) => {
    for (const id of [...headings.map(({ id }) => id), ...ids]) {
      if (!places.has(id)) places.set(id, section);
    }
  });
  const [first] = chapters[0]?.headings ?? [];
  return {
    name,
    title: (first?.depth === 1 && first.title) || name,
    language: "",
    direction: "ltr",
    cover: "none",
    sections: chapters.map((chapter) => sectionOf(chapter, name)),
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

function sectionOf({ html }: Chapter, name: string): FlowSection {
  const load = async (): Promise<FlowContent> => {
    const document = parseMarkup(`<html><body>${html}</body></html>`, "text/html");
    const files = { data: checkedData, style: async () => [] };
    const content = await cleanMarkup(document, files, name);
    return { root: content.root, styles: [style, ...content.styles] };
  };
  return { length: html.length, isFixed: false, lines: async () => linesIn(html), load };
}

/** Splits plain text where paragraphs end; lines that are indented stay as they are. */
function plainChapters(text: string): Chapter[] {
  // Without blank lines each line is a paragraph.
  const paragraphs = /\n[ \t]*\n/.test(text) ? text.split(/\n(?:[ \t]*\n)+/) : text.split("\n");
  const blocks = paragraphs
    .flatMap((one) => (one.length > longestPart ? (one.match(piece) ?? []) : one))
    // A page ends where its mark is, within a paragraph too.
    .flatMap((one) => one.split(/(?=\f)/));
  const chapters: Chapter[] = [];
  let html: string[] = [];
  let length = 0;
  const end = (): void => {
    if (html.length > 0) chapters.push({ html: html.join("\n"), headings: [] });
    [html, length] = [[], 0];
  };
  for (const block of blocks) {
    if (block.includes("\f") || length > longestPart) end();
    const words = block.replaceAll("\f", "");
    if (words.trim() === "") continue;
    const isSet = /^(?: {2,}|\t)\S/m.test(words);
    const escaped = escapeText(isSet ? words : linesOf(words).join(" "));
    html.push(isSet ? `<p class="lines">${escaped}</p>` : `<p>${escaped}</p>`);
    length += words.length;
  }
  end();
  return chapters.length > 0
    ? chapters.slice(0, limits.pages)
    : [{ html: "<p></p>", headings: [] }];
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
  const tokens = notes.take(readMarkdown(text.replace(frontMatter, "")));
  const depths = [1, 2].filter((depth) => tokens.filter(isHeading(depth)).length > 1);
  const [depth = 0] = depths;
  const parts: Token[][] = [[]];
  for (const token of tokens) {
    const isLong = (parts.at(-1)?.length ?? 0) > 0;
    if (isHeading(depth)(token) && isLong) parts.push([]);
    parts.at(-1)?.push(token);
  }
  const used = new Map<string, number>();
  return parts.slice(0, limits.pages).map((part, index, shown) => {
    const own = notes.of(part, index === shown.length - 1);
    const ids = new Map<Token, string>();
    const headings = headingsIn(part).map((heading) => {
      const title = cleanText(textOf(heading)) || "–";
      const id = slugOf(title, used);
      ids.set(heading, id);
      return { title, depth: heading.depth, id };
    });
    const html = (one: Token[]): string => htmlOf(one, ids, notes);
    return { html: html(part) + listOf(own, html), headings, ids: own.flatMap(idsOf) };
  });
}

const isHeading =
  (depth: number) =>
  (token: Token): boolean =>
    token.type === "heading" && token.depth === depth;

/** Returns headings in the order in which they stand, within quotations and lists too. */
function headingsIn(tokens: readonly Token[]): Tokens.Heading[] {
  return tokens.flatMap((token) => {
    if (token.type === "heading") return token.depth <= 3 ? [token as Tokens.Heading] : [];
    if (token.type === "list") return headingsIn((token as Tokens.List).items);
    const inner = token.type === "blockquote" || token.type === "list_item";
    return inner ? headingsIn((token as Tokens.Blockquote).tokens) : [];
  });
}

function textOf(heading: Tokens.Heading): string {
  const html = htmlOf([{ ...heading, type: "paragraph" } as Token]);
  return parseMarkup(html, "text/html").body.textContent ?? "";
}

/** Returns a heading's id as links name it: words in lower case with hyphens between them. */
function slugOf(title: string, used: Map<string, number>): string {
  const slug = title
    .toLowerCase()
    .replace(/[^\p{Letter}\p{Number}\s_-]/gu, "")
    .trim()
    .replace(/\s/g, "-");
  const count = used.get(slug) ?? 0;
  used.set(slug, count + 1);
  return count === 0 ? slug : `${slug}-${count}`;
}

function outlineOf(chapters: readonly Chapter[]): FlowOutline[] {
  const root: Line = { depth: 0, children: [] };
  const path: Line[] = [root];
  chapters.forEach(({ headings }, section) => {
    for (const { title, id, depth } of headings) {
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

/** Returns the lines of a paragraph that are not blank, without the spaces about them. */
function linesOf(words: string): string[] {
  return words
    .split("\n")
    .map((line) => line.trim())
    .filter((line) => line !== "");
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
