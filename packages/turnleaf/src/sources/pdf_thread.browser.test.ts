import { afterEach, expect, test, vi } from "vitest";
import { eventually } from "../for_tests/eventually.ts";
import type { PdfLibrary } from "./pdf_runtime.ts";
import { PdfThread } from "./pdf_thread.ts";

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
