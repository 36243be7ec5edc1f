/**
 * XML that is not well-formed, made so. Books are written by hand, and by programs that do not check what
 * they write: a strict reader loses a chapter, the contents or the whole book by one character.
 */

import { Parser } from "htmlparser2";
import { withDeclaredEntities } from "./declared_entities.ts";
import { parseMarkup } from "./parse_markup.ts";
import { forbidden } from "./xml.ts";

const xhtml = "http://www.w3.org/1999/xhtml";

/** Namespaces of elements of HTML, whether they declare them, another or none. */
const elementNamespaces: Readonly<Record<string, string>> = {
  html: xhtml,
  svg: "http://www.w3.org/2000/svg",
  math: "http://www.w3.org/1998/Math/MathML",
};

/** Namespaces of the prefixes that books use without declaring them. */
const prefixNamespaces: Readonly<Record<string, string>> = {
  dc: "http://purl.org/dc/elements/1.1/",
  epub: "http://www.idpf.org/2007/ops",
  l: "http://www.w3.org/1999/xlink",
  m: "http://www.w3.org/1998/Math/MathML",
  mml: "http://www.w3.org/1998/Math/MathML",
  ncx: "http://www.daisy.org/z3986/2005/ncx/",
  opf: "http://www.idpf.org/2007/opf",
  svg: "http://www.w3.org/2000/svg",
  xlink: "http://www.w3.org/1999/xlink",
};

/** A name of an element or an attribute, with its prefix. */
const xmlName = /^(?:([A-Z_a-z][\w.-]*):)?[A-Z_a-z][\w.-]*$/;

