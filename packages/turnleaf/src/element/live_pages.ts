/**
 * Pages that are elements, over their places in the book: what lies there is
 * the web page's own, so that forms, links and films work. While a leaf is in
 * flight they are unseen, and the book shows their pictures.
 */

import { leftPage, pagesAt, rightPage } from "../book/spreads.ts";
import { type Projection, projectionOnto } from "../element_plane.ts";
import { decodeEscapes } from "../sources/book_text.ts";
import { loadPart } from "../sources/load_part.ts";
import type { PageSource } from "../sources/page_source.ts";
import type { Point } from "../text/page_view.ts";
import type { Viewer } from "../viewer/viewer.ts";
import type { LiveDrawings } from "./live_drawings.ts";
import { PaintedCanvases } from "./painted_canvases.ts";
import { addStyle } from "./shadow_tree.ts";

/** Where the place of a page is measured, in fractions: it bends near the spine, where little stands. */
const [near, far] = [0.1, 0.9];

/** Whether the browser draws elements on a canvas that contains them, and moves them there as they are. */
const drawsElements: boolean =
  "drawElementImage" in CanvasRenderingContext2D.prototype &&
  "onpaint" in HTMLCanvasElement.prototype &&
  "moveBefore" in Element.prototype;

/** What a page's name and links need of the book around it. */
export interface LivePagesHooks {
  /** Returns a page's name for screen readers, such as "Page 4". */
  readonly name: (page: number) => string;
  /** Returns the number of the page that an element is; 0 if it is none. */
  readonly pageOf: (element: HTMLElement) => number;
  /** Turns to a page (from 1). */
  readonly goTo: (page: number) => void;
}

/** The elements of one book. */
export class LivePages {
  readonly #host: HTMLElement;
  readonly #stage: HTMLElement;
  readonly #layer: HTMLElement = document.createElement("div");
  readonly #hooks: LivePagesHooks;
  /** The places of the elements, in the order of the pages. */
  #boxes = new Map<HTMLElement, HTMLElement>();
  /** Elements that came from elsewhere. */
  readonly #guests = new Set<HTMLElement>();
  /** Films and sounds that go on when their page is open again. */
  readonly #paused = new Set<HTMLMediaElement>();
  readonly #ended = new AbortController();
  /** Draws them while they turn: all of them where the browser can, otherwise their canvases. */
  #drawings: LiveDrawings | PaintedCanvases | null = null;

