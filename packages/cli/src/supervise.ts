/** The command runs in a thread of its own, so that a request to end is heard whatever it does. */

import { isMainThread, parentPort, Worker, workerData } from "node:worker_threads";
import { TemporaryFolders, type TemporaryNote, watchTemporary } from "./temporary.ts";

/** Milliseconds in which the thread has to hear a request; it is busy for good otherwise. */
const patience = 3000;

/** What the thread says of a request. */
const heard = "heard";

const signals = ["SIGINT", "SIGTERM", "SIGHUP"] as const;

/** What the thread cannot see by itself of the terminal on which progress is shown. */
type Terminal = Pick<NodeJS.WriteStream, "isTTY" | "columns">;

/**
 * Runs a script's `command` in a thread; called there, runs the command itself. A signal aborts the command,
 * which then ends by itself; a second one, or one that it does not hear in time, ends the process, without
 * the temporary files that the command made.
 *
 * @param script the address of the script that calls this
 */
export async function supervise(
  script: string,
  command: (args: readonly string[], signal: AbortSignal) => Promise<void>,
): Promise<void> {
  if (!isMainThread) {
    Object.assign(process.stderr, workerData as Terminal);
    watchTemporary((note) => parentPort?.postMessage(note));
    return await command(process.argv.slice(2), interrupted());
  }
  const { isTTY, columns } = process.stderr;
  const thread = new Worker(new URL(script), {
    argv: process.argv.slice(2),
    workerData: { isTTY, columns } satisfies Terminal,
  });
  const folders = new TemporaryFolders();
  let timer: NodeJS.Timeout | null = null;
  const end = (signal: NodeJS.Signals): void => {
    folders.remove();
    process.removeAllListeners(signal);
    process.kill(process.pid, signal);
  };
  process.once("exit", () => folders.remove());
  for (const signal of signals) {
    process.on(signal, () => {
      if (timer) return end(signal);
      timer = setTimeout(end, patience, signal);
      thread.postMessage(signal);
    });
  }
  thread.on("message", (message: typeof heard | TemporaryNote) => {
    if (message === heard) clearTimeout(timer ?? undefined);
    else folders.note(message);
  });
  thread.on("exit", (status) => {
    clearTimeout(timer ?? undefined);
    process.exitCode = status;
  });
}

/** Returns a signal, in the command's thread, that aborts when the user or the system asks it to end. */
function interrupted(): AbortSignal {
  const controller = new AbortController();
  parentPort?.once("message", () => {
    parentPort?.postMessage(heard);
    controller.abort();
  });
  // A command that is done ends, though it could still be asked to.
  parentPort?.unref();
  return controller.signal;
}
