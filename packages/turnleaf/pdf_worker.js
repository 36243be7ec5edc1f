/**
 * What the package's file pdf-worker.js is made of: both of pdf.js's workers, for pages whose security
 * policy forbids workers from blob: addresses. The address says which of the two is to run.
 */
if (location.hash === "#renderer") await import("pdfjs-dist/legacy/build/pdf.renderer.min.mjs");
else await import("pdfjs-dist/legacy/build/pdf.worker.min.mjs");
