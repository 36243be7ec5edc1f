import { afterEach, expect, test, vi } from "vitest";
import { eventually } from "../for_tests/eventually.ts";
import type { PdfLibrary } from "./pdf_runtime.ts";
import { PdfThread } from "./pdf_thread.ts";
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

/** A worker that has started and sends nothing more. */
class SilentWorker extends EventTarget {
  postMessage(): void {}
  terminate(): void {}
}

test("a worker is given up once it takes too long; that in which the page draws counts as a quarter", async () => {
  const workers: SilentWorker[] = [];
  vi.stubGlobal(
    "Worker",
    class extends SilentWorker {
      constructor() {
        super();
        workers.push(this);
      }
    },
  );
  let look = new AbortController();
  vi.spyOn(AbortSignal, "timeout").mockImplementation(() => {
    look = new AbortController();
    return look.signal;
  });
  const library = { PDFWorker: class {}, VerbosityLevel: { ERRORS: 0 } } as unknown as PdfLibrary;
  /** Returns after how many looks something that does not come is given up. */
  const looksBefore = async (isDrawn: boolean): Promise<number> => {
    const thread = await PdfThread.start(Promise.resolve(library));
    workers.at(-1)?.dispatchEvent(new MessageEvent("message"));
    let isOver = false;
    thread.orFailed(new Promise(() => {})).catch(() => {
      isOver = true;
    });
    for (let count = 1; ; count++) {
      if (isDrawn) thread.noteDrawing();
      look.abort();
      await new Promise<void>((resolve) => queueMicrotask(resolve));
      if (isOver) return count;
    }
  };
  expect(await looksBefore(false)).toBe(12);
  expect(await looksBefore(true)).toBe(48);
});
