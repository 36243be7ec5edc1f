/** The reader that `turnleaf read` serves: one book in the whole window. */

import "turnleaf";

/** The command's configuration of the book. */
interface Config {
  readonly src: string;
  readonly title: string;
}

async function start(): Promise<void> {
  const config: Config = await (await fetch("./config.json")).json();
  document.title = config.title;
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
  document.getElementById("wait")?.remove();
  document.getElementById("desk")?.append(book);
}

start().catch(() => {
  const wait = document.getElementById("wait");
  if (wait) wait.textContent = "The book is no longer served; start turnleaf again and reload.";
});
