/** Prints the pages of a book, one per sheet, and downloads its file. */

import { BookError, type PagePicture, type PageSource } from "../sources/page_source.ts";
import { mostPrinted, type PrintOptions } from "./printing.ts";

/**
 * Width of a printed page in pixels: A4 at 300 dots an inch, as printers print letters. Many pages take
 * half of it, as each of the others takes up to two megabytes until it is printed.
 */
const widthOfFew = 2480;
const widthOfMany = 1240;
const mostSharp = 40;

/**
 * Draws pages and opens the browser's print dialog with them, each upright on a
 * sheet of its own. Resolves to true once they are in the dialog. Rejects with
 * a `BookError` if a page cannot be drawn, there is none or there are too many,
 * or with the signal's reason.
 */
export async function printPages(
  source: Pick<PageSource, "title" | "pageCount" | "draw">,
  options: PrintOptions,
): Promise<true> {
  const { from = 1, to = source.pageCount, onPage } = options;
  const [first, last] = [Math.max(Math.ceil(from), 1), Math.min(Math.floor(to), source.pageCount)];
  // Nor is there one between 3 and 2, or if a number is NaN.
  if (!(first <= last)) {
    throw new BookError(
      `There are no pages ${from} to ${to} to print; the book has ${source.pageCount}.`,
      { code: "noPage" },
    );
  }
  if (last - first >= mostPrinted) {
    throw new BookError(`${mostPrinted} pages can be printed at once; print fewer.`, {
      code: "tooLarge",
    });
  }
  const signal = options.signal ?? new AbortController().signal;
  const width = last - first < mostSharp ? widthOfFew : widthOfMany;
  const urls: string[] = [];
  const frame = document.createElement("iframe");
  const end = (): void => {
    frame.remove();
    for (const url of urls) URL.revokeObjectURL(url);
  };
  try {
    document.body.append(hidden(frame));
    const { document: sheets, window } = inside(frame);
    sheets.title = source.title;
    for (let page = first; page <= last; page++) {
      onPage?.(page);
      const picture = await source.draw(page - 1, width, signal, undefined, null);
      const url = URL.createObjectURL(await encode(picture));
      urls.push(url);
      const image = sheets.createElement("img");
      image.src = url;
      sheets.body.append(image);
      await image.decode().catch((cause) => {
        const sentence =
          "The book cannot be printed; this page's Content-Security-Policy may not allow blob: in img-src.";
        throw new BookError(sentence, { code: "blocked", source: source.title, cause });
      });
      signal.throwIfAborted();
    }
    window.addEventListener("afterprint", () => setTimeout(end), { once: true });
    window.focus();
    window.print();
    return true;
  } catch (error) {
    end();
    throw error;
  }
}

/** Out of sight but rendered: an element that is not rendered is not printed. */
function hidden(frame: HTMLIFrameElement): HTMLIFrameElement {
  frame.ariaHidden = "true";
  frame.tabIndex = -1;
  Object.assign(frame.style, {
    position: "fixed",
    inset: "auto auto 0 0",
    width: "1px",
    height: "1px",
    border: "0",
    opacity: "0",
  });
  return frame;
}

function inside(frame: HTMLIFrameElement): { document: Document; window: Window } {
  const window = frame.contentWindow as Window & typeof globalThis;
  const sheet = new window.CSSStyleSheet();
  sheet.replaceSync(`@page { margin: 0; } html, body { margin: 0; }
    img { display: block; width: 100vw; height: 100vh; object-fit: contain; break-after: page; break-inside: avoid; }`);
  window.document.adoptedStyleSheets = [sheet];
  return { document: window.document, window };
}

/** Returns a drawn page as a file; its bitmap is freed. */
async function encode(picture: PagePicture): Promise<Blob> {
  const canvas = document.createElement("canvas");
  canvas.width = picture.width;
  canvas.height = picture.height;
  canvas.getContext("2d")?.drawImage(picture, 0, 0);
  if ("close" in picture) picture.close();
  const blob = await new Promise<Blob | null>((resolve) =>
    canvas.toBlob(resolve, "image/jpeg", 0.92),
  );
  canvas.width = 0;
  if (blob === null)
    throw new BookError("There is no memory left to print with; print fewer pages.", {
      code: "tooLarge",
    });
  return blob;
}

/** Downloads the source's own file for the reader. Resolves to whether there is one. */
export async function downloadFile(source: PageSource): Promise<boolean> {
  const file = await source.file?.();
  if (file === undefined) return false;
  const link = document.createElement("a");
  const ending = { "application/pdf": ".pdf", "application/epub+zip": ".epub" }[file.type] ?? "";
  // Characters that file systems do not allow in a name.
  const name = source.title.replace(/[\p{C}\\/:*?"<>|]+/gu, " ").trim() || "book";
  const isNamed = ending !== "" && name.toLowerCase().endsWith(ending);
  link.download = isNamed ? name : name + ending;
  link.href = URL.createObjectURL(file);
  link.click();
  // The browser has read it by the next task, at the latest in a minute.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  return true;
}
