/** The HTML of one book: its own page, and the text of its pages. */

import { type Content, type Html, html } from "../html.ts";
import { parseLicence } from "./licence.ts";
import { languageName, pageShell, type SiteOptions } from "./page_shell.ts";
import { paragraphsOf } from "./page_text.ts";
import type { BookDetails } from "./record.ts";
import type { SiteAssets } from "./site_assets.ts";
import {
  halved,
  halvings,
  pagesInPart,
  pictureAddress,
  type SiteBook,
  type SiteOutlineEntry,
  type SiteText,
} from "./site_book.ts";

/** Everything that a book's pages show. */
export interface BookView {
  readonly site: SiteOptions;
  readonly assets: SiteAssets;
  readonly id: string;
  readonly book: SiteBook;
  readonly details: BookDetails;
  /** Part of the addresses of pictures: a book that was drawn anew has others. */
  readonly version: string;
}

/** Returns a book's folder relative to the site, as an address. */
export function bookAddress(id: string): string {
  return `books/${encodeURIComponent(id)}/`;
}

/** Returns the number of parts in which a book's text is. */
export function partCount(book: SiteBook): number {
  return Math.ceil(book.pages.length / pagesInPart);
}

/** Returns the book's own page: its reader, and everything that is known of it. */
export function bookPage(view: BookView): string {
  const { site, assets, id, book, details, version } = view;
  const name = details.title;
  const data = html`data-id="${id}" data-title="${name}" data-language="${details.language}" data-direction="${details.direction}" data-version="${version}" data-file="${book.file}"`;
  const authors = details.authors ?? [];
  return pageShell(site, {
    title: `${name} – ${site.title}`,
    description:
      details.description ?? `${name}${authors.length > 0 ? ` by ${authors.join(", ")}` : ""}`,
    address: bookAddress(id),
    assets: assets.pages.book,
    head: html`<link rel="alternate" type="text/html" href="text/1.html" title="The text of the pages">
${
  site.url !== null && book.file === null
    ? html`<link rel="alternate" type="application/ld+json" href="manifest.json" title="IIIF manifest">
`
    : null
}`,
    bodyClass: "book-page",
    body: html`<header class="bar"><a href="../../" rel="up">${site.title}</a><nav><a href="#about">About</a> <a href="text/1.html">Text</a></nav></header>
<main itemscope itemtype="https://schema.org/Book">
<div id="reader" ${data}>${coverLink(view)}</div>
<section id="about">
<h1 itemprop="name" lang="${details.language}">${name}</h1>
${detailList(view)}
<p class="actions"><button id="keep-offline" type="button" hidden>Keep for reading offline</button> <span id="keep-offline-state" role="status"></span></p>
${contents(book.outline)}
<h2>Page by page</h2>
<ul class="parts">${
      book.pages.length === 0
        ? null
        : Array.from(
            { length: partCount(book) },
            (_, k) => html`<li><a href="text/${k + 1}.html">${partName(book, k)}</a></li>
`,
          )
    }</ul>
</section>
</main>`,
  });
}

/** Returns the page with the text of part `part` (from 0). */
export function textPage(view: BookView, part: number, texts: readonly SiteText[]): string {
  const { site, assets, id, book, details } = view;
  const turns = html`<nav class="turns">${part > 0 ? html`<a rel="prev" href="${part}.html">${partName(book, part - 1)}</a>` : html`<span></span>`}<a href="../">The book</a>${part + 1 < partCount(book) ? html`<a rel="next" href="${part + 2}.html">${partName(book, part + 1)}</a>` : html`<span></span>`}</nav>`;
  return pageShell(site, {
    title: `${partName(book, part)} – ${details.title}`,
    description: `${details.title}: ${partName(book, part).toLowerCase()}, as text`,
    address: `${bookAddress(id)}text/${part + 1}.html`,
    // A page of text and pictures needs no script.
    assets: { script: assets.pages.shelf.script, styles: assets.pages.shelf.styles },
    bodyClass: "text-page",
    body: html`<header class="bar"><a href="../../../" rel="up">${site.title}</a><nav><a href="../">Turn the pages</a></nav></header>
<main>
<h1 lang="${details.language}"><a href="../">${details.title}</a></h1>
${turns}
${texts.map((text, k) => pageSection(view, part * pagesInPart + k, text))}
${turns}
</main>`,
  });
}

function pageSection(view: BookView, index: number, text: SiteText): Html {
  const { book, details } = view;
  const page = book.pages[index];
  const name = `Page ${page?.label ?? index + 1}`;
  return html`<section class="page" id="page-${index + 1}">
<h2><a href="../#page=${index + 1}">${name}</a></h2>
${
  page?.failed === undefined
    ? null
    : html`<p class="failed">This page could not be drawn: ${page.failed}</p>
`
}${picture(view, index, "../", text.alt === "" ? name : text.alt)}
<div class="words" lang="${details.language}" dir="auto">${paragraphsOf(text.runs).map(
    (paragraph) => html`<p>${paragraph}</p>
`,
  )}</div>
</section>
`;
}

