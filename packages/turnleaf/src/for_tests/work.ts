/** What a file of browser tests has the viewer do, counted: the same on a fast machine and on a slow one. */

import { afterEach } from "vitest";
import { TickCounter } from "../viewer/frame_timing.ts";
import { hookContexts } from "./webgl_contexts.ts";

/** Counted work of a file. */
export interface Work {
  /** Frames that books drew: not those of a page that waits, of which a busy machine has more. */
  readonly frames: number;
  /** Ticks that engines were to step. */
  readonly ticks: number;
  /** Canvases on which a book was set up to be drawn by WebGL. */
  readonly books: number;
}

declare module "vitest" {
  interface TaskMeta {
    work?: Work;
  }
}

const work: { -readonly [Count in keyof Work]: number } = { frames: 0, ticks: 0, books: 0 };
let isCounting = false;

/** Counts the work of a file from now on, and reports it after each test. */
export function countWork(): void {
  Object.assign(work, { frames: 0, ticks: 0, books: 0 });
  afterEach(({ task }) => {
    task.file.meta.work = { ...work };
  });
  // Several files may run in one page.
  if (isCounting) return;
  isCounting = true;
  const { count } = TickCounter.prototype;
  TickCounter.prototype.count = function (now) {
    const passed = count.call(this, now);
    work.frames++;
    work.ticks += passed;
    return passed;
  };
  const known = new WeakSet<HTMLCanvasElement>();
  hookContexts((canvas, options, next) => {
    if (!known.has(canvas)) work.books++;
    known.add(canvas);
    return next(options);
  });
}
