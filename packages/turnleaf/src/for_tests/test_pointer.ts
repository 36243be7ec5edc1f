/** Simulated pointers, for tests in a browser. */

import type { TurnleafBook } from "../element.ts";
import { clock } from "./clock.ts";

/**
 * Dispatches pointer and keyboard events to one book: places in CSS pixels from
 * the element's upper left corner.
 */
export class TestPointer {
  readonly element: TurnleafBook;
  readonly canvas: HTMLCanvasElement;
  readonly stage: HTMLElement;
  /** How far the times of its events are ahead of the clock's, milliseconds. */
  #ahead = 0;

  constructor(element: TurnleafBook) {
    this.element = element;
    this.stage = element.shadowRoot?.querySelector("[part=stage]") as HTMLElement;
    this.canvas = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
    // Pointers without a device cannot be captured.
    this.canvas.setPointerCapture = () => {};
  }

  /** Dispatches a pointer event. Returns whether its default action is allowed. */
  point(name: string, x: number, y: number, more: PointerEventInit = {}): boolean {
    const { left, top } = this.element.getBoundingClientRect();
    return this.#dispatch(
      new PointerEvent(name, {
        pointerId: 1,
        pointerType: "mouse",
        isPrimary: true,
        bubbles: true,
        composed: true,
        cancelable: true,
        clientX: left + x,
        clientY: top + y,
        ...more,
      }),
    );
  }

  /** Presses and releases. */
  click(x: number, y: number, more: PointerEventInit = {}): void {
    this.point("pointerdown", x, y, more);
    this.point("pointerup", x, y, more);
  }

  /** Moves in small steps from one place to another, as fast as events are dispatched. */
  flick(from: [number, number], to: [number, number], more: PointerEventInit = {}): void {
    for (let k = 1; k <= 4; k++) {
      const [x, y] = [0, 1].map((i) => from[i] + ((to[i] - from[i]) * k) / 4);
      this.point("pointermove", x, y, more);
    }
  }

  /** Moves in small steps from one place to another, some per frame. */
  async move(
    from: [number, number],
    to: [number, number],
    more: PointerEventInit = {},
  ): Promise<void> {
    for (let k = 1; k <= 6; k++) {
      const fraction = k / 6;
      const [x, y] = [0, 1].map((i) => from[i] + (to[i] - from[i]) * fraction);
      this.point("pointermove", x, y, more);
      await clock.pass(8);
    }
  }

  /** Lets milliseconds pass before the next event, at once. */
  wait(milliseconds: number): void {
    this.#ahead += milliseconds;
  }

  /** Dispatches a wheel event. Returns whether the page around may scroll by it. */
  roll(deltaX: number, deltaY: number, more: WheelEventInit = {}): boolean {
    const { left, top } = this.element.getBoundingClientRect();
    return this.#dispatch(
      new WheelEvent("wheel", {
        deltaX,
        deltaY,
        bubbles: true,
        composed: true,
        cancelable: true,
        clientX: left + 200,
        clientY: top + 100,
        ...more,
      }),
    );
  }

  #dispatch(event: Event): boolean {
    Object.defineProperty(event, "timeStamp", { value: clock.now + this.#ahead });
    return this.canvas.dispatchEvent(event);
  }

  key(key: string): void {
    this.element.dispatchEvent(
      new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }),
    );
  }
}