/** A reference to a character; or a character that has to be one. */
const reference = /&(?:#(\d{1,7}|x[\da-f]{1,6})|([a-z][\da-z]{0,31}));|[&<>"]/gi;

/** Two references to the halves of a character, as programs write them that count in these. */
const halves = /&#(xd[89ab][\da-f]{2}|5[56]\d{3});&#(xd[c-f][\da-f]{2}|5[67]\d{3});/gi;

/** What is within tags alone, and what a tag begins with. */
const [ofTags, tagName] = [/[>"'=]/, /^\/?([a-z][\w-]*)(?![^\s/])/i];

/** What begins and ends what is neither text nor a tag. */
const others: readonly (readonly [begin: string, end: string])[] = [
  ["<!--", "-->"],
  ["<![CDATA[", "]]>"],
  ["<?", ">"],
];

/** Characters that XML knows by name. */
const escapes: Readonly<Record<string, string>> = {
  "&": "&amp;",
  "<": "&lt;",
  ">": "&gt;",
  '"': "&quot;",
};

/** An element that is the root of a document of HTML. */
const documentElement = /^(?:[\w.-]+:)?(?:html|svg)$/;

/** Elements of HTML that go on to the end of their document, whatever stands behind their ends. */
const lasting = /^(?:html|body)$/;

/** Elements within each other, at most, as parsers of HTML have it: each end is looked for in all of them. */
const deepest = 512;

/** What a document becomes. */
export interface RepairedXml {
  readonly xml: string;
  /** Whether it ends before its root does. */
  readonly isCutOff: boolean;
}

/**
 * Returns a document as well-formed XML: named characters, entities that it declares, ampersands and prefixes
 * mean what they were to, elements end within each other, and what XML forbids is left out.
 *
 * @param isHtml whether its elements are those of HTML: some have no end, and some end others
 * @returns null if its elements lie too deep within each other
 */
export function repairedXml(text: string, isHtml: boolean): RepairedXml | null {
  const writer = new XmlWriter(isHtml);
  // As HTML was once written; else the case is that of the names.
  const isCapital = isHtml && /<(?:HTML|BODY)\b/.test(text);
  const parser = new Parser(writer, {
    xmlMode: !isHtml,
    lowerCaseTags: isCapital,
    lowerCaseAttributeNames: isCapital,
    recognizeSelfClosing: true,
    recognizeCDATA: true,
    decodeEntities: false,
  });
  try {
    const whole = withWholeCharacters(withDeclaredEntities(text));
    parser.write(isHtml ? withEscapedSigns(whole) : whole);
  } catch (error) {
    if (writer.isTooDeep) return null;
    throw error;
  }
  const isCutOff = writer.isOpen && !writer.isWrapped;
  parser.end();
  return { xml: writer.xml(), isCutOff };
}

/** Returns a document in which halves of a character are one. */
function withWholeCharacters(text: string): string {
  return text.replace(halves, (all, first: string, second: string) => {
    const [high, low] = [first, second].map((one) => Number(one.replace(/^x/i, "0x")));
    const character = String.fromCharCode(high as number, low as number);
    return /\p{Surrogate}/u.test(character) ? all : character;
  });
}

/** Returns a document of HTML in which signs that begin no tag, though letters follow, are escaped. */
function withEscapedSigns(text: string): string {
  const parts: string[] = [];
  let written = 0;
  for (let at = text.indexOf("<"); at >= 0; ) {
    const other = others.find(([begin]) => text.startsWith(begin, at));
    const next = text.indexOf("<", other ? text.indexOf(other[1], at) : at + 1);
    // What is never ended goes on to the end.
    if (next <= at) break;
    const run = text.slice(at + 1, next);
    if (!other && !ofTags.test(run) && !isElementName(tagName.exec(run)?.[1])) {
      parts.push(text.slice(written, at), "&lt;");
      written = at + 1;
    }
    at = next;
  }
  return parts.join("") + text.slice(written);
}

/** Returns whether a name is that of an element of HTML. */
function isElementName(name: string | undefined): boolean {
  return name !== undefined && !(document.createElement(name) instanceof HTMLUnknownElement);
}

/** Writes what a parser finds. */
class XmlWriter {
  readonly #isHtml: boolean;
  readonly #written: string[] = [];
  /** The names of open elements; null for one whose name is none in XML. */
  readonly #open: (string | null)[] = [];
  /** The ends of elements that go on to the end of the document, in the order of their beginnings. */
  readonly #lastEnds: string[] = [];
  readonly #used = new Set<string>();
  readonly #declared = new Set<string>(["xml", "xmlns"]);
  readonly #named = new Map<string, string>();
  #hasRoot = false;
  /** Whether what there is was no document, and stands in one. */
  isWrapped = false;
  #isData = false;
  /** Whether its parser was given up. */
  isTooDeep = false;

  constructor(isHtml: boolean) {
    this.#isHtml = isHtml;
  }

  /** Whether an element is open. */
  get isOpen(): boolean {
    return this.#open.length > 0;
  }

  get #isInside(): boolean {
    return this.isWrapped || this.#lastEnds.length > 0 || (this.#hasRoot && this.isOpen);
  }

  xml(): string {
    const missing = [...this.#used].filter((prefix) => !this.#declared.has(prefix));
    const namespaces = missing.map(
      (prefix) => ` xmlns:${prefix}="${prefixNamespaces[prefix] ?? `urn:prefix:${prefix}`}"`,
    );
    const [root = "", ...rest] = this.#written;
    const end = this.isWrapped ? "</body></html>" : "";
    const ends = this.#lastEnds.reverse().join("");
    return root.replace(/>$/, `${namespaces.join("")}>`) + rest.join("") + ends + end;
  }

  onopentag(name: string, attributes: Readonly<Record<string, string>>): void {
    const isWrapping = this.#isHtml && !this.#hasRoot && !documentElement.test(name);
    if (isWrapping) {
      this.#written.push(`<html xmlns="${xhtml}">`, "<body>");
      this.isWrapped = this.#hasRoot = true;
    }
    const isRoot = !this.#hasRoot;
    // A second root is no XML, and neither is text beside one; in HTML they are part of the first.
    const isWritten = this.#use(name) && (isRoot || this.#isInside);
    this.#open.push(isWritten ? name : null);
    if (this.#open.length > deepest) {
      this.isTooDeep = true;
      throw new RangeError(`Elements lie more than ${deepest} deep.`);
    }
    if (!isWritten) return;
    this.#hasRoot = true;
    const own = Object.entries(attributes).filter(([attribute, value]) => {
      const declares = /^xmlns:(.+)/.exec(attribute)?.[1];
      if (declares && value === "") return false;
      if (declares && isRoot) this.#declared.add(declares);
      return this.#use(attribute);
    });
    // A root of another language declares that, and what is in it is read as HTML.
    const usual = isWrapping ? xhtml : undefined;
    const namespace = this.#isHtml ? (elementNamespaces[name] ?? usual) : undefined;
    const tag = Object.entries({
      ...Object.fromEntries(own),
      ...(namespace && { xmlns: namespace }),
    }).map(([attribute, value]) => ` ${attribute}="${this.#meant(value)}"`);
    this.#written.push(`<${name}${tag.join("")}>`);
    if (this.#isLasting(name)) this.#lastEnds.push(`</${name}>`);
  }

  onclosetag(): void {
    const name = this.#open.pop();
    if (name && !this.#isLasting(name)) this.#written.push(`</${name}>`);
  }

  #isLasting(name: string): boolean {
    return this.#isHtml && lasting.test(name);
  }

  ontext(data: string): void {
    if (!this.#isInside) return;
    this.#written.push(
      this.#isData
        ? data.replace(forbidden, "").replace(/[&<>]/g, (character) => escapes[character] as string)
        : this.#meant(data),
    );
  }

  oncdatastart(): void {
    this.#isData = true;
  }

  oncdataend(): void {
    this.#isData = false;
  }

  /** Returns whether a name is one in XML, and notes its prefix. */
  #use(name: string): boolean {
    const match = xmlName.exec(name);
    if (match?.[1]) this.#used.add(match[1]);
    return match !== null;
  }

  /** Returns text with its references as XML. */
  #meant(text: string): string {
    return text.replace(forbidden, "").replace(reference, (all, number, name) => {
      if (number) {
        const isHexadecimal = /^x/i.test(number);
        return this.#character(Number.parseInt(number.replace(/^x/i, ""), isHexadecimal ? 16 : 10));
      }
      if (name) return this.#characters(name) ?? `&amp;${name};`;
      return escapes[all] as string;
    });
  }

  #character(code: number): string {
    if (code > 0x10ffff) return "";
    const character = String.fromCodePoint(code).replace(forbidden, "");
    return escapes[character] ?? character;
  }

  /** Returns the characters that HTML knows by a name, as XML; null if there are none. */
  #characters(name: string): string | null {
    let found = this.#named.get(name);
    if (found === undefined) {
      found = parseMarkup(`<body>&${name};`, "text/html").body.textContent ?? "";
      this.#named.set(name, found);
    }
    if (found === `&${name};`) return null;
    return [...found].map((character) => escapes[character] ?? character).join("");
  }
}
