/** Detects double taps: presses that end where they began, one after the other, close together. */

/** Maximum time between two, milliseconds. */
export const soon = 350;

/** Maximum distance, CSS pixels: a finger is less precise than a mouse. */
const near = { mouse: 6, other: 28 };

interface Tap {
  readonly x: number;
  readonly y: number;
  readonly time: number;
  readonly kind: string;
}

/** Detects the second of two taps. */
export class Taps {
  #last: Tap | null = null;

  /** Records a tap. Returns whether it is the second of a double tap. */
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

  /** Forgets the previous tap. */
  forget(): void {
    this.#last = null;
  }
}
