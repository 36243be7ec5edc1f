/**
 * A copy of an element as it looks now, as one SVG that needs nothing else: an
 * image of it runs nothing and loads nothing. Every element of the copy starts
 * from initial values and has what its computed style says besides, so that
 * neither style sheets nor the elements around it matter.
 */

import { limits } from "../limits.ts";
import { isXmlAttribute, xmlOf, xmlText } from "../markup/xml.ts";
import { BookError, type PageSize } from "../page_source.ts";
import { fontRules, unquoted } from "./embedded_fonts.ts";
import { clearPixel, drawnPixels, type PixelCache } from "./embedded_pixels.ts";

/** An element's picture, to be drawn at any size. */
export interface FrozenCopy {
  readonly svg: string;
  /** CSS pixels. */
  readonly size: PageSize;
}

const xhtml = "http://www.w3.org/1999/xhtml";

/** Stands for a class in its rules; no style sheet has this character. */
const self = "\u0001";

/** Attributes that decide what an element of HTML shows, besides its style. */
const shownAttributes = [
  ..."type checked placeholder rows cols multiple size min max low high optimum open".split(" "),
  ..."colspan rowspan span start reversed dir lang label".split(" "),
];

/**
 * Properties that are copied even if they have their initial value: those that
 * `all: initial` leaves alone, and those whose initial value a browser's
 * settings decide.
 */
const always = new Set(["direction", "unicode-bidi", "font-family", "font-size", "color"]);

/** What moves is copied where it is now; directions relative to the text are copied as sides. */
const uncopied =
  /^(animation|transition|cursor$|pointer-events|user-select|-webkit-user-|-webkit-locale|zoom$)|(^|-)(inline|block)(-|$)|^d$/;

/** Elements that are drawn by the browser itself and have no style of their own to set. */
const bare = /^(br|wbr|option|optgroup)$/;

/** Elements that browsers draw in the system's look. */
const control = /^(input|button|select|textarea|progress|meter)$/;

/** What another document draws: plain paper. */
const framed = /^(iframe|object|embed|frame)$/;

/** A `url()` of a computed style, with the address in it. */
const styleUrl = /url\("((?:[^"\\]|\\.)*)"\)/g;

/**
 * Returns a copy of an element and what it contains, as it is laid out now.
 * Rejects with a `BookError` if it contains too much.
 *
 * @param name of the page, in sentences
 * @param pixels what was copied of pictures before
 */
export async function freeze(
  page: HTMLElement,
  name: string,
  pixels: PixelCache,
): Promise<FrozenCopy> {
  const size = { width: page.offsetWidth, height: page.offsetHeight };
  const copy = new Copy(page, name, pixels);
  const root = copy.element(page);
  const [css, fonts] = await Promise.all([
    copy.css(),
    fontRules(page.ownerDocument, copy.families, page.getRootNode()),
  ]);
  const { width, height } = size;
  const style = xmlText(`${fonts}${css}`);
  const markup = root ? xmlOf(root) : "";
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}"><style>${style}</style><rect width="${width}" height="${height}" fill="#fff"/><foreignObject width="${width}" height="${height}">${markup}</foreignObject></svg>`;
  return { svg, size };
}

/** One copy in the making. */
class Copy {
  /** The typefaces that are named, in lower case. */
  readonly families = new Set<string>();
  readonly #page: HTMLElement;
  readonly #name: string;
  readonly #view: Window & typeof globalThis;
  readonly #document: Document;
  readonly #initial: ReadonlyMap<string, string>;
  /** Names of classes by their rules, in which `self` stands for the class. */
  readonly #classes = new Map<string, string>();
  readonly #pixels: PixelCache;
  #count = 0;

  constructor(page: HTMLElement, name: string, pixels: PixelCache) {
    this.#page = page;
    this.#name = name;
    this.#pixels = pixels;
    this.#view = page.ownerDocument.defaultView ?? window;
    // Nothing in a document without a window loads or runs.
    this.#document = page.ownerDocument.implementation.createHTMLDocument("");
    this.#initial = initialValues(page.ownerDocument);
  }

