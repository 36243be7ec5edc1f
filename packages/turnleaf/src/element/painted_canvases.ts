/**
 * What scripts have painted on canvases of pages that are elements, while these turn. Nothing tells
 * when a canvas is painted, so the picture of its page is of before: as leaves take off, the canvases
 * are drawn into it as they look then.
 */

import type { DrawnPage, LiveBitmaps, Viewer } from "../viewer/viewer.ts";

/** A page with canvases in the air: the picture it was made of, and what is shown. */
interface PaintedPage {
  readonly picture: DrawnPage["picture"];
  /** Null if what is painted may not be read, or the page has no canvas. */
  readonly canvas: HTMLCanvasElement | null;
}

/** The pages with canvases of a book while leaves are in flight. */
export class PaintedCanvases implements LiveBitmaps {
  readonly #viewer: Viewer;
  readonly #elementOf: (page: number) => HTMLElement | null | undefined;
  readonly #elements: () => Iterable<HTMLElement>;
  readonly #pages = new Map<number, PaintedPage>();
  #isOn = false;

  /**
   * @param elementOf returns the element that a page (from 1) is, if it is one
   *
   * @param elements returns those of all pages
   */
  constructor(
    viewer: Viewer,
    elementOf: (page: number) => HTMLElement | null | undefined,
    elements: () => Iterable<HTMLElement>,
  ) {
    this.#viewer = viewer;
    this.#elementOf = elementOf;
    this.#elements = elements;
  }

  /** Shows canvases as they look now, if a page has any. */
  begin(): void {
    this.#isOn = [...this.#elements()].some((page) => page.querySelector("canvas") !== null);
    if (this.#isOn) this.#viewer.setLiveBitmaps(this);
  }

  /** Shows the pages' own pictures again. */
  end(): void {
    if (!this.#isOn) return;
    this.#isOn = false;
    const pages = [...this.#pages.values()];
    this.#pages.clear();
    this.#viewer.setLiveBitmaps(null);
    for (const { canvas } of pages) if (canvas) this.#viewer.forgetCanvas(canvas);
  }

  /** Ends it for good. */
  destroy(): void {
    this.end();
  }

  bitmapOf(page: number, drawn: DrawnPage): HTMLCanvasElement | null {
    const known = this.#pages.get(page);
    if (known?.picture === drawn.picture) return known.canvas;
    if (known?.canvas) this.#viewer.forgetCanvas(known.canvas);
    const canvas = paintedOver(drawn, this.#elementOf(page));
    this.#pages.set(page, { picture: drawn.picture, canvas });
    return canvas;
  }
}

/** Returns the picture of a page with its canvases as they look now; null if there is nothing to draw. */
function paintedOver(
  { picture, place }: DrawnPage,
  page: HTMLElement | null | undefined,
): HTMLCanvasElement | null {
  const canvases = [...(page?.querySelectorAll("canvas") ?? [])];
  const painted = canvases.filter(({ width, height }) => width > 0 && height > 0);
  if (!page || painted.length === 0 || !(page.offsetWidth > 0 && page.offsetHeight > 0))
    return null;
  const shown = document.createElement("canvas");
  [shown.width, shown.height] = [picture.width, picture.height];
  const pen = shown.getContext("2d");
  if (pen === null) return null;
  pen.drawImage(picture, 0, 0);
  // From the page's own CSS pixels.
  pen.translate(place.x * shown.width, place.y * shown.height);
  pen.scale(
    (place.width * shown.width) / page.offsetWidth,
    (place.height * shown.height) / page.offsetHeight,
  );
  for (const canvas of painted) {
    const style = getComputedStyle(canvas);
    if (!canvas.checkVisibility({ visibilityProperty: true })) continue;
    const [left, top, right, bottom] = [
      style.paddingLeft,
      style.paddingTop,
      style.paddingRight,
      style.paddingBottom,
    ].map(Number.parseFloat);
    const at = placeOn(page, canvas);
    pen.globalAlpha = Number(style.opacity);
    pen.drawImage(
      canvas,
      at.x + canvas.clientLeft + left,
      at.y + canvas.clientTop + top,
      canvas.clientWidth - left - right,
      canvas.clientHeight - top - bottom,
    );
  }
  try {
    pen.getImageData(0, 0, 1, 1);
  } catch {
    // Of another site, which does not let this one read it: as in pictures of pages at rest.
    return null;
  }
  return shown;
}

/** Returns where an element lies on the page around it, CSS pixels. */
function placeOn(
  page: HTMLElement,
  element: HTMLElement,
): { readonly x: number; readonly y: number } {
  let [x, y] = [element.offsetLeft, element.offsetTop];
  // The page is positioned, so the way up ends there.
  let around = element.offsetParent;
  while (around instanceof HTMLElement && around !== page) {
    x += around.offsetLeft + around.clientLeft - around.scrollLeft;
    y += around.offsetTop + around.clientTop - around.scrollTop;
    around = around.offsetParent;
  }
  return { x: x + page.clientLeft, y: y + page.clientTop };
}
