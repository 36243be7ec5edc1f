/**
 * What a drawing or a chapter of a stranger may take, counted before anything is
 * made of it: a few hundred bytes can name each other so that they stand for
 * billions of elements, and layers and pictures of any number of pixels.
 */

import { claimedSize } from "./image_header.ts";
import { limits } from "./limits.ts";
import { carriedName, withCarriedShorthands } from "./markup/carried_shorthands.ts";
import { dataPicture, isNoPicture } from "./markup/data_address.ts";
import { errorIn, parseMarkup, styleStandIn } from "./markup/parse_markup.ts";
import { BookError } from "./page_source.ts";
import { dataAddress, StyleValues } from "./style_values.ts";
import { pixelsAttribute, styleAttribute } from "./typeset/flow_book.ts";
import { mostNanoseconds, paintingOfDrawing, stepsOf } from "./typeset/paint_cost.ts";

/**
 * Elements that references and repeated pictures may add: so many for each element that is there, as
 * of maps with a symbol at each place, and so many besides.
 */
const addedEach = 20;
const addedBesides = 2000;

/** Layers within each other: each may have all pixels of a page, 64 MB; a gigabyte in all. */
const deepestLayers = 16;

/** Columns within each other, besides those of pages: with each more a browser takes four times as long. */
const deepestColumns = 4;

/** Steps in which marks upon a letter are put in their places, some ten nanoseconds each: as many as they are, squared. */
const mostMarkSteps = 100_000_000;

/**
 * Steps of the filters that a thing goes through, its own and those around it: one of a whole page takes some
 * 25 milliseconds. Drawing programs write filters of up to some 25 steps.
 */
const mostFilterSteps = 100;

/** Elements of a drawing, at least, that may be so many upon each other that they take long. */
const leastPainted = 20;

/** Pixels that the blur of a chapter's shadows covers beside their boxes: as many as a picture may have. */
const mostBlurred = limits.imagePixels;

/** Pictures within each other. */
const deepestPictures = 4;

/**
 * Steps in which elements are compared with selectors, some five nanoseconds
 * each; and siblings that one is compared with, as a longer chapter is divided.
 */
const mostSteps = 1_000_000_000;
const mostSiblings = 4000;

/** Characters of a value: 200 shadows, which books have at most. And those of all text that style adds to a chapter. */
const longestValue = 5000;
const mostGenerated = 1_000_000;
/** Characters that may be added to each element there is. */
const fewCharacters = mostGenerated / limits.elements;

/** Places for cells in the rows and columns of a table: a browser has each of them. */
const mostCells = 10_000_000;

/** The greatest number of columns, rows and lines of a grid. */
const mostTracks = 9999;

/** What is counted of an element with all that it shows. */
interface Cost {
  readonly elements: number;
  /** Layers within each other. */
  readonly layers: number;
  /** Columns within each other. */
  readonly columns: number;
  /** Steps of filters, along the way through them that has the most. */
  readonly filterSteps: number;
  /** Whether any of it is clipped: a clip that is takes a layer, others do not. */
  readonly isClipped: boolean;
}

/** What is counted of a picture. */
interface PictureCost extends Cost {
  readonly pixels: number;
}

/** A rule of a style sheet. */
interface StyleRule {
  /** Its selector, with those of the rules that it is nested in. */
  readonly selectorText: string;
  /** Its selector as it is written. */
  readonly ownSelector: string;
  /** What it is nested in. */
  readonly outer: StyleRule | null;
  readonly style: CSSStyleDeclaration;
}

const nothing: Cost = { elements: 0, layers: 0, columns: 0, filterSteps: 0, isClipped: false };
const plainCost: Cost = { ...nothing, elements: 1 };
const noPicture: PictureCost = { ...nothing, pixels: 0 };

/** Declarations for which an element and what is in it are drawn on a layer of their own. */
const layered =
  /(?:^|[\s;])(?:-webkit-)?(?:opacity|mask|mask-image|filter|backdrop-filter|mix-blend-mode|isolation)\s*:\s*(?!none|auto|normal|1\b)/;

/** Declarations for which an element is set in columns. */
const columned = /(?:^|[\s;])(?:columns|column-(?:count|width))\s*:\s*(?!auto\s*(?:;|$))/;

/** Marks upon a letter: more than any language writes. */
const manyMarks = /\p{M}{100,}/gu;

/** Properties whose strings are written at elements that have others' text: marks of lists, quotes, hyphens. */
const writing = ["list-style-type", "quotes", "hyphenate-character", "text-emphasis-style"];

/** Pseudo-elements, whose rules are about the elements that have them. */
const pseudoElement = /::?(before|after|marker|first-line|first-letter)\b/g;

