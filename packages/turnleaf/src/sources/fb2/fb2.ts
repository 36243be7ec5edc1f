/** FictionBook 2: one XML document, written anew as XHTML and set by `FlowSource`. */

import { bytesOf } from "../book_file.ts";
import { cleanLanguage, cleanText, decodeEscapes } from "../book_text.ts";
import { decodeText } from "../decode_text.ts";
import { unknownFailure } from "../failures.ts";
import { limits } from "../limits.ts";
import { checkElements, cleanMarkup, type MarkupFiles } from "../markup/clean_markup.ts";
import { parseMarkup } from "../markup/parse_markup.ts";
import { readMarkup } from "../markup/read_markup.ts";
import { type BookDetail, BookError, type PageSource, type Typography } from "../page_source.ts";
import { pictureData } from "../showable_image.ts";
import type {
  FlowBook,
  FlowContent,
  FlowOutline,
  FlowSection,
  FlowTarget,
} from "../typeset/flow_book.ts";
import { FlowSource } from "../typeset/flow_source.ts";
import { coverSection } from "../typeset/lone_picture.ts";
import { linesIn } from "../typeset/page_estimate.ts";
import { isRightToLeft, mostlyRightToLeft } from "../typeset/writing_direction.ts";
import { warningOf } from "../warnings.ts";

const xhtml = "http://www.w3.org/1999/xhtml";
const epub = "http://www.idpf.org/2007/ops";
const xlink = "http://www.w3.org/1999/xlink";

/** Elements within each other that are read. */
const deepest = 100;

/** The elements of HTML by those of FictionBook; what is in no list is read as if it were not there. */
const elements: Readonly<Record<string, string>> = {
  section: "section",
  title: "header",
  subtitle: "h3",
  p: "p",
  v: "p",
  "empty-line": "div",
  epigraph: "blockquote",
  cite: "blockquote",
  poem: "blockquote",
  stanza: "div",
  "text-author": "p",
  date: "p",
  annotation: "aside",
  strong: "strong",
  emphasis: "em",
  style: "span",
  strikethrough: "s",
  sub: "sub",
  sup: "sup",
  code: "code",
  table: "table",
  tr: "tr",
  th: "th",
  td: "td",
};

/** Attributes that HTML has too. */
const attributes = ["colspan", "rowspan", "xml:lang"];

/** What bodies of notes are called, besides those to which notes lead. */
const notesName = /note|comment/i;

/** Series that are named. */
const mostSeries = 5;

/** Pictures of the cover of which the first that is there is shown, and characters by which a direction is found. */
const mostCovers = 10;
const sampleLength = 20_000;

const style = `
header { margin: 0 0 1.5em; text-align: center; font-weight: bold; }
header p { font-size: 1.3em; text-indent: 0; text-align: center; margin: 0.2em 0; }
section section header p { font-size: 1.15em; }
.notes header { margin: 0.7em 0 0; text-align: start; }
.notes header p { font-size: 1em; text-align: start; }
h3 { font-size: 1em; text-align: center; margin: 1em 0; }
p { margin: 0; text-indent: 1.4em; text-align: justify; }
header + p, h3 + p, .empty-line + p, img + p, section > p:first-child { text-indent: 0; }
.empty-line { height: 1em; }
.epigraph { margin: 1em 0 1em 30%; font-style: italic; }
.cite, .poem { margin: 1em 1.4em; }
.stanza { margin: 0.7em 0; }
.v, .text-author, .date, .epigraph p { text-indent: 0; text-align: start; }
.text-author { text-align: end; }
img { display: block; margin: 0.7em auto; }
p img { display: inline; margin: 0; }
code { font-family: monospace; }
table { border-collapse: collapse; margin: 0.7em 0; }
td, th { border: 1px solid; padding: 0.2em 0.4em; text-indent: 0; }
[role="doc-noteref"] { font-size: 0.75em; vertical-align: super; }
`;

