/**
 * How public projects use page-flip, each with page-flip 2.0.7 and with the drop-in in one page. What
 * both do is compared; where they differ, both are written down, and docs/page-flip.md says why.
 */

import { createElement, StrictMode, useEffect, useRef } from "react";
import { createRoot } from "react-dom/client";
import { afterEach, expect, test } from "vitest";
import { createApp, h, onMounted, reactive, ref } from "vue";
import { clock } from "../for_tests/clock.ts";
import { scan } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import {
  type Book,
  type BookClass,
  classes,
  hasRead,
  htmlPages,
  make,
  opened,
  pageSize,
  removeBooks,
} from "../for_tests/page_flips.ts";

afterEach(removeBooks);

/** What both do, or what each does. */
type Outcome = { both: unknown } | { original: unknown; ours: unknown };

const place = (book: Book) => [book.getPageCount(), book.getCurrentPageIndex()];

/** Turns with motion, and waits until the book is read again. */
async function turned(
  { book, log }: Awaited<ReturnType<typeof opened>>,
  turn: (book: Book) => void,
) {
  const from = log.length;
  turn(book);
  await hasRead(log, from);
  return book.getCurrentPageIndex();
}

/** Resolves once a book has said that it is open. */
const opens = (book: Book): Promise<void> =>
  new Promise((resolve) => book.on("init", () => resolve()));

function addHost(): HTMLElement {
  const host = document.createElement("div");
  host.style.width = "400px";
  document.body.append(host);
  return host;
}

/** Mounts a book in a React component as projects do, in StrictMode, and mounts it anew. */
async function inReact(made: BookClass): Promise<unknown> {
  const books: Book[] = [];
  // One may open before the next look at how many there are.
  const opening: Promise<void>[] = [];
  const Flip = () => {
    const around = useRef<HTMLDivElement>(null);
    useEffect(() => {
      // A host of its own, as page-flip removes its host.
      const host = document.createElement("div");
      around.current?.append(host);
      const book = new made(host, pageSize);
      opening.push(opens(book));
      book.loadFromHTML(htmlPages(6));
      books.push(book);
      return () => book.destroy();
    }, []);
    return createElement("div", { ref: around, style: { width: 400 } });
  };
  const root = createRoot(addHost());
  root.render(createElement(StrictMode, null, createElement(Flip)));
  await eventually(() => books.length).toBe(2);
  await opening[1];
  const first = place(books[1]);
  root.render(createElement(StrictMode, null, createElement(Flip, { key: "other" })));
  await eventually(() => books.length).toBe(4);
  await opening[3];
  books[3].turnToPage(2);
  const seen = [first, place(books[3]), document.querySelectorAll(".stf__wrapper").length];
  root.unmount();
  await eventually(() => document.querySelectorAll(".stf__wrapper").length).toBe(0);
  return seen;
}

