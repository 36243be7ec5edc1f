/** Frames in which text is laid out, out of sight: no script runs in them and nothing is fetched. */

import { trustedMarkup } from "../trusted_script.ts";
import { styleAttribute } from "./flow_book.ts";

/** Even if an address were left in the markup, it would not be fetched. */
const policy = "default-src 'none'; img-src data:; font-src data:; style-src 'unsafe-inline'";

/** A frame's document, whose root is an empty `<div>`. */
export interface LayoutFrame {
  readonly document: Document;
  readonly root: HTMLElement;
  /** Removes it. */
  close(): void;
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
  // The book's own <html> is laid out as it is drawn: within another element.
  const root = frame.createElement("div");
  frame.documentElement.replaceWith(root);
  return { document: frame, root, close: () => element.remove() };
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

/** Gives elements their own styles. */
export function applyInlineStyles(html: HTMLElement): void {
  for (const element of [html, ...html.querySelectorAll<HTMLElement>(`[${styleAttribute}]`)]) {
    element.style.cssText = element.getAttribute(styleAttribute) ?? "";
    element.removeAttribute(styleAttribute);
  }
}

/** Waits until the pictures and fonts of a section are there, or have failed. */
export async function loadedIn({ document }: LayoutFrame, html: HTMLElement): Promise<void> {
  // Laid out once, it is known which fonts are used.
  html.getBoundingClientRect();
  // Not decoded: only those of a page that is drawn are.
  const images = [...html.querySelectorAll("img")].map(
    (image) => image.complete || new Promise((done) => (image.onload = image.onerror = done)),
  );
  await Promise.all([document.fonts.ready, ...images]);
}
