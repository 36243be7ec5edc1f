/** Converts pointer events to commands to the book, and passes on wheel and keys. */

import { sideBefore } from "../book/leaf_order.ts";
import { forward, pagesAt } from "../book/spreads.ts";
import { Side } from "../engine/phases.ts";
import type { Place } from "../stage/book_stage.ts";
import { type Dragged, type DragHit, isOnLeaf, type LeafHit, maxDrags } from "../viewer/drag.ts";
import type { Viewer } from "../viewer/viewer.ts";
import { Flick } from "./flick.ts";
import { Keys } from "./held_keys.ts";
import { keepsPointer } from "./own_pointers.ts";
import { pageZoom } from "./page_zoom.ts";
import { Pinch } from "./pinch.ts";
import { soon, Taps } from "./taps.ts";
import type { InputTarget } from "./target.ts";
import { Wheel } from "./wheel.ts";

/**
 * Fraction of a page next to its fore-edge, and of its height at head and foot,
 * where a click turns.
 */
const edgeZone = 0.3;
const cornerZone = { u: 0.5, v: 0.2 };

/** The corner that lifts under a pointer, and the larger one in which it stays up. */
const liftZone = { u: 0.16, v: 0.13 };
const stayZone = { u: 0.3, v: 0.24 };

/** Movement in CSS pixels from which a press is a drag: fingers are less precise. */
const dragStart = { mouse: 4, other: 8 };

/**
 * Minimum speed of a pointer whose release flicks the leaf over, CSS pixels per
 * millisecond; and the maximum duration of such a press, ms.
 */
const flickSpeed = 0.45;
const flickTime = 450;

/**
 * Up to when and how far, ms and CSS pixels, a finger that has begun to move a leaf is the first of a pinch if
 * a second one comes down: no two come down at once, nor lie still until both do.
 */
const pinchStart = { time: 200, distance: 24 };

/** How far a panned book glides on, in seconds of its speed, and for how long, seconds. */
const glideOn = 0.13;
const glideTime = 0.4;

/** Duration of the zoom of a double tap, seconds. */
const tapZoomTime = 0.28;

/** Maximum duration of a finger's tap, milliseconds: one that stays on text selects the word under it. */
const longestTap = 450;

/** A pointer that is down. */
interface Press extends Place {
  /** What lay under it when it went down. */
  readonly hit: DragHit | null;
  readonly kind: string;
  readonly time: number;
  readonly flick: Flick;
  /** The leaf that it moves, once it does. */
  drag: Dragged | null;
  /** Whether it caught that leaf in flight. */
  readonly caught: boolean;
  /** Whether it moves the view. */
  pans: boolean;
  /** Extends what it selects to a place of the window, once it selects. */
  extend: ((x: number, y: number) => void) | null;
  /** Its position. */
  at: Place;
  /** Where it went down and where it is in the window, whose pixels say how far a pointer has moved. */
  readonly from: Place;
  to: Place;
}

/** All pointer input on one book; `destroy` removes every listener. */
export class Input {
  readonly #canvas: HTMLCanvasElement;
  readonly #stage: HTMLElement;
  readonly #viewer: Viewer;
  readonly #target: InputTarget;
  readonly #ended = new AbortController();
  /** By the pointer's id. */
  readonly #presses = new Map<number, Press>();
  readonly #taps = new Taps();
  /** Waits for what may be the second of two taps. */
  #tapped: ReturnType<typeof setTimeout> | undefined;
  readonly #wheel: Wheel;
  #pinch: Pinch | null = null;
  #isPeeking = false;
  /** Where the last pointer was. */
  #last: Place = { x: 0, y: 0 };

