/** Asks which pages are to be printed, the open ones at first, and shows how far their drawing is. */

import { mostPrinted } from "../element/printing.ts";
import { fill } from "../words/languages.ts";
import type { ControlledBook } from "./book.ts";
import { findPage } from "./find_page.ts";
import { make } from "./make.ts";
import type { Wording } from "./wording.ts";

/**
 * Opens the dialog in a shadow tree; it removes itself.
 *
 * @csspart dialog The dialogs that ask which pages are to be printed, and for a password.
 */
export function askPrint(book: ControlledBook, wording: Wording, host: Node): void {
  const { texts, number } = wording;
  const ended = new AbortController();
  const field = (label: string, page: number) => {
    const input = make("input", { class: "entry", autocomplete: "off", spellcheck: "false" });
    input.value = book.label(page);
    return { input, line: make("label", {}, make("span", {}, label), input) };
  };
  const { left, right } = book.spread;
  const open = [left, right].filter((page) => page !== null);
  const from = field(texts.from, Math.min(...open, book.page));
  const to = field(texts.to, Math.max(...open, book.page));
  const all = make("button", { type: "button", class: "plain" }, texts.allPages);
  all.addEventListener("click", () => {
    from.input.value = book.label(1);
    to.input.value = book.label(Math.min(book.pageCount, mostPrinted));
  });
  const status = make("p", { role: "status", class: "remark" });
  if (book.pageCount > mostPrinted)
    status.textContent = wording.plural(texts.mostPrinted, mostPrinted);
  const progress = make("progress", { hidden: true, "aria-label": texts.print });
  const cancel = make("button", { type: "button", class: "plain" }, texts.cancel);
  const go = make("button", { type: "submit", class: "plain strong" }, texts.print);
  const form = make("form", {}, make("h2", { id: "print" }, texts.print));
  form.append(
    from.line,
    to.line,
    status,
    progress,
    make("div", { class: "choices" }, all, cancel, go),
  );
  const dialog = make(
    "dialog",
    { part: "dialog", class: "ui dialog", "aria-labelledby": "print" },
    form,
  );

  const range = (): { first: number; last: number } | null => {
    const first = findPage(book, from.input.value);
    const last = findPage(book, to.input.value);
    for (const [{ input }, page] of [
      [from, first],
      [to, last],
    ] as const) {
      input.ariaInvalid = String(page === null);
      if (page === null) {
        status.textContent = fill(texts.noSuchPage, { label: input.value.slice(0, 40) });
      }
    }
    if (first === null || last === null) return null;
    if (Math.abs(last - first) < mostPrinted) {
      return { first: Math.min(first, last), last: Math.max(first, last) };
    }
    status.textContent = wording.plural(texts.mostPrinted, mostPrinted);
    return null;
  };

  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const pages = range();
    if (pages === null) return;
    const { first, last } = pages;
    go.disabled = true;
    progress.hidden = false;
    progress.max = last - first + 1;
    const onPage = (page: number): void => {
      progress.value = page - first;
      status.textContent = fill(texts.drawing, { page: number(page) });
    };
    book.print({ from: first, to: last, signal: ended.signal, onPage }).then(
      () => dialog.close(),
      (error: unknown) => {
        go.disabled = false;
        progress.hidden = true;
        status.textContent = error instanceof Error ? wording.sentence(error) : "";
      },
    );
  });
  cancel.addEventListener("click", () => dialog.close());
  dialog.addEventListener("close", () => {
    ended.abort();
    dialog.remove();
  });
  host.appendChild(dialog);
  dialog.showModal();
}
