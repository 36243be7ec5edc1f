/**
 * Pages that are scrolled and not turned: those of the open page's roll, one
 * beneath the other without a gap, in place of the book. The viewer stays under
 * it, unseen, open at the page that is read.
 */

import { attributeOf } from "../attributes.ts";
import { forward, pageOf, spreadOf } from "../book/spreads.ts";
import type { ElementPlane } from "../element_plane.ts";
import { wholePage } from "../sources/limits.ts";
import type { PageBox, PageSize, PageSource } from "../sources/page_source.ts";
import type { PageView, Point } from "../text/page_view.ts";
import type { Viewer } from "../viewer/viewer.ts";
import { allowsGesture } from "./attribute_options.ts";
import { addStyle } from "./shadow_tree.ts";

/** The most by which flowing text is magnified in a wide place; pages of fixed layout fill it. */
const mostMagnified = 1.25;

/** How far down the window the page lies that is read, as a fraction of its height. */
const readAt = 0.3;

/** Milliseconds after which the page that has been scrolled to is reported. */
const reportTime = 120;

/** CSS pixels that an arrow key scrolls. */
const keyStep = 60;

/** CSS pixels of a swipe to the next roll, at least, and how much longer than high it is. */
const leastSwipe = 40;
const swipeSlope = 2;

/** CSS pixels of a wheel across that lead to the next roll, and the pause between two, milliseconds. */
const wheelSwipe = 60;
const wheelPause = 300;

/** Zoom per pixel of a wheel with Ctrl, as an exponent, and the most pixels of one event. */
const zoomRate = 0.009;
const mostZoomStep = 40;

/** The place of one page in a roll. */
interface Sheet {
  readonly page: number;
  readonly box: HTMLElement;
  /** Aborts the drawing of a page that is near the window, or was; null for one that is far. */
  drawing: AbortController | null;
}

/** What lies around a roll. */
export interface RollTarget {
  readonly host: HTMLElement;
  readonly stage: HTMLElement;
  readonly source: PageSource;
  readonly viewer: Viewer;
  /** How the stage is seen in the window. */
  readonly plane: ElementPlane;
}

/**
 * The rolls of one book: shown while a page of one lies open.
 *
 * @csspart roll The pages that are scrolled, in place of the book.
 */
export class RollView implements PageView {
  /** What is scrolled, as wide as the pages: places of the text are in its CSS pixels. */
  readonly content: HTMLElement = document.createElement("div");
  readonly #scroller: HTMLElement = document.createElement("div");
  readonly #host: HTMLElement;
  readonly #stage: HTMLElement;
  readonly #source: PageSource;
  readonly #viewer: Viewer;
  readonly #plane: ElementPlane;
  readonly #ended = new AbortController();
  readonly #near: IntersectionObserver;
  readonly #sizes: ResizeObserver;
  readonly #listeners = new Set<(rests: boolean) => void>();
  #sheets: readonly Sheet[] = [];
  /** The number of pages of the book that the sheets are of. */
  #pageCount = 0;
  #page = 0;
  /** How far down that page the window's head was put, as a fraction of the page's height. */
  #top = 0;
  /** Where the link leads that is being followed. */
  #aim: { readonly page: number; readonly top: number } | null = null;
  #isShown = false;
  /** Where the view was last put by a command: no reader scrolled there. */
  #putAt = -1;
  #frame = 0;
  /** How wide a page of text is in its own unit; unknown before the first is drawn. */
  #textWidth = Number.POSITIVE_INFINITY;
  #revealing: MutationObserver | null = null;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #swipe = { sum: 0, last: Number.NEGATIVE_INFINITY, isSpent: false };