  /**
   * @param host whose children the elements are, or become
   *
   * @param stage contains the canvas
   */
  constructor(host: HTMLElement, stage: HTMLElement, hooks: LivePagesHooks) {
    this.#host = host;
    this.#stage = stage;
    this.#hooks = hooks;
    this.#layer.className = "elements";
    const removeStyle = addStyle(stage.getRootNode() as ShadowRoot, style);
    stage.append(this.#layer);
    const { signal } = this.#ended;
    signal.addEventListener("abort", removeStyle);
    this.#layer.addEventListener("click", (event) => this.#click(event), { signal });
  }

  /**
   * Lays out the pages of a source that are elements: at first unseen, and not
   * to be focused.
   *
   * @param isWhole whether the book has no other pages
   */
  adopt(source: PageSource, isWhole = true): void {
    this.#drawings?.end();
    const boxes = isWhole ? new Map<HTMLElement, HTMLElement>() : this.#boxes;
    const before = this.#boxes;
    for (let index = 0; index < source.pageCount; index++) {
      const page = source.element?.(index);
      if (page) boxes.set(page, before.get(page) ?? this.#boxOf(page));
    }
    this.#boxes = boxes;
    for (const [page, box] of before) if (!boxes.has(page)) this.#remove(page, box);
    // One that is moved loses its focus: only those out of order are.
    let next = this.#layer.firstElementChild;
    for (const box of boxes.values()) {
      if (box === next) next = next.nextElementSibling;
      else this.#layer.insertBefore(box, next);
    }
  }

  /** Shows the elements of a viewer's open pages while they lie still. */
  follow(viewer: Viewer, source: PageSource): void {
    const { signal } = this.#ended;
    this.#drawings?.destroy();
    this.#drawings = new PaintedCanvases(
      viewer,
      (page) => source.element?.(page - 1),
      () => this.#boxes.keys(),
    );
    const stop = viewer.onStillChange((isStill) => {
      this.#layer.classList.toggle("seen", isStill);
      if (isStill) this.#drawings?.end();
      else this.#drawings?.begin();
      if (isStill) this.#lay(viewer, source);
    });
    signal.addEventListener("abort", stop);
    if (drawsElements) void this.#drawWhileTurning(viewer, source);
  }

  /** Removes the places of all pages; elements from elsewhere leave the host. */
  destroy(): void {
    this.#ended.abort();
    this.#drawings?.destroy();
    for (const [page, box] of this.#boxes) this.#remove(page, box);
    this.#layer.remove();
  }

  async #drawWhileTurning(viewer: Viewer, source: PageSource): Promise<void> {
    // Without it pages show their pictures, as in other browsers.
    const part = await loadPart(import("./live_drawings.ts")).catch(() => null);
    if (part === null || this.#ended.signal.aborted) return;
    this.#drawings?.destroy();
    this.#drawings = new part.LiveDrawings(this.#stage, viewer, (page) => {
      const element = source.element?.(page - 1);
      return element ? this.#boxes.get(element) : undefined;
    });
  }

  #boxOf(page: HTMLElement): HTMLElement {
    if (page.parentNode !== this.#host) {
      this.#guests.add(page);
      this.#host.append(page);
    }
    const box = document.createElement("div");
    box.setAttribute("role", "group");
    box.inert = true;
    const slot = document.createElement("slot");
    slot.assign(page);
    box.append(slot);
    return box;
  }

  #remove(page: HTMLElement, box: HTMLElement): void {
    box.remove();
    if (this.#guests.delete(page) && page.parentNode === this.#host) page.remove();
  }

  /** Lays the elements of the open pages over their places; others cannot be used. */
  #lay(viewer: Viewer, source: PageSource): void {
    const open = new Set<HTMLElement>();
    const spine = spineOf(viewer);
    for (const page of pagesAt(viewer.binding, viewer.turning.spread)) {
      const element = viewer.isElement(page) ? source.element?.(page - 1) : null;
      const box = element && this.#boxes.get(element);
      if (!element || !box) continue;
      open.add(element);
      box.setAttribute("aria-label", this.#hooks.name(page));
      layPage(box, element, viewer, page, spine);
    }
    for (const [page, box] of this.#boxes) {
      const isOpen = open.has(page);
      if (box.inert !== isOpen) continue;
      box.inert = !isOpen;
      this.#play(page, isOpen);
    }
  }

  /** Pauses what plays on a page that is closed, and lets it go on when it is open again. */
  #play(page: HTMLElement, isOpen: boolean): void {
    for (const media of page.querySelectorAll<HTMLMediaElement>("audio, video")) {
      if (!isOpen && !media.paused) {
        media.pause();
        this.#paused.add(media);
      } else if (isOpen && this.#paused.delete(media)) {
        // A browser may not allow it; the reader can still start it.
        media.play().catch(() => {});
      }
    }
  }

  /** Follows a link to an element of another page. */
  #click(event: MouseEvent): void {
    const link = event.composedPath().find((node) => node instanceof HTMLAnchorElement);
    if (!(link instanceof HTMLAnchorElement) || event.defaultPrevented) return;
    const here = link.ownerDocument.URL.split("#")[0];
    if (link.hash === "" || link.href.split("#")[0] !== here) return;
    const target = link.ownerDocument.getElementById(decodeEscapes(link.hash.slice(1)));
    const page = [...this.#boxes.keys()].find((page) => target && page.contains(target));
    const number = page ? this.#hooks.pageOf(page) : 0;
    if (number === 0) return;
    event.preventDefault();
    this.#hooks.goTo(number);
  }
}

