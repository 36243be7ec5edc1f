/** A cover board that swings about the spine: held, falling, or played. */

import { isResting, Phase, Side } from "../engine/phases.ts";
import { speedTime } from "./peel.ts";

/** Time in seconds in which a released board would swing from side to side. */
const fallSeconds = 0.6;

/** A board's angle from the right-hand side, radians, and its destination. */
export class Swing {
  angle = 0;
  #way: { from: number; to: Side; seconds: number; time: number; isFall: boolean } | null = null;
  #isHeld = false;
  /** For how many seconds it has been held at its angle. */
  #stillFor = 0;

  /** Whether it rests, or has been held still for as long as a leaf's speed is measured. */
  get isAsleep(): boolean {
    return this.#isHeld ? this.#stillFor >= speedTime : isResting(this.phase);
  }

  get phase(): Phase {
    if (this.#isHeld) return Phase.held;
    const way = this.#way;
    if (way === null) return this.angle > 1 ? Phase.restingLeft : Phase.restingRight;
    if (way.isFall) return way.to === Side.left ? Phase.fallingLeft : Phase.fallingRight;
    return way.to === Side.left ? Phase.playingLeft : Phase.playingRight;
  }

  /** Puts it down on a side at once. */
  lay(side: Side): void {
    this.#way = null;
    this.#isHeld = false;
    this.angle = angleOf(side);
  }

  /** Holds it at an angle. */
  hold(angle: number): void {
    const to = Math.min(Math.max(angle, 0), Math.PI);
    if (!this.#isHeld || to !== this.angle) this.#stillFor = 0;
    this.#way = null;
    this.#isHeld = true;
    this.angle = to;
  }

  /** Releases it: it falls to the nearer side. */
  release(): void {
    if (this.#isHeld)
      this.send(this.angle > Math.PI / 2 ? Side.left : Side.right, fallSeconds, true);
  }

  /** Swings it to a side, `seconds` for a whole half turn. */
  send(to: Side, seconds: number, isFall = false): void {
    this.#isHeld = false;
    const fraction = Math.abs(angleOf(to) - this.angle) / Math.PI;
    this.#way = {
      from: this.angle,
      to,
      seconds: Math.max(seconds * fraction, 0.1),
      time: 0,
      isFall,
    };
  }

  /** Advances by a time in seconds. */
  step(seconds: number): void {
    this.#stillFor += seconds;
    const way = this.#way;
    if (way === null) return;
    way.time += seconds;
    const t = Math.min(way.time / way.seconds, 1);
    const fraction = way.isFall ? t * t : t * t * (3 - 2 * t);
    this.angle = way.from + (angleOf(way.to) - way.from) * fraction;
    if (t < 1) return;
    this.angle = angleOf(way.to);
    this.#way = null;
  }
}

function angleOf(side: Side): number {
  return side === Side.left ? Math.PI : 0;
}
