/**
 * What the times of the screen's frames mean: how many ticks the engine steps,
 * and how well the next frame is drawn. They are the viewer's only clock.
 */

/** Time since the last frame, in seconds, above which a frame is late. */
const lateFrame = 0.1;

/**
 * Lateness, in seconds, that a movement takes as its own: it goes on slower instead of leaping, as
 * where the first frame compiles what draws. Later frames leap, so that a turn takes no longer than
 * this beyond its duration, however slow the machine is.
 */
const mostSlack = 0.2;

/**
 * Maximum time, in milliseconds, for which a book's first frame waits for the bitmaps of its open
 * pages where the processor draws. A frame without them takes longer than that, and they would wait
 * for it.
 */
export const firstFrameWait: number = 1000 * mostSlack;

/** Maximum time of one frame, in seconds: a page that was hidden comes back to a turn that has ended. */
const longestFrame = 1;

/**
 * Ticks in a frame, at most, of a sheet that was torn out or is the flap of a fold-out: on a machine
 * that is slower it moves slower.
 */
export const mostSheetTicks = 12;

/**
 * Ticks from one place of a sheet's motion to the next where a command moves it, as many as a frame
 * at 60 Hz has. Moved on by those of a late frame at once it would be thrown.
 */
const moveTicks = 2;

/**
 * Time in a frame, in milliseconds, after which sheets are stepped by no more ticks than a frame at
 * 30 Hz has. Where steps take longer than the time that they step, as a sheet's that is crumpled may,
 * each frame would else be later than the one before.
 */
const sheetTime = 1000 / 60;

/**
 * Steps sheets by the whole ticks of a frame, in parts of at most two.
 *
 * @param step steps by so many ticks, and returns whether anything goes on moving
 * @param now the time, in milliseconds
 * @returns what the last step returned
 */
export function stepSheets(
  ticks: number,
  step: (ticks: number) => boolean,
  now: () => number = () => performance.now(),
): boolean {
  const start = now();
  const most = Math.min(ticks, mostSheetTicks);
  let done = 0;
  let goesOn: boolean;
  do {
    const some = Math.min(most - done, moveTicks);
    goesOn = step(some);
    done += some;
  } while (done < most && (done < 2 * moveTicks || now() - start < sheetTime));
  return goesOn;
}

/** Counts the whole ticks from frame to frame while something moves. */
export class TickCounter {
  readonly #tick: number;
  #lastTime: number | null = null;
  #stoppedAt: number | null = null;
  #remainder = 0;
  #slack = mostSlack;

  /** @param tick length of a tick in seconds */
  constructor(tick: number) {
    this.#tick = tick;
  }

  /**
   * Returns the whole ticks since the last frame, 0 or more: none in the first
   * frame of a movement, nor for a frame whose time is not a number or not
   * later than the last one's.
   *
   * @param now time of the animation frame in milliseconds
   */
  count(now: number): number {
    if (!Number.isFinite(now)) return 0;
    const since = this.#lastTime === null ? 0 : (now - this.#lastTime) / 1000;
    const seconds = Math.min(Math.max(since, 0), longestFrame);
    const absorbed = Math.min(Math.max(seconds - lateFrame, 0), this.#slack);
    this.#slack -= absorbed;
    this.#lastTime = now;
    this.#remainder += (seconds - absorbed) / this.#tick;
    const ticks = Math.floor(this.#remainder);
    this.#remainder -= ticks;
    return ticks;
  }

  /**
   * Returns the seconds since the last movement ended, if this is the first frame of another; else 0.
   *
   * @param now time of the animation frame in milliseconds
   */
  rested(now: number): number {
    if (this.#stoppedAt === null) return 0;
    const seconds = (now - this.#stoppedAt) / 1000;
    this.#stoppedAt = null;
    return Math.max(seconds, 0);
  }

  /** Ends the movement: the next frame is the first of another. */
  stop(): void {
    this.#stoppedAt = this.#lastTime;
    this.#lastTime = null;
    this.#remainder = 0;
    this.#slack = mostSlack;
  }
}

/** The settings with which a frame of a movement is drawn. */
export interface Quality {
  /** Fraction of the screen's pixel ratio. */
  readonly pixels: number;
  /** If true, shadows between leaves are computed only in every other frame. */
  readonly roughly: boolean;
}

/** From the best to the lowest. */
const steps: readonly Quality[] = [
  { pixels: 1, roughly: false },
  { pixels: 1, roughly: true },
  { pixels: 0.75, roughly: true },
  { pixels: 0.55, roughly: true },
];

/** Time between two frames, in milliseconds, above which they are late: fewer than 45 a second. */
const dueAtFirst = 22;

/**
 * Frames are judged together, by their median, once they have taken the time of
 * twelve that are just in time, in milliseconds; there are at least three, so
 * that a single late one, as after the page was hidden, counts for nothing.
 */
const judgedTime = 12 * dueAtFirst;
const leastJudged = 3;

/** Minimum fraction of their time that frames must gain by a step down for it to be kept. */
const leastGain = 0.1;

/**
 * Judgements in time before a step up is tried. Each failed trial adds as many,
 * up to the maximum.
 */
const patience = 5;
const mostPatience = 8;

/** Chooses the quality of moving frames. */
export class FrameQuality {
  #step: number;
  #intervals: number[] = [];
  #last = 0;
  #due = dueAtFirst;
  #inTime = 0;
  #wait = 1;
  /**
   * Time between frames before the last step down, until that one is judged;
   * and whether a step up is on trial.
   */
  #before = 0;
  #isTrial = false;

  /** @param isSlow whether to begin with fewer pixels, as where drawing is in software */
  constructor(isSlow = false) {
    this.#step = isSlow ? steps.length - 2 : 0;
  }

  /** The quality for the next frame of a movement. */
  get quality(): Quality {
    return steps[this.#step];
  }

  /** A frame of a movement, at a time in milliseconds. */
  frame(now: number): void {
    const interval = now - this.#last;
    const isFirst = this.#last === 0;
    this.#last = now;
    if (isFirst) return;
    const count = this.#intervals.push(interval);
    const time = this.#intervals.reduce((sum, one) => sum + one);
    if (count < leastJudged || time < judgedTime) return;
    const sorted = this.#intervals.sort((a, b) => a - b);
    this.#intervals = [];
    this.#judge(sorted[count >> 1]);
  }

  /** Ends the movement: the time until the next one belongs to no frame. */
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
    const last = steps.length - 1;
    if (this.#before > 0 && middle > (1 - leastGain) * this.#before) {
      if (this.#step < last) this.#step++;
      else {
        // No setting here is what takes the time: the screen itself, or the page around, is slow.
        this.#step = 0;
        this.#due = 1.3 * middle;
        this.#before = 0;
      }
      return;
    }
    // The lowest has gained what there was to gain.
    this.#before = this.#step < last ? middle : 0;
    // A frame costs about as much as it has pixels: where even the fewest are too many, all at once.
    const isFarLate = middle * steps[last].pixels ** 2 > this.#due;
    this.#step = isFarLate ? last : Math.min(this.#step + 1, last);
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