  /** Returns a copy of an element; null if it is not shown. */
  element(source: Element): Element | null {
    const style = this.#view.getComputedStyle(source);
    if (style.display === "none") return null;
    if (++this.#count > limits.elements) {
      throw new BookError(`${this.#name} has too many elements to be drawn; divide it.`, {
        code: "tooLarge",
        source: this.#name,
      });
    }
    const copy = this.#empty(source, style);
    if (!bare.test(source.localName)) {
      const name = this.#classOf(this.#rulesOf(source, style));
      copy.setAttribute("class", name);
    }
    if (copy.localName !== source.localName) return copy;
    if (source instanceof this.#view.HTMLTextAreaElement) copy.textContent = source.value;
    else copy.append(...this.#children(source));
    return copy;
  }

  /** Returns the rules of all classes, with their pictures in them. */
  async css(): Promise<string> {
    const text = [...this.#classes].map(([rules, name]) => rules.replaceAll(self, `.${name}`));
    const css = text.join("");
    const urls = new Set([...css.matchAll(styleUrl)].map(([, url]) => url));
    const data = new Map<string, string>();
    await Promise.all(
      [...urls].map(async (url) => {
        if (/^(#|data:)/i.test(url)) return;
        data.set(url, await this.#pixels.ofAddress(url.replace(/\\(.)/g, "$1")));
      }),
    );
    return css.replace(styleUrl, (all, url: string) => {
      const own = url.slice(url.indexOf("#"));
      // A gradient or a clip of the page's own SVG.
      if (own.startsWith("#") && url.startsWith(this.#page.baseURI.split("#")[0])) {
        return `url("${own}")`;
      }
      const pixels = data.get(url);
      return pixels === undefined ? all : `url("${pixels}")`;
    });
  }

  /** Returns an element for a copy, with the attributes that it shows. */
  #empty(source: Element, style: CSSStyleDeclaration): Element {
    if (source.namespaceURI !== xhtml) return this.#vector(source);
    const pixels = this.#pixelsOf(source, style);
    if (pixels !== null) {
      const image = this.#document.createElement("img");
      image.setAttribute("src", pixels);
      return image;
    }
    if (framed.test(source.localName)) return this.#document.createElement("div");
    const copy = this.#document.createElement(source.localName);
    for (const name of shownAttributes) {
      const value = source.getAttribute(name);
      if (value !== null) copy.setAttribute(name, value);
    }
    const { HTMLInputElement, HTMLOptionElement, HTMLProgressElement, HTMLMeterElement } =
      this.#view;
    if (source instanceof HTMLInputElement) {
      copy.toggleAttribute("checked", source.checked);
      if (source.type !== "file") copy.setAttribute("value", source.value);
    } else if (source instanceof HTMLOptionElement) {
      copy.toggleAttribute("selected", source.selected);
    } else if (source instanceof HTMLProgressElement || source instanceof HTMLMeterElement) {
      const value = source.getAttribute("value");
      if (value !== null) copy.setAttribute("value", String(source.value));
    }
    return copy;
  }

  /** Returns an element of SVG or MathML with all of its attributes but scripts and addresses. */
  #vector(source: Element): Element {
    const copy = this.#document.createElementNS(source.namespaceURI, source.localName);
    for (const attribute of source.attributes) {
      const { name, value, namespaceURI } = attribute;
      if (/^on|^(class|style|xmlns)$/i.test(name) || !isXmlAttribute(attribute)) continue;
      const isAddress = /(^|:)href$/.test(name) && !/^(#|data:image\/)/i.test(value);
      if (!isAddress) copy.setAttributeNS(namespaceURI, name, value);
    }
    if (source.localName === "image") {
      const href = (source as SVGImageElement).href.baseVal;
      if (!href.startsWith("data:")) copy.setAttribute("href", this.#pixels.known(href));
    }
    return copy;
  }

  /** Returns a picture, a canvas or a film as data; null for other elements. */
  #pixelsOf(source: Element, style: CSSStyleDeclaration): string | null {
    const { HTMLImageElement, HTMLCanvasElement, HTMLVideoElement } = this.#view;
    const width = Number.parseFloat(style.width);
    if (source instanceof HTMLImageElement) {
      return source.complete ? this.#pixels.ofImage(source, width) : clearPixel;
    }
    if (source instanceof HTMLCanvasElement) return drawnPixels(source, source) ?? clearPixel;
    if (!(source instanceof HTMLVideoElement)) return null;
    const size = { width: source.videoWidth, height: source.videoHeight };
    const isBegun = source.currentTime > 0 || source.poster === "";
    const frame = isBegun && source.readyState >= 2 ? drawnPixels(source, size) : null;
    return frame ?? this.#pixels.known(source.poster);
  }

  /** Returns copies of what an element contains, in the shadow tree as it is seen. */
  #children(source: Element): Node[] {
    const isSlot = source instanceof this.#view.HTMLSlotElement;
    const assigned = isSlot ? source.assignedNodes({ flatten: true }) : [];
    const nodes = assigned.length > 0 ? assigned : (source.shadowRoot ?? source).childNodes;
    const { scrollLeft, scrollTop } = source;
    const copies: Node[] = [];
    for (const node of nodes) {
      if (node.nodeType === Node.TEXT_NODE) {
        copies.push(this.#document.createTextNode(node.nodeValue ?? ""));
      } else if (node.nodeType === Node.ELEMENT_NODE) {
        const copy = this.element(node as Element);
        if (copy === null) continue;
        if (scrollLeft !== 0 || scrollTop !== 0) this.#scroll(copy, -scrollLeft, -scrollTop);
        copies.push(copy);
      }
    }
    return copies;
  }

  /** Moves a copy as its container is scrolled. */
  #scroll(copy: Element, x: number, y: number): void {
    const name = this.#classOf(`${self}{translate:${x}px ${y}px}`);
    copy.setAttribute("class", `${copy.getAttribute("class") ?? ""} ${name}`.trim());
  }

  #classOf(rules: string): string {
    const name = this.#classes.get(rules) ?? `t${this.#classes.size}`;
    this.#classes.set(rules, name);
    return name;
  }

  /** Returns the rules of an element, in which `self` stands for its class. */
  #rulesOf(source: Element, style: CSSStyleDeclaration): string {
    const isRoot = source === this.#page;
    const place = "position:relative;inset:auto;margin:0;float:none;translate:none;rotate:none;";
    const declared = control.test(source.localName)
      ? this.#declaredOfControl(source, style)
      : this.#declared(style);
    const own = `${self}{${declared}${isRoot ? place : ""}}`;
    return `${own}${this.#partsOf(source, style)}`;
  }

  /**
   * Returns what the style of a control says: all of it, but for borders and
   * backgrounds that are the browser's own, with which it draws such a control
   * in the system's look.
   */
  #declaredOfControl(source: Element, style: CSSStyleDeclaration): string {
    const own = valuesUnder(source, "revert");
    let text = "all:revert;";
    for (const name of this.#initial.keys()) {
      const value = style.getPropertyValue(name);
      const isOwn = /^(border|background)/.test(name) && value === own.get(name);
      if (value !== "" && !isOwn) text += `${name}:${value};`;
    }
    for (const family of style.fontFamily.split(",")) this.families.add(unquoted(family));
    return text;
  }

  /** Returns what a style says that is not its initial value. */
  #declared(style: CSSStyleDeclaration): string {
    let text = "all:initial;";
    for (const [name, initial] of this.#initial) {
      const value = style.getPropertyValue(name);
      if (value === "" || (value === initial && !always.has(name))) continue;
      text += `${name}:${value};`;
    }
    for (const family of style.fontFamily.split(",")) this.families.add(unquoted(family));
    return text;
  }

  /** Returns the rules of what is drawn before, after and in an element without being in the document. */
  #partsOf(source: Element, style: CSSStyleDeclaration): string {
    let rules = "";
    for (const part of ["::before", "::after"]) {
      const of = this.#view.getComputedStyle(source, part);
      if (/^(none|normal|)$/.test(of.content)) continue;
      rules += `${self}${part}{${this.#declared(of)}content:${of.content}}`;
    }
    const some = (part: string, names: readonly string[]): void => {
      const of = this.#view.getComputedStyle(source, part);
      const other = names.filter(
        (name) => of.getPropertyValue(name) !== style.getPropertyValue(name),
      );
      const text = other.map((name) => `${name}:${of.getPropertyValue(name)};`).join("");
      if (text !== "") rules += `${self}${part}{${text}}`;
      for (const family of of.fontFamily.split(",")) this.families.add(unquoted(family));
    };
    if (style.display.includes("list-item")) some("::marker", [...lettering, "content"]);
    if (source.hasAttribute("placeholder")) some("::placeholder", [...lettering, "opacity"]);
    if (/block|list-item|cell|caption|flow-root/.test(style.display)) {
      some("::first-line", lettering);
      some("::first-letter", [...lettering, ...initialLetter]);
    }
    return rules;
  }
}