/** A function of a filter in CSS. */
const filterFunction =
  /\b(?:blur|drop-shadow|brightness|contrast|grayscale|hue-rotate|invert|sepia|saturate)\(/g;

/** Attributes of SVG that name what is drawn with an element. */
const naming = [
  ...["mask", "clip-path", "filter", "fill", "stroke", "opacity"],
  ...["marker", "marker-start", "marker-mid", "marker-end"],
];

const svg = "http://www.w3.org/2000/svg";
const xlink = "http://www.w3.org/1999/xlink";

const ownAddress = /href="#([^"]*)"|url\(\s*["']?#([^"')]*)/g;

/**
 * Counts what a chapter or a drawing takes. Rejects with a `BookError` where it is
 * more than the budget.
 *
 * @param sheets its style sheets, clean
 * @param name in sentences
 */
export async function checkBudget(
  root: Element,
  sheets: readonly string[],
  name: string,
): Promise<void> {
  await new Count(root, sheets, name, null).check();
}

/** Counts what an SVG takes, as `checkBudget` does; one that is none takes nothing. */
export async function checkSvg(text: string, name: string): Promise<void> {
  await costOfSvg(text, name, 0);
}

/** Returns what an SVG takes, which is within the budget. */
async function costOfSvg(text: string, name: string, depth: number): Promise<PictureCost> {
  const document = parseMarkup(text, "image/svg+xml");
  if (errorIn(document)) return noPicture;
  const sheets = [...document.querySelectorAll(styleStandIn)].map(
    (style) => style.textContent ?? "",
  );
  return await new Count(document.documentElement, sheets, name, depth).check();
}

class Count {
  readonly #root: Element;
  readonly #sheets: readonly string[];
  readonly #name: string;
  /** Pictures around it, if it is one itself; null for a chapter. */
  readonly #depth: number | null;
  readonly #elements: readonly Element[];
  readonly #byId = new Map<string, Element>();
  /** Style that rules give to elements, where that matters here. */
  readonly #styles = new Map<Element, string>();
  readonly #costs = new Map<Element, Cost | null>();
  /** Pictures by their addresses. */
  readonly #pictures = new Map<string, PictureCost>();

