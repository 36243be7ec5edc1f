/** A cross-fade from one spread to another, for readers who prefer reduced motion. */

/** Length of a fade, milliseconds. */
const fadeTime = 200;

/** A cross-fade over a canvas from one spread to another. Between fades it holds no memory. */
export class CrossFade {
  readonly #canvas: HTMLCanvasElement;
  readonly #rested: (from: number) => void;
  /** The spread where the first of consecutive fades began. */
  #from = 0;
  #promised: { isKeptAt: (spread: number) => boolean; resolve: (kept: boolean) => void }[] = [];
  /** The visible mix, and the picture that fades out. */
  #mix: HTMLCanvasElement | null = null;
  #before: HTMLCanvasElement | null = null;
  #start = 0;

  /** @param rested called at the end of consecutive fades with the spread where the first began */
  constructor(canvas: HTMLCanvasElement, rested: (from: number) => void) {
    this.#canvas = canvas;
    this.#rested = rested;
  }

  /** Whether a fade is under way. */
  get isOn(): boolean {
    return this.#mix !== null;
  }

  /**
   * Keeps the current picture of a spread to fade from. Call it right after a
   * frame, before the WebGL canvas is cleared.
   */
  begin(from: number): void {
    const { width, height } = this.#mix ?? this.#canvas;
    const before = document.createElement("canvas");
    [before.width, before.height] = [Math.max(width, 1), Math.max(height, 1)];
    if (width * height > 0) penOf(before).drawImage(this.#mix ?? this.#canvas, 0, 0);
    this.#before = before;
    this.#start = 0;
    if (this.#mix) return;
    this.#from = from;
    this.#mix = document.createElement("canvas");
    this.#mix.setAttribute("aria-hidden", "true");
    this.#mix.style.pointerEvents = "none";
    this.#canvas.after(this.#mix);
    // Still there for pointers and assistive technology, but not visible twice.
    this.#canvas.style.opacity = "0";
  }

  /**
   * Resolves, once the fade is over, to the result of `isKeptAt` for the spread
   * where the book lies then.
   */
  promise(isKeptAt: (spread: number) => boolean): Promise<boolean> {
    return new Promise((resolve) => this.#promised.push({ isKeptAt, resolve }));
  }

  /**
   * Mixes the frame just drawn with the picture before; ends by itself.
   *
   * @param now time of the animation frame
   * @param spread where the book lies
   */
  step(now: number, spread: number): void {
    const [mix, before] = [this.#mix, this.#before];
    if (mix === null || before === null) return;
    this.#start ||= now;
    const fraction = (now - this.#start) / fadeTime;
    if (fraction >= 1) {
      this.#clear();
      // What a listener requests belongs to the fade after this one.
      const promised = this.#takePromises();
      this.#rested(this.#from);
      for (const { isKeptAt, resolve } of promised) resolve(isKeptAt(spread));
      return;
    }
    [mix.width, mix.height] = [this.#canvas.width, this.#canvas.height];
    if (mix.width * mix.height === 0) return;
    const pen = penOf(mix);
    pen.globalAlpha = 1 - fraction;
    pen.drawImage(before, 0, 0, mix.width, mix.height);
    // Adds light, so that what is in both pictures does not fade on the way.
    pen.globalCompositeOperation = "lighter";
    pen.globalAlpha = fraction;
    pen.drawImage(this.#canvas, 0, 0);
  }

  /** Shows the canvas itself at once; pending promises resolve to false. */
  close(): void {
    this.#clear();
    for (const { resolve } of this.#takePromises()) resolve(false);
  }

  #takePromises() {
    const promised = this.#promised;
    this.#promised = [];
    return promised;
  }

  #clear(): void {
    this.#canvas.style.opacity = "";
    this.#mix?.remove();
    for (const canvas of [this.#mix, this.#before]) if (canvas) canvas.width = canvas.height = 0;
    this.#mix = this.#before = null;
  }
}

function penOf(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
  return canvas.getContext("2d") as CanvasRenderingContext2D;
}
