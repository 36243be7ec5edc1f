/**
 * Directives of the Content-Security-Policy under which the reader works, wherever its
 * page is served; docs/policy.md says what each is for. `blob:` is used by pdf.js's
 * workers, printed pages and recordings in EPUBs, `data:` by SVG pages and by EPUBs and
 * their fonts.
 */
export const readerPolicy: readonly string[] = policyFor("'self'");

/** As `readerPolicy`, for a book whose images are on other sites: a IIIF manifest. */
export const onlinePolicy: readonly string[] = policyFor("'self' https: http:");

function policyFor(sites: string): string[] {
  return [
    "default-src 'none'",
    "script-src 'self' 'wasm-unsafe-eval'",
    "worker-src 'self' blob:",
    "style-src 'self'",
    "img-src 'self' blob: data:",
    "font-src 'self' data:",
    "media-src blob:",
    `connect-src ${sites}`,
    "base-uri 'none'",
  ];
}
