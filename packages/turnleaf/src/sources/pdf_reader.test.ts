import { expect, test } from "vitest";
import { limits } from "./limits.ts";
import type { OpenPdf, PdfFile } from "./pdf_file.ts";
import { PdfReader } from "./pdf_reader.ts";
import { type PdfThread, WorkerStalled } from "./pdf_thread.ts";

/** A reader of a file in which everything stalls the worker, and the milliseconds that each try was given. */
function stallingReader(): { reader: PdfReader; tries: number[] } {
  const tries: number[] = [];
  const orFailed = async (_: Promise<unknown>, most: number): Promise<never> => {
    tries.push(most);
    throw new WorkerStalled("It takes too long.");
  };
  const open = { thread: { orFailed } as unknown as PdfThread, end: () => {} } as OpenPdf;
  const file = { open: async () => open } as unknown as PdfFile;
  return { reader: new PdfReader(file, open, () => {}), tries };
}

test("what stalls the worker beside other things is tried once more by itself", async () => {
  const { reader, tries } = stallingReader();
  await expect(reader.run("page 0", async () => {})).rejects.toThrow(WorkerStalled);
  await expect(reader.run("page 0", async () => {})).rejects.toThrow(WorkerStalled);
  expect(tries).toEqual([limits.pdfTime / 3, limits.pdfTime]);
});

test("what is read by itself from the beginning, as the cover, is tried once", async () => {
  const { reader, tries } = stallingReader();
  const { signal } = new AbortController();
  const reading = reader.run("page 0", async () => {}, signal, "page 0", true);
  await expect(reading).rejects.toThrow(WorkerStalled);
  expect(tries).toEqual([limits.pdfTime]);
});