/** Properties of letters, and of one that is set apart at the beginning. */
const lettering =
  "color font-family font-size font-weight font-style font-variant-caps text-transform letter-spacing".split(
    " ",
  );
const initialLetter =
  "float line-height margin-top margin-right margin-bottom margin-left padding-top padding-right padding-bottom padding-left background-color".split(
    " ",
  );

const initials = new WeakMap<Document, ReadonlyMap<string, string>>();

/** Returns the initial value of every property that is copied. */
function initialValues(document: Document): ReadonlyMap<string, string> {
  const known = initials.get(document);
  if (known) return known;
  const values = valuesUnder(document.createElement("div"), "initial");
  // Of an inline box, which has neither.
  for (const name of ["width", "height"]) values.set(name, "auto");
  initials.set(document, values);
  return values;
}

/** Returns the values that an element of the same kind has without the page's style. */
function valuesUnder(like: Element, all: "initial" | "revert"): Map<string, string> {
  const document = like.ownerDocument;
  const probe = document.createElement(like.localName);
  const type = like.getAttribute("type");
  if (type !== null) probe.setAttribute("type", type);
  probe.style.setProperty("all", all);
  document.documentElement.append(probe);
  const style = (document.defaultView ?? window).getComputedStyle(probe);
  const values = new Map<string, string>();
  for (const name of style) {
    if (!uncopied.test(name)) values.set(name, style.getPropertyValue(name));
  }
  probe.remove();
  return values;
}
