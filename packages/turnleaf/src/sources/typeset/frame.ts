/** Frames in which text is laid out, out of sight: no script runs in them and nothing is fetched. */

import { orAborted } from "../shared_tasks.ts";
import { trustedMarkup } from "../trusted_script.ts";
import { styleAttribute } from "./flow_book.ts";

/** Even if an address were left in the markup, it would not be fetched. */
const policy = "default-src 'none'; img-src data:; font-src data:; style-src 'unsafe-inline'";

const svg = "http://www.w3.org/2000/svg";

/** Where text is laid out: an empty `<div>`, in a document of its own if there may be one. */
export interface LayoutFrame {
  readonly document: Document;
  /** The element around it: the root of a document of its own, of which lengths in rem are. */
  readonly drawing: SVGElement;
  readonly root: HTMLElement;
  /**
   * Applies style sheets in place of those before, whatever the page's policy says of inline styles. Those in
   * the same place as before stay: they, which may have megabytes of fonts, are not read again.
   */
  adopt(sheets: readonly string[]): void;
  /** Returns the fonts that its style sheets name. */
  fonts(): FontFace[];
  /** Removes it. */
  close(): void;
}

/** Returns a new frame of a size in CSS pixels. Rejects with the signal's reason, and leaves no frame then. */
export async function openFrame(
  width: number,
  height: number,
  signal?: AbortSignal,
): Promise<LayoutFrame> {
  signal?.throwIfAborted();
  const element = document.createElement("iframe");
  element.setAttribute("sandbox", "allow-same-origin");
  hide(element, width, height);
  const loaded = new Promise((resolve) => {
    element.addEventListener("load", resolve, { once: true });
  });
  element.srcdoc = trustedMarkup(
    `<!doctype html><meta http-equiv="Content-Security-Policy" content="${policy}">`,
  );
  document.body.append(element);
  const remove = (): void => element.remove();
  signal?.addEventListener("abort", remove);
  await (signal ? orAborted(loaded, signal) : loaded);
  signal?.removeEventListener("abort", remove);
  const frame = element.contentDocument;
  if (frame === null) {
    // In a page without an origin of its own no frame is of the page's.
    element.remove();
    return openShadow(width, height);
  }
  const { drawing, root } = drawingIn(frame, width, height);
  frame.documentElement.replaceWith(drawing);
  const read = sheetReader(frame.defaultView as Window & typeof globalThis);
  const adopt = (sheets: readonly string[]): void => {
    frame.adoptedStyleSheets = read([unmovedStyle, ...sheets]);
  };
  return {
    ...{ document: frame, drawing, root, adopt },
    fonts: () => [...frame.fonts],
    close: remove,
  };
}

/**
 * Returns a place for a section as it is drawn: its own <html> is laid out within an element of an SVG,
 * where browsers set some lines otherwise, such as those with ruby.
 */
