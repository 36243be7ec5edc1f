/** The body of the page that lists the books which `turnleaf read` serves. */

import { html } from "../html.ts";
import { shelfCard } from "../shelf_card.ts";

/** Returns the markup of a shelf; its script draws the covers. */
export function shelfBody(
  books: readonly { readonly src: string; readonly title: string }[],
): string {
  const cards = books.map(({ src, title }, k) =>
    shelfCard({
      ...{ href: `index.html?book=${k + 1}`, title, language: "" },
      ...{ authors: [], facts: [], cover: null, bookSrc: src },
    }),
  );
  return html`<header class="masthead"><h1>${books.length} books</h1></header>
<main>
<ul class="shelf">${cards}</ul>
</main>
`.text;
}
