import { afterEach, expect, test, vi } from "vitest";
import { eventually } from "../for_tests/eventually.ts";
import { limits } from "./limits.ts";
import { blobWorker, loadPdfLibrary, type PdfLibrary } from "./pdf_runtime.ts";
import { PdfThread, WorkerStalled } from "./pdf_thread.ts";
import { ProcessorFraction } from "./processor_fraction.ts";
import { tinyPdf } from "./tiny_pdf.ts";

afterEach(() => {
  vi.restoreAllMocks();
  vi.unstubAllGlobals();
});

test("a worker starts while pdf.js itself is still compiled, and ends if that fails", async () => {
  const terminate = vi.spyOn(Worker.prototype, "terminate");
  let started = 0;
  class CountedWorker extends Worker {
    constructor(...how: ConstructorParameters<typeof Worker>) {
      super(...how);
      started += 1;
    }
  }
  vi.stubGlobal("Worker", CountedWorker);
  const library = Promise.withResolvers<PdfLibrary>();
  const starting = PdfThread.start(library.promise);
  await eventually(() => started).toBe(1);
  expect(terminate).not.toHaveBeenCalled();
  library.reject(new Error("It does not compile."));
  await expect(starting).rejects.toThrow("It does not compile.");
  expect(terminate).toHaveBeenCalledOnce();
});

test("neither the worker nor the renderer warns on the console of what a file has strange", async () => {
  // pdf.js is loaded anew: it remembers its last verbosity.
  vi.resetModules();
  const said: unknown[] = [];
  const { postMessage } = Worker.prototype;
  vi.spyOn(Worker.prototype, "postMessage").mockImplementation(function (
    this: Worker,
    message: { action?: string; data?: { verbosity?: number } },
    ...how: unknown[]
  ) {
    if (message?.action === "configure") said.push(message.data?.verbosity);
    return (postMessage as (...all: unknown[]) => void).call(this, message, ...how);
  } as typeof postMessage);
  const { openPdf } = await import("./pdf.ts");
  const bytes = tinyPdf({ pages: ["0 0 10 10 re f"] });
  const source = await openPdf({ from: new Blob([bytes]), name: "a.pdf" });
  const picture = await source.draw(0, 50, new AbortController().signal);
  expect(picture.width).toBe(50);
  expect(said.length).toBeGreaterThan(0);
  expect(new Set(said)).toEqual(new Set([0]));
  source.close();
});

test.each([
  [1, 11],
  [1 / 4, 44],
])(
  "a worker that gets %f of a processor is looked at %i times after the first before it is given up",
  async (fraction, looks) => {
    const { pdfTime } = limits;
    const measure = vi.fn(async () => fraction);
    const thread = await PdfThread.start(loadPdfLibrary(), undefined, { measure, stop: () => {} });
    Object.assign(limits, { pdfTime: 24 });
    try {
      await expect(thread.orFailed(new Promise(() => {}))).rejects.toBeInstanceOf(WorkerStalled);
      expect(measure).toHaveBeenCalledTimes(looks);
    } finally {
      Object.assign(limits, { pdfTime });
      thread.stop();
    }
  },
);

test("a worker of the page's own site has its time measured by that file, not by a blob", async () => {
  const { pdfTime } = limits;
  const address = `${await blobWorker()}#`;
  const started: string[] = [];
  class NotedWorker extends Worker {
    constructor(...how: ConstructorParameters<typeof Worker>) {
      super(...how);
      started.push(String(how[0]));
    }
  }
  vi.stubGlobal("Worker", NotedWorker);
  const thread = await PdfThread.start(loadPdfLibrary(), address);
  Object.assign(limits, { pdfTime: 24 });
  try {
    await expect(thread.orFailed(new Promise(() => {}))).rejects.toBeInstanceOf(WorkerStalled);
    expect(started).toEqual([address, `${address}#fraction`]);
  } finally {
    Object.assign(limits, { pdfTime });
    thread.stop();
  }
});

test("the fraction of a processor that a worker gets is the time that its clock does not jump over", async () => {
  /** A worker whose clock jumps over five eighths of the time. */
  class InterruptedWorker {
    onmessage: (event: { data: unknown }) => void = () => {};
    readonly #script: Promise<string>;
    constructor(address: string) {
      this.#script = fetch(address).then((response) => response.text());
    }
    async postMessage(): Promise<void> {
      let [time, readings] = [0, 0];
      const now = (): number => {
        time += ++readings % 4 === 0 ? 2.5 : 0.5;
        return time;
      };
      const run = new Function(
        "performance",
        "postMessage",
        `let onmessage;${await this.#script}onmessage();`,
      );
      run({ now }, (data: unknown) => this.onmessage({ data }));
    }
    terminate(): void {}
  }
  vi.stubGlobal("Worker", InterruptedWorker);
  const fraction = new ProcessorFraction();
  expect(await fraction.measure()).toBeCloseTo(3 / 8, 1);
  fraction.stop();
  // Where the browser starts no worker, all time counts.
  vi.stubGlobal("Worker", undefined);
  expect(await fraction.measure()).toBe(1);
});