  constructor(root: Element, sheets: readonly string[], name: string, depth: number | null) {
    this.#root = root;
    this.#sheets = sheets;
    this.#name = name;
    this.#depth = depth;
    this.#elements = [root, ...root.querySelectorAll("*")];
    for (const one of this.#elements) {
      if (one.id && !this.#byId.has(one.id)) this.#byId.set(one.id, one);
    }
  }

  /** Returns what there is. Rejects with a `BookError` where that is too much. */
  async check(): Promise<PictureCost> {
    const { length } = this.#elements;
    if (length > limits.elements) this.#reject(`it has ${length} elements`);
    this.#checkStyle();
    this.#checkMarks();
    this.#checkTables();
    const pixels = await this.#checkPictures();
    const cost = this.#total();
    const { elements, layers, columns, filterSteps } = cost;
    // What is in its pictures, each of them once, is there too, and within a budget of its own.
    const there = [...this.#pictures.values()].reduce((sum, one) => sum + one.elements, length);
    const most = Math.min(there + addedEach * there + addedBesides, limits.elements);
    if (!(elements <= most)) this.#reject("its elements stand for too many others");
    if (!(layers <= deepestLayers)) this.#reject("too many of its layers are within each other");
    if (columns > deepestColumns) this.#reject("too many of its columns are within each other");
    if (!(filterSteps <= mostFilterSteps)) this.#reject("its filters have too many steps");
    // What is in a chapter is measured where that is laid out.
    if (this.#depth !== null && length > leastPainted) {
      const painting = await paintingOfDrawing(this.#root, this.#sheets);
      if (painting > mostNanoseconds) this.#reject("too much is painted upon each other");
    }
    return { ...cost, pixels };
  }

  #reject(what: string): never {
    throw new BookError(
      `${this.#name} takes more time or memory than a page may: ${what}; make it simpler.`,
      { code: "tooLarge", source: this.#name },
    );
  }

  #total(): Cost {
    try {
      return this.#cost(this.#root);
    } catch (error) {
      // A chain of references that is longer than the stack.
      if (error instanceof RangeError) return { ...nothing, elements: Number.POSITIVE_INFINITY };
      throw error;
    }
  }

  #cost(element: Element): Cost {
    const known = this.#costs.get(element);
    // What names itself is not drawn.
    if (known !== undefined) return known ?? nothing;
    if (isPlain(element) && !this.#styles.has(element)) return plainCost;
    this.#costs.set(element, null);
    let elements = spanOf(element);
    let layers = 0;
    let columns = 0;
    let filterSteps = 0;
    let isClipped = false;
    const add = (cost: Cost, times = 1): void => {
      elements += times * cost.elements;
      layers = Math.max(layers, cost.layers);
      columns = Math.max(columns, cost.columns);
      filterSteps = Math.max(filterSteps, cost.filterSteps);
      isClipped ||= cost.isClipped;
    };
    for (const child of element.children) add(this.#cost(child));
    add(this.#pictures.get(pictureOf(element)) ?? nothing);
    const style = `${this.#styles.get(element) ?? ""};${ownStyle(element)}`;
    const text = element.namespaceURI === svg ? `${style};${shownBy(element)}` : style;
    let isLayer = layered.test(text);
    let ownSteps = text.match(filterFunction)?.length ?? 0;
    for (const [, href, id] of text.matchAll(ownAddress)) {
      const target = this.#byId.get(href ?? id ?? "");
      if (!target) continue;
      const { localName } = target;
      const cost = this.#cost(target);
      isLayer ||= localName === "pattern" || (localName === "clipPath" && cost.isClipped);
      if (localName === "filter") ownSteps += stepsOf(target);
      add(cost, localName === "marker" ? cornersOf(element) : 1);
    }
    isClipped ||= /clip-path\s*:/.test(text);
    filterSteps += ownSteps;
    const cost = {
      elements,
      layers: layers + (isLayer ? 1 : 0),
      columns: columns + (columned.test(text) ? 1 : 0),
      filterSteps,
      isClipped,
    };
    this.#costs.set(element, cost);
    return cost;
  }

  /** Counts what style takes: comparisons with selectors, long values, text that is added, and tracks of grids. */
  #checkStyle(): void {
    const rules = this.#sheets.flatMap(rulesOf);
    this.#checkSelectors(rules);
    const values = new StyleValues(
      rules,
      this.#sheets.some((css) => css.includes("attr(")) ? this.#elements : [],
    );
    let [generated, compared, blurred] = [0, 0, 0];
    // Marks count for all elements, as those that have them take them by name or from what is around them.
    for (const css of this.#sheets) generated += this.#writtenEach(longestMark(css));
    for (const { selectorText, style } of rules) {
      const added = values.lengthOf(style.getPropertyValue("content"));
      generated += this.#writtenEach(
        stringsIn(writing.map((name) => style.getPropertyValue(name)).join(" ")),
      );
      if (generated > mostGenerated) this.#reject("its style adds too much text");
      const text = style.cssText.replace(dataAddress, "");
      this.#checkDeclarations(text, values);
      const isCounted = layered.test(text) || columned.test(text) || text.includes("url(");
      const blur = values.blurOf(style);
      if (added <= fewCharacters && !isCounted && blur === 0) continue;
      compared += this.#elements.length;
      // Found here, they take ten times as long as in the layout.
      if (compared > mostSteps / 10) this.#reject("its style has too many rules for its elements");
      const matched = this.#matching(selectorText);
      generated += added * matched.length;
      if (generated > mostGenerated) this.#reject("its style adds too much text");
      blurred += blur * matched.length;
      if (blurred > mostBlurred) this.#reject("its shadows are too many and too large");
      if (!isCounted) continue;
      for (const one of matched) {
        this.#styles.set(one, `${this.#styles.get(one) ?? ""};${text}`);
      }
    }
    for (const element of this.#elements) {
      if (!element.hasAttributes()) continue;
      this.#checkDeclarations(ownStyle(element).replace(dataAddress, ""), values);
    }
  }

  /** Returns what marks of so many characters come to, one at each element; few are as good as none. */
  #writtenEach(length: number): number {
    return length <= fewCharacters ? 0 : length * this.#elements.length;
  }

  #checkTables(): void {
    for (const table of this.#root.querySelectorAll<HTMLTableElement>("table")) {
      // One that is not of HTML has none.
      const { rows = [] } = table as Partial<HTMLTableElement>;
      let columns = 0;
      for (const { cells } of rows) {
        let width = 0;
        for (const { colSpan } of cells) width += colSpan;
        columns = Math.max(columns, width);
      }
      if (columns * rows.length > mostCells) this.#reject("a table of it has too many cells");
    }
  }

  #checkMarks(): void {
    let steps = 0;
    for (const [{ length }] of (this.#root.textContent ?? "").matchAll(manyMarks)) {
      steps += length ** 2;
    }
    if (steps > mostMarkSteps) this.#reject("too many marks are upon its letters");
  }

  #checkDeclarations(text: string, values: StyleValues): void {
    for (const declaration of text.split(";")) {
      const at = declaration.indexOf(":");
      if (at < 0) continue;
      const name = carriedName(declaration.slice(0, at).trim());
      this.#checkValue(name, declaration.slice(at + 1), values);
    }
  }

