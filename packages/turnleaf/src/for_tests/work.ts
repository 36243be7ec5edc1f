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

/** Counts the work of a file from now on, and reports it after each test. */
export function countWork(): void {
  let frames = 0;
  let ticks = 0;
  const { count } = TickCounter.prototype;
  TickCounter.prototype.count = function (now) {
    const passed = count.call(this, now);
    frames++;
    ticks += passed;
    return passed;
  };
  let books = 0;
  const known = new WeakSet<HTMLCanvasElement>();
  hookContexts((canvas, options, next) => {
    if (!known.has(canvas)) books++;
    known.add(canvas);
    return next(options);
  });
  afterEach(({ task }) => {
    task.file.meta.work = { frames, ticks, books };
  });
}
