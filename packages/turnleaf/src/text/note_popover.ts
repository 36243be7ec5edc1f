/** A note shown over the book, in place of a turn to where it is printed, or a question before a link is followed. */

/** Distance between the note and its link, and from the edges of what is seen, CSS pixels. */
const gap = 8;

/** One note at a time. Escape and a click elsewhere close it; the focus returns to its link. */
export class NotePopover {
  readonly element: HTMLElement = document.createElement("div");
  readonly #text: HTMLElement = document.createElement("p");
  readonly #more: HTMLButtonElement = document.createElement("button");
  #link: HTMLElement | null = null;
  #follow: () => void = () => {};

  constructor() {
    const { element } = this;
    element.className = "note";
    element.setAttribute("part", "note");
    element.setAttribute("popover", "auto");
    element.setAttribute("role", "dialog");
    element.tabIndex = -1;
    this.#more.type = "button";
    this.#more.addEventListener("click", () => {
      this.hide();
      this.#follow();
    });
    element.append(this.#text, this.#more);
    element.addEventListener("keydown", (event) => {
      // The keys of the book are not those of the note.
      event.stopPropagation();
      if (event.key !== "Escape") return;
      // It closes the note alone, and no dialog around the book.
      event.preventDefault();
      this.hide();
      this.#link?.focus();
    });
  }

  /** Whether the browser can show it; a link to a note is followed as any other where it cannot. */
  static get isSupported(): boolean {
    return "showPopover" in HTMLElement.prototype;
  }

  /**
   * Shows a note, or a question, at the foot of what is seen of the book, or at its head if its link
   * stands there.
   *
   * @param more the name of the page where the note is printed, or a word for following the link
   * @param follow turns there, or follows the link
   */
  show(note: string, link: HTMLElement, more: string, follow: () => void): void {
    const { element } = this;
    this.#text.textContent = note;
    this.#more.textContent = more;
    this.#link = link;
    this.#follow = follow;
    element.setAttribute("aria-label", link.getAttribute("aria-label") ?? "");
    element.showPopover();
    const beside = link.getBoundingClientRect();
    const { width, height } = element.getBoundingClientRect();
    const middle = beside.left + beside.width / 2 - width / 2;
    const left = Math.max(Math.min(middle, innerWidth - width - gap), gap);
    // At the foot of what is seen of the book, as notes are printed: not over the lines that are read next.
    const { top: head, bottom: foot } = element.parentElement?.getBoundingClientRect() ?? beside;
    const lowest = Math.min(foot, innerHeight) - gap - height;
    const isFree = lowest >= beside.bottom + gap;
    const top = Math.max(isFree ? lowest : Math.max(head, 0) + gap, gap);
    // No transformation reaches what lies over everything, but the `zoom` around it does.
    const zoom = width / element.offsetWidth || 1;
    Object.assign(element.style, { left: `${left / zoom}px`, top: `${top / zoom}px` });
    element.focus({ preventScroll: true });
  }

  hide(): void {
    if (this.element.matches(":popover-open")) this.element.hidePopover();
  }
}
