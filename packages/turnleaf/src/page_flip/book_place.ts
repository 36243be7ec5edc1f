/**
 * Where a book lies in its host. page-flip's rectangle is the open book to the
 * pixel; the element needs room around it for leaves in the air. So the element
 * is larger than the rectangle and lies so that its open book fills that. At rest
 * it is clipped, so that it takes no clicks from what stands beside the book.
 */

import type { TurnleafBook } from "../index.ts";
import { LentStyle } from "./lent_style.ts";
import type { FlipSetting } from "./settings.ts";

/** Where a book is in its host, CSS pixels. */
export interface PageRect {
  /** Of the two-page spread; with one page, that of the empty half beside it. */
  left: number;
  top: number;
  /** Of two pages. */
  width: number;
  height: number;
  pageWidth: number;
}

/** page-flip's words for one page and two. */
export type Orientation = "portrait" | "landscape";

/** The element's size over the open book's before that is known, across and along. */
const firstScale = { x: 1 / 0.9, y: 1 / 0.81 };

/** How much of the shadow around a resting book is seen, CSS pixels. */
const restingMargin = 6;

/** The boxes of one book in its host. */
export class BookPlace {
  private readonly host: HTMLElement;
  private readonly book: TurnleafBook;
  private readonly settings: FlipSetting;
  private readonly lent: LentStyle;
  private readonly wrapper: HTMLElement = document.createElement("div");
  private readonly block: HTMLElement = document.createElement("div");
  private readonly resized: ResizeObserver;
  private shownOrientation: Orientation | null = null;
  /** Where the open book lies in the element, as fractions of that. */
  private inside: { x: number; y: number; width: number; height: number } | null = null;
  private isStill = true;

  /** @param resized called when the host has another size */
  constructor(host: HTMLElement, book: TurnleafBook, settings: FlipSetting, resized: () => void) {
    this.host = host;
    this.book = book;
    this.settings = settings;
    this.lent = new LentStyle(host);
    this.wrapper.className = "stf__wrapper";
    this.block.className = "stf__block";
    this.block.style.cssText = "position: absolute; inset: 0; box-sizing: border-box";
    book.style.cssText = "position: absolute; min-height: 0; margin: 0";
    this.wrapper.style.zIndex = String(settings.startZIndex);
    this.styleHost();
    // A key that the book takes is not also one of the web page's that turns the book.
    this.wrapper.addEventListener("keydown", (event) => {
      if (event.defaultPrevented) event.stopPropagation();
    });
    this.block.append(book);
    this.wrapper.append(this.block);
    host.prepend(this.wrapper);
    // In the next frame: what changes the size of what is observed is a loop.
    this.resized = new ResizeObserver(() => requestAnimationFrame(resized));
    this.resized.observe(this.block);
  }

  /** Gives the host back as it was. */
  remove(): void {
    this.resized.disconnect();
    this.wrapper.remove();
    this.lent.restore();
  }

  /** Whether the book is in its host still: others may have emptied that. */
  get isInHost(): boolean {
    return this.host.contains(this.book);
  }

  /** One page or two, as the host's width is now. */
  get orientation(): Orientation {
    const { size, usePortrait, width, minWidth } = this.settings;
    const least = 2 * (size === "stretch" ? minWidth : width);
    return usePortrait && this.block.offsetWidth < least ? "portrait" : "landscape";
  }

  /** Where the book is in its host. */
  get rect(): PageRect {
    const { size, width, height, maxWidth } = this.settings;
    const { offsetWidth, offsetHeight } = this.block;
    const isPortrait = this.orientation === "portrait";
    let pageWidth = width;
    let pageHeight = height;
    if (size === "stretch") {
      pageWidth = Math.min(isPortrait ? offsetWidth : offsetWidth / 2, maxWidth);
      pageHeight = (pageWidth * height) / width;
      if (pageHeight > offsetHeight) {
        pageHeight = offsetHeight;
        pageWidth = (pageHeight * width) / height;
      }
    }
    return {
      left: offsetWidth / 2 - (isPortrait ? 1.5 : 1) * pageWidth,
      top: (offsetHeight - pageHeight) / 2,
      width: 2 * pageWidth,
      height: pageHeight,
      pageWidth,
    };
  }

