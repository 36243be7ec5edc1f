/** The reader that `turnleaf read` serves: one book in the whole window. */

import "turnleaf";
import { Bar } from "./bar.ts";
import { pageOfHash } from "./pages.ts";

/** What the command says about the book it serves. */
interface Config {
  readonly src: string;
  readonly title: string;
}

async function start(): Promise<void> {
  const config: Config = await (await fetch("./config.json")).json();
  document.title = config.title;
  // Pages already read are found again after a reload, and when the command is started anew.
  const memory = `turnleaf page of ${config.title}`;
  const book = document.createElement("turnleaf-book");
  // Where neither says, the book opens where it asks to.
  const page = pageOfHash(location.hash) ?? recall(memory);
  if (page !== null) book.setAttribute("page", String(page));
  book.setAttribute("src", config.src);
  const bar = new Bar(book);
  book.addEventListener("load", () => {
    document.title = book.bookTitle || config.title;
    bar.show();
    book.focus({ preventScroll: true });
  });
  book.addEventListener("pagechange", () => {
    bar.refresh();
    history.replaceState(null, "", `#page=${book.page}`);
    remember(memory, String(book.page));
  });
  addEventListener("hashchange", () => {
    const wanted = pageOfHash(location.hash);
    if (wanted !== null && wanted !== book.page) void book.goTo(wanted);
  });
  document.getElementById("wait")?.remove();
  document.getElementById("desk")?.append(book);
}

/** Storage may be forbidden: the book then opens at its start. */
function recall(key: string): string | null {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}

function remember(key: string, value: string): void {
  try {
    localStorage.setItem(key, value);
  } catch {
    // Not remembering is no reason to stop reading.
  }
}

start().catch(() => {
  const wait = document.getElementById("wait");
  if (wait) wait.textContent = "The book is no longer served; start turnleaf again and reload.";
});
