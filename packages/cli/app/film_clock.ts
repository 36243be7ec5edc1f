/**
 * A clock that advances on command. It replaces the page's animation frames, so
 * that everything in the page moves by whole frames of the film, however long
 * each takes to draw.
 */

/** Maximum time between frames, milliseconds: at more, the viewer would lower its quality. */
const longest = 1000 / 50;

/** The page's animation frames, under the film's control. */
export class FilmClock {
  #waiting = new Map<number, FrameRequestCallback>();
  #count = 0;
  /** When the current movement began, and the time since then, milliseconds. */
  #start = 1000;
  #passed = 0;
  /** Whether the current frame will not be seen. */
  #isUnseen = false;
  /** Whether frames come by themselves, as they do in a page. */
  #isFree = true;

  constructor() {
    window.requestAnimationFrame = (call) => {
      this.#waiting.set(++this.#count, call);
      if (this.#isFree) setTimeout(() => this.#isFree && this.pass(longest), 0);
      return this.#count;
    };
    window.cancelAnimationFrame = (id) => void this.#waiting.delete(id);
    this.#skipUnseen();
  }

  /** Whether a frame is requested: something moves. */
  get isAsked(): boolean {
    return this.#waiting.size > 0;
  }

  set free(free: boolean) {
    this.#isFree = free;
    if (free && this.isAsked) setTimeout(() => this.#isFree && this.pass(longest), 0);
  }

  /** Begins a movement. Its frames are equally spaced to the last bit, whenever it begins. */
  begin(): void {
    this.#start = Math.ceil(this.#now);
    this.#passed = 0;
  }

  /** Rounded so that differences are exact at any time. */
  get #now(): number {
    return this.#start + Math.round(this.#passed * 1024) / 1024;
  }

  /**
   * Advances by a time, milliseconds; only its last frame is drawn.
   *
   * @param isSeen false if that is drawn only where everything comes to rest in it
   */
  pass(milliseconds: number, isSeen = true): void {
    const frames = Math.ceil(milliseconds / longest);
    for (let frame = 1; frame <= frames; frame++) {
      this.#passed += milliseconds / frames;
      this.#isUnseen = frame < frames || !isSeen;
      this.#call();
    }
  }

  /**
   * Calls what waits for a frame while no time passes: what moves asks for another, and nothing
   * else does.
   *
   * @param isSeen as in `pass`: a frame that is not drawn leaves the picture empty
   */
  stand(isSeen: boolean): void {
    this.#isUnseen = !isSeen;
    this.#call();
  }

  #call(): void {
    const calls = [...this.#waiting.values()];
    this.#waiting.clear();
    const call = (): void => {
      for (const each of calls) each(this.#now);
    };
    call();
    if (!this.#isUnseen || this.isAsked) return;
    // Everything came to rest in a frame that was not drawn, and nobody will request another.
    this.#isUnseen = false;
    call();
  }

  /** Software rendering takes a second per frame: frames without a picture are not drawn. */
  #skipUnseen(): void {
    const { prototype } = WebGL2RenderingContext;
    for (const name of ["drawElements", "drawArrays"] as const) {
      const draw = prototype[name] as (...what: number[]) => void;
      Object.assign(prototype, {
        [name]: ((clock) =>
          function (this: WebGL2RenderingContext, ...what: number[]) {
            if (!clock.#isUnseen) draw.apply(this, what);
          })(this),
      });
    }
  }
}