  /** Fits everything to the host. Returns whether the orientation has changed. */
  fit(): boolean {
    const { orientation } = this;
    const isChanged = orientation !== this.shownOrientation;
    if (isChanged) {
      this.shownOrientation = orientation;
      this.inside = null;
      this.styleWrapper(orientation);
      this.book.layout = orientation === "portrait" ? "single" : "spread";
    }
    this.layElement();
    return isChanged;
  }

  /** Lays the element so that its open book fills the rectangle, once that is known. */
  measure(): void {
    const bounds = this.book.bookBounds;
    const { clientWidth, clientHeight } = this.book;
    if (!bounds || !(bounds.width > 0 && clientWidth > 0 && clientHeight > 0)) return;
    this.inside = {
      x: bounds.x / clientWidth,
      y: bounds.y / clientHeight,
      width: bounds.width / clientWidth,
      height: bounds.height / clientHeight,
    };
    this.layElement();
  }

  /** Whether nothing moves, so that only the book itself is to be seen. */
  set isResting(isResting: boolean) {
    if (isResting === this.isStill) return;
    this.isStill = isResting;
    this.layElement();
  }

  private layElement(): void {
    const { left, top, width, height, pageWidth } = this.rect;
    const isPortrait = this.shownOrientation === "portrait";
    const target = {
      x: isPortrait ? left + pageWidth : left,
      width: isPortrait ? pageWidth : width,
    };
    const { style } = this.book;
    const [elementWidth, elementHeight] = [firstScale.x * target.width, firstScale.y * height];
    const inside = this.inside ?? {
      x: (1 - 1 / firstScale.x) / 2,
      y: (1 - 1 / firstScale.y) / 2,
      width: 1 / firstScale.x,
      height: 1 / firstScale.y,
    };
    // Pages of other proportions than the options say keep theirs.
    const scale = Math.min(
      target.width / (inside.width * elementWidth),
      height / (inside.height * elementHeight),
    );
    const [w, h] = [scale * elementWidth, scale * elementHeight];
    const x = target.x + target.width / 2 - (inside.x + inside.width / 2) * w;
    const y = top + height / 2 - (inside.y + inside.height / 2) * h;
    style.left = `${x}px`;
    style.top = `${y}px`;
    style.width = `${w}px`;
    style.height = `${h}px`;
    const sides = [
      inside.y * h,
      (1 - inside.x - inside.width) * w,
      (1 - inside.y - inside.height) * h,
      inside.x * w,
    ];
    const clip = sides.map((side) => `${Math.max(0, side - restingMargin)}px`).join(" ");
    style.clipPath = this.isStill && this.inside ? `inset(${clip})` : "";
  }

  private styleHost(): void {
    const { minWidth, minHeight, maxWidth, usePortrait, autoSize } = this.settings;
    const { mobileScrollSupport, useMouseEvents } = this.settings;
    this.lent.wear(["stf__parent"]);
    this.lent.style({
      position: "relative",
      display: "block",
      "box-sizing": "border-box",
      "min-width": `${minWidth * (usePortrait ? 1 : 2)}px`,
      "min-height": `${minHeight}px`,
      "touch-action": mobileScrollSupport ? "pan-y" : "none",
      // A mouse drags pages wherever it takes them, also by their text.
      ...(useMouseEvents && { "user-select": "none" }),
      ...(autoSize && { width: "100%", "max-width": `${2 * maxWidth}px` }),
    });
  }

  private styleWrapper(orientation: Orientation): void {
    const { classList, style } = this.wrapper;
    classList.remove("--portrait", "--landscape");
    classList.add(`--${orientation}`);
    const { autoSize, width, height } = this.settings;
    const across = orientation === "portrait" ? width : 2 * width;
    if (autoSize) style.paddingBottom = `${(100 * height) / across}%`;
  }
}