/** Lays an element's box over its page by one CSS matrix, so that it ends where the page does at the spine. */
function layPage(
  box: HTMLElement,
  element: HTMLElement,
  viewer: Viewer,
  page: number,
  spine: { readonly page: number; readonly at: Point } | null,
): void {
  const [width, height] = [element.offsetWidth, element.offsetHeight];
  const place = viewer.placeOf(page, { width, height });
  const at = (u: number, v: number) =>
    viewer.project(page, place.x + u * place.width, place.y + v * place.height);
  const corners = [at(near, near), at(far, near), at(near, far), at(far, far)];
  const [a, b, c, d] = corners;
  if (!a || !b || !c || !d || !(width > 0 && height > 0)) return;
  const seen = projectionOnto([a, b, c, d]);
  const span = far - near;
  const [sx, sy, from] = [1 / (span * width), 1 / (span * height), -near / span];
  // The same from CSS pixels of the element's own.
  const row = ([x, y, one]: Projection[0]): Projection[0] => [x * sx, y * sy, (x + y) * from + one];
  const [[xx, yx, x], [xy, yy, y], [wx, wy, w]] = seen.map(row) as unknown as Projection;
  const parts = [xx, xy, 0, wx, yx, yy, 0, wy, 0, 0, w, 0, x, y, 0, w].map((part) => part / w);
  box.style.transform = `matrix3d(${parts.map((part) => Number(part.toFixed(9))).join()})`;
  if (viewer.binding.quarterTurned) return;
  const middle = height / 2;
  const isAtSpine = (k: number): boolean => spine !== null && (k === 1) === (page === spine.page);
  const ends = [at(0, 0.5), at(1, 0.5)].map((end, k) => (isAtSpine(k) ? spine?.at : end));
  const [left, right] = ends.map((end, k) => {
    if (!end) return k * width;
    return (yx * middle + x - end.x * (wy * middle + w)) / (end.x * wx - xx);
  });
  box.style.clipPath = `inset(0 ${(width - right).toFixed(2)}px 0 ${left.toFixed(2)}px)`;
  // Its colour goes on to the spine.
  box.style.outline = `${width}px solid ${getComputedStyle(element).backgroundColor}`;
}

/** Returns the middle of the spine between two open pages, and the page on its left; null for one page. */
function spineOf(viewer: Viewer): { readonly page: number; readonly at: Point } | null {
  const { binding, turning } = viewer;
  const [left, right] = [leftPage(binding, turning.spread), rightPage(binding, turning.spread)];
  if (left === null || right === null) return null;
  const [a, b] = [viewer.project(left, 1, 0.5), viewer.project(right, 0, 0.5)];
  return a && b && { page: left, at: { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 } };
}

/**
 * The style of pages that are elements. They darken the paper as ink does, so
 * that its shading shows through them as through a picture of theirs.
 */
const style: string = /* css */ `
.elements {
  position: absolute; inset: 0; overflow: clip; pointer-events: none; opacity: 0;
  mix-blend-mode: multiply; isolation: isolate;
}
.elements.seen { opacity: 1; }
.elements > div {
  position: absolute; left: 0; top: 0; width: max-content; transform-origin: 0 0; opacity: 0;
}
/* A box's outline has its page's colour, which a theme of high contrast has given the page. */
.elements > div { forced-color-adjust: none; }
.elements slot { forced-color-adjust: auto; }
.elements.seen > :not([inert]) { opacity: 1; pointer-events: auto; }
::slotted(*) {
  display: block; box-sizing: border-box; position: relative !important; inset: auto !important;
  margin: 0 !important; float: none !important; overflow: hidden;
}
::slotted(:not(img, picture, canvas, video)) { width: 480px; height: 720px; background: #fff; }
`;
