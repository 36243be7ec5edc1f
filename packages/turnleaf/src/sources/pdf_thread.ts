/** pdf.js's workers: how they start, and how their errors are reported. */

import type { PDFWorker } from "pdfjs-dist";
import { nameAndMessage } from "./failures.ts";
import { limits } from "./limits.ts";
import { BookError } from "./page_source.ts";
import { blobWorker, isLoadingData, type PdfLibrary } from "./pdf_runtime.ts";
import { ProcessorFraction } from "./processor_fraction.ts";
import { trustedScript } from "./trusted_script.ts";

/** Milliseconds in which a worker has to report that it has started. */
export const startingTime = 60_000;

/** The reason why a worker does not work: it was not started, or its code or the page's failed. */
export class WorkerFailure extends Error {
  override readonly name: string = "WorkerFailure";
}

/** The browser did not start the worker: a policy forbids it, or the script is missing. */
export class WorkerNotStarted extends WorkerFailure {}

/** What the worker does takes longer than it may, or more steps: it has to be ended. */
export class WorkerStalled extends WorkerFailure {}

/** Looks at what is pending in the time that it may take. */
const looks = 12;

/** What is awaited of a worker. */
interface Job {
  readonly reject: (failure: Error) => void;
  /** Milliseconds of a processor that it may take, and those that it has taken. */
  readonly most: number;
  taken: number;
}

/** A message of a worker, as far as it is read here. */
interface WorkerMessage {
  readonly streamId?: unknown;
  /** A piece of a stream; a list of steps says how many are in it. */
  readonly chunk?: { readonly length?: unknown; readonly lastChunk?: unknown } | null;
}

/**
 * A worker that reads one document. Errors in it, or in the page's handling of
 * its messages, that pdf.js does not notice reject every pending promise:
 * nothing waits for ever. So does a worker that takes longer, or sends more,
 * than it may.
 */
export class PdfThread {
  readonly #thread: Worker;
  #library: PdfLibrary | null = null;
  #worker: PDFWorker | null = null;
  /**
   * Whether what is awaited may wait for something else than the worker: bytes from the network, or the
   * reader's password.
   */
  waitsForOthers = false;
  readonly #waiting = new Set<Job>();
  readonly #fraction: Pick<ProcessorFraction, "measure" | "stop">;
  /** Steps of drawing that have come, by their list. */
  readonly #steps = new Map<unknown, number>();
  #stepLimit: { readonly most: number; readonly onMore: () => void } | null = null;
  #hasStarted = false;
  #isWatched = false;
  #failure: Error | null = null;
  readonly #timer: ReturnType<typeof setTimeout>;

