/** Imported for its side effect only: pdf.js then finds its worker's code in this thread. */
declare module "pdfjs-dist/legacy/build/pdf.worker.min.mjs";
