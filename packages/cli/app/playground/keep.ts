/** Files for the reader to save: links in a list, each replaced by the next of its name. */

import { make } from "./make.ts";

/** The list. */
export class Kept {
  readonly element: HTMLUListElement = make("ul", { className: "files" });
  readonly #urls = new Map<string, { url: string; item: HTMLElement }>();

  /** @param label the name of the list */
  constructor(label: string) {
    this.element.setAttribute("aria-label", label);
  }

  /**
   * Adds a file.
   *
   * @param note shown beside its size
   * @param isSaved whether it is saved at once, because its button was pressed
   */
  add(name: string, blob: Blob, note = "", isSaved = false): void {
    const before = this.#urls.get(name);
    if (before) {
      URL.revokeObjectURL(before.url);
      before.item.remove();
    }
    const url = URL.createObjectURL(blob);
    const link = make("a", { href: url, download: name }, name);
    const size = `${Number((blob.size / 1000).toPrecision(3))} kB`;
    const item = make("li", {}, link, ` ${[size, note].filter(Boolean).join(", ")}`);
    this.#urls.set(name, { url, item });
    this.element.append(item);
    if (isSaved) link.click();
  }
}
