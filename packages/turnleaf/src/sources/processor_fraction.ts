/** How much of a processor's time a worker gets, beside all else that runs on the machine. */

import { measureFraction } from "./measure_fraction.ts";
import { trustedScript } from "./trusted_script.ts";
import { scriptAddress } from "./worker_script.ts";

/** The least fraction that is reported, so that what is measured by it ends. */
const leastFraction = 1 / 4;

/** Milliseconds after which a worker that has not measured gets the least. */
const patience = 2000;

/** What a worker from a blob runs, and one from the package's file pdf-worker.js. */
const script = `onmessage = () => postMessage((${measureFraction})());`;

/** Measures it in a worker of its own, which starts when it is first needed. */
export class ProcessorFraction {
  readonly #address: string | undefined;
  #worker: Promise<Worker> | null = null;

  /** @param address of the package's file pdf-worker.js, for pages whose policy forbids workers from blobs */
  constructor(address?: string) {
    this.#address = address;
  }

  /** Returns the fraction of a processor that a worker gets now, 1/4 to 1; 1 if the browser starts no worker. */
  async measure(): Promise<number> {
    try {
      this.#worker ??= start(this.#address);
      const worker = await this.#worker;
      const fraction = await new Promise<number>((resolve, reject) => {
        // The file of another version may send something else.
        worker.onmessage = ({ data }) => resolve(typeof data === "number" ? data : 1);
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

async function start(file?: string): Promise<Worker> {
  if (file !== undefined) return new Worker(trustedScript(`${file}#fraction`), { type: "module" });
  return new Worker(trustedScript(await scriptAddress(new TextEncoder().encode(script))));
}
