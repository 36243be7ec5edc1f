/**
 * The wheel: zoom with Ctrl or by pinching a trackpad, pan while zoomed, turn
 * where nothing scrolls.
 */

import { forward } from "../book/spreads.ts";
import type { Place } from "../stage/book_stage.ts";
import type { InputTarget } from "./target.ts";

/** CSS pixels of a line, for wheels that count in lines. */
const line = 16;

/**
 * Zoom per pixel of a pinch, as an exponent, and the maximum of pixels that one
 * event counts for.
 */
const zoomRate = 0.009;
const mostZoomStep = 40;

/** From this many pixels on an event is a notch of a wheel, and turns a leaf by itself. */
const notch = 90;

/** Pixels of a smooth wheel that turn a leaf. */
const swipe = 60;

/**
 * Minimum time between two leaves, and the pause that separates one swipe from
 * the next, milliseconds.
 */
const leastApart = 120;
const pause = 150;

/** Duration of a zoom or pan by wheel, seconds: wheels go in steps. */
const glide = 0.12;

/** The wheel over one book. */
export class Wheel {
  readonly #target: InputTarget;
  #sum = 0;
  /** When the last event came and the last leaf was turned, and whether this swipe has turned one. */
  #last = Number.NEGATIVE_INFINITY;
  #turned = Number.NEGATIVE_INFINITY;
  #isSpent = false;

  constructor(target: InputTarget) {
    this.#target = target;
  }

  /**
   * Handles an event at a place on the canvas. An event that it uses does not scroll the page.
   *
   * @param back returns the place so many pixels of the window to the left and above; null if the
   * book is seen edge-on
   */
  roll(event: WheelEvent, at: Place, back: (x: number, y: number) => Place | null): void {
    if (event.defaultPrevented) return;
    const { viewer, allows } = this.#target;
    const unit = event.deltaMode === 0 ? 1 : event.deltaMode === 1 ? line : 20 * line;
    const [x, y] = [event.deltaX * unit, event.deltaY * unit];
    const seconds = this.#target.calm() ? 0 : glide;
    if (event.ctrlKey || event.metaKey) {
      if (!allows("zoom")) return;
      const step = Math.min(Math.max(y, -mostZoomStep), mostZoomStep);
      viewer.zoom(viewer.zoomLevel * Math.exp(-zoomRate * step), at, at, seconds);
    } else if (viewer.zoomLevel > 1) {
      viewer.zoom(viewer.zoomLevel, at, back(x, y) ?? at, seconds);
    } else if (!allows("wheel") || !this.#turn(event, x, y)) return;
    event.preventDefault();
  }

  /** Turns leaves. Returns whether the event is the book's. */
  #turn(event: WheelEvent, x: number, y: number): boolean {
    const isAcross = Math.abs(x) > Math.abs(y);
    if (!isAcross && scrolls(event)) return false;
    const { viewer, plane } = this.#target;
    // A page that is mirrored or upside down still goes where the fingers do.
    const along = plane.xAxis === "left" ? -x : x;
    const delta = isAcross ? along * forward(viewer.binding) : y;
    const time = event.timeStamp;
    const isNotch = event.deltaMode !== 0 || Math.abs(delta) >= notch;
    if (time - this.#last > pause || delta * this.#sum < 0) {
      this.#sum = 0;
      this.#isSpent = false;
    }
    this.#last = time;
    this.#sum += delta;
    // A trackpad continues by itself after a swipe: that turns no more leaves.
    const isEnough = isNotch || (!this.#isSpent && Math.abs(this.#sum) >= swipe);
    if (isEnough && time - this.#turned >= leastApart) {
      this.#isSpent = true;
      this.#turned = time;
      this.#target.turn(delta > 0 ? 1 : -1);
    }
    return true;
  }
}

/**
 * Returns whether the wheel would scroll an element around the book, up to the
 * one that fills the screen.
 */
function scrolls(event: WheelEvent): boolean {
  const { fullscreenElement, scrollingElement } = document;
  for (const node of event.composedPath()) {
    if (!(node instanceof Element)) continue;
    if (node === fullscreenElement) return false;
    if (node.scrollHeight <= node.clientHeight + 1) continue;
    if (node === scrollingElement) return getComputedStyle(node).overflowY !== "hidden";
    if (/auto|scroll/.test(getComputedStyle(node).overflowY)) return true;
  }
  return false;
}
