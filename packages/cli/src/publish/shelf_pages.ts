/** The pages of a site that are not of one book: shelf and search. */

import { type Content, type Html, html } from "../html.ts";
import { shelfCard } from "../shelf_card.ts";
import { bookAddress } from "./book_pages.ts";
import { parseLicence } from "./licence.ts";
import { languageName, pageShell, type SiteOptions } from "./page_shell.ts";
import type { BookRecord } from "./record.ts";
import type { SiteAssets } from "./site_assets.ts";

/** Books on one page of the shelf. */
const booksOnShelf = 48;

/** A book of the site. */
export interface ShelvedBook {
  readonly id: string;
  readonly record: BookRecord;
}

/** Returns the number of the shelf's pages. */
export function shelfCount(books: number): number {
  return Math.max(Math.ceil(books / booksOnShelf), 1);
}

/** Returns the address of a page of the shelf (from 0), relative to the site. */
export function shelfAddress(shelf: number): string {
  return shelf === 0 ? "" : `shelf/${shelf + 1}.html`;
}

/** Returns a page of the shelf (from 0). */
export function shelfPage(
  site: SiteOptions,
  assets: SiteAssets,
  books: readonly ShelvedBook[],
  shelf: number,
): string {
  const count = shelfCount(books.length);
  const up = shelf === 0 ? "" : "../";
  const here = books.slice(shelf * booksOnShelf, (shelf + 1) * booksOnShelf);
  const name = site.title;
  return pageShell(site, {
    title: count > 1 && shelf > 0 ? `${name}, page ${shelf + 1} of ${count}` : name,
    description: `${name}: ${books.length} ${books.length === 1 ? "book" : "books"} to read`,
    address: shelfAddress(shelf),
    assets: assets.pages.shelf,
    bodyClass: "shelf-page",
    body: html`<header class="masthead"><h1>${shelf === 0 ? name : html`<a href="../">${name}</a>`}</h1>
${searchForm(up, "")}</header>
<main>
<ul class="shelf">${here.map((book) => card(up, book))}</ul>
${pager(up, shelf, count)}
</main>`,
  });
}

/** Returns the search page, whose results its script fills in. */
export function searchPage(site: SiteOptions, assets: SiteAssets): string {
  const name = site.title;
  return pageShell(site, {
    title: `Search – ${name}`,
    description: `Search all pages of all books of ${name}`,
    address: "search.html",
    assets: assets.pages.search,
    bodyClass: "search-page",
    body: html`<header class="masthead"><h1><a href="./">${name}</a></h1>
${searchForm("", "")}</header>
<main>
<p id="search-state" role="status"></p>
<noscript><p>Searching needs JavaScript; every page of every book can be read without it.</p></noscript>
<ol id="results" class="results"></ol>
<p><button id="more" type="button" hidden>More books</button></p>
</main>`,
  });
}

function searchForm(up: string, query: string): Html {
  return html`<form role="search" action="${up}search.html" method="get"><input type="search" name="q" value="${query}" aria-label="Search in all books" placeholder="Search in all books" required><button>Search</button></form>`;
}

function card(up: string, { id, record: { details, drawn } }: ShelvedBook): Html {
  const { title, language, cover, pageCount } = details;
  const folder = up + bookAddress(id);
  const licence = details.licence === undefined ? null : parseLicence(details.licence).name;
  const facts = [
    ...(language === "" ? [] : [languageName(language)]),
    `${pageCount} ${pageCount === 1 ? "page" : "pages"}`,
    ...(licence === null ? [] : [licence]),
  ];
  return shelfCard({
    ...{ href: folder, title, language, facts },
    authors: details.authors ?? [],
    cover: cover && { ...cover, src: `${folder}${cover.src}?v=${drawn.slice(0, 8)}` },
  });
}

function pager(up: string, shelf: number, count: number): Content {
  if (count === 1) return null;
  const to = (target: number): string => `${up}${shelfAddress(target)}` || "./";
  const link = (target: number, text: string, rel: string): Content =>
    target < 0 || target >= count
      ? html`<span></span>`
      : html`<a rel="${rel}" href="${to(target)}">${text}</a>`;
  return html`<nav class="turns" aria-label="Shelf">${link(shelf - 1, "Before", "prev")}<span>${shelf + 1} of ${count}</span>${link(shelf + 1, "More books", "next")}</nav>`;
}
