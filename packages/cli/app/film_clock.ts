/**
 * A clock that advances on command. It replaces the page's animation frames, so
 * that everything in the page moves by whole frames of the film, however long
 * each takes to draw.
 */

/** Maximum time between frames, milliseconds: at more, the viewer would lower its quality. */
const longest = 1000 / 50;

/** How often in a row a frame is asked for, while no time passes, by something that moves. */
const steady = 3;

/** The page's animation frames, under the film's control. */
export class FilmClock {
  #waiting = new Map<number, FrameRequestCallback>();
  #count = 0;
  /** When the current movement began, and the time since then, milliseconds. */
  #start = 1000;
  #passed = 0;
  /** Whether the film does not show the current frame: drawn in software, it would take a second. */
  isSkipped = false;
  /** Whether frames come by themselves, as they do in a page. */
  #isFree = true;

  constructor() {
    window.requestAnimationFrame = (call) => {
      this.#waiting.set(++this.#count, call);
      if (this.#isFree) setTimeout(() => this.#isFree && this.pass(longest), 0);
      return this.#count;
    };
    window.cancelAnimationFrame = (id) => void this.#waiting.delete(id);
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
      this.isSkipped = frame < frames || !isSeen;
      this.#call();
    }
  }

  /**
   * Calls what waits for a frame while no time passes: what moves asks for another, and nothing
   * else does.
   *
   * @param isSeen as in `pass`
   */
  stand(isSeen: boolean): void {
    this.isSkipped = !isSeen;
    this.#call();
  }

  /**
   * Returns whether anything moves, and not only asks for a frame: so does a page whose picture has come,
   * sooner or later on every machine. No time passes, and a frame at rest is drawn.
   */
  isMoving(): boolean {
    for (let count = 0; count < steady && this.isAsked; count++) this.stand(false);
    return this.isAsked;
  }

  #call(): void {
    const calls = [...this.#waiting.values()];
    this.#waiting.clear();
    const call = (): void => {
      for (const each of calls) each(this.#now);
    };
    call();
    if (!this.isSkipped || this.isAsked) return;
    // Everything came to rest in a frame that was not drawn, and nobody will request another.
    this.isSkipped = false;
    call();
  }
}