/** Opens a FictionBook. Rejects with a `BookError`. */
export async function openFb2(
  file: Blob,
  name: string,
  typography?: Typography,
): Promise<PageSource> {
  try {
    const book = await readFb2(await decodeText(await bytesOf(file, name)), file, name);
    return await FlowSource.open(book, typography);
  } catch (error) {
    throw unknownFailure(
      `${name} is damaged or no FictionBook`,
      error,
      "repair it or get it again",
      { code: "damaged", source: name },
    );
  }
}

/** A part of a book that begins on a page of its own. */
interface Part {
  readonly nodes: readonly Element[];
  readonly isNotes: boolean;
}

async function readFb2(text: string, file: Blob, name: string): Promise<FlowBook> {
  // Entities of its own, which could be of any size, are not known then.
  const { document, damagedLine } = await readMarkup(withoutDoctype(text), "application/xml");
  if (damagedLine !== undefined) {
    const where = damagedLine === null ? "" : ` in line ${damagedLine}`;
    throw new BookError(`${name} is damaged${where}; repair it or get it again.`, {
      code: "damaged",
      source: name,
    });
  }
  checkElements(document, name);
  const root = document.documentElement;
  const info = childOf(childOf(root, "description"), "title-info");
  const covers = childrenOf(childOf(info, "coverpage"), "image").slice(0, mostCovers);
  const files = filesOf(root);
  const cover = covers.find((image) => files.has(addressOf(image)));
  const parts = partsOf(root, cover);
  if (parts.length === 0)
    throw new BookError(`${name} has no text; get it again.`, { code: "empty", source: name });
  const { places, outline } = readPlaces(parts);
  const language = cleanLanguage(childOf(info, "lang")?.textContent);
  const isReversed = language === "" ? mostlyRightToLeft(sampleOf(parts)) : isRightToLeft(language);
  const direction = isReversed ? "rtl" : "ltr";
  const isCovered = cover !== undefined;
  const sections = parts.map((part, index): FlowSection => {
    if (isCovered && index === 0) return coverSection(() => load(part, direction, files, name));
    return {
      length: part.nodes.reduce((sum, node) => sum + (node.textContent?.length ?? 0), 0),
      isFixed: false,
      lines: async () => part.nodes.reduce((sum, node) => sum + linesIn(node.outerHTML), 0),
      load: () => load(part, direction, files, name),
    };
  });
  return {
    name,
    title: cleanText(childOf(info, "book-title")?.textContent) || name,
    language,
    direction,
    cover: isCovered ? "picture" : "stamped",
    // One that is not there covers nothing.
    warnings: isCovered ? [] : covers.map((image) => warningOf("image", addressOf(image), name)),
    details: [...authorsOf(info), ...seriesOf(info), ...annotationOf(info)],
    sections,
    outline,
    asksToLeave: true,
    resolve: (_section, href): FlowTarget | null => {
      const id = decodeEscapes(/^#(.+)/.exec(href)?.[1] ?? "");
      const section = places.get(id);
      return section === undefined ? null : { section, id };
    },
    file: async () => new Blob([file], { type: "application/x-fictionbook+xml" }),
    close: () => {},
  };
}

/** Returns XML without its document type. */
function withoutDoctype(text: string): string {
  const at = text.search(/<!DOCTYPE\b/i);
  const root = text.search(/<([\w.-]{1,40}:)?FictionBook\b/);
  return at >= 0 && at < root ? text.slice(0, at) + text.slice(root) : text;
}

/** Returns the parts: the cover, what stands before the sections, each section, and the notes as they follow. */
function partsOf(root: Element, cover: Element | undefined): Part[] {
  const parts: Part[] = cover ? [{ nodes: [cover], isNotes: false }] : [];
  const [main, ...others] = childrenOf(root, "body");
  if (main) parts.push(...sectionsOf(main));
  const noted = new Set(
    [...root.getElementsByTagNameNS("*", "a")]
      .filter((link) => link.getAttribute("type") === "note")
      .map((link) => decodeEscapes(addressOf(link).replace(/^#/, ""))),
  );
  for (const body of others) {
    const name = body.getAttribute("name") ?? "";
    const isNotes =
      notesName.test(name) || [...body.querySelectorAll("[id]")].some(({ id }) => noted.has(id));
    if (isNotes) parts.push({ nodes: [...body.children], isNotes });
    else parts.push(...sectionsOf(body));
  }
  return parts.filter(({ nodes }) => nodes.length > 0).slice(0, limits.pages);
}

/** Returns the parts of a body of text. */
function sectionsOf(body: Element): Part[] {
  const parts: Part[] = [];
  let before: Element[] = [];
  for (const node of body.children) {
    if (node.localName !== "section") {
      before.push(node);
      continue;
    }
    if (before.length > 0) parts.push({ nodes: before, isNotes: false });
    before = [];
    parts.push({ nodes: [node], isNotes: false });
  }
  if (before.length > 0) parts.push({ nodes: before, isNotes: false });
  return parts;
}

/** Returns some of the text of a book. */
function sampleOf(parts: readonly Part[]): string {
  let text = "";
  for (const { nodes } of parts) {
    for (const node of nodes) text += node.textContent ?? "";
    if (text.length > sampleLength) break;
  }
  return text;
}

/** Returns which part each id is in, and the contents; sections without an id are given one. */
function readPlaces(parts: readonly Part[]): {
  readonly places: ReadonlyMap<string, number>;
  readonly outline: readonly FlowOutline[];
} {
  const places = new Map<string, number>();
  let count = 0;
  const linesOf = (nodes: Iterable<Element>, section: number, depth: number): FlowOutline[] =>
    [...nodes].flatMap((node): FlowOutline[] => {
      const title = titleOf(node);
      const isSection = node.localName === "section";
      if (isSection && !node.id) node.id = `turnleaf-section-${++count}`;
      const children =
        isSection && depth < limits.outlineDepth ? linesOf(node.children, section, depth + 1) : [];
      if (title === "" || !isSection) return children;
      return [{ title, target: { section, id: node.id }, children }];
    });
  const outline = parts.flatMap(({ nodes, isNotes }, section) => {
    const lines = linesOf(nodes, section, 1);
    for (const node of nodes) {
      for (const one of [node, ...node.querySelectorAll("[id]")]) {
        if (one.id && !places.has(one.id)) places.set(one.id, section);
      }
    }
    // Each note is no line; their heading is.
    const own = nodes.find(({ localName }) => localName === "title");
    const title = own ? cleanText(own.textContent) : "";
    if (isNotes) return title === "" ? [] : [{ title, target: { section, id: "" }, children: [] }];
    return lines;
  });
  return { places, outline };
}

function titleOf(section: Element): string {
  const title = childOf(section, "title");
  return title ? cleanText([...title.childNodes].map((p) => p.textContent).join(" ")) : "";
}

async function load(
  { nodes, isNotes }: Part,
  direction: FlowBook["direction"],
  files: MarkupFiles,
  name: string,
): Promise<FlowContent> {
  const document = parseMarkup(`<html xmlns="${xhtml}"><body/></html>`, "application/xhtml+xml");
  const body = document.querySelector("body") as Element;
  if (isNotes) body.setAttribute("class", "notes");
  if (direction === "rtl") body.setAttribute("dir", direction);
  for (const node of nodes) write(node, body, 0);
  const content = await cleanMarkup(document, files, `A chapter of ${name}`);
  return { root: content.root, styles: [style] };
}

/** Writes an element of FictionBook into one of HTML. */
function write(node: Node, into: Element, depth: number): void {
  const document = into.ownerDocument;
  if (node.nodeType === Node.TEXT_NODE || node.nodeType === Node.CDATA_SECTION_NODE) {
    into.append(document.createTextNode(node.textContent ?? ""));
    return;
  }
  if (!(node instanceof Element)) return;
  if (depth > deepest) {
    into.append(document.createTextNode(node.textContent ?? ""));
    return;
  }
  const { localName } = node;
  const made = document.createElementNS(xhtml, nameOf(localName) ?? "span");
  if (node.id) made.id = node.id;
  if (localName === "image") {
    made.setAttribute("src", addressOf(node));
    made.setAttribute("alt", node.getAttribute("alt") ?? "");
    into.append(made);
    return;
  }
  if (localName === "a") {
    made.setAttribute("href", addressOf(node));
    if (node.getAttribute("type") === "note") {
      made.setAttribute("role", "doc-noteref");
      made.setAttributeNS(epub, "epub:type", "noteref");
    }
  } else if (localName in elements) made.setAttribute("class", localName);
  for (const name of attributes) {
    const value = node.getAttribute(name);
    if (value !== null) made.setAttribute(name, value);
  }
  for (const child of node.childNodes) write(child, made, depth + 1);
  into.append(made);
}

function nameOf(localName: string): string | undefined {
  if (localName === "image") return "img";
  return localName === "a" ? "a" : elements[localName];
}

function addressOf(node: Element): string {
  return node.getAttributeNS(xlink, "href") ?? node.getAttribute("href") ?? "";
}

/** The pictures in a book. */
interface BookFiles extends MarkupFiles {
  /** Returns whether there is a file at an address. */
  has(address: string): boolean;
}

/** Returns the pictures in a book, by their ids. */
function filesOf(root: Element): BookFiles {
  const binaries = new Map(childrenOf(root, "binary").map((one) => [one.id, one]));
  const binaryAt = (address: string): Element | undefined =>
    address.startsWith("#") ? binaries.get(decodeEscapes(address.slice(1))) : undefined;
  return {
    has: (address) => binaryAt(address) !== undefined,
    data: async (address) => {
      const binary = binaryAt(address);
      return binary ? await pictureIn(binary.textContent ?? "") : null;
    },
    style: async () => [],
  };
}

async function pictureIn(base64: string): Promise<string | null> {
  if (base64.length > 1.4 * limits.imageBytes) return null;
  try {
    const letters = atob(base64.replace(/\s+/g, ""));
    const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    return await pictureData(bytes, "A picture");
  } catch {
    return null;
  }
}

function authorsOf(info: Element | null): BookDetail[] {
  return childrenOf(info, "author")
    .slice(0, limits.authors)
    .map((author) => {
      const names = ["first-name", "middle-name", "last-name"];
      const full = names.map((name) => childOf(author, name)?.textContent ?? "").join(" ");
      const value = cleanText(full) || cleanText(childOf(author, "nickname")?.textContent);
      return { label: "", value };
    })
    .filter(({ value }) => value !== "");
}

/** Returns the series that a book is of, with its number in each. */
function seriesOf(info: Element | null): BookDetail[] {
  return childrenOf(info, "sequence")
    .slice(0, mostSeries)
    .map((one) => {
      const [name, number] = ["name", "number"].map((about) => cleanText(one.getAttribute(about)));
      return { label: "Series", value: number && name ? `${name}, ${number}` : (name ?? "") };
    })
    .filter(({ value }) => value !== "");
}

/** Returns what a book says that it is about. */
function annotationOf(info: Element | null): BookDetail[] {
  const paragraphs = childrenOf(childOf(info, "annotation"), "p");
  const text = paragraphs.map((one) => one.textContent ?? "").join(" ");
  const value = cleanText(text, limits.noteLength);
  return value === "" ? [] : [{ label: "", value }];
}

function childrenOf(element: Element | null, name: string): Element[] {
  return [...(element?.children ?? [])].filter(({ localName }) => localName === name);
}

function childOf(element: Element | null, name: string): Element | null {
  return childrenOf(element, name)[0] ?? null;
}
