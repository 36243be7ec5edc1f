import { measureFraction } from "./src/sources/measure_fraction.ts";

/**
 * What the package's file pdf-worker.js is made of: both of pdf.js's workers, and one that measures how busy the
 * machine is, for pages whose security policy forbids workers from blob: addresses. The address says which is
 * to run.
 */
if (location.hash === "#fraction") globalThis.onmessage = () => postMessage(measureFraction());
else if (location.hash === "#renderer") {
  await import("pdfjs-dist/legacy/build/pdf.renderer.min.mjs");
} else await import("pdfjs-dist/legacy/build/pdf.worker.min.mjs");
