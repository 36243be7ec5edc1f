/** A section as markup, from which each page is drawn as an SVG of its own. */

import { limits } from "../limits.ts";
import { xmlOf, xmlText } from "../markup/xml.ts";
import type { PageColours, PageSize } from "../page_source.ts";
import { pixelsAttribute } from "./flow_book.ts";
import { drawingOf, ownStyle } from "./frame.ts";
import { serif } from "./serif.ts";
import { styleElements } from "./style_elements.ts";
import { type PageFlow, pageOfRect } from "./text_map.ts";
import { colourStyle } from "./typography.ts";

const xhtml = "http://www.w3.org/1999/xhtml";

/** Data shorter than this, and pictures of fewer pixels, stay in every page's markup: characters. */
const shortData = 1000;
const fewPixels = 10_000;

/** Data of a picture. */
const pictureData = /(data:[^,:"<&]{0,200};base64,[\w+/=]*)/;

/** A picture of no colour. */
const clear = "data:image/gif;base64,R0lGODlhAQABAAAAACH5BAEKAAEALAAAAAABAAEAAAICTAEAOw==";

/** What stands in the margins of a page; "" for nothing. */
export interface PageMargins {
  /** Above its text, and below it. */
  readonly head: string;
  readonly folio: string;
}

/** How what stands in the margins is set. */
export interface MarginStyle {
  /** Size of its type, CSS pixels of the page as it is laid out. */
  readonly size: number;
  /** Height of the margins, and width of the text between them, likewise. */
  readonly ends: number;
  readonly line: number;
}

/** Opacity of what stands in the margins, less black than the text: of black on white, a contrast of 8 : 1. */
const marginOpacity = 0.7;

/** How wide a letter of it is on the average, over the size of its type. */
const marginLetter = 0.6;

/** How a section is drawn. */
export interface MarkupStyle {
  readonly styles: readonly string[];
  readonly size: PageSize;
  /** The root's type size, a CSS length. */
  readonly rem: string;
  /** How its margins are set; null if nothing stands there. */
  readonly margins: MarginStyle | null;
  readonly flow: PageFlow;
}

/** A picture's data, and the pages on which it is seen. */
interface Picture {
  readonly data: string;
  readonly pixels: number;
  readonly isOn: (page: number) => boolean;
}

/** The markup of one section as it is laid out. */
export class Markup {
  readonly #style: MarkupStyle;
  /** The markup; in place of each picture's data, the picture. */
  readonly #parts: readonly (string | Picture)[];
  readonly #styles: string;
  readonly #paper: string;
  readonly #ink: string;

  /** @param html the section's element, laid out */
  constructor(html: Element, style: MarkupStyle) {
    this.#style = style;
    const view = html.ownerDocument.defaultView as Window;
    const pictures = picturesOf(html, style.flow, view);
    const markup = xmlOf(html);
    // Gone through once, however many pictures there are.
    this.#parts = markup.split(pictureData).map((part) => pictures.get(part) ?? part);
    this.#styles = styleElements(style.styles);
    this.#paper = paperOf(html, view) ?? "#fff";
    this.#ink = view.getComputedStyle(html.querySelector("body") ?? html).color;
  }

  /**
   * Returns a page as an SVG, in colours of the reader's if there are any.
   *
   * @param moved by how much its section is moved, CSS pixels
   * @param margins what stands in its margins
   */
  svg(
    page: number,
    { x, y }: { readonly x: number; readonly y: number },
    margins: PageMargins,
    colours: PageColours | null,
  ): string {
    const { size, rem } = this.#style;
    const own = colours ? styleElements([colourStyle(colours)]) : "";
    const { width, height } = size;
    const shown = this.#shownOn(page);
    const html = this.#parts
      .map((part) => (typeof part === "string" ? part : shown.has(part) ? part.data : clear))
      .join("");
    const sized = `display: block; width: ${width}px; height: ${height}px`;
    const [whole, paper, view, section] = [
      `${sized}; font-size: ${rem}`,
      `${sized}; fill: ${colours?.paper ?? this.#paper}; forced-color-adjust: none`,
      `${sized}; position: relative; overflow: hidden`,
      `${sized}; position: absolute; left: 0; top: 0; font-size: 16px; transform: translate(${x}px, ${y}px)`,
    ].map(ownStyle);
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" style="${whole}">${this.#styles}${own}<rect width="${width}" height="${height}" style="${paper}"/><foreignObject width="${width}" height="${height}" style="${ownStyle(sized)}"><div xmlns="${xhtml}" style="${view}"><div style="${section}">${html}</div></div></foreignObject>${this.#inMargins(margins, colours?.ink ?? this.#ink)}</svg>`;
  }

  /** Returns what stands in the margins as SVG: in the middle, as far from the text as from the edge or a little nearer. */
  #inMargins({ head, folio }: PageMargins, ink: string): string {
    const { margins, size } = this.#style;
    // Nothing stands in margins that are hardly higher than it.
    if (margins === null || margins.ends < 2 * margins.size) return "";
    const { ends, line } = margins;
    const put = (text: string, y: number, look: string): string => {
      const most = Math.floor(line / (marginLetter * margins.size));
      const short = text.length > most ? `${text.slice(0, most - 1).trimEnd()}…` : text;
      const style = ownStyle(
        `font: ${margins.size}px ${serif}; fill: ${ink}; fill-opacity: ${marginOpacity}; text-anchor: middle; forced-color-adjust: none; ${look}`,
      );
      if (text === "") return "";
      return `<text x="${size.width / 2}" y="${y}" style='${style}'>${xmlText(short)}</text>`;
    };
    const caps = "font-variant: small-caps; letter-spacing: 0.06em";
    return (
      put(head, 0.62 * ends, caps) + put(folio, size.height - 0.45 * ends, "letter-spacing: 0.03em")
    );
  }

  /** Returns the pictures that are seen on a page, as many in order as have pixels that can be drawn. */
  #shownOn(page: number): ReadonlySet<string | Picture> {
    const shown = new Set<string | Picture>();
    let left: number = limits.imagePixels;
    for (const part of this.#parts) {
      if (typeof part === "string" || shown.has(part) || !part.isOn(page)) continue;
      left -= part.pixels;
      if (left < 0) break;
      shown.add(part);
    }
    return shown;
  }
}

