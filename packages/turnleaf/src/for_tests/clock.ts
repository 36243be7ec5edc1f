/**
 * The clock of the browser tests. It takes the window's animation frames and times over for a whole
 * file: a frame comes a sixtieth of a second after the one before, however busy the machine is, and as
 * soon as the browser has had a task between them, so that a turn of a second takes as long as its work.
 */

import { expect } from "vitest";

/** Time between two frames, milliseconds. */
const frameTime = 1000 / 60;

/**
 * The real time, milliseconds, after which what is waited for is given up: less than the time that a
 * test may take, so that it says what it waited for.
 */
const patience = 50_000;

/** The real time between two looks at what is waited for while no frame is requested, milliseconds. */
const idleTime = 4;

const realTime = performance.now.bind(performance);
const realTimeout = setTimeout.bind(globalThis);

const requests = new Map<number, FrameRequestCallback>();
const tasks = new MessageChannel();
const waiting: (() => void)[] = [];
let count = 0;
let drawn = 0;
let isHeld = false;
let hasTask = false;

tasks.port1.onmessage = () => {
  const resolve = waiting.shift();
  if (resolve) resolve();
  else {
    hasTask = false;
    if (!isHeld) frame();
  }
};

/** Has the next frame drawn in a task of its own. */
function schedule(): void {
  if (isHeld || hasTask || requests.size === 0) return;
  hasTask = true;
  tasks.port2.postMessage(null);
}

function frame(): void {
  clock.now += frameTime;
  drawn++;
  const calls = [...requests.values()];
  requests.clear();
  for (const call of calls) {
    try {
      call(clock.now);
    } catch (error) {
      reportError(error);
    }
  }
  schedule();
}

/** Lets the browser do what it has to do: pictures and promises arrive as they would. */
function task(): Promise<void> {
  return new Promise((resolve) => {
    // While nothing moves, what is waited for comes from elsewhere, to which the processor is left.
    if (requests.size === 0) realTimeout(resolve, idleTime);
    else {
      waiting.push(resolve);
      tasks.port2.postMessage(null);
    }
  });
}

/** The window's animation frames and times. */
export const clock = {
  /** The current time, milliseconds. */
  now: realTime() as number,

  /** Whether a frame has been requested. */
  get isAsked(): boolean {
    return requests.size > 0;
  },

  /** How many frames have been drawn. */
  get drawn(): number {
    return drawn;
  },

  /** Has frames drawn from now on only when `frames`, `until` or `eventually` ask for them. */
  hold(): void {
    isHeld = true;
  },

  /** Has frames drawn whenever they are requested. */
  run(): void {
    isHeld = false;
    schedule();
  },

  /** Draws some frames at once, and calls `look` after each of them. */
  frames(count: number, look: () => void = () => undefined): void {
    for (let k = 0; k < count; k++) {
      frame();
      look();
    }
  },

  /** Lets milliseconds pass, with the frames that are requested meanwhile and a task after each. */
  async pass(milliseconds: number): Promise<void> {
    const end = clock.now + milliseconds;
    while (clock.now < end) {
      frame();
      await task();
    }
  },

  /**
   * Draws frames until a condition holds, with a task of the browser between them. While no frame is
   * requested, no time passes.
   */
  async until(condition: () => boolean): Promise<void> {
    await stepUntil(() => {
      if (!condition()) throw new Error(`Waited in vain for ${condition}`);
    });
  },
};

/**
 * Asserts what will be: `await eventually(() => book.page).toBe(3)`. Takes what `expect` takes, and
 * draws frames until that holds.
 */
export function eventually<T>(get: () => T): ReturnType<typeof expect.poll<T>> {
  const along = (path: readonly string[]): unknown =>
    new Proxy(() => undefined, {
      get: (_, name: string) => along([...path, name]),
      apply: (_, __, expected: readonly unknown[]) =>
        stepUntil(async () => {
          const assertion = path
            .slice(0, -1)
            .reduce((at, name) => Reflect.get(at, name), expect(await get()) as object);
          return Reflect.get(assertion, path.at(-1) as string).apply(assertion, expected);
        }),
    });
  return along([]) as ReturnType<typeof expect.poll<T>>;
}

/** Draws frames until `check` throws no more. Rejects with what it throws once it has done so for too long. */
async function stepUntil(check: () => unknown): Promise<void> {
  const wasHeld = isHeld;
  const start = realTime();
  isHeld = true;
  try {
    for (;;) {
      try {
        await check();
        return;
      } catch (error) {
        if (realTime() - start > patience) throw error;
      }
      if (requests.size > 0) frame();
      await task();
    }
  } finally {
    isHeld = wasHeld;
    schedule();
  }
}

/** Takes the window's animation frames and times over, for as long as the page lives. */
export function installClock(): void {
  window.requestAnimationFrame = (call) => {
    requests.set(++count, call);
    schedule();
    return count;
  };
  window.cancelAnimationFrame = (request) => {
    requests.delete(request);
  };
  performance.now = () => clock.now;
  Object.defineProperty(Event.prototype, "timeStamp", { get: () => clock.now, configurable: true });
}
