/**
 * The clock of the browser tests. It takes the window's animation frames, timers and times over for as
 * long as the page lives. A frame comes a sixtieth of a second after the one before, however busy the
 * machine is, and as soon as the browser has had a task between them: a turn of a second takes as long as
 * its work does. A timer ends once the frames have taken its time, and in any case once that is over on
 * the machine's clock, so that what waits for the network or a worker is not given up early; but not
 * while a test lets time pass, or holds timers, which then end by frames alone, however long they take.
 */

/** Time between two frames, milliseconds. */
const frameTime = 1000 / 60;

/**
 * The real time, milliseconds, after which what is waited for is given up: less than a test may take, so
 * that it says what it waited for.
 */
const patience = 50_000;

/** The real time between two looks at what is waited for while no frame is requested, milliseconds. */
const idleTime = 4;

const realTime = performance.now.bind(performance);
const realTimeout = globalThis.setTimeout.bind(globalThis);
const endRealTimeout = globalThis.clearTimeout.bind(globalThis);

/** A timer that has not ended. */
interface Timer {
  readonly due: number;
  readonly call: () => void;
  /** The machine's timer that ends it. */
  real: number;
}

const requests = new Map<number, FrameRequestCallback>();
const timers = new Map<number, Timer>();
const tasks = new MessageChannel();
const waiting: (() => void)[] = [];
let now = realTime();
let isInstalled = false;
let lastRequest = 0;
/** Whether a test has asked that no frame be drawn but those it asks for. */
let isHeld = false;
/** Whether a test has asked that timers end by frames alone. */
let holdsTimers = false;
/** Calls that are drawing frames of their own. They may overlap, and end in any order, even in a later test. */
let drawing = 0;
/** Calls that are letting time pass. */
let passing = 0;
let hasTask = false;

tasks.port1.onmessage = () => {
  const resolve = waiting.shift();
  if (resolve) resolve();
  else {
    hasTask = false;
    if (drawsUnasked()) frame();
  }
};

/** Returns whether frames are drawn as soon as they are requested. */
function drawsUnasked(): boolean {
  return !isHeld && drawing === 0;
}

/** Has the next frame drawn in a task of its own. */
function schedule(): void {
  if (!drawsUnasked() || hasTask || requests.size === 0) return;
  hasTask = true;
  tasks.port2.postMessage(null);
}

function frame(): void {
  now += frameTime;
  for (const [id, { due, call, real }] of [...timers]) {
    if (due > now || !timers.delete(id)) continue;
    endRealTimeout(real);
    attempt(call);
  }
  const calls = [...requests.values()];
  requests.clear();
  for (const call of calls) attempt(() => call(now));
  schedule();
}

/** Calls a listener as the browser does: what one throws keeps no other from being called. */
function attempt(call: () => void): void {
  try {
    call();
  } catch (error) {
    reportError(error);
  }
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

/** Has no frames drawn but those of `work`. */
async function whileHeld(work: () => Promise<void>): Promise<void> {
  drawing++;
  try {
    await work();
  } finally {
    drawing--;
    schedule();
  }
}

/** Draws frames until `check` throws no more. Rejects with what it throws once it has done so for too long. */
function stepUntil(check: () => unknown): Promise<void> {
  const start = realTime();
  return whileHeld(async () => {
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
  });
}

/** What tests ask of the clock. */
interface TestClock {
  /** The current time, milliseconds. */
  readonly now: number;
  /** Whether a frame has been requested. */
  readonly isAsked: boolean;
  /** Has frames drawn from now on only when the calls below ask for them. */
  hold(): void;
  /** The same, and no timer ends meanwhile: for pointers that are led by messages, which may take their time. */
  holdTimers(): void;
  /** Has frames drawn whenever they are requested. */
  run(): void;
  /** Has the frames that are requested never drawn: of what requests them for ever, once it is not looked at. */
  dropRequests(): void;
  /** Draws some frames at once, and calls `look` after each of them. */
  frames(count: number, look?: () => void): void;
  /** Lets milliseconds pass, with the frames that are requested meanwhile and a task after each. */
  pass(milliseconds: number): Promise<void>;
  /** Resolves once the browser has had a task: what was resolved before has been heard. */
  task(): Promise<void>;
  /**
   * Draws frames until a condition holds, with a task of the browser between them. While no frame is
   * requested, no time passes.
   */
  until(condition: () => boolean): Promise<void>;
  /** Draws frames, likewise, until `check` throws no more. Rejects with what it throws to the end. */
  untilPasses(check: () => unknown): Promise<void>;
}

/** The window's animation frames, timers and times; before it is installed, those of the machine. */
export const clock: TestClock = {
  get now() {
    return isInstalled ? now : realTime();
  },
  get isAsked() {
    return requests.size > 0;
  },
  hold() {
    isHeld = true;
  },
  holdTimers() {
    isHeld = true;
    holdsTimers = true;
  },
  run() {
    isHeld = false;
    holdsTimers = false;
    schedule();
  },
  dropRequests() {
    requests.clear();
  },
  frames(count, look = () => undefined) {
    for (let k = 0; k < count; k++) {
      frame();
      look();
    }
  },
  pass(milliseconds) {
    if (!isInstalled) return new Promise((resolve) => realTimeout(resolve, milliseconds));
    const end = now + milliseconds;
    return whileHeld(async () => {
      passing++;
      while (now < end) {
        frame();
        await task();
      }
      passing--;
    });
  },
  task,
  until: (condition) =>
    stepUntil(() => {
      if (!condition()) throw new Error(`Waited in vain for ${condition}`);
    }),
  untilPasses: stepUntil,
};

/** Gives the window's own back, in a file that tests what the browser does by the machine's clock. */
export let removeClock: () => void = () => {};

/** Takes the window's animation frames, timers and times over, if it has not done so in this page. */
export function installClock(): void {
  if (isInstalled) return;
  const { requestAnimationFrame, cancelAnimationFrame, setTimeout, clearTimeout } = window;
  const time = Object.getOwnPropertyDescriptor(Event.prototype, "timeStamp") as PropertyDescriptor;
  isInstalled = true;
  window.requestAnimationFrame = (call) => {
    requests.set(++lastRequest, call);
    schedule();
    return lastRequest;
  };
  window.cancelAnimationFrame = (request) => {
    requests.delete(request);
  };
  window.setTimeout = ((handler: TimerHandler, milliseconds = 0, ...args: unknown[]) => {
    const call = (): void => {
      if (typeof handler === "function") handler(...args);
    };
    if (!(milliseconds > 0)) return realTimeout(call, milliseconds);
    const end = (): void => {
      if (passing > 0 || holdsTimers) timer.real = realTimeout(end, idleTime);
      else if (timers.delete(id)) call();
    };
    const id = realTimeout(end, milliseconds);
    const timer = { due: now + milliseconds, call, real: id };
    timers.set(id, timer);
    return id;
  }) as typeof setTimeout;
  window.clearTimeout = (id) => {
    endRealTimeout(timers.get(Number(id))?.real ?? id);
    timers.delete(Number(id));
  };
  performance.now = () => now;
  Object.defineProperty(Event.prototype, "timeStamp", { get: () => now, configurable: true });
  removeClock = () => {
    isInstalled = false;
    Object.assign(window, {
      requestAnimationFrame,
      cancelAnimationFrame,
      setTimeout,
      clearTimeout,
    });
    performance.now = realTime;
    Object.defineProperty(Event.prototype, "timeStamp", time);
  };
}