/** Returns a section's pictures with much data or many pixels, and keeps their sizes without them. */
function picturesOf(html: Element, flow: PageFlow, view: Window): Map<string, Picture> {
  const pages = new Map<string, (readonly [first: number, last: number])[]>();
  const sizes = new Map<string, number>();
  const isDown = flow.stepY !== 0;
  const step = isDown ? flow.stepY : Math.abs(flow.stepX);
  const large = [...html.querySelectorAll<HTMLElement>("img, image")].flatMap((image) => {
    const data = image.getAttribute("src") ?? image.getAttribute("href") ?? "";
    const pixels = Number(image.getAttribute(pixelsAttribute) ?? 0);
    const isSmall = data.length < shortData && pixels < fewPixels;
    if (isSmall || pictureData.exec(data)?.[0] !== data) return [];
    const { width, height } = view.getComputedStyle(image);
    return [{ image, data, pixels, width, height }];
  });
  // All are measured before any is changed: each change would have all laid out anew.
  for (const { image, width, height } of large) {
    if (image.localName !== "img") continue;
    image.style.setProperty("width", width, "important");
    image.style.setProperty("height", height, "important");
  }
  for (const { image, data, pixels } of large) {
    sizes.set(data, pixels);
    const ranges = pages.get(data) ?? [];
    pages.set(data, ranges);
    for (const rect of drawingOf(image, html).getClientRects()) {
      const on = pageOfRect(flow, rect);
      // A long one may reach over several pages.
      const length = isDown ? rect.height : rect.width;
      ranges.push([on - 1, on + Math.ceil(length / Math.max(step, 1))]);
    }
  }
  return new Map(
    [...pages].map(([data, ranges]) => [
      data,
      {
        data,
        pixels: sizes.get(data) ?? 0,
        isOn: (page) => ranges.some(([first, last]) => page >= first && page <= last),
      },
    ]),
  );
}

/** Returns the colour behind a section, which is that of the whole page; null if it has none. */
function paperOf(html: Element, view: Window): string | null {
  for (const element of [html, html.querySelector("body")]) {
    const colour = element && view.getComputedStyle(element).backgroundColor;
    if (colour && !/^(transparent|rgba\(.*, 0\))$/.test(colour)) return colour;
  }
  return null;
}