function drawingIn(document: Document, width: number, height: number) {
  const drawing = document.createElementNS(svg, "svg");
  const foreign = document.createElementNS(svg, "foreignObject");
  const root = document.createElement("div");
  for (const one of [drawing, foreign]) {
    one.style.cssText = ownStyle(`display: block; width: ${width}px; height: ${height}px`);
  }
  root.style.cssText = ownStyle("display: block");
  foreign.append(root);
  drawing.append(foreign);
  return { drawing, root };
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

/**
 * Returns a place in the page itself for what may have no document of its own. Markup is clean before it
 * comes here; what is lost is that style sheets see the page's window, and its type size as `rem`.
 */
function openShadow(width: number, height: number): LayoutFrame {
  const host = document.createElement("div");
  hide(host, width, height);
  // What is measured in it lies as in a frame, and is visible but for its place.
  const styles = { left: "0", overflow: "hidden", "z-index": "-1", opacity: "0" };
  for (const [name, value] of Object.entries(styles)) {
    host.style.setProperty(name, value, "important");
  }
  const shadow = host.attachShadow({ mode: "open" });
  const { drawing, root } = drawingIn(document, width, height);
  shadow.append(drawing);
  document.body.append(host);
  const before = new Set(document.fonts);
  let rules: readonly CSSStyleSheet[] = [];
  const [read, readFonts] = [sheetReader(window), sheetReader(window)];
  const withRules = (next: readonly CSSStyleSheet[]): void => {
    const others = document.adoptedStyleSheets.filter((sheet) => !rules.includes(sheet));
    rules = next;
    document.adoptedStyleSheets = [...others, ...rules];
  };
  return {
    ...{ document, drawing, root },
    adopt: (sheets) => {
      shadow.adoptedStyleSheets = read([unmovedStyle, ...sheets]);
      // Fonts are the document's alone.
      withRules(readFonts([sheets.flatMap((css) => css.match(fontRule) ?? []).join("\n")]));
    },
    fonts: () => [...document.fonts].filter((face) => !before.has(face)),
    close: () => {
      host.remove();
      withRules([]);
    },
  };
}

/** Hides what text is laid out in from readers, whatever the page's own style is. */
function hide(element: HTMLElement, width: number, height: number): void {
  element.ariaHidden = "true";
  element.inert = true;
  element.tabIndex = -1;
  element.style.cssText =
    "all: initial !important; position: fixed !important; left: -100000px !important; top: 0 !important; border: 0 !important; visibility: hidden !important";
  element.style.setProperty("width", `${width}px`, "important");
  element.style.setProperty("height", `${height}px`, "important");
}

/** Returns a function that reads style sheets, but for those that were in the same place the last time. */
function sheetReader(
  view: Window & typeof globalThis,
): (texts: readonly string[]) => CSSStyleSheet[] {
  let known: readonly { readonly css: string; readonly sheet: CSSStyleSheet }[] = [];
  return (texts) => {
    known = texts.map((css, k) => {
      const before = known[k];
      if (before?.css === css) return before;
      const sheet = new view.CSSStyleSheet();
      sheet.replaceSync(css);
      return { css, sheet };
    });
    return known.map(({ sheet }) => sheet);
  };
}

/** A rule of a font, as `cleanCss` writes it. */
export const fontRule: RegExp = /@font-face \{ [^{}]*\}/g;

/** Properties that move boxes after they are laid out. */
export const moving: readonly string[] = [
  "transform",
  "translate",
  "rotate",
  "scale",
  "offset-path",
];

/** Marks the root of a frame in which no box is moved for now. */
const unmovedAttribute = "data-turnleaf-unmoved";

/** The rule for that. What is important in the first layer is above all else that is important in style sheets. */
const unmovedStyle = `@layer { [${unmovedAttribute}] * { ${moving.map((name) => `${name}: none !important;`).join(" ")} } }`;

/** Gives elements their own styles. */
export function applyInlineStyles(html: HTMLElement): void {
  for (const element of [html, ...html.querySelectorAll<HTMLElement>(`[${styleAttribute}]`)]) {
    const { style } = element;
    style.cssText = element.getAttribute(styleAttribute) ?? "";
    // More important than all, it could not be left out by `unmoved`.
    for (const name of moving) {
      if (style.getPropertyPriority(name)) style.setProperty(name, style.getPropertyValue(name));
    }
    element.removeAttribute(styleAttribute);
  }
}

/** Returns whether a box is moved after it is laid out. */
export function isMoved(element: Element): boolean {
  const style = (element.ownerDocument.defaultView as Window).getComputedStyle(element);
  // What a browser does not know has no value.
  return moving.some((name) => !/^(none)?$/.test(style.getPropertyValue(name)));
}

/** Returns what is measured while no box is moved: a box that is fills no pages, nor leaves any empty. */
export function unmoved<T>({ root }: LayoutFrame, measure: () => T): T {
  root.setAttribute(unmovedAttribute, "");
  const measured = measure();
  root.removeAttribute(unmovedAttribute);
  return measured;
}

/** Waits until the pictures and fonts of a section are there, or have failed. */
export async function loadedIn({ document, fonts }: LayoutFrame, html: HTMLElement): Promise<void> {
  // Laid out once, it is known which fonts are used.
  html.getBoundingClientRect();
  // Not decoded: only those of a page that is drawn are.
  const images = [...html.querySelectorAll("img")].map(
    (image) => image.complete || new Promise((done) => (image.onload = image.onerror = done)),
  );
  // Waiting for nothing would let the page draw a section that is about to be changed.
  if (images.length === 0 && fonts().length === 0) return;
  await Promise.all([document.fonts.ready, ...images]);
}