  private constructor(thread: Worker, fraction: Pick<ProcessorFraction, "measure" | "stop">) {
    this.#thread = thread;
    this.#fraction = fraction;
    this.#timer = setTimeout(() => {
      this.#fail(new WorkerNotStarted("It gave no sign of life."), true);
    }, startingTime);
    const started = (): void => {
      clearTimeout(this.#timer);
      this.#hasStarted = true;
    };
    thread.addEventListener("message", started, { once: true });
    thread.addEventListener("error", (event) => {
      event.preventDefault();
      const { message } = event;
      // An event without a message comes from a script that could not be loaded.
      const failure = message
        ? new WorkerFailure(message.replace(/^Uncaught /, ""))
        : new WorkerNotStarted("It did not load.");
      this.#fail(failure, !message);
    });
    thread.addEventListener("messageerror", () => {
      this.#fail(new WorkerFailure("A message could not be read."), false);
    });
  }

  /**
   * Starts a worker; its owner ends it by `stop`. Rejects with a
   * `WorkerNotStarted` if the browser does not allow it, or as `library` does.
   *
   * @param library pdf.js itself, which is compiled while the worker's script is
   * @param address the worker's script on the page's own site, if it may not be
   * a blob
   * @param fraction measures how much of a processor the worker gets
   */
  static async start(
    library: Promise<PdfLibrary>,
    address?: string,
    fraction: Pick<ProcessorFraction, "measure" | "stop"> = new ProcessorFraction(address),
  ): Promise<PdfThread> {
    const script = address ?? (await blobWorker());
    let thread: PdfThread;
    try {
      thread = new PdfThread(new Worker(trustedScript(script), { type: "module" }), fraction);
    } catch (error) {
      throw new WorkerNotStarted(nameAndMessage(error));
    }
    try {
      thread.#library = await library;
      const { PDFWorker, VerbosityLevel } = thread.pdfjs;
      // Said here too: the worker is there before the document that says it.
      const verbosity = VerbosityLevel.ERRORS;
      thread.#worker = new PDFWorker({ port: thread.#port() as unknown as null, verbosity });
      return thread;
    } catch (error) {
      thread.stop();
      throw error;
    }
  }

  /** pdf.js, whose worker it is. */
  get pdfjs(): PdfLibrary {
    return this.#library as PdfLibrary;
  }

  /** As pdf.js expects it. */
  get worker(): PDFWorker {
    return this.#worker as PDFWorker;
  }

  /**
   * Resolves as `promise` does, or rejects as soon as the worker fails. Rejects with a `WorkerStalled` once
   * the worker takes too long for it, or for anything else that is pending.
   *
   * @param most milliseconds of a processor that it may take
   */
  orFailed<T>(promise: Promise<T>, most: number = limits.pdfTime): Promise<T> {
    return new Promise((resolve, reject) => {
      if (this.#failure) reject(this.#failure);
      const job: Job = { reject, most, taken: 0 };
      this.#waiting.add(job);
      this.#watch();
      promise.then(resolve, reject).finally(() => this.#waiting.delete(job));
    });
  }

  /**
   * Calls `onMore` whenever a drawing has more than `most` steps, while `promise` is pending. Resolves or
   * rejects as that does.
   */
  async countSteps<T>(promise: Promise<T>, most: number, onMore: () => void): Promise<T> {
    const limit = { most, onMore };
    this.#stepLimit = limit;
    try {
      return await promise;
    } finally {
      if (this.#stepLimit === limit) this.#stepLimit = null;
    }
  }

  /** Rejects every promise that is pending, and those to come: what the worker sends is no longer awaited. */
  giveUp(reason: Error): void {
    this.#fail(reason, true);
  }

  /** Ends the worker at once. */
  readonly stop = (): void => {
    clearTimeout(this.#timer);
    this.#fraction.stop();
    this.#worker?.destroy();
    this.#thread.terminate();
  };

  /** Returns the worker for pdf.js, whose own listeners throw without a handler. */
  #port(): Pick<Worker, "postMessage" | "addEventListener" | "removeEventListener"> {
    const thread = this.#thread;
    const guarded = (listener: (event: Event) => void) => (event: Event) => {
      try {
        if (this.#counted(event)) listener(event);
      } catch (error) {
        this.#fail(error instanceof Error ? error : new Error(String(error)), false);
      }
    };
    return {
      postMessage: thread.postMessage.bind(thread),
      addEventListener: (type: string, listener: never, options?: AddEventListenerOptions) =>
        thread.addEventListener(type, guarded(listener), options),
      removeEventListener: thread.removeEventListener.bind(thread),
    };
  }

  /**
   * Looks from time to time how long each job has taken. Time in which the page itself stood still, or the
   * device slept, counts as one look; time in which the machine was busy with other things counts as much as
   * a worker got of it.
   */
  #watch(): void {
    if (this.#isWatched || this.#waiting.size === 0) return;
    this.#isWatched = true;
    const lookEvery = limits.pdfTime / looks;
    AbortSignal.timeout(lookEvery).addEventListener("abort", async () => {
      if (this.#hasStarted && !this.waitsForOthers && !isLoadingData()) {
        const jobs = [...this.#waiting];
        // Most jobs have ended before a second look.
        const isLong = jobs.some(({ taken }) => taken > 0);
        const given = lookEvery * (isLong ? await this.#fraction.measure() : 1);
        for (const job of jobs) job.taken += given;
        const isLate = jobs.some((job) => this.#waiting.has(job) && job.taken >= job.most);
        if (isLate) this.#fail(new WorkerStalled("It takes too long."), true);
      }
      this.#isWatched = false;
      this.#watch();
    });
  }

  /**
   * Counts the steps in a message: the page does not look at its timers while many come. Returns whether
   * the message is still of use.
   */
  #counted(event: Event): boolean {
    // One that is closed still says that it has ended.
    if (this.#failure instanceof WorkerStalled) return false;
    const { chunk, streamId } = ((event as MessageEvent).data ?? {}) as WorkerMessage;
    if (typeof chunk?.length !== "number") return true;
    const steps = (this.#steps.get(streamId) ?? 0) + chunk.length;
    if (steps > limits.pdfSteps) {
      this.#fail(new WorkerStalled("It sends too much."), true);
      this.stop();
      return false;
    }
    if (this.#stepLimit !== null && steps > this.#stepLimit.most) this.#stepLimit.onMore();
    if (chunk.lastChunk === true) this.#steps.delete(streamId);
    else this.#steps.set(streamId, steps);
    return true;
  }

  /** @param isFinal whether the worker cannot recover */
  #fail(failure: Error, isFinal: boolean): void {
    if (isFinal) this.#failure = failure;
    for (const { reject } of this.#waiting) reject(failure);
    this.#waiting.clear();
  }
}

/** Returns the error for a worker that the browser did not start. */
export function notStarted(name: string, address: string | undefined, cause: Error): BookError {
  let remedy =
    "allow blob: in worker-src of this page's Content-Security-Policy, or set the attribute pdf-worker";
  if (/Trusted/.test(cause.message)) {
    remedy = "allow turnleaf in trusted-types of this page's Content-Security-Policy";
  } else if (address) {
    remedy = `pdf-worker names ${address}: correct it, or allow it in worker-src of this page's Content-Security-Policy`;
  }
  return new BookError(
    `${name} cannot be read, as the browser did not start the script that reads it; ${remedy}.`,
    { code: "blocked", source: name, cause },
  );
}
