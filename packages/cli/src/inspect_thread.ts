import { closeSync, fstatSync, openSync, readSync } from "node:fs";
import { parentPort, workerData } from "node:worker_threads";
import type { PdfFinding } from "./inspect_pdf.ts";

/** Bytes read at a time: of a large file only what its first page and title need. */
const piece = 1 << 16;

/** Adds the newer JavaScript features that pdf.js needs and Node 20 does not have. */
function completeNode(): void {
  Promise.withResolvers ??= function withResolvers<T>(): PromiseWithResolvers<T> {
    let resolve!: PromiseWithResolvers<T>["resolve"];
    let reject!: PromiseWithResolvers<T>["reject"];
    const promise = new Promise<T>((onResolve, onReject) => {
      resolve = onResolve;
      reject = onReject;
    });
    return { promise, resolve, reject };
  };
}

async function inspect(file: string): Promise<PdfFinding | null> {
  completeNode();
  // The worker's code first: pdf.js then reads in this thread instead of starting another.
  await import("pdfjs-dist/legacy/build/pdf.worker.min.mjs");
  const pdfjs = await import("pdfjs-dist/legacy/build/pdf.mjs");
  const descriptor = openSync(file, "r");
  const { size } = fstatSync(descriptor);
  const transport = new pdfjs.PDFDataRangeTransport(size, null);
  transport.requestDataRange = (begin: number, end: number): void => {
    const bytes = new Uint8Array(end - begin);
    const read = readSync(descriptor, bytes, 0, bytes.length, begin);
    transport.onDataRange(begin, bytes.subarray(0, read));
  };
  try {
    const document = await pdfjs.getDocument({
      range: transport,
      rangeChunkSize: piece,
      disableAutoFetch: true,
      verbosity: pdfjs.VerbosityLevel.ERRORS,
    }).promise;
    // The first page must exist: a file may have a valid end and nothing else.
    if (document.numPages > 0) await document.getPage(1);
    const metadata = await document.getMetadata().catch(() => null);
    const info = metadata?.info as { Title?: unknown } | undefined;
    const title = metadata?.metadata?.get("dc:title") || info?.Title;
    return { title: typeof title === "string" ? title : "", pageCount: document.numPages };
  } catch (error) {
    if (error instanceof pdfjs.PasswordException) return { fault: "password" };
    const { details } = Object(error) as { details?: unknown };
    const isDamaged =
      error instanceof pdfjs.InvalidPDFException || /^FormatError/.test(`${details}`);
    // Other failures may be this machine's: the reader in the browser tries again.
    return isDamaged ? { fault: "damaged" } : null;
  } finally {
    closeSync(descriptor);
  }
}

const result = await inspect(workerData as string).catch(
  (): PdfFinding => ({ fault: "unreadable" }),
);
parentPort?.postMessage(result);