  constructor({ host, stage, source, viewer, plane }: RollTarget) {
    this.#host = host;
    this.#stage = stage;
    this.#source = source;
    this.#viewer = viewer;
    this.#plane = plane;
    const scroller = this.#scroller;
    scroller.setAttribute("part", "roll");
    scroller.className = "roll";
    scroller.hidden = true;
    scroller.tabIndex = 0;
    scroller.setAttribute("role", "group");
    scroller.ariaLabel = source.title;
    this.content.className = "roll-pages";
    scroller.append(this.content);
    stage.after(scroller);
    const removeStyle = addStyle(stage.getRootNode() as ShadowRoot, style);
    this.#near = new IntersectionObserver((changes) => this.#follow(changes), {
      root: scroller,
      rootMargin: "100% 0px",
    });
    // In the next frame: what is laid out anew is observed itself.
    this.#sizes = new ResizeObserver(() => {
      this.#frame ||= requestAnimationFrame(() => this.#resized());
    });
    this.#sizes.observe(scroller);
    this.#sizes.observe(this.content);
    const { signal } = this.#ended;
    signal.addEventListener("abort", removeStyle);
    const stop = viewer.onViewChange((rests) => rests && this.#update());
    signal.addEventListener("abort", stop);
    scroller.addEventListener("scroll", () => this.#scrolled(), { signal, passive: true });
    scroller.addEventListener("wheel", (event) => this.#wheel(event), { signal, passive: false });
    host.addEventListener("keydown", (event) => this.#key(event), { signal, capture: true });
    this.#followSwipes(signal);
    this.#update();
  }

  /** Whether the open page is scrolled. */
  get isShown(): boolean {
    return this.#isShown;
  }

  get openPages(): readonly number[] {
    return this.#sheets.filter(({ drawing }) => drawing !== null).map(({ page }) => page);
  }

  placeOf(): PageBox {
    return wholePage;
  }

  project(page: number, x: number, y: number): Point | null {
    const sheet = this.#sheetOf(page);
    if (!this.#isShown || !sheet || sheet.drawing === null) return null;
    const { offsetTop, offsetWidth, offsetHeight } = sheet.box;
    return { x: x * offsetWidth, y: offsetTop + y * offsetHeight };
  }

  onView(listener: (rests: boolean) => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /**
   * Scrolls to a place of a page (from 1) when it comes to be the open page; at once if it is.
   *
   * @param top as a fraction of the page's height from its head
   */
  aim(page: number, top = 0): void {
    this.#aim = { page, top };
    if (!this.#isShown || page !== this.#openPage) return;
    this.#put(page);
    this.#aim = null;
  }

  /** Scrolls to the mark of a hit on a page (from 1), once it is the open page and the mark is there. */
  reveal(page: number): void {
    this.#revealing?.disconnect();
    const revealing = new MutationObserver(() => {
      const mark = this.#page === page ? this.content.querySelector(".mark.here") : null;
      if (!mark) return;
      revealing.disconnect();
      mark.scrollIntoView({ block: "center" });
    });
    revealing.observe(this.content, { childList: true, subtree: true });
    this.#revealing = revealing;
  }

  /** Draws a page (from 1) anew, if it is near. */
  redraw(page: number): void {
    const sheet = this.#sheetOf(page);
    if (sheet?.drawing) this.#draw(sheet);
  }

  /** Draws all pages anew that are drawn, as they are in other colours. */
  recolour(): void {
    for (const sheet of this.#sheets) if (sheet.drawing) this.#draw(sheet);
  }

  /** Removes it, with all its listeners. */
  destroy(): void {
    this.#ended.abort();
    this.#near.disconnect();
    this.#sizes.disconnect();
    this.#revealing?.disconnect();
    clearTimeout(this.#timer);
    cancelAnimationFrame(this.#frame);
    for (const { drawing } of this.#sheets) drawing?.abort();
    this.#stage.classList.remove("scrolled");
    this.#scroller.remove();
  }

  /** Follows the viewer to its open page. */
  #update(): void {
    const page = this.#openPage;
    const roll = this.#rollOf(page);
    this.#isShown = roll !== null;
    this.#scroller.hidden = roll === null;
    this.#stage.classList.toggle("scrolled", roll !== null);
    if (roll === null) {
      this.#page = 0;
      this.#lay([]);
    } else {
      const isSame = this.#pageCount === this.#source.pageCount && this.#sheetOf(page);
      if (!isSame) {
        this.#lay(this.#pagesAround(page));
        this.#top = 0;
      }
      this.#fit();
      if (page !== this.#page || !isSame) this.#put(page);
    }
    this.#aim = null;
    this.#report();
  }

  /** The page at which the viewer is open. */
  get #openPage(): number {
    const { binding, turning } = this.#viewer;
    return pageOf(binding, turning.spread);
  }

  #rollOf(page: number): number | null {
    return this.#source.roll?.(page - 1) ?? null;
  }

  /** Returns the pages of a page's roll: those before and after it that belong to it. */
  #pagesAround(page: number): number[] {
    const roll = this.#rollOf(page);
    let first = page;
    while (first > 1 && this.#rollOf(first - 1) === roll) first -= 1;
    const pages = [];
    const { pageCount } = this.#source;
    for (let next = first; next <= pageCount && this.#rollOf(next) === roll; next++) {
      pages.push(next);
    }
    return pages;
  }

  /** Lays other pages out, as large as they are thought to be until they are drawn. */
  #lay(pages: readonly number[]): void {
    for (const { drawing } of this.#sheets) drawing?.abort();
    this.#near.disconnect();
    this.#pageCount = this.#source.pageCount;
    this.#sheets = pages.map((page) => {
      const box = document.createElement("div");
      box.className = "roll-page";
      return { page, box, drawing: null };
    });
    for (const old of this.content.querySelectorAll(".roll-page")) old.remove();
    this.content.prepend(...this.#sheets.map(({ box }) => box));
    for (const { box } of this.#sheets) this.#near.observe(box);
  }

  /** Makes the pages as wide as the window, and as the zoom asks. */
  #fit(): void {
    const { clientWidth } = this.#scroller;
    const wide = this.#source.typeset ? mostMagnified * this.#textWidth : clientWidth;
    const width = Math.min(clientWidth, wide) * this.#viewer.zoomLevel;
    this.content.style.width = `${width}px`;
    this.#scroller.style.touchAction = this.#viewer.zoomLevel > 1 ? "pan-x pan-y" : "pan-y";
  }

  /** Puts the head of a page, or the place on it to which a link leads, to the head of the window. */
  #put(page: number): void {
    const sheet = this.#sheetOf(page);
    if (!sheet) return;
    if (this.#aim?.page === page) this.#top = this.#aim.top;
    else if (page !== this.#page) this.#top = 0;
    this.#page = page;
    const { offsetTop, offsetHeight } = sheet.box;
    this.#scroller.scrollTop = offsetTop + this.#top * offsetHeight;
    this.#putAt = this.#scroller.scrollTop;
  }

  /** Draws what comes near the window, and frees what is far from it. */
  #follow(changes: readonly IntersectionObserverEntry[]): void {
    for (const { target, isIntersecting } of changes) {
      const sheet = this.#sheets.find(({ box }) => box === target);
      if (!sheet) continue;
      if (isIntersecting) this.#draw(sheet);
      else {
        sheet.drawing?.abort();
        sheet.drawing = null;
        sheet.box.replaceChildren();
      }
    }
    this.#report();
  }

  async #draw(sheet: Sheet): Promise<void> {
    sheet.drawing?.abort();
    const drawing = new AbortController();
    sheet.drawing = drawing;
    const { signal } = drawing;
    const { page, box } = sheet;
    try {
      const size = await this.#source.size(page - 1, signal);
      signal.throwIfAborted();
      this.#shape(sheet, size);
      const view = this.#host.ownerDocument.defaultView ?? window;
      const width = Math.max(Math.round(box.clientWidth * view.devicePixelRatio), 1);
      const picture = await this.#source.draw(page - 1, width, signal);
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [picture.width, picture.height];
      canvas.getContext("2d")?.drawImage(picture, 0, 0);
      if ("close" in picture) picture.close();
      signal.throwIfAborted();
      box.replaceChildren(canvas);
    } catch (error) {
      if (signal.aborted) return;
      const sentence = document.createElement("p");
      sentence.textContent = error instanceof Error ? error.message : String(error);
      box.replaceChildren(sentence);
    }
  }

  /** Gives a page its own proportions. */
  #shape({ box }: Sheet, { width, height }: PageSize): void {
    const ratio = `${width} / ${height}`;
    if (box.style.aspectRatio === ratio) return;
    box.style.aspectRatio = ratio;
    if (this.#textWidth === Number.POSITIVE_INFINITY) {
      this.#textWidth = width;
      this.#fit();
    }
    // The page that was put to the head stays there.
    if (Math.abs(this.#scroller.scrollTop - this.#putAt) < 1) this.#put(this.#page);
  }

  /** Fits the pages to another window, and lays their text over them. */
  #resized(): void {
    this.#frame = 0;
    if (!this.#isShown) return;
    const before = this.content.style.width;
    this.#fit();
    if (this.content.style.width !== before) {
      this.#put(this.#page);
      for (const sheet of this.#sheets) if (sheet.drawing) this.#draw(sheet);
    }
    this.#report();
  }

  /** Opens the viewer at the page that has been scrolled to. */
  #scrolled(): void {
    if (Math.abs(this.#scroller.scrollTop - this.#putAt) < 1) return;
    this.#putAt = -1;
    this.#top = 0;
    this.#timer ??= setTimeout(() => {
      this.#timer = undefined;
      const page = this.#pageInSight();
      // A command may have led elsewhere since.
      const isHere = this.#isShown && this.#page === this.#openPage && this.#putAt < 0;
      if (!isHere || page === this.#page) return;
      this.#page = page;
      void this.#viewer.change(spreadOf(this.#viewer.binding, page), false);
    }, reportTime);
  }

  #pageInSight(): number {
    const { scrollTop, clientHeight, scrollHeight } = this.#scroller;
    const last = this.#sheets.at(-1)?.page ?? 1;
    if (scrollTop > 0 && scrollTop + clientHeight >= scrollHeight - 1) return last;
    const line = scrollTop + readAt * clientHeight;
    const at = this.#sheets.findLast(({ box }) => box.offsetTop <= line);
    return at?.page ?? this.#sheets[0]?.page ?? 1;
  }

  #wheel(event: WheelEvent): void {
    const { deltaY } = event;
    const viewer = this.#viewer;
    const deltaX = this.#plane.xAxis === "left" ? -event.deltaX : event.deltaX;
    if (event.ctrlKey || event.metaKey) {
      if (!allowsGesture(this.#host, "zoom")) return;
      event.preventDefault();
      const step = Math.min(Math.max(deltaY, -mostZoomStep), mostZoomStep);
      const origin = { x: 0, y: 0 };
      viewer.zoom(viewer.zoomLevel * Math.exp(-zoomRate * step), origin, origin, 0);
      return;
    }
    const isAcross = Math.abs(deltaX) > Math.abs(deltaY);
    if (!isAcross || viewer.zoomLevel > 1 || !allowsGesture(this.#host, "wheel")) return;
    event.preventDefault();
    const swipe = this.#swipe;
    if (event.timeStamp - swipe.last > wheelPause || deltaX * swipe.sum < 0) {
      swipe.sum = 0;
      swipe.isSpent = false;
    }
    swipe.last = event.timeStamp;
    swipe.sum += deltaX;
    // A trackpad goes on by itself after a swipe.
    if (swipe.isSpent || Math.abs(swipe.sum) < wheelSwipe) return;
    swipe.isSpent = true;
    this.#leave(swipe.sum > 0 ? 1 : -1);
  }

  /** Leads to the next roll, or the one before, by a finger that goes across. */
  #followSwipes(signal: AbortSignal): void {
    const from = new Map<number, Point>();
    const on = (name: string, handle: (event: PointerEvent) => void): void =>
      this.#scroller.addEventListener(name, handle as EventListener, { signal });
    on("pointerdown", ({ pointerId, pointerType, clientX, clientY }) => {
      const at = this.#plane.fromClient(clientX, clientY);
      if (pointerType !== "mouse" && at) from.set(pointerId, at);
    });
    // From here on the finger scrolls.
    on("pointercancel", ({ pointerId }) => from.delete(pointerId));
    on("pointerup", ({ pointerId, clientX, clientY }) => {
      const start = from.get(pointerId);
      const isOnlyOne = from.size === 1;
      from.delete(pointerId);
      const end = this.#plane.fromClient(clientX, clientY);
      if (!start || !end || !isOnlyOne || this.#viewer.zoomLevel > 1) return;
      const [x, y] = [end.x - start.x, end.y - start.y];
      const isLong = Math.abs(x) >= Math.max(leastSwipe, attributeOf(this.#host, "swipeDistance"));
      if (!isLong || Math.abs(x) < swipeSlope * Math.abs(y)) return;
      if (allowsGesture(this.#host, "drag")) this.#leave(x < 0 ? 1 : -1);
    });
  }

  /** Opens the first page of the roll on the right (1) or on the left (-1) of this one. */
  #leave(way: 1 | -1): void {
    const { binding } = this.#viewer;
    const pages = this.#pagesAround(this.#openPage);
    const isOn = way * forward(binding) > 0;
    const page = isOn ? (pages.at(-1) ?? 0) + 1 : (pages[0] ?? 0) - 1;
    if (page < 1 || page > this.#source.pageCount) return;
    const [first = page] = this.#rollOf(page) === null ? [page] : this.#pagesAround(page);
    void this.#viewer.change(spreadOf(binding, first), false);
  }

  #key(event: KeyboardEvent): void {
    if (!this.#isShown || event.defaultPrevented || event.ctrlKey || event.metaKey) return;
    const [target] = event.composedPath();
    if (target instanceof Element && target.matches("input, select, textarea, [role^=menu]"))
      return;
    const down = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    const across = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (down !== undefined) this.#scroller.scrollBy({ top: down * keyStep });
    else if (across !== undefined && this.#viewer.zoomLevel > 1) {
      this.#scroller.scrollBy({ left: across * keyStep });
    } else return;
    event.preventDefault();
    event.stopImmediatePropagation();
  }

  #sheetOf(page: number): Sheet | undefined {
    return this.#sheets[page - (this.#sheets[0]?.page ?? 0)];
  }

  #report(): void {
    for (const listener of this.#listeners) listener(this.#isShown);
  }
}

const style: string = /* css */ `
.roll {
  position: absolute; inset: 0; overflow: auto; overflow-anchor: auto; color-scheme: light;
  background: var(--turnleaf-desk);
}
.roll[hidden] { display: none; }
:host([controls]) .roll { inset-block: 48px 52px; }
.roll:focus { outline: none; }
.roll:focus-visible { outline: 2px solid var(--turnleaf-accent); outline-offset: -2px; }
.roll-pages { position: relative; margin: 0 auto; }
.roll-page { aspect-ratio: 2 / 3; background: #fff; overflow: hidden; }
.roll-page canvas { display: block; width: 100%; height: 100%; }
.roll-page p { margin: 2rem; font: italic 1.05rem/1.5 Georgia, serif; color: #211d1a; }
.scrolled [part="canvas"] { visibility: hidden; }
`;