  #checkValue(name: string, value: string, values: StyleValues): void {
    // Of a text that is added it matters to how many elements; of a variable, where it is used.
    if (name === "content" || name.startsWith("--")) return;
    const length = values.lengthOf(value);
    if (length > longestValue) this.#reject(`its style has a ${name} of ${length} characters`);
    if (!/^(grid|column-count$)/.test(name)) return;
    const numbers = `${value} ${values.namedIn(value)}`.match(/(?<![\w.#])\d+/g) ?? [];
    if (numbers.some((count) => Number(count) > mostTracks)) {
      this.#reject("its style has a grid of too many columns or rows");
    }
  }

  #checkSelectors(rules: readonly StyleRule[]): void {
    const count = this.#elements.length;
    let siblings = 0;
    let ancestors = 0;
    const depths = new Map<Element, number>();
    for (const element of this.#elements) {
      const depth = (depths.get(element.parentElement as Element) ?? 0) + 1;
      depths.set(element, depth);
      ancestors += depth;
      const { childElementCount } = element;
      siblings += childElementCount * Math.min(childElementCount, mostSiblings);
    }
    const each = new Map<StyleRule | null, number>([[null, 1]]);
    let steps = 0;
    for (const rule of rules) {
      const { ownSelector, outer, selectorText } = rule;
      if (outer && selectorText.length > longestValue)
        this.#reject("its rules are nested too deeply");
      let sum = 0;
      for (const selector of ownSelector.split(",")) {
        const following = selector.split("~").length - 1;
        const looking = selector.split(":has(").length - 1;
        const within =
          /[^\s>+~,] +[^\s>+~,]/.test(selector) || (outer && !selector.includes("&"))
            ? ancestors / count
            : 1;
        const own = count + following * siblings * within + looking * (ancestors + siblings);
        // Each time that it names the rule around it, an element and those around that are compared with that one.
        const named = outer ? Math.max(selector.split("&").length - 1, 1) * within : 1;
        sum += own * named * (each.get(outer) ?? 1);
      }
      each.set(rule, sum / count);
      steps += sum;
      if (steps > mostSteps) this.#reject("its style has too many rules for its elements");
    }
  }

  /** Returns the elements that a rule is about, those of its pseudo-elements too. */
  #matching(selector: string): readonly Element[] {
    try {
      return [...this.#root.querySelectorAll(selector.replace(pseudoElement, "") || "*")];
    } catch {
      return this.#elements;
    }
  }

  /**
   * Returns the pixels of pictures. Those that are elements of a chapter are not
   * counted together, as each is drawn on its own page: it is said what each has.
   */
  async #checkPictures(): Promise<number> {
    const counted = new Set(
      this.#sheets.flatMap((css) =>
        [...css.matchAll(dataAddress)].map(([, address]) => address ?? ""),
      ),
    );
    for (const element of this.#elements) {
      if (!element.hasAttributes()) continue;
      for (const [, address] of ownStyle(element).matchAll(dataAddress)) counted.add(address ?? "");
      const address = pictureOf(element);
      if (address === "") continue;
      if (this.#depth !== null) counted.add(address);
      const { pixels } = await this.#picture(address, true);
      if (this.#depth === null) element.setAttribute(pixelsAttribute, String(pixels));
    }
    let pixels = 0;
    for (const address of counted) {
      pixels += (await this.#picture(address, /^data:image\//i.test(address))).pixels;
    }
    if (pixels > limits.imagePixels) this.#reject("its pictures have too many pixels");
    return pixels;
  }

  /** @param isPicture whether it can be nothing else, such as a font */
  async #picture(address: string, isPicture: boolean): Promise<PictureCost> {
    const known = this.#pictures.get(address) ?? (await this.#costOf(address, isPicture));
    this.#pictures.set(address, known);
    return known;
  }

  async #costOf(address: string, isPicture: boolean): Promise<PictureCost> {
    // One of no data is none.
    if (address.endsWith(",")) return noPicture;
    // A font is not unpacked once more for each chapter.
    if (!isPicture && (await isNoPicture(address))) return noPicture;
    const image = await dataPicture(address);
    if (image === null) {
      if (isPicture) this.#reject("it has a picture of an unknown kind");
      return noPicture;
    }
    if (image.type === "image/svg+xml") {
      const depth = (this.#depth ?? -1) + 1;
      if (depth > deepestPictures) this.#reject("too many pictures are within each other");
      return await costOfSvg(await image.text(), this.#name, depth);
    }
    const size = await claimedSize(image);
    return { ...noPicture, pixels: size ? size.width * size.height : 0 };
  }
}

/** Returns whether an element has neither attributes nor others in it. */
function isPlain(element: Element): boolean {
  return !element.hasAttributes() && element.firstElementChild === null;
}

/** Returns an element's own style. */
function ownStyle(element: Element): string {
  return element.getAttribute(styleAttribute) ?? element.getAttribute("style") ?? "";
}

/** Returns an SVG element's attributes that name others or make it a layer, as declarations. */
function shownBy(element: Element): string {
  const href = element.getAttribute("href") ?? element.getAttributeNS(xlink, "href") ?? "";
  const shown = naming.map((name) => {
    const value = element.getAttribute(name);
    return value === null ? "" : `${name}: ${value};`;
  });
  return `${shown.join("")}${href.startsWith("#") && element.localName !== "a" ? `href="${href}"` : ""}`;
}

/** Returns the data of the picture that an element is; "" if it is none. */
function pictureOf(element: Element): string {
  if (!/^(img|image|feImage|input)$/i.test(element.localName)) return "";
  const address =
    element.getAttribute("src") ??
    element.getAttribute("href") ??
    element.getAttributeNS(xlink, "href") ??
    "";
  return /^\s*data:/i.test(address) ? address : "";
}

/** Returns how many elements one counts: a cell, or a column, as many as it spans. */
function spanOf(element: Element): number {
  const span = element.getAttribute("colspan") ?? element.getAttribute("span") ?? "1";
  return Math.max(Number.parseInt(span, 10) || 1, 1);
}

/** Returns how many markers a line may have, by its numbers: two for a place. */
function cornersOf(element: Element): number {
  const places = element.getAttribute("d") ?? element.getAttribute("points") ?? "";
  return Math.max(places.match(/\d+/g)?.length ?? 0, 2);
}

/** Returns all rules of a style sheet, those within others too. */
function rulesOf(css: string): StyleRule[] {
  const rules: StyleRule[] = [];
  const read = (list: CSSRuleList, outer: StyleRule | null): void => {
    for (const rule of list) {
      let within = outer;
      if (rule instanceof CSSStyleRule) {
        const { selectorText: ownSelector, style } = rule;
        const selectorText = outer ? nestedIn(outer.selectorText, ownSelector) : ownSelector;
        within = { selectorText, ownSelector, outer, style };
        rules.push(within);
        // It is too long, and what is nested in it is longer still.
        if (outer && selectorText.length > longestValue) continue;
      }
      const nested = (rule as CSSGroupingRule).cssRules;
      if (nested) read(nested, within);
    }
  };
  read(sheetOf(css).cssRules, null);
  return rules;
}

/** Returns the selectors of a rule that is nested in another, as ones that stand for themselves. */
function nestedIn(outer: string, selector: string): string {
  const around = `:is(${outer.replace(pseudoElement, "")})`;
  return selectorsIn(selector)
    .map((one) => (one.includes("&") ? one.replaceAll("&", around) : `${around} ${one}`))
    .join(", ");
}

/** Returns the selectors of a list. */
function selectorsIn(list: string): readonly string[] {
  const selectors: string[] = [];
  let depth = 0;
  for (const [part] of list.matchAll(/[^,()]+|[,()]/g)) {
    if (part === "(") depth++;
    if (part === ")") depth--;
    if (part === "," && depth === 0) selectors.push("");
    else selectors.push(`${selectors.pop() ?? ""}${part}`);
  }
  return selectors.map((one) => one.trim());
}

/** Returns how many characters the longest mark has that a sheet's own styles of counters write. */
function longestMark(css: string): number {
  const styles = [...sheetOf(css).cssRules].filter((rule) => rule instanceof CSSCounterStyleRule);
  const marks = styles.map(({ additiveSymbols, negative, pad, prefix, suffix, symbols }) =>
    stringsIn([additiveSymbols, negative, pad, prefix, suffix, symbols].join(" ")),
  );
  return marks.reduce((longest, length) => Math.max(longest, length), 0);
}

/** Returns how many characters the strings in a value have. */
function stringsIn(value: string): number {
  // They are what stands between one mark of a string and the next.
  return value.split('"').reduce((sum, { length }, k) => sum + (k % 2 === 1 ? length : 0), 0);
}

/** Returns a style sheet as the browser reads it. */
function sheetOf(css: string): CSSStyleSheet {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(withCarriedShorthands(css));
  return sheet;
}