const patterns: Record<string, [run: (made: BookClass) => Promise<unknown>, outcome: Outcome]> = {
  "pages are added while the book is open": [
    async (made) => {
      const { book, log, pages } = await opened(made, { startPage: 2 }, undefined, 4);
      log.length = 0;
      book.updateFromHtml([...pages, ...htmlPages(4)]);
      await eventually(() => log.some(([name]) => name === "update")).toBe(true);
      book.turnToPage(6);
      return place(book);
    },
    { both: [8, 6] },
  ],
  "the book in a Vue ref": [
    async (made) => {
      const held: { value: unknown } = ref();
      const app = createApp({
        setup() {
          const host = ref<HTMLElement>();
          onMounted(() => {
            held.value = new made(host.value as HTMLElement, pageSize);
            (held.value as Book).loadFromHTML(htmlPages(6));
          });
          return () => h("div", { ref: host, style: "width: 400px" });
        },
      });
      app.mount(addHost());
      const book = held.value as Book;
      await opens(book);
      book.turnToPage(2);
      const seen = [...place(book), book.getOrientation()];
      book.destroy();
      app.unmount();
      return seen;
    },
    { both: [6, 2, "landscape"] },
  ],
  "the book in reactive data": [
    async (made) => {
      const data = reactive({ book: null as Book | null, page: 0 });
      data.book = new made(addHost(), { ...pageSize, flippingTime: 200 }) as never;
      const book = data.book as Book;
      book.on("flip", ({ data: page }) => {
        data.page = page;
      });
      book.loadFromHTML(htmlPages(6));
      await opens(book);
      book.flipNext();
      await eventually(() => data.page).toBe(2);
      return data.page;
    },
    { both: 2 },
  ],
  "a React effect that runs twice, and a component that is mounted anew": [
    inReact,
    { both: [[6, 0], [6, 2], 1] },
  ],
  "pages that are canvases, painted by a script": [
    async (made) => {
      const pages = htmlPages(6).map((page) => {
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [100, 150];
        canvas.getContext("2d")?.fillRect(0, 0, 50, 50);
        page.replaceChildren(canvas);
        return page;
      });
      const { book } = make(made);
      book.loadFromHTML(pages);
      await opens(book);
      book.turnToPage(2);
      const pen = pages[2].querySelector("canvas")?.getContext("2d");
      return [...place(book), pen?.getImageData(10, 10, 1, 1).data[3]];
    },
    { both: [6, 2, 255] },
  ],
  "a stage that is scaled": [
    async (made) => {
      const shown = await opened(made, {}, "width: 400px; transform: scale(0.5)");
      const { book, host } = shown;
      const { width } = host.getBoundingClientRect();
      return [width, book.getBoundsRect().width, await turned(shown, () => book.flipNext())];
    },
    { both: [100, 200, 2] },
  ],
  "a tab that is hidden at first": [
    async (made) => {
      const { book, around } = make(made, { size: "stretch", minWidth: 50, maxWidth: 200 });
      around.style.display = "none";
      book.loadFromImages([1, 2, 3, 4].map((number) => scan(number)));
      await opens(book);
      around.style.display = "";
      book.update();
      await eventually(() => book.getBoundsRect().pageWidth).toBe(200);
      return [book.getOrientation(), book.getBoundsRect().height];
    },
    { both: ["landscape", 300] },
  ],
  "pages whose content comes later, as react-pdf draws it": [
    async (made) => {
      const { book, pages } = await opened(made);
      for (const page of pages) {
        const canvas = document.createElement("canvas");
        page.replaceChildren(canvas);
        canvas.getContext("2d")?.fillRect(0, 0, 10, 10);
      }
      book.turnToPage(2);
      return [...place(book), pages[2].isConnected, pages[2].childElementCount];
    },
    { both: [7, 2, true, 1] },
  ],
  "forms in pages": [
    async (made) => {
      const { book, pages } = await opened(made);
      const field = document.createElement("input");
      field.value = "typed";
      const button = document.createElement("button");
      let clicks = 0;
      button.addEventListener("click", () => clicks++);
      pages[1].replaceChildren(field, button);
      field.click();
      button.click();
      await clock.pass(300);
      book.turnToPage(2);
      book.turnToPage(0);
      return [book.getCurrentPageIndex(), field.value, clicks];
    },
    { both: [0, "typed", 1] },
  ],
  "frames in pages": [
    async (made) => {
      const { book } = make(made);
      const list = htmlPages(6);
      const frame = document.createElement("iframe");
      frame.srcdoc = "<p>Inside</p>";
      list[0].replaceChildren(frame);
      book.loadFromHTML(list);
      await opens(book);
      await eventually(() => frame.contentDocument?.body?.textContent).toBe("Inside");
      return frame.isConnected;
    },
    { both: true },
  ],
  "buttons outside, with the page's number between them": [
    async (made) => {
      const shown = await opened(made, { showCover: true });
      const { book } = shown;
      const label = document.createElement("output");
      book.on("flip", ({ data }) => {
        label.value = `${data + 1} of ${book.getPageCount()}`;
      });
      await turned(shown, () => book.flipNext());
      await turned(shown, () => book.flipNext());
      await turned(shown, () => book.flipPrev());
      return label.value;
    },
    { both: "2 of 7" },
  ],
  "arrow keys that the web page listens to": [
    async (made) => {
      const shown = await opened(made);
      const { book } = shown;
      const ended = new AbortController();
      document.addEventListener(
        "keydown",
        ({ key }) => {
          if (key === "ArrowRight") book.flipNext();
        },
        { signal: ended.signal },
      );
      const press = (on: Element): void => {
        const key = { key: "ArrowRight", bubbles: true, composed: true, cancelable: true };
        on.dispatchEvent(new KeyboardEvent("keydown", key));
      };
      const seen = [await turned(shown, () => press(document.body))];
      // The book has the focus: one key is one turn.
      seen.push(await turned(shown, () => press(book.getBook?.() ?? document.body)));
      ended.abort();
      return seen;
    },
    { both: [2, 4] },
  ],
  "a show that begins anew after the last page": [
    async (made) => {
      const shown = await opened(made, {}, undefined, 4);
      const { book } = shown;
      const seen: number[] = [];
      for (let step = 0; step < 3; step++) {
        const isLast = book.getCurrentPageIndex() >= book.getPageCount() - 2;
        if (isLast) book.turnToPage(0);
        else await turned(shown, () => book.flipNext());
        seen.push(book.getCurrentPageIndex());
      }
      return seen;
    },
    { both: [2, 0, 2] },
  ],
  "a link to a page, opened as soon as the pages are given": [
    async (made) => {
      const { book } = make(made);
      book.loadFromHTML(htmlPages(8));
      book.turnToPage(5);
      const at = book.getCurrentPageIndex();
      await opens(book);
      return [at, book.getCurrentPageIndex()];
    },
    { both: [4, 4] },
  ],
  "two books in one page, of which one is destroyed": [
    async (made) => {
      const [one, two] = [await opened(made), await opened(made)];
      one.book.destroy();
      return [await turned(two, (book) => book.flipNext()), one.host.isConnected];
    },
    { original: [2, false], ours: [2, true] },
  ],
  "a sound that is played as a page flips": [
    async (made) => {
      const shown = await opened(made);
      let plays = 0;
      shown.book.on("changeState", ({ data }) => {
        if (data === "flipping") plays++;
      });
      await turned(shown, (book) => book.flipNext());
      await turned(shown, (book) => book.flipPrev());
      return plays;
    },
    { both: 2 },
  ],
};

test.each(Object.entries(patterns))("%s", async (_, [run, outcome]) => {
  const seen: Record<string, unknown> = {};
  for (const [name, made] of classes) {
    seen[name] = await run(made);
    removeBooks();
  }
  const [original, ours] =
    "both" in outcome ? [outcome.both, outcome.both] : [outcome.original, outcome.ours];
  expect(seen).toEqual({ "page-flip": original, turnleaf: ours });
});
