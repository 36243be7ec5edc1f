/** Pointers and keys become commands to the book. */

import { turnOfKey } from "./book/layout.ts";
import { forward } from "./book/spreads.ts";
import { handCount, Side } from "./engine/phases.ts";
import type { Hold } from "./view/holding.ts";
import type { Viewer } from "./viewer.ts";

/** Share of a page next to its fore-edge, and of its height at head and foot, that a hand can take. */
const edgeZone = 0.3;
const cornerZone = { u: 0.5, v: 0.2 };

/** Movement in CSS pixels from which a press is a drag. */
const dragStart = 4;

/** A pointer that is down: the hand it stands for, where it came down, and whether it moves a leaf. */
interface Press {
  readonly hand: number;
  readonly x: number;
  readonly y: number;
  readonly hold: Hold;
  dragging: boolean;
}

/** Pointers and keys on one canvas; `destroy` takes every listener away. */
export class Input {
  readonly #canvas: HTMLCanvasElement;
  readonly #keys: HTMLElement;
  readonly #viewer: Viewer;
  readonly #turn: (by: 1 | -1) => void;
  readonly #ended = new AbortController();
  /** By the pointer's number. */
  readonly #presses = new Map<number, Press>();

  /**
   * @param keys the element whose keys turn pages
   * @param turn turns one leaf on (1) or back (-1), as the reader likes it: with a turn or without
   */
  constructor(
    canvas: HTMLCanvasElement,
    keys: HTMLElement,
    viewer: Viewer,
    turn: (by: 1 | -1) => void,
  ) {
    this.#canvas = canvas;
    this.#keys = keys;
    this.#viewer = viewer;
    this.#turn = turn;
    const { signal } = this.#ended;
    const on = (name: string, handle: (event: PointerEvent) => void) =>
      canvas.addEventListener(name, handle as EventListener, { signal });
    on("pointerdown", (event) => this.#down(event));
    on("pointermove", (event) => this.#move(event));
    on("pointerup", (event) => this.#up(event));
    on("pointercancel", (event) => this.#up(event));
    // A menu or a dialog may swallow the end of a press; nobody must be left holding a leaf.
    on("lostpointercapture", (event) => this.#up(event));
    keys.addEventListener("keydown", (event) => this.#key(event), { signal });
  }

  /** Takes every listener away. */
  destroy(): void {
    this.#ended.abort();
  }

  #down(event: PointerEvent): void {
    const hand = this.#freeHand();
    if (hand === null || this.#presses.has(event.pointerId) || event.button !== 0) return;
    const { x, y } = this.#place(event);
    const hold = this.#viewer.pick(x, y);
    if (hold === null || !canTake(hold)) return;
    // A leaf already turning is caught at once, where it is.
    const dragging = isFlying(hold) && this.#viewer.grab(hold, hand);
    this.#presses.set(event.pointerId, { hand, x, y, hold, dragging });
    this.#canvas.setPointerCapture(event.pointerId);
    if (dragging) this.#viewer.drag(hand, x, y);
  }

  #move(event: PointerEvent): void {
    const { x, y } = this.#place(event);
    const press = this.#presses.get(event.pointerId);
    if (press === undefined) {
      const hold = event.pointerType === "mouse" ? this.#viewer.pick(x, y) : null;
      this.#canvas.style.cursor = hold !== null && canTake(hold) ? "grab" : "";
      return;
    }
    if (!press.dragging && Math.hypot(x - press.x, y - press.y) > dragStart) {
      press.dragging = this.#viewer.grab(press.hold, press.hand);
      this.#canvas.style.cursor = "grabbing";
    }
    if (press.dragging) this.#viewer.drag(press.hand, x, y);
  }

  #up(event: PointerEvent): void {
    const press = this.#presses.get(event.pointerId);
    if (press === undefined) return;
    this.#presses.delete(event.pointerId);
    this.#canvas.style.cursor = "";
    if (press.dragging) {
      this.#viewer.release(press.hand);
    } else if (event.type === "pointerup" && !isFlying(press.hold)) {
      const way = forward(this.#viewer.binding);
      this.#turn(press.hold.on === Side.right ? way : (-way as 1 | -1));
    }
  }

  /** A hand that no pointer stands for, or null. */
  #freeHand(): number | null {
    const taken = new Set([...this.#presses.values()].map(({ hand }) => hand));
    for (let hand = 0; hand < handCount; hand++) if (!taken.has(hand)) return hand;
    return null;
  }

  #key(event: KeyboardEvent): void {
    if (event.defaultPrevented || event.altKey || event.ctrlKey || event.metaKey) return;
    if (!this.#isMeant(event.composedPath()[0])) return;
    const by = turnOfKey(event.key, this.#viewer.binding.edge);
    if (by === 0) return;
    event.preventDefault();
    this.#turn(by);
  }

  /** Whether a key pressed there is the book's: not a field's on a page, nor one of the controls beside it. */
  #isMeant(target: EventTarget | undefined): boolean {
    if (target === this.#keys) return true;
    const isField = target instanceof Element && target.matches("input, textarea, select");
    return !isField && (this.#canvas.parentElement?.contains(target as Node) ?? false);
  }

  /** Where a pointer is on the canvas, CSS pixels. */
  #place(event: PointerEvent): { x: number; y: number } {
    const box = this.#canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }
}

/** Whether it is a place on what is in flight rather than on a resting page. */
function isFlying(hold: Hold): boolean {
  return typeof hold.on !== "number";
}

/** Whether a hand takes hold there: at an edge or a corner; of a leaf in flight, anywhere. */
function canTake(hold: Hold): boolean {
  if (isFlying(hold) || hold.u > 1 - edgeZone) return true;
  return hold.u > 1 - cornerZone.u && Math.abs(hold.v - 0.5) > 0.5 - cornerZone.v;
}
