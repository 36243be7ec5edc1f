/** The help of keys: what each does in the book that is open. */

import type { ControlledBook } from "./book.ts";
import { make } from "./make.ts";
import type { Wording } from "./wording.ts";

/** Opens the help in a shadow tree; it removes itself. */
export function showKeys(book: ControlledBook, { texts }: Wording, host: Node): void {
  const [on, back] = book.direction === "rtl" ? ["←", "→"] : ["→", "←"];
  const isSpread = book.shownLayout === "spread";
  const rows: readonly (readonly [what: string, keys: readonly string[], isUseful?: boolean])[] = [
    [texts.next, [on, texts.keySpace]],
    [texts.previous, [back, `⇧ ${texts.keySpace}`]],
    [texts.firstPage, [texts.keyHome]],
    [texts.lastPage, [texts.keyEnd]],
    [texts.zoomIn, ["+"]],
    [texts.zoomOut, ["−"]],
    [texts.wholePage, ["0"]],
    [texts.largerType, [">"], book.canTypeset],
    [texts.smallerType, ["<"], book.canTypeset],
    [texts.search, ["/"]],
    [texts.addBookmark, ["B"]],
    [texts.shift, ["O"], isSpread],
    [texts.fullscreen, ["F"]],
    [texts.print, ["Ctrl P"], book.allows.print],
    [texts.keys, ["?"]],
  ];
  const list = make("dl", { class: "keys" });
  for (const [what, keys, isUseful = true] of rows) {
    if (!isUseful) continue;
    const names = make("dd");
    for (const key of keys) names.append(make("kbd", {}, key));
    list.append(make("dt", {}, what), names);
  }
  const close = make("button", { type: "button", class: "plain" }, texts.close);
  const dialog = make(
    "dialog",
    { part: "dialog", class: "ui dialog", "aria-labelledby": "keys" },
    make("h2", { id: "keys" }, texts.keys),
    list,
    make("div", { class: "choices" }, close),
  );
  close.addEventListener("click", () => dialog.close());
  dialog.addEventListener("keydown", (event) => {
    if (event.key === "?") dialog.close();
  });
  dialog.addEventListener("close", () => dialog.remove());
  host.appendChild(dialog);
  dialog.showModal();
}