/** Returns a picture of a page in all its sizes; nothing if none was drawn. */
function picture(view: BookView, index: number, up: string, alt: string): Content {
  const { book, version } = view;
  const pixels = book.pages[index]?.pixels;
  if (!pixels) return null;
  const address = (times: number): string =>
    `${up}${pictureAddress(index, pixels, times, book.format)}?v=${version}`;
  // A comma in an address would end it in a srcset.
  const set = Array.from({ length: halvings + 1 }, (_, times) => {
    return `${address(times).replaceAll(",", "%2C")} ${halved(pixels, times)[0]}w`;
  });
  return html`<img src="${address(1)}" srcset="${set.join(", ")}" sizes="(max-width: 50rem) 92vw, 24rem" width="${pixels[0]}" height="${pixels[1]}" alt="${alt}" loading="lazy" decoding="async">`;
}

function coverLink(view: BookView): Html {
  return html`<a class="cover" href="text/1.html">${picture(view, 0, "", `First page of ${view.details.title}`)}<span>Read it page by page</span></a>`;
}

function detailList({ book, details, site, id }: BookView): Html {
  const licence = details.licence === undefined ? null : parseLicence(details.licence);
  const rows: (readonly [string, Content])[] = [
    ...(details.authors ?? []).map(
      (author) => ["Author", html`<span itemprop="author">${author}</span>`] as const,
    ),
    ...(details.publisher
      ? [["Publisher", html`<span itemprop="publisher">${details.publisher}</span>`] as const]
      : []),
    ...(details.date
      ? [["Date", html`<span itemprop="datePublished">${details.date}</span>`] as const]
      : []),
    [
      "Language",
      details.language === ""
        ? "not stated"
        : html`<span itemprop="inLanguage" content="${details.language}">${languageName(details.language)}</span>`,
    ],
    [
      "Licence",
      licence === null
        ? "not stated"
        : licence.href === null
          ? html`<span itemprop="license">${licence.name}</span>`
          : html`<a itemprop="license" rel="license" href="${licence.href}">${licence.name}</a>`,
    ],
    ...otherDetails(book),
    ["Pages", html`<span itemprop="numberOfPages">${book.pages.length}</span>`],
    ...(book.file === null
      ? []
      : [["File", html`<a href="${book.file}" download>${book.file}</a>`] as const]),
    ...(site.url === null || book.file !== null
      ? []
      : [
          [
            "IIIF",
            html`<a href="${site.url}${bookAddress(id)}manifest.json">Manifest</a>`,
          ] as const,
        ]),
  ];
  return html`${
    details.description
      ? html`<p class="description" itemprop="description">${details.description}</p>
`
      : null
  }<dl>${rows.map(
    ([term, value]) => html`<div><dt>${term}</dt><dd>${value}</dd></div>
`,
  )}</dl>`;
}

/** What the book's owner wants to be shown, besides author and licence. */
function otherDetails({ details }: SiteBook): (readonly [string, Content])[] {
  return details
    .filter(({ label }) => !/^(author|rights|licen[cs]e)$/i.test(label))
    .map(({ label, value, href }) => {
      const isAddress = href !== undefined && /^https?:/.test(href);
      return [
        label,
        isAddress ? html`<a rel="nofollow noopener" href="${href}">${value}</a>` : value,
      ];
    });
}

function contents(outline: readonly SiteOutlineEntry[]): Content {
  if (outline.length === 0) return null;
  return html`<h2>Contents</h2>
<nav class="contents">${outlineList(outline)}</nav>`;
}

function outlineList(entries: readonly SiteOutlineEntry[]): Html {
  return html`<ol>${entries.map(
    (
      entry,
    ) => html`<li>${outlineLink(entry)}${entry.children.length > 0 ? outlineList(entry.children) : null}</li>
`,
  )}</ol>`;
}

function outlineLink({ title, page, href }: SiteOutlineEntry): Content {
  if (page !== null) {
    const part = Math.floor((page - 1) / pagesInPart) + 1;
    return html`<a href="text/${part}.html#page-${page}" data-page="${page}">${title}</a>`;
  }
  return href === undefined ? title : html`<a rel="nofollow noopener" href="${href}">${title}</a>`;
}

function partName(book: SiteBook, part: number): string {
  const from = part * pagesInPart;
  const to = Math.min(from + pagesInPart, book.pages.length) - 1;
  const label = (index: number): string => book.pages[index]?.label ?? String(index + 1);
  return from === to ? `Page ${label(from)}` : `Pages ${label(from)} to ${label(to)}`;
}
