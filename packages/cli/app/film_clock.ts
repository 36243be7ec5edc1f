/**
 * A clock that goes on when it is told to. It takes the place of the page's
 * animation frames, so that whatever moves in the page moves by whole frames of
 * the film, however long each takes to draw.
 */

/** Of frames farther apart, the viewer would take the machine for a slow one and draw worse, milliseconds. */
const longest = 1000 / 50;

/** The page's animation frames, driven by hand. */
export class FilmClock {
  #waiting = new Map<number, FrameRequestCallback>();
  #count = 0;
  /** When the movement under way began, and the time since then, milliseconds. */
  #start = 1000;
  #passed = 0;
  /** Whether the frame under way is one that nobody will see. */
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

  /** Whether a frame is asked for: something moves. */
  get isAsked(): boolean {
    return this.#waiting.size > 0;
  }

  set free(free: boolean) {
    this.#isFree = free;
    if (free && this.isAsked) setTimeout(() => this.#isFree && this.pass(longest), 0);
  }

  /** Begins a movement. Its frames are as far apart to the last bit whenever it begins. */
  begin(): void {
    this.#start = Math.ceil(this.#now);
    this.#passed = 0;
  }

  /** To a fraction that can be told apart at any time, so that differences are exact. */
  get #now(): number {
    return this.#start + Math.round(this.#passed * 1024) / 1024;
  }

  /** Lets a time pass, milliseconds; only its last frame is drawn. */
  pass(milliseconds: number): void {
    const frames = Math.ceil(milliseconds / longest);
    for (let frame = 1; frame <= frames; frame++) {
      this.#passed += milliseconds / frames;
      this.#isUnseen = frame < frames;
      const calls = [...this.#waiting.values()];
      this.#waiting.clear();
      const call = (): void => {
        for (const each of calls) each(this.#now);
      };
      call();
      if (!this.#isUnseen || this.isAsked) continue;
      // All came to rest in a frame that was not drawn, and nobody will ask for another.
      this.#isUnseen = false;
      call();
    }
  }

  /** In software a frame takes a second to draw: those that no picture is taken of are not. */
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
