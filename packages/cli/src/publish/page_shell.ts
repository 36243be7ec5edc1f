/** What every page of a site has in common. */

import { type Content, type Html, html } from "../html.ts";
import { readerPolicy } from "../reader_policy.ts";
import type { PageAssets } from "./site_assets.ts";

/** What the publisher says of the whole site. */
export interface SiteOptions {
  readonly title: string;
  /** Its address, ending in a slash; null if it is not known. */
  readonly url: string | null;
}

const policy = [
  ...readerPolicy,
  "manifest-src 'self'",
  "form-action 'self'",
  "require-trusted-types-for 'script'",
  "trusted-types turnleaf turnleaf-site",
].join("; ");

/** A page of the site. */
export interface ShellPage {
  readonly title: string;
  readonly description: string;
  /** Its address relative to the site. */
  readonly address: string;
  readonly assets: PageAssets | null;
  readonly head?: Content;
  readonly bodyClass: string;
  readonly body: Content;
}

/** Returns a whole page. */
export function pageShell(site: SiteOptions, page: ShellPage): string {
  const up = rootFrom(page.address);
  const styles = page.assets?.styles ?? [];
  const head: Html[] = [
    html`<meta charset="utf-8">`,
    html`<meta http-equiv="Content-Security-Policy" content="${policy}">`,
    html`<meta name="viewport" content="width=device-width, initial-scale=1, viewport-fit=cover">`,
    html`<meta name="color-scheme" content="light dark">`,
    html`<meta name="referrer" content="no-referrer">`,
    html`<title>${page.title}</title>`,
    html`<meta name="description" content="${page.description}">`,
    ...(site.url === null ? [] : [html`<link rel="canonical" href="${site.url + page.address}">`]),
    html`<link rel="icon" type="image/svg+xml" href="${up}icon.svg">`,
    html`<link rel="manifest" href="${up}site.webmanifest">`,
    ...styles.map((style) => html`<link rel="stylesheet" href="${up}${style}">`),
    ...(page.assets
      ? [html`<script type="module" src="${up}${page.assets.script}"></script>`]
      : []),
  ];
  const whole = html`<!doctype html>
<html lang="en">
<head>
${head.map(
  (line) => html`${line}
`,
)}${page.head}</head>
<body class="${page.bodyClass}" data-root="${up}">
${page.body}
</body>
</html>
`;
  return whole.text;
}

/** Returns the way from a page to the site's root, "" or "../../". */
function rootFrom(address: string): string {
  return "../".repeat(address.split("/").length - 1);
}

/** Returns the name of a language in English. */
export function languageName(tag: string): string {
  try {
    return new Intl.DisplayNames(["en"], { type: "language" }).of(tag) ?? tag;
  } catch {
    return tag;
  }
}
