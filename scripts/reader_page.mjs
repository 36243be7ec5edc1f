/** The built reader with the book that comes with it, for pictures and benchmarks. */
import { spawn } from "node:child_process";
import { join } from "node:path";

const root = join(import.meta.dirname, "..");

/** Serves the book that comes with the project, or what another command serves. Returns its address. */
export async function serve(...args) {
  const command = join(root, "packages/cli/dist/main.js");
  const book = join(root, "books/moby-dick.pdf");
  const what = args.length > 0 ? args : ["read", book];
  const child = spawn(process.execPath, [command, ...what, "--no-open", "--port", "0"]);
  child.stderr.pipe(process.stderr);
  const url = await new Promise((resolve, reject) => {
    child.stdout.on("data", (data) => {
      const found = /http:\S+/.exec(String(data));
      if (found) resolve(found[0]);
    });
    child.on("exit", () => reject(new Error("The reader did not start.")));
  });
  return { url, stop: () => child.kill() };
}

/** Runs in the page before anything else: frames come when they are called for. */
export function driveClock() {
  let waiting = [];
  let now = 1000;
  let count = 0;
  const clock = {
    free: true,
    /** Frames so far. */
    frames: 0,
    /** Whether the frame under way is the last one of its time, which is the one that is seen. */
    last: true,
    /** Whether no frame is waited for. */
    get rests() {
      return waiting.length === 0;
    },
    /** Lets a time pass, in frames of 60 Hz. */
    pass(milliseconds) {
      for (let t = 0; t < milliseconds; t += 1000 / 60) {
        now += 1000 / 60;
        clock.frames++;
        clock.last = t + 1000 / 60 >= milliseconds;
        const calls = waiting;
        waiting = [];
        for (const { call } of calls) call(now);
      }
    },
  };
  Object.assign(window, {
    clock,
    requestAnimationFrame(call) {
      waiting.push({ id: ++count, call });
      if (clock.free) setTimeout(() => clock.pass(1), 0);
      return count;
    },
    cancelAnimationFrame(id) {
      waiting = waiting.filter((frame) => frame.id !== id);
    },
  });
}
