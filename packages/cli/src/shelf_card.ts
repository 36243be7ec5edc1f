/** A book on a shelf: of a published site, or of those that `turnleaf read` serves. */

import { type Html, html } from "./html.ts";

/** What a shelf shows of a book. */
export interface ShelfCard {
  /** Where it is read. */
  readonly href: string;
  readonly title: string;
  /** BCP 47 tag of the title; "" if unknown. */
  readonly language: string;
  readonly authors: readonly string[];
  /** Its language, number of pages and the like. */
  readonly facts: readonly string[];
  /** Its picture; without one there is room for it. */
  readonly cover: { readonly src: string; readonly width: number; readonly height: number } | null;
  /** The address of the book's own file, for a script that draws its cover. */
  readonly bookSrc?: string;
}

/** Returns an entry of a list of the class `shelf`. */
export function shelfCard(card: ShelfCard): Html {
  const { href, title, language, authors, facts, cover, bookSrc } = card;
  return html`<li${bookSrc === undefined ? null : html` data-src="${bookSrc}"`}><a href="${href}"><span class="cover">${cover ? html`<img src="${cover.src}" width="${cover.width}" height="${cover.height}" alt="" loading="lazy" decoding="async">` : html`<span class="blank"></span>`}</span>
<span class="title" lang="${language}">${title}</span></a>
${
  authors.length > 0
    ? html`<span class="author">${authors.join(", ")}</span>
`
    : null
}<span class="facts">${facts.join(" · ")}</span></li>
`;
}
