/** Presses that end where they began: one after the other, close by, is a double one. */

/** Most time between two, milliseconds, and most distance, CSS pixels: a finger is not as sure as a mouse. */
const soon = 350;
const near = { mouse: 6, other: 28 };

interface Tap {
  readonly x: number;
  readonly y: number;
  readonly time: number;
  readonly kind: string;
}

/** Tells the second of two taps. */
export class Taps {
  #last: Tap | null = null;

  /** Takes down a tap; answers whether it is the second of a double one. */
  tap({ clientX: x, clientY: y, timeStamp: time, pointerType: kind }: PointerEvent): boolean {
    const last = this.#last;
    const reach = kind === "mouse" ? near.mouse : near.other;
    const isSecond =
      last !== null &&
      last.kind === kind &&
      time - last.time <= soon &&
      Math.hypot(x - last.x, y - last.y) <= reach;
    this.#last = isSecond ? null : { x, y, time, kind };
    return isSecond;
  }

  /** What was tapped so far counts no more. */
  forget(): void {
    this.#last = null;
  }
}
