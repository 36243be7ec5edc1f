/** The reader's keys. Those that turn one page belong to the element. */

import type { ControlledBook } from "./book.ts";

/** Commands of keys besides those of the book itself. */
export interface KeyCommands {
  search(): void;
  /** Closes what is open. Returns whether something was. */
  escape(): boolean;
  zoom(by: 1 | 0 | -1): void;
  bookmark(): void;
  /** Asks which pages are to be printed. Returns whether the book may be. */
  print(): boolean;
  /** Shows what each key does. */
  help(): void;
  /** Sets flowing text one step larger (1) or smaller (-1). */
  type(by: 1 | -1): void;
}

/**
 * Listens on the element until the signal aborts. Keys with Ctrl, Alt or Meta
 * belong to the browser, but for the one that prints, as the browser would print a picture of the
 * screen, and the one that puts a torn leaf back; those typed into a field or a dialog, or meant for
 * a button, stay there.
 */
export function listenToKeys(
  book: ControlledBook,
  commands: KeyCommands,
  signal: AbortSignal,
): void {
  book.addEventListener("keydown", (event) => handle(event, book, commands), { signal });
}

function handle(event: KeyboardEvent, book: ControlledBook, commands: KeyCommands): void {
  // A dialog around the book is the web page's own: the book is read there as anywhere.
  const path = event.composedPath();
  const inside = path.slice(0, path.indexOf(book));
  const isDialogs = inside.some((at) => at instanceof HTMLDialogElement);
  if (event.defaultPrevented || event.altKey || isDialogs) return;
  if (event.ctrlKey || event.metaKey) {
    if (event.key === "p" && !event.shiftKey) {
      if (commands.print()) event.preventDefault();
      return;
    }
    const undoes = event.key === "z" && !event.shiftKey && book.tornLeaves > 0;
    if (!undoes || isTyping(event.composedPath()[0])) return;
    event.preventDefault();
    void book.putBack();
    return;
  }
  if (event.key === "Escape") {
    if (commands.escape()) event.preventDefault();
    return;
  }
  const target = event.composedPath()[0];
  if (isTyping(target)) return;
  const anywhere: Record<string, () => unknown> = {
    "+": () => commands.zoom(1),
    "=": () => commands.zoom(1),
    "-": () => commands.zoom(-1),
    "0": () => commands.zoom(0),
    ">": () => commands.type(1),
    "<": () => commands.type(-1),
    f: () => book.toggleFullscreen(),
    b: () => commands.bookmark(),
    o: () => book.shownLayout === "spread" && book.toggleShift(),
    "/": () => commands.search(),
    "?": () => commands.help(),
  };
  const onBook: Record<string, () => unknown> = {
    Home: () => book.turnTo(1, { jump: true }),
    End: () => book.turnTo(Number.POSITIVE_INFINITY, { jump: true }),
    // While it is zoomed, the key is the book's own.
    ...(book.zoom <= 1 && { " ": () => book.press(event.shiftKey ? -1 : 1, !event.repeat) }),
  };
  // In its shadow tree, the frame around everything takes the focus for the book.
  const isBook = target === book || (target as Node).parentNode === book.shadowRoot;
  const command = anywhere[event.key] ?? (isBook ? onBook[event.key] : undefined);
  if (command === undefined) return;
  event.preventDefault();
  void command();
}

/** Returns whether a key typed there is a letter rather than a command. */
function isTyping(target: EventTarget | undefined): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target.isContentEditable || /^(TEXTAREA|SELECT)$/.test(target.tagName)) return true;
  return target instanceof HTMLInputElement && target.type !== "range";
}
