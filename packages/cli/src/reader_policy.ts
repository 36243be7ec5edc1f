/**
 * Directives of the Content-Security-Policy under which the reader works, wherever its
 * page is served; docs/policy.md says what each is for. `blob:` is used by pdf.js's
 * workers and printed pages, `data:` by SVG pages and by EPUBs and their fonts.
 */
export const readerPolicy: readonly string[] = [
  "default-src 'none'",
  "script-src 'self' 'wasm-unsafe-eval'",
  "worker-src 'self' blob:",
  "style-src 'self'",
  "img-src 'self' blob: data:",
  "font-src 'self' data:",
  "connect-src 'self'",
  "base-uri 'none'",
];
