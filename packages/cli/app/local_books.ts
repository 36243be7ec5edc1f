/**
 * Books of the reader's own machine: dropped on the window, or picked by a
 * button or a key (Ctrl or Cmd and O, with Shift for a folder). One is opened
 * beside the book that is shown, and takes its place only once it can be read.
 */

import { openSource, type TurnleafBook } from "turnleaf";
import { droppedFiles, filesOfFolder, pickedFiles } from "./local_files.ts";

/** Milliseconds after which an opening that takes longer is announced. */
const noticed = 300;

/** The state of the history while a local book is shown; the book keeps it as it writes its place. */
const ofLocalBook = "local book";

/** Takes the place in the book out of the address, which gets a state. */
function leavePlace(state: string | null): void {
  history.replaceState(state, "", location.pathname + location.search);
}

/** Follows drops, the buttons and the keys until the page is left. */
export class LocalBooks {
  readonly #book: TurnleafBook;
  readonly #notice: HTMLElement;
  readonly #text: HTMLElement;
  readonly #button: HTMLButtonElement;
  /** Kept: one that nothing refers to may be collected while its dialog is open. */
  readonly #files: HTMLInputElement;
  readonly #folder: HTMLInputElement;
  #opening: AbortController | null = null;

  /**
   * @param book in which they are shown, not yet on the page
   * @param notice an element with a text and a button, hidden until there is something to say
   * @param pickers an element with a button that picks files, and one that picks a folder
   */
  constructor(book: TurnleafBook, notice: HTMLElement, pickers: HTMLElement) {
    this.#book = book;
    // The place in the address is that of a local book, which a reload does not bring back.
    if (history.state === ofLocalBook) leavePlace(null);
    this.#notice = notice;
    this.#text = notice.querySelector("span") as HTMLElement;
    this.#button = notice.querySelector("button") as HTMLButtonElement;
    this.#button.addEventListener("click", () => this.#end());
    window.addEventListener("dragover", (event) => {
      if (event.dataTransfer?.types.includes("Files")) event.preventDefault();
    });
    window.addEventListener("drop", (event) => {
      if (!event.dataTransfer?.types.includes("Files")) return;
      event.preventDefault();
      // Its files can be asked for during the event alone.
      void this.#open(droppedFiles(event.dataTransfer));
    });
    this.#files = this.#pickerOf(pickedFiles);
    this.#files.multiple = true;
    this.#folder = this.#pickerOf(filesOfFolder);
    this.#folder.webkitdirectory = true;
    const [files, folder] = pickers.querySelectorAll("button");
    files?.addEventListener("click", () => pick(this.#files));
    folder?.addEventListener("click", () => pick(this.#folder));
    window.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && !notice.hidden) this.#end();
      if (event.key.toLowerCase() !== "o" || event.altKey) return;
      if (!(event.ctrlKey || event.metaKey)) return;
      event.preventDefault();
      pick(event.shiftKey ? this.#folder : this.#files);
    });
  }

  /** @param chosen returns what of the picked files is opened, in order */
  #pickerOf(chosen: (files: Iterable<File>) => readonly File[]): HTMLInputElement {
    const input = document.createElement("input");
    input.type = "file";
    input.addEventListener(
      "change",
      () => void this.#open(Promise.resolve(chosen(input.files ?? []))),
    );
    return input;
  }

  /** Ends an opening, and takes the notice away. */
  #end(): void {
    this.#opening?.abort();
    this.#opening = null;
    this.#notice.hidden = true;
  }

  async #open(chosen: Promise<readonly File[]>): Promise<void> {
    this.#end();
    const opening = new AbortController();
    this.#opening = opening;
    const { signal } = opening;
    const announce = (): void => {
      if (!signal.aborted) this.#say("Opening …", "Cancel");
    };
    const timer = setTimeout(announce, noticed);
    try {
      const files = await chosen;
      signal.throwIfAborted();
      if (files.length === 0) throw new Error("There is no book in it; choose another.");
      const source = await openSource(files, { signal, askPassword });
      if (signal.aborted) return source.close();
      this.#notice.hidden = true;
      // The place in the address is that of the book before.
      leavePlace(ofLocalBook);
      this.#book.pages = source;
    } catch (error) {
      if (!signal.aborted) this.#say(error instanceof Error ? error.message : `${error}`, "Close");
    } finally {
      clearTimeout(timer);
    }
  }

  #say(text: string, button: string): void {
    this.#text.textContent = text;
    this.#button.textContent = button;
    this.#notice.hidden = false;
  }
}

/** Opens an input's dialog. */
function pick(input: HTMLInputElement): void {
  // The same files may be picked again.
  input.value = "";
  input.click();
}

async function askPassword(isWrong: boolean): Promise<string | null> {
  return prompt(isWrong ? "The password was wrong. Try again:" : "The file's password:");
}
