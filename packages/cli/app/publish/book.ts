/** The script of a book's page: the reader in place of the cover, and the book for offline. */

import "turnleaf";
import "./site.css";
import type { TurnleafBook } from "turnleaf";
import { keepBook, keepVisited } from "./offline.ts";
import { type BookData, openPublished, type PublishedSource } from "./published_source.ts";

const desk = document.getElementById("reader");

if (desk) {
  const data = { ...desk.dataset } as unknown as BookData;
  const { book, source } = open(desk, data);
  leadContents(book);
  void offerOffline(desk, data, source);
}

/** Puts the reader in the cover's place. */
function open(desk: HTMLElement, data: BookData) {
  const book = document.createElement("turnleaf-book");
  // The page is English, the reader may not be.
  book.lang = navigator.language;
  for (const name of ["controls", "address", "remember"]) book.setAttribute(name, "");
  let source: Promise<PublishedSource> | null = null;
  if (data.file) book.setAttribute("src", data.file);
  else {
    book.pages = () => {
      source = openPublished(data);
      return source;
    };
  }
  desk.replaceChildren(book);
  return { book, source: () => source };
}

/** Makes the contents turn the book to their pages instead of leading to its text. */
function leadContents(book: TurnleafBook): void {
  document.addEventListener("click", (event) => {
    const link = (event.target as Element | null)?.closest?.("a[data-page]");
    const isPlain = !(event.ctrlKey || event.metaKey || event.shiftKey || event.altKey);
    if (!(link instanceof HTMLAnchorElement) || !isPlain) return;
    event.preventDefault();
    scrollTo({ top: 0 });
    void book.goTo(Number(link.dataset.page));
  });
}

async function offerOffline(
  desk: HTMLElement,
  data: BookData,
  source: () => Promise<PublishedSource> | null,
): Promise<void> {
  // What the reader loads for its first pages is kept with the rest.
  const book = desk.querySelector("turnleaf-book");
  await new Promise<void>((resolve) => {
    if (!book || book.ready) return resolve();
    for (const type of ["load", "error"] as const) {
      book.addEventListener(type, () => resolve(), { once: true });
    }
  });
  const registration = await keepVisited();
  const button = document.getElementById("keep-offline");
  const state = document.getElementById("keep-offline-state");
  if (!registration || !(button instanceof HTMLButtonElement) || !state) return;
  button.hidden = false;
  button.addEventListener("click", async () => {
    button.disabled = true;
    const opened = await source();
    const pages = opened ? opened.addresses() : [data.file];
    const scripts = performance
      .getEntriesByType("resource")
      .map(({ name }) => name)
      .filter((name) => name.includes("/assets/"));
    const first = [location.href.split("#", 1)[0] ?? "", `book.json?v=${data.version}`];
    try {
      await keepBook(registration, data.id, [...first, ...scripts, ...pages], (fraction) => {
        state.textContent = `${Math.floor(100 * fraction)} %`;
      });
      state.textContent = "Kept: the whole book can be read without a connection.";
    } catch (error) {
      state.textContent = error instanceof Error ? error.message : "";
      button.disabled = false;
    }
  });
}
