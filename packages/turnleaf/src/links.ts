/**
 * Books without code: `<a href="book.pdf" data-turnleaf>Title</a>` becomes a book in its place. The
 * link stays where there is no JavaScript, and where the book does not open.
 *
 * Importing this module shows the books of all such links in the web page, once that is parsed; on a
 * server it does nothing.
 */

import { TurnleafBook } from "./index.ts";

/** Begins the attributes of a link that are attributes of its book. */
const prefix = "data-turnleaf-";

/** They name code: a link may be by somebody who may add links to the page, and no code. */
const forbidden = new Set(["engine-src", "pdf-worker"]);

/**
 * Shows the books of the links in a part of the web page, for links that came after it was parsed:
 * each `<a href>` with the attribute `data-turnleaf` becomes a book with controls. Its attributes are
 * those of the link that begin with `data-turnleaf-`, as `data-turnleaf-page="5"`;
 * `data-turnleaf-controls="off"` leaves the controls out.
 */
export function openLinks(root: ParentNode = document): void {
  for (const link of root.querySelectorAll<HTMLAnchorElement>("a[href][data-turnleaf]")) {
    link.replaceWith(bookOf(link));
  }
}

/** Returns the book of a link, whose place that takes again if the book does not open. */
function bookOf(link: HTMLAnchorElement): TurnleafBook {
  const book = link.ownerDocument.createElement("turnleaf-book");
  for (const { name, value } of link.attributes) {
    const attribute = name.slice(prefix.length);
    if (name.startsWith(prefix) && isOfBooks(attribute)) book.setAttribute(attribute, value);
  }
  // A link's reader could save the file and search it.
  book.toggleAttribute("controls", link.dataset.turnleafControls !== "off");
  book.setAttribute("src", link.href);
  const ended = new AbortController();
  const { signal } = ended;
  book.addEventListener("load", () => ended.abort(), { signal });
  book.addEventListener(
    "error",
    () => {
      ended.abort();
      book.replaceWith(link);
    },
    { signal },
  );
  return book;
}

/** Whether an attribute is one of books, and of no other element: none that runs code is. */
function isOfBooks(name: string): boolean {
  const property = name.replace(/-([a-z])/g, (_, letter: string) => letter.toUpperCase());
  const isOwn = property in TurnleafBook.prototype && !(property in HTMLElement.prototype);
  return isOwn && !forbidden.has(name);
}

if (globalThis.document) {
  if (document.readyState !== "loading") openLinks();
  else document.addEventListener("DOMContentLoaded", () => openLinks(), { once: true });
}
