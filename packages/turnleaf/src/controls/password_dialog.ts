/** Asks for the password of a protected file. */

import { languageOf } from "../words/languages.ts";
import { make } from "./make.ts";
import { wordingFor } from "./wording.ts";

/**
 * Opens the dialog in an element's shadow tree; it removes itself. Resolves to
 * the password; to null if the reader gives none, or once the signal aborts.
 *
 * @param isWrong whether the last one was not the file's
 */
export function askPassword(
  book: HTMLElement,
  isWrong: boolean,
  signal: AbortSignal,
): Promise<string | null> {
  if (signal.aborted) return Promise.resolve(null);
  const { texts } = wordingFor(languageOf(book));
  const input = make("input", {
    class: "entry",
    type: "password",
    autocomplete: "current-password",
    required: true,
  });
  const note = make("p", { role: "status", class: "remark" });
  note.textContent = isWrong ? texts.wrongPassword : texts.passwordNeeded;
  const cancel = make("button", { type: "button", class: "plain" }, texts.cancel);
  const go = make("button", { type: "submit", class: "plain strong" }, texts.open);
  const form = make("form", {}, make("h2", { id: "password" }, texts.password), note);
  form.append(
    make("label", {}, make("span", {}, texts.password), input),
    make("div", { class: "choices" }, cancel, go),
  );
  const dialog = make(
    "dialog",
    { part: "dialog", class: "ui dialog", "aria-labelledby": "password" },
    form,
  );
  let password: string | null = null;
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    password = input.value;
    dialog.close();
  });
  cancel.addEventListener("click", () => dialog.close());
  (book.shadowRoot?.querySelector(".frame") ?? book).append(dialog);
  dialog.showModal();
  const close = (): void => dialog.close();
  signal.addEventListener("abort", close);
  return new Promise((resolve) => {
    dialog.addEventListener("close", () => {
      signal.removeEventListener("abort", close);
      dialog.remove();
      resolve(password);
    });
  });
}
