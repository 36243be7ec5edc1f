/** A section as markup, from which each page is drawn as an SVG of its own. */

import type { PageSize } from "../page_source.ts";
import { type PageFlow, pageOfRect } from "./text_map.ts";

const xhtml = "http://www.w3.org/1999/xhtml";

/** Data shorter than this stays in every page's markup, characters. */
const shortData = 1000;

/** A picture of no colour. */
const clear = "data:image/gif;base64,R0lGODlhAQABAAAAACH5BAEKAAEALAAAAAABAAEAAAICTAEAOw==";

/** How a section is drawn. */
export interface MarkupStyle {
  readonly css: string;
  readonly size: PageSize;
  /** The root's type size, a CSS length. */
  readonly rem: string;
  /** The paper's colour. */
  readonly paper: string;
  readonly flow: PageFlow;
}

/** A picture's data, and the pages on which it is seen. */
interface Picture {
  readonly data: string;
  readonly isOn: (page: number) => boolean;
}

/** The markup of one section as it is laid out. */
export class Markup {
  readonly #style: MarkupStyle;
  /** The markup; in place of each picture's data, the picture. */
  readonly #parts: readonly (string | Picture)[];
  readonly #css: string;
  readonly #paper: string;

  /** @param html the section's element, laid out */
  constructor(html: Element, style: MarkupStyle) {
    this.#style = style;
    const view = html.ownerDocument.defaultView as Window;
    const pictures = picturesOf(html, style.flow, view);
    let parts: (string | Picture)[] = [new XMLSerializer().serializeToString(html)];
    for (const picture of pictures) {
      parts = parts.flatMap((part) =>
        typeof part !== "string"
          ? [part]
          : part.split(picture.data).flatMap((text, k) => (k === 0 ? [text] : [picture, text])),
      );
    }
    this.#parts = parts;
    this.#css = style.css.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
    this.#paper = paperOf(html, view) ?? style.paper;
  }

  /** A page's size in CSS pixels. */
  get size(): PageSize {
    return this.#style.size;
  }

  /** Returns a page as an SVG, its section moved by some CSS pixels. */
  svg(page: number, x: number, y: number): string {
    const { size, rem } = this.#style;
    const { width, height } = size;
    const html = this.#parts
      .map((part) => (typeof part === "string" ? part : part.isOn(page) ? part.data : clear))
      .join("");
    const box = `position: absolute; left: 0; top: 0; width: ${width}px; height: ${height}px`;
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" style="font-size: ${rem}"><style>${this.#css}</style><rect width="${width}" height="${height}" fill="${this.#paper}"/><foreignObject width="${width}" height="${height}"><div xmlns="${xhtml}" style="position: relative; overflow: hidden; width: ${width}px; height: ${height}px"><div style="${box}; font-size: 16px; transform: translate(${x}px, ${y}px)">${html}</div></div></foreignObject></svg>`;
  }
}

/** Returns a section's pictures with much data, and keeps their sizes without them. */
function picturesOf(html: Element, flow: PageFlow, view: Window): Picture[] {
  const pages = new Map<string, (readonly [first: number, last: number])[]>();
  const step = flow.isVertical ? flow.stepY : Math.abs(flow.stepX);
  for (const image of html.querySelectorAll<HTMLElement>("img, image")) {
    const data = image.getAttribute("src") ?? image.getAttribute("href") ?? "";
    if (data.length < shortData || !/^data:[^,"<&]*;base64,[\w+/=]*$/.test(data)) continue;
    if (image.localName === "img") {
      const { width, height } = view.getComputedStyle(image);
      image.style.setProperty("width", width, "important");
      image.style.setProperty("height", height, "important");
    }
    const ranges = pages.get(data) ?? [];
    pages.set(data, ranges);
    for (const rect of (image.closest("svg") ?? image).getClientRects()) {
      const on = pageOfRect(flow, rect);
      // A wide one may reach over several pages.
      const length = flow.isVertical ? rect.height : rect.width;
      ranges.push([on - 1, on + Math.ceil(length / Math.max(step, 1))]);
    }
  }
  return [...pages].map(([data, ranges]) => ({
    data,
    isOn: (page) => ranges.some(([first, last]) => page >= first && page <= last),
  }));
}

/** Returns the colour behind a section, which is that of the whole page; null if it has none. */
function paperOf(html: Element, view: Window): string | null {
  for (const element of [html, html.querySelector("body")]) {
    const colour = element && view.getComputedStyle(element).backgroundColor;
    if (colour && !/^(transparent|rgba\(.*, 0\))$/.test(colour)) return colour;
  }
  return null;
}
