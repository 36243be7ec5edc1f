/** The size of a page of fixed layout that names none: that of what stands on it. */

import { isPageSize } from "../limits.ts";
import type { PageSize } from "../page_source.ts";
import type { FlowContent } from "./flow_book.ts";
import { applyInlineStyles, drawingOf, loadedIn, openFrame } from "./frame.ts";
import { baseStyle } from "./typography.ts";

/** What has a size of its own. */
const replaced = "img, svg, video, canvas, object";

/** Elements that are measured: a page of fixed layout has some hundred. */
const mostMeasured = 5000;

/**
 * Returns how far boxes of a fixed size reach on a page: pictures, what is placed, and the body, if it is as
 * wide on pages of two widths. Null if text alone stands there, which fills a page of any size.
 *
 * @param usual the size of a page that could be of any
 */
export async function naturalSize(content: FlowContent, usual: PageSize): Promise<PageSize | null> {
  const frame = await openFrame(usual.width, usual.height);
  try {
    const { document } = frame;
    const sheet = document.createElement("div");
    sheet.style.cssText = `position: absolute; left: 0; top: 0; width: ${usual.width}px; font-size: 16px`;
    const html = document.importNode(content.root, true) as HTMLElement;
    applyInlineStyles(html);
    sheet.append(html);
    frame.root.append(sheet);
    frame.adopt([baseStyle, ...content.styles]);
    await loadedIn(frame, html);
    const view = document.defaultView as Window;
    const body = html.querySelector("body") ?? html;
    const all = [body, ...body.querySelectorAll("*")].slice(0, mostMeasured);
    const boxes = all.filter((element) => {
      // What is a part of a drawing is measured with it.
      if (element !== drawingOf(element, html)) return false;
      return element === body || element.matches(replaced) || isPlaced(element, view);
    });
    const widths = boxes.map((element) => element.getBoundingClientRect().width);
    sheet.style.width = `${usual.width / 2}px`;
    const { marginRight, marginBottom } = view.getComputedStyle(body);
    const [right, bottom] = [Number.parseFloat(marginRight), Number.parseFloat(marginBottom)];
    let [width, height] = [0, 0];
    boxes.forEach((element, k) => {
      const rect = element.getBoundingClientRect();
      const isFixed = rect.width > 0 && rect.width === widths[k];
      const own = isFixed ? rect : ownSize(element);
      if (!own || own.width === 0 || own.height === 0) return;
      const inFlow = isPlaced(element, view) ? 0 : 1;
      width = Math.max(width, rect.left + own.width + inFlow * right);
      height = Math.max(height, rect.top + own.height + inFlow * bottom);
    });
    const size = { width: Math.ceil(width), height: Math.ceil(height) };
    return isPageSize(size) ? size : null;
  } finally {
    frame.close();
  }
}

/** Returns whether an element stands where it is put, and not after others. */
function isPlaced(element: Element, view: Window): boolean {
  return /absolute|fixed/.test(view.getComputedStyle(element).position);
}

/** Returns the pixels of a picture that fills what is around it; null for what has none. */
function ownSize(element: Element): PageSize | null {
  if (element.localName !== "img") return null;
  const { naturalWidth: width, naturalHeight: height } = element as HTMLImageElement;
  return { width, height };
}

/** Returns the size of the picture at an address in its own pixels, upright; 0 by 0 if it is none. */
export async function decodedSize(address: string): Promise<PageSize> {
  const image = new Image();
  image.src = address;
  await image.decode().catch(() => {});
  return { width: image.naturalWidth, height: image.naturalHeight };
}