  /**
   * @param stage contains the canvas and the text over it
   *
   * @param keys the element whose keys turn pages
   */
  constructor(
    canvas: HTMLCanvasElement,
    stage: HTMLElement,
    keys: HTMLElement,
    target: InputTarget,
  ) {
    this.#canvas = canvas;
    this.#stage = stage;
    this.#target = target;
    this.#viewer = target.viewer;
    this.#wheel = new Wheel(target);
    const { signal } = this.#ended;
    // In the capture phase: elements on top of the canvas have their own listeners.
    const on = (name: string, handle: (event: PointerEvent) => void) =>
      stage.addEventListener(name, handle as EventListener, { signal, capture: true });
    on("pointerdown", (event) => this.#down(event));
    on("pointermove", (event) => this.#move(event));
    on("pointerup", (event) => this.#up(event));
    on("pointercancel", (event) => this.#up(event));
    // A menu or a dialog may swallow the end of a press; no leaf must stay held.
    on("lostpointercapture", (event) => {
      if (event.target === canvas) this.#up(event);
    });
    stage.addEventListener("pointerleave", () => this.#peek(null), { signal });
    stage.addEventListener("wheel", (event) => this.#roll(event), { signal, passive: false });
    // Two fingers belong to the book; so does one on a zoomed book. Otherwise
    // the page scrolls as it likes.
    stage.addEventListener("touchmove", (event) => this.#touch(event), { signal, passive: false });
    const pressed = new Keys(keys, stage, target);
    keys.addEventListener("keydown", (event) => pressed.press(event), { signal });
    const unfollow = this.#viewer.onViewChange(() => this.#follow());
    signal.addEventListener("abort", unfollow, { once: true });
    this.#follow();
  }

  /** Removes every listener. */
  destroy(): void {
    this.#ended.abort();
    clearTimeout(this.#tapped);
    this.#stage.style.touchAction = "";
  }

  /** Lets the page scroll by drags that turn no leaf, unless they move a zoomed book. */
  #follow(): void {
    const scroll = this.#turnsAcross ? "pan-y" : "pan-x";
    this.#stage.style.touchAction = this.#viewer.zoomLevel > 1 ? "none" : scroll;
  }

  /** Whether leaves turn to the left and right of the window, rather than up and down. */
  get #turnsAcross(): boolean {
    const isAcross = /left|right/.test(this.#target.plane.xAxis);
    return isAcross !== this.#viewer.binding.quarterTurned;
  }

  #down(event: PointerEvent): void {
    const kind = event.pointerType;
    // What is around the book may have been turned since.
    this.#follow();
    if (this.#presses.has(event.pointerId) || event.button !== 0) return;
    if (keepsPointer(event, this.#stage)) return;
    const at = this.#place(event);
    if (this.#beginPinch(event, at)) return;
    if (this.#presses.size >= maxDrags || this.#pinch) return;
    const isZoomed = this.#viewer.zoomLevel > 1;
    const { drags } = this.#viewer;
    const hit = isZoomed ? null : drags.pick(at.x, at.y);
    // A finger beside the book turns it as one on its pages does.
    if (hit === null && !isZoomed && kind !== "touch") return;
    // A leaf in flight is caught at once, where it is.
    const catches = hit && drags.isFlying(hit) && this.#target.allows("drag");
    const drag = catches ? drags.grab(hit) : null;
    const flick = new Flick();
    const time = event.timeStamp;
    flick.move(at, time);
    const from = inWindow(event);
    const caught = drag !== null;
    const press: Press = {
      ...at,
      at,
      from,
      to: from,
      hit,
      kind,
      flick,
      time,
      drag,
      caught,
      pans: false,
      extend: null,
    };
    this.#presses.set(event.pointerId, press);
    this.#canvas.setPointerCapture(event.pointerId);
    drag?.move(at.x, at.y);
    if (kind === "mouse" || drag) return;
    setTimeout(() => {
      if (this.#presses.get(event.pointerId) === press) this.#select(press);
    }, longestTap);
  }

  /** Selects the word under a finger or pen that has stayed where it went down. */
  #select(press: Press): void {
    const stays = press.drag === null && !press.pans && press.extend === null && !hasMoved(press);
    if (!stays || this.#ended.signal.aborted) return;
    press.extend = this.#target.selectWord(press.from);
    if (press.extend) this.#taps.forget();
  }

  #move(event: PointerEvent): void {
    const at = this.#place(event);
    if (this.#pinch?.move(event.pointerId, at)) return;
    const press = this.#presses.get(event.pointerId);
    if (press === undefined) this.#hover(event, at);
    else {
      press.flick.move(at, event.timeStamp);
      // On a busy page it may move before the page knows that it has stayed.
      const hasStayed = press.kind !== "mouse" && event.timeStamp - press.time > longestTap;
      if (hasStayed) this.#select(press);
      press.to = inWindow(event);
      if (press.extend) press.extend(press.to.x, press.to.y);
      else if (press.drag === null && !press.pans) this.#begin(press, at, event.pointerId);
      press.drag?.move(at.x, at.y);
      if (press.pans) this.#viewer.zoom(this.#viewer.zoomLevel, press.at, at, 0);
      press.at = at;
    }
  }

  /** Makes a press that has moved a drag or a pan. */
  #begin(press: Press, at: Place, id: number): void {
    if (!hasMoved(press)) return;
    this.#taps.forget();
    if (press.hit === null) {
      if (this.#viewer.zoomLevel <= 1) return;
      press.pans = true;
      this.#viewer.handled = true;
    } else {
      if (!this.#target.allows("drag")) {
        // It is no click either.
        this.#presses.delete(id);
        return;
      }
      // Along the page's own scroll direction a finger scrolls it: the browser will say so.
      const [across, down] = [press.to.x - press.from.x, press.to.y - press.from.y].map(Math.abs);
      if (press.kind === "touch" && (this.#turnsAcross ? down > across : across > down)) return;
      press.drag = this.#viewer.drags.grab(press.hit, { x: at.x - press.x, y: at.y - press.y });
      this.#isPeeking = false;
    }
    this.#canvas.style.cursor = "grabbing";
  }

  #up(event: PointerEvent): void {
    if (this.#endPinch(event)) return;
    const press = this.#presses.get(event.pointerId);
    if (press === undefined) return;
    this.#presses.delete(event.pointerId);
    this.#canvas.style.cursor = "";
    const isDone = event.type === "pointerup";
    if (press.extend) return;
    if (press.drag) {
      this.#release(press, press.drag, isDone ? event.timeStamp : null);
      const isTap = isDone && press.drag.doubleTap !== undefined && !hasMoved(press);
      if (isTap && this.#taps.tap(event)) press.drag.doubleTap?.();
    } else if (press.pans) this.#letGlide(press, isDone ? event.timeStamp : null);
    else if (isDone && press.hit === null && hasMoved(press)) this.#swipe(press, event.timeStamp);
    else if (isDone) this.#tap(press, event);
  }

  /** Turns a leaf if a press beside the book has been a flick. */
  #swipe({ x, y, at, flick, time }: Press, now: number): void {
    const isLong = Math.hypot(at.x - x, at.y - y) >= this.#target.swipeDistance();
    const isFlick = isLong && now - time <= flickTime && this.#target.allows("drag");
    const way = isFlick ? this.#flicked(flick.velocity(now)) : 0;
    if (way !== 0) this.#target.turn((way * forward(this.#viewer.binding)) as 1 | -1);
  }

  /**
   * Releases a press: a leaf falls where it is released; a flick turns it over,
   * or one of the other side.
   */
  #release({ x, y, at, hit, flick, time }: Press, drag: Dragged, now: number | null): void {
    const isLong = Math.hypot(at.x - x, at.y - y) >= this.#target.swipeDistance();
    const isFlick = drag.canFlick && isLong && now !== null && now - time <= flickTime;
    const way = isFlick ? this.#flicked(flick.velocity(now)) : 0;
    const isOwn =
      hit === null || !isOnLeaf(hit) || sideOf(hit) === (way === 1 ? Side.right : Side.left);
    if (way !== 0 && isOwn) this.#target.turn((way * forward(this.#viewer.binding)) as 1 | -1);
    drag.release();
    if (way !== 0 && !isOwn) this.#target.turn((way * forward(this.#viewer.binding)) as 1 | -1);
  }

  /** Returns the direction in which a flick turns: 1 to the left, -1 to the right, 0 for none. */
  #flicked(velocity: Place): 1 | 0 | -1 {
    const { quarterTurned } = this.#viewer.binding;
    const along = quarterTurned ? velocity.y : velocity.x;
    const beside = quarterTurned ? velocity.x : velocity.y;
    if (Math.abs(along) < flickSpeed || Math.abs(along) < Math.abs(beside)) return 0;
    return along < 0 ? 1 : -1;
  }

  #letGlide({ at, flick }: Press, now: number | null): void {
    const { x, y } = flick.velocity(now ?? 0);
    const far = 1000 * glideOn;
    if (now !== null && Math.hypot(x, y) > 0.1 && !this.#target.calm()) {
      const to = { x: at.x + far * x, y: at.y + far * y };
      this.#viewer.zoom(this.#viewer.zoomLevel, at, to, glideTime);
    }
    this.#viewer.handled = false;
  }

  #tap({ hit, at, time }: Press, event: PointerEvent): void {
    const { allows } = this.#target;
    const isTouch = event.pointerType === "touch";
    if (isTouch && event.timeStamp - time > longestTap) return;
    const way = !allows("click") ? 0 : hit === null ? this.#besideBook(at) : this.#clicked(hit);
    const inside = way === 0;
    clearTimeout(this.#tapped);
    if (inside && allows("zoom") && this.#taps.tap(event)) {
      const { level, from, to } = pageZoom(
        this.#viewer,
        at,
        this.#canvas.clientWidth,
        this.#target.columnAt,
      );
      this.#viewer.zoom(level, from, to, this.#target.calm() ? 0 : tapZoomTime);
      return;
    }
    if (inside) {
      this.#viewer.commands.tap(at.x, at.y);
      // A second tap zooms, and leaves the bars as they are.
      if (isTouch) this.#tapped = setTimeout(this.#target.tapped, allows("zoom") ? soon : 0);
    }
    if (way === 0 || (hit && (!isOnLeaf(hit) || this.#viewer.drags.isFlying(hit)))) return;
    this.#target.turn(way, true);
  }

  /** Returns which way a tap beside the book turns in the order of reading: to its own side; 0 for nowhere. */
  #besideBook({ x }: Place): 1 | 0 | -1 {
    const { binding, turning, zoomLevel } = this.#viewer;
    if (zoomLevel > 1 || !this.#turnsAcross) return 0;
    const edges = pagesAt(binding, turning.spread).flatMap((page) =>
      [0, 1].flatMap((u) => this.#viewer.project(page, u, 0.5)?.x ?? []),
    );
    const side = x > Math.max(...edges) ? 1 : x < Math.min(...edges) ? -1 : 0;
    return (side * forward(binding)) as 1 | 0 | -1;
  }

  /**
   * Returns which way a click on a page turns in the order of reading: at its edge and its corners to
   * its own side, and beside the spine of one that is shown by itself to the other; 0 for nowhere.
   */
  #clicked(hit: DragHit): 1 | 0 | -1 {
    const { binding } = this.#viewer;
    if (!turnsByClick(hit)) return binding.layout === "single" && hit.u < edgeZone ? -1 : 0;
    const way = forward(binding);
    return isOnLeaf(hit) && sideOf(hit) === Side.right ? way : (-way as 1 | -1);
  }

  /**
   * Starts a zoom with a second finger, unless the first already turns a leaf: then it is another drag. A
   * leaf that the first has only begun to move goes back.
   */
  #beginPinch(event: PointerEvent, at: Place): boolean {
    if (event.pointerType !== "touch" || this.#pinch || !this.#target.allows("zoom")) return false;
    const other = [...this.#presses].find(
      ([, press]) =>
        press.kind === "touch" && (press.drag === null || mayPinch(press, event.timeStamp)),
    );
    if (other === undefined) return false;
    const [id, press] = other;
    this.#presses.delete(id);
    press.drag?.release();
    this.#taps.forget();
    this.#viewer.handled = true;
    this.#pinch = new Pinch(this.#viewer, [id, press.at], [event.pointerId, at]);
    this.#canvas.setPointerCapture(event.pointerId);
    return true;
  }

  #endPinch(event: PointerEvent): boolean {
    const left = this.#pinch?.pointerUp(event.pointerId) ?? null;
    if (left === null) return false;
    this.#pinch = null;
    const [id, at] = left;
    // The remaining finger continues to pan.
    if (this.#viewer.zoomLevel > 1) {
      const from = inWindow(event);
      const press = {
        ...at,
        at,
        from,
        to: from,
        hit: null,
        drag: null,
        caught: false,
        pans: true,
        extend: null,
        kind: "touch",
      };
      this.#presses.set(id, { ...press, flick: new Flick(), time: event.timeStamp });
    } else this.#viewer.handled = false;
    return true;
  }

  #touch(event: TouchEvent): void {
    const isPinch = event.touches.length >= 2 && this.#target.allows("zoom");
    // What is caught or selected follows the finger in every direction.
    const holds = [...this.#presses.values()].some(({ drag, extend }) => drag ?? extend);
    if (!event.cancelable || !(isPinch || holds || this.#viewer.zoomLevel > 1)) return;
    event.preventDefault();
  }

  /** Handles a hovering mouse or pen: its cursor, and the corner that lifts under it. */
  #hover(event: PointerEvent, at: Place): void {
    if (event.pointerType === "touch" || event.buttons !== 0 || this.#presses.size > 0) return;
    const isZoomed = this.#viewer.zoomLevel > 1;
    const isBook = event.target === this.#canvas || this.#isBarePage(event);
    const hit = isZoomed || !isBook ? null : this.#viewer.drags.pick(at.x, at.y);
    const isGrabbed = isZoomed || (hit !== null && this.#target.allows("drag"));
    this.#canvas.style.cursor = isGrabbed ? "grab" : "";
    this.#peek(hit);
  }

  /** Returns whether a pointer is on a page that is an element, where nothing on it is pressed. */
  #isBarePage(event: PointerEvent): boolean {
    const { target } = event;
    const isPage = target instanceof Element && !this.#stage.contains(target);
    return isPage && !keepsPointer(event, this.#stage);
  }

  /** Lifts the corner at a place, or lets it fall. */
  #peek(hit: DragHit | null): void {
    const zone = this.#isPeeking ? stayZone : liftZone;
    const isCorner =
      hit !== null && isOnLeaf(hit) && hit.u > 1 - zone.u && Math.abs(hit.v - 0.5) > 0.5 - zone.v;
    const lifts = isCorner && this.#target.allows("corner") && !this.#target.calm();
    if (lifts === this.#isPeeking) return;
    this.#isPeeking = this.#viewer.commands.peek(lifts ? hit : null);
  }

  /** Passes on a wheel: what it moves goes its way in the window, however the book lies there. */
  #roll(event: WheelEvent): void {
    const { plane } = this.#target;
    this.#wheel.roll(event, this.#place(event), (x, y) =>
      plane.fromClient(event.clientX - x, event.clientY - y),
    );
  }

  /** Returns where a pointer is on the canvas, CSS pixels of its own: where it was while that is seen edge-on. */
  #place({ clientX, clientY }: MouseEvent): Place {
    this.#last = this.#target.plane.fromClient(clientX, clientY) ?? this.#last;
    return this.#last;
  }
}

/** Returns where a pointer is in the window, CSS pixels. */
function inWindow({ clientX, clientY }: MouseEvent): Place {
  return { x: clientX, y: clientY };
}

/** Returns whether a press has moved so far that it is no tap. */
function hasMoved({ from, to, kind }: Press): boolean {
  return (
    Math.hypot(to.x - from.x, to.y - from.y) >
    (kind === "mouse" ? dragStart.mouse : dragStart.other)
  );
}

/** Returns whether a finger that moves a leaf has only just begun to, so that a second one makes it a pinch. */
function mayPinch({ from, to, time, caught }: Press, now: number): boolean {
  const isNear = Math.hypot(to.x - from.x, to.y - from.y) <= pinchStart.distance;
  return !caught && isNear && now - time <= pinchStart.time;
}

/** Returns the side where a leaf was grabbed. */
function sideOf({ on }: LeafHit): Side {
  return typeof on === "number" ? on : sideBefore(on);
}

/** Returns whether a click there turns the leaf: at an edge or a corner. */
function turnsByClick({ u, v }: DragHit): boolean {
  if (u > 1 - edgeZone) return true;
  return u > 1 - cornerZone.u && Math.abs(v - 0.5) > 0.5 - cornerZone.v;
}
