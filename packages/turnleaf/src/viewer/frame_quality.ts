/**
 * How well frames are drawn while something moves: worse by itself where they
 * come late, and better again where they come in time. What rests is always
 * drawn as well as it can be. Knows no clock but the frames it is told of.
 */

/** What a frame of a movement is drawn with. */
export interface Quality {
  /** Share of the screen's pixel ratio. */
  readonly pixels: number;
  /** Whether shadows between leaves are found anew in every other frame alone. */
  readonly roughly: boolean;
}

/** From the best to the least. */
const steps: readonly Quality[] = [
  { pixels: 1, roughly: false },
  { pixels: 1, roughly: true },
  { pixels: 0.75, roughly: true },
  { pixels: 0.55, roughly: true },
];

/** Frames that are judged together: by the middle one, so that a single late one counts for nothing. */
const judged = 12;

/** Time between two frames, milliseconds, above which they are late: fewer than 45 a second. */
const dueAtFirst = 22;

/** Longer than this nobody was looking, milliseconds. */
const absent = 250;

/** Share of their time that frames must lose by a step down for it to be of use. */
const leastGain = 0.1;

/** Judgements in time before a step up is tried; more with every one that was in vain, up to as many times more. */
const patience = 5;
const mostPatience = 8;

/** Chooses the quality of moving frames. */
export class FrameQuality {
  #step = 0;
  #intervals: number[] = [];
  #last = 0;
  #due = dueAtFirst;
  #inTime = 0;
  #wait = 1;
  /** Time between frames before the last step down, until that one is judged; and whether a step up is. */
  #before = 0;
  #isTrial = false;

  /** The quality for the next frame of a movement. */
  get quality(): Quality {
    return steps[this.#step];
  }

  /** A frame of a movement, at a time in milliseconds. */
  frame(now: number): void {
    const interval = now - this.#last;
    const isFirst = this.#last === 0;
    this.#last = now;
    if (isFirst || interval > absent) return;
    this.#intervals.push(interval);
    if (this.#intervals.length < judged) return;
    const sorted = this.#intervals.sort((a, b) => a - b);
    this.#intervals = [];
    this.#judge(sorted[judged >> 1]);
  }

  /** The movement is over: the time until the next one is no frame's. */
  rest(): void {
    this.#last = 0;
  }

  #judge(middle: number): void {
    if (middle > this.#due) this.#worsen(middle);
    else this.#improve();
  }

  #worsen(middle: number): void {
    this.#inTime = 0;
    if (this.#isTrial) this.#wait = Math.min(2 * this.#wait, mostPatience);
    this.#isTrial = false;
    if (this.#before > 0 && middle > (1 - leastGain) * this.#before) {
      const isLast = this.#step === steps.length - 1;
      if (!isLast) this.#step++;
      else {
        // Nothing of this is what takes the time: the screen itself, or the page around, is slow.
        this.#step = 0;
        this.#due = 1.3 * middle;
        this.#before = 0;
      }
      return;
    }
    this.#before = middle;
    this.#step = Math.min(this.#step + 1, steps.length - 1);
  }

  #improve(): void {
    this.#before = 0;
    this.#inTime++;
    if (this.#isTrial && this.#inTime >= patience) {
      this.#isTrial = false;
      this.#wait = 1;
    }
    if (this.#step === 0 || this.#inTime < patience * this.#wait) return;
    this.#step--;
    this.#inTime = 0;
    this.#isTrial = true;
  }
}
