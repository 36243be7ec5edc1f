/** Frames in which text is laid out, out of sight: no script runs in them and nothing is fetched. */

import { trustedMarkup } from "../trusted_script.ts";

/** Even if an address were left in the markup, it would not be fetched. */
const policy = "default-src 'none'; img-src data:; font-src data:; style-src 'unsafe-inline'";

const svg = "http://www.w3.org/2000/svg";

/** A frame's document, in which `root` is an empty `<div>`. */
export interface LayoutFrame {
  readonly element: HTMLIFrameElement;
  readonly document: Document;
  /** The root element of the document, of which lengths in rem are. */
  readonly drawing: SVGElement;
  readonly root: HTMLElement;
}

/** Returns a new frame of a size in CSS pixels. */
export async function openFrame(width: number, height: number): Promise<LayoutFrame> {
  const element = document.createElement("iframe");
  element.setAttribute("sandbox", "allow-same-origin");
  element.ariaHidden = "true";
  element.inert = true;
  element.tabIndex = -1;
  // The page's own style must not reach it.
  element.style.cssText =
    "all: initial !important; position: fixed !important; left: -100000px !important; top: 0 !important; border: 0 !important; visibility: hidden !important";
  element.style.setProperty("width", `${width}px`, "important");
  element.style.setProperty("height", `${height}px`, "important");
  const loaded = new Promise((resolve) => {
    element.addEventListener("load", resolve, { once: true });
  });
  element.srcdoc = trustedMarkup(
    `<!doctype html><meta http-equiv="Content-Security-Policy" content="${policy}">`,
  );
  document.body.append(element);
  await loaded;
  const frame = element.contentDocument;
  if (frame === null) {
    element.remove();
    throw new Error("The browser allows no frame without scripts.");
  }
  // The book's own <html> is laid out as it is drawn: within an element of an SVG, where browsers set
  // some lines otherwise, such as those with ruby.
  const drawing = frame.createElementNS(svg, "svg");
  const foreign = frame.createElementNS(svg, "foreignObject");
  const root = frame.createElement("div");
  for (const one of [drawing, foreign]) {
    one.style.cssText = ownStyle(`display: block; width: ${width}px; height: ${height}px`);
  }
  root.style.cssText = ownStyle("display: block");
  foreign.append(root);
  drawing.append(foreign);
  frame.documentElement.replaceWith(drawing);
  return { element, document: frame, drawing, root };
}

/**
 * Returns the style of an element around a section: rules of a book for all of its drawings or boxes do
 * not apply to it.
 *
 * @param declarations what it has besides, none of which says `!important`
 */
export function ownStyle(declarations: string): string {
  return `all: initial !important; ${declarations.replace(/;|$/g, " !important;")}`;
}

/** Returns the drawing in a section's element that an element is a part of; the element itself if there is none. */
export function drawingOf(element: Element, html: Element): Element {
  const drawing = element.closest("svg");
  return drawing && html.contains(drawing) ? drawing : element;
}

/** Applies style sheets to a frame, whatever the page's policy says of inline styles. */
export function adoptStyles(frame: LayoutFrame, sheets: readonly string[]): void {
  const view = frame.document.defaultView as Window & typeof globalThis;
  frame.document.adoptedStyleSheets = sheets.map((css) => {
    const sheet = new view.CSSStyleSheet();
    sheet.replaceSync(css);
    return sheet;
  });
}
