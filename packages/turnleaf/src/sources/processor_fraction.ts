/** How much of a processor's time a worker gets, beside all else that runs on the machine. */

import { trustedScript } from "./trusted_script.ts";
import { scriptAddress } from "./worker_script.ts";

/** The least fraction that is reported, so that what is measured by it ends. */
const leastFraction = 1 / 4;

/** Milliseconds after which a worker that has not measured gets the least. */
const patience = 2000;

/**
 * The script of the worker that measures it: for 50 ms it does nothing but read the clock. Where readings are
 * further apart than 2 ms, more than any clock's step, something else ran meanwhile.
 */
const script = `onmessage = () => {
  const start = performance.now();
  let [last, paused] = [start, 0];
  while (last - start < 50) {
    const now = performance.now();
    if (now - last > 2) paused += now - last;
    last = now;
  }
  postMessage(1 - paused / (last - start));
};`;

/** Measures it in a worker of its own, which starts when it is first needed. */
export class ProcessorFraction {
  #worker: Promise<Worker> | null = null;

  /** Returns the fraction of a processor that a worker gets now, 1/4 to 1; 1 if the browser starts no worker. */
  async measure(): Promise<number> {
    try {
      this.#worker ??= start();
      const worker = await this.#worker;
      const fraction = await new Promise<number>((resolve, reject) => {
        worker.onmessage = ({ data }) => resolve(Number(data));
        worker.onerror = (event) => {
          event.preventDefault();
          reject(new Error("It did not start."));
        };
        AbortSignal.timeout(patience).addEventListener("abort", () => resolve(leastFraction));
        worker.postMessage(null);
      });
      return Math.min(Math.max(fraction, leastFraction), 1);
    } catch {
      return 1;
    }
  }

  /** Ends the worker. */
  stop(): void {
    this.#worker?.then((worker) => worker.terminate()).catch(() => {});
    this.#worker = null;
  }
}

async function start(): Promise<Worker> {
  const address = await scriptAddress(new TextEncoder().encode(script));
  return new Worker(trustedScript(address));
}
