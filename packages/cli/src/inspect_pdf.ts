import { Worker } from "node:worker_threads";
import { Problem, printable } from "./problem.ts";

/** The thread's result for a PDF. */
export type PdfFinding =
  | { readonly title: string; readonly pageCount: number }
  | { readonly fault: "password" | "damaged" | "unreadable" };

/** Milliseconds after which a PDF is served unchecked: the reader then reports its errors. */
const patience = 20_000;

/**
 * Opens a PDF with the same library as the reader does, in a thread of its own
 * with bounded memory and time.
 * @param given how the user named the file
 * @throws Problem
 */
export async function inspectPdf(file: string, given: string): Promise<{ readonly title: string }> {
  const found = await ask(file);
  if (found === null) return { title: "" };
  if ("title" in found) {
    if (found.pageCount > 0) return found;
    throw new Problem(`${printable(given)} has no pages; choose another file.`);
  }
  const name = printable(given);
  switch (found.fault) {
    case "password":
      // The reader asks for it.
      return { title: "" };
    case "damaged":
      throw new Problem(`${name} is damaged or no PDF; repair the file or get it again.`);
    case "unreadable":
      throw new Problem(`${name} may not be read; give yourself the permission to read it.`);
  }
}

/** Resolves to null if the thread gave no result. */
function ask(file: string): Promise<PdfFinding | null> {
  const thread = new Worker(new URL("./inspect_thread.js", import.meta.url), {
    workerData: file,
    // The library's own messages are for developers.
    stdout: true,
    stderr: true,
    resourceLimits: { maxOldGenerationSizeMb: 1024 },
  });
  return new Promise((resolve) => {
    const timer = setTimeout(() => finish(null), patience);
    const finish = (found: PdfFinding | null): void => {
      clearTimeout(timer);
      void thread.terminate();
      resolve(found);
    };
    thread.once("message", finish);
    thread.once("error", () => finish(null));
    thread.once("exit", () => finish(null));
  });
}
