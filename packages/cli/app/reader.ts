/** The reader that `turnleaf read` serves: one book in the whole window, of a shelf with a way back. */

import type { TurnleafBook } from "turnleaf";
import "turnleaf";
import { LocalBooks } from "./local_books.ts";

/** The command's configuration. */
interface Config {
  /** Several are a shelf; the page's address says which is read, counted from 1. */
  readonly books: readonly { readonly src: string; readonly title: string }[];
}

async function start(): Promise<void> {
  const { books }: Config = await (await fetch("./config.json")).json();
  const number = Number(new URLSearchParams(location.search).get("book") ?? 1);
  const config = books[number - 1];
  if (!config) throw new Error("There is no such book.");
  document.title = config.title;
  document.getElementById("shelf")?.toggleAttribute("hidden", books.length === 1);
  const book = document.createElement("turnleaf-book");
  // The document is English, the reader may not be.
  book.lang = navigator.language;
  // Pages already read are found again after a reload, and when the command is started anew.
  for (const name of ["controls", "address", "remember"]) book.setAttribute(name, "");
  book.setAttribute("src", config.src);
  book.addEventListener("load", () => {
    document.title = book.bookTitle || config.title;
    book.focus({ preventScroll: true, focusVisible: false });
  });
  reportWarnings(book);
  document.getElementById("wait")?.remove();
  const [notice, pickers] = ["notice", "pickers"].map((id) => document.getElementById(id));
  if (notice && pickers) new LocalBooks(book, notice, pickers);
  document.getElementById("desk")?.append(book);
}

/** Reports what a book drops to the command, which prints it, as it is found. */
function reportWarnings(book: TurnleafBook): void {
  const reported = new Set<string>();
  book.addEventListener("warnings", ({ detail }) => {
    const sentences = detail.warnings.map(({ message }) => message);
    const others = sentences.filter((sentence) => !reported.has(sentence));
    for (const sentence of others) reported.add(sentence);
    // A command that was ended prints nothing more.
    if (others.length > 0) {
      fetch("./report", { method: "POST", body: JSON.stringify(others) }).catch(() => {});
    }
  });
}

start().catch(() => {
  const wait = document.getElementById("wait");
  if (wait) wait.textContent = "The book is no longer served; start turnleaf again and reload.";
});
