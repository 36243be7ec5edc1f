/**
 * The drop-in beside page-flip 2.0.7 itself, in the same page: each does the same
 * things with the same options, and what it says of itself is compared.
 */

import { afterEach, expect, test } from "vitest";
import { clock } from "../for_tests/clock.ts";
import { scan } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import {
  type Book,
  type BookClass,
  classes,
  fillsRect,
  hasRead,
  htmlPages,
  make,
  opened,
  pageSize,
  removeBooks,
  type ShownBook,
} from "../for_tests/page_flips.ts";
import { type FlipSetting, PageFlip } from "./index.ts";

afterEach(removeBooks);

const state = (book: Book) => ({
  count: book.getPageCount(),
  index: book.getCurrentPageIndex(),
  orientation: book.getOrientation(),
  bounds: book.getBoundsRect(),
  state: book.getState(),
});

/** Runs the same with both, and expects the same of both. */
async function compare(run: (made: BookClass) => Promise<unknown>): Promise<unknown> {
  const seen: unknown[] = [];
  for (const [, made] of classes) {
    seen.push(await run(made));
    removeBooks();
  }
  expect(seen[1]).toEqual(seen[0]);
  return seen[1];
}

const sizes: readonly [Partial<FlipSetting>, string][] = [
  [{}, "width: 400px"],
  [{ showCover: true }, "width: 400px"],
  [{ startPage: 3 }, "width: 400px"],
  [{ startPage: 3, showCover: true }, "width: 400px"],
  [{ startPage: 30 }, "width: 400px"],
  // One page, where two have no room, and two all the same.
  [{ startPage: 3 }, "width: 150px"],
  [{ usePortrait: false }, "width: 150px"],
  [{ autoSize: false }, "width: 400px; height: 300px"],
  [{ size: "stretch", minWidth: 80, maxWidth: 160 }, "width: 500px"],
  [{ size: "stretch", minWidth: 80, maxWidth: 160 }, "width: 260px"],
  [{ size: "stretch", minWidth: 80, maxWidth: 160 }, "width: 140px"],
  [{ size: "stretch", minHeight: 400 }, "width: 300px"],
];

test.each(sizes)("where it lies and what it shows with %j in %s", async (options, style) => {
  const seen = await compare(async (made) => {
    const { book, log, host } = await opened(made, options, style);
    const init = log.find(([name]) => name === "init")?.[1];
    const { width, height } = host.getBoundingClientRect();
    return { ...state(book), init, width, height, settings: book.getSettings() };
  });
  expect(seen).toMatchObject({ count: 7, state: "read" });
});

test.each([{ width: 0 }, { height: -1 }, { size: "huge" as "fixed" }, { flippingTime: 0 }])(
  "an option that is not valid is rejected: %j",
  (wrong) => {
    const messages = classes.map(([, made]) => {
      try {
        return new made(document.createElement("div"), { ...pageSize, ...wrong });
      } catch (error) {
        return (error as Error).message;
      }
    });
    expect(messages[0]).toMatch(/Invalid/);
    expect(messages[1]).toBe(messages[0]);
  },
);

test.each([
  { options: {}, style: "width: 400px" },
  { options: { showCover: true }, style: "width: 400px" },
  { options: {}, style: "width: 150px" },
])("turning at once, $options in $style", async ({ options, style }) => {
  const seen = await compare(async (made) => {
    const { book, log } = await opened(made, options, style);
    log.length = 0;
    const indexes: number[] = [];
    const did = (turn: () => void): void => {
      turn();
      indexes.push(book.getCurrentPageIndex());
    };
    did(() => book.turnToPage(3));
    did(() => book.turnToNextPage());
    did(() => book.turnToPrevPage());
    did(() => book.turnToPage(6));
    did(() => book.turnToPage(99));
    did(() => book.turnToPage(-1));
    did(() => book.turnToPage(0));
    did(() => book.turnToPrevPage());
    return { indexes, log: [...log] };
  });
  expect((seen as { log: unknown[] }).log.length).toBeGreaterThan(4);
});

test("turning with motion, and what is said of it", async () => {
  const seen = await compare(async (made) => {
    const { book, log } = await opened(made, { showCover: true });
    const turned = async (turn: () => void): Promise<unknown[]> => {
      log.length = 0;
      turn();
      await hasRead(log, 0);
      return [...log, book.getCurrentPageIndex(), book.getState()];
    };
    return [
      await turned(() => book.flipNext()),
      await turned(() => book.flipNext("bottom")),
      await turned(() => book.flipPrev("top")),
      await turned(() => book.flip(6)),
      await turned(() => book.flip(0, "bottom")),
    ];
  });
  expect((seen as unknown[])[0]).toEqual([
    ["changeState", "flipping"],
    ["flip", 1],
    ["changeState", "read"],
    1,
    "read",
  ]);
});

test("at the ends of the book nothing turns", async () => {
  await compare(async (made) => {
    const { book, log } = await opened(made);
    log.length = 0;
    book.flipPrev();
    await clock.pass(300);
    return [...log, book.getCurrentPageIndex()];
  });
});

test("other elements take the place of the pages, at the same index", async () => {
  await compare(async (made) => {
    const { book, log } = await opened(made, { startPage: 4 });
    log.length = 0;
    book.updateFromHtml(htmlPages(9));
    await eventually(() => log.some(([name]) => name === "update")).toBe(true);
    return { log: [...log], ...state(book) };
  });
});

test("images as pages, and others in their place", async () => {
  await compare(async (made) => {
    const { book, log } = make(made, { startPage: 2 });
    const images = (count: number): string[] =>
      Array.from({ length: count }, (_, k) => scan(k + 1, 100, 150));
    book.loadFromImages(images(6));
    await eventually(() => log.some(([name]) => name === "init")).toBe(true);
    const before = state(book);
    log.length = 0;
    book.updateFromImages(images(8));
    await eventually(() => log.some(([name]) => name === "update")).toBe(true);
    return { before, after: state(book), log: [...log] };
  });
});

test("pages that cannot be loaded leave the book as it was; no pages clear it", async () => {
  const { book, host } = make(PageFlip, { startPage: 2 });
  const opens = new Promise((resolve) => book.on("init", resolve));
  const pages = htmlPages(6);
  book.loadFromHTML(pages);
  await opens;
  const style = pages[2]?.getAttribute("style");
  const fails = new Promise((resolve) => book.getBook()?.addEventListener("error", resolve));
  book.updateFromImages(["none.png"]);
  book.flipNext();
  await fails;
  expect([book.getPageCount(), book.getCurrentPageIndex()]).toEqual([6, 2]);
  expect(pages[2]?.getAttribute("style")).toBe(style);
  const element = book.getBook();
  expect([element?.pageCount, element?.page]).toEqual([6, 3]);
  book.turnToPage(4);
  await eventually(() => element?.page).toBe(5);
  book.updateFromHtml([]);
  expect([book.getPageCount(), book.getCurrentPageIndex()]).toEqual([0, 0]);
  await eventually(() => element?.ready).toBe(false);
  expect([...host.querySelectorAll(":scope > .page")]).toEqual(pages);
});

test("a host that gets narrower shows one page", async () => {
  await compare(async (made) => {
    const { book, log, around } = await opened(made, { startPage: 3 });
    log.length = 0;
    around.style.width = "150px";
    window.dispatchEvent(new Event("resize"));
    await eventually(() => book.getOrientation()).toBe("portrait");
    await eventually(() => log.length > 0).toBe(true);
    return log.find(([name]) => name === "changeOrientation");
  });
});

/** Presses, moves and releases a mouse at places in a book's host, for either implementation. */
async function drag({ book, host }: ShownBook, places: readonly [x: number, y: number][]) {
  if (book instanceof PageFlip) await fillsRect(book);
  const box = host.getBoundingClientRect();
  const canvas = host.querySelector("turnleaf-book")?.shadowRoot?.querySelector("canvas");
  if (canvas) canvas.setPointerCapture = () => {};
  const target = canvas ?? host.querySelector(".stf__block") ?? host;
  const send = (kind: string, [x, y]: readonly [number, number]): void => {
    const place = { clientX: box.left + x, clientY: box.top + y, bubbles: true, composed: true };
    target.dispatchEvent(
      new PointerEvent(`pointer${kind}`, { ...place, pointerId: 1, pointerType: "mouse" }),
    );
    target.dispatchEvent(new MouseEvent(`mouse${kind}`, place));
  };
  send("down", places[0]);
  for (const place of places.slice(1)) {
    send("move", place);
    await clock.pass(60);
  }
  // A leaf comes after the pointer: it is let go where it has arrived.
  await clock.pass(1500);
  const last = places.at(-1) as [number, number];
  send("up", last);
  const place = { clientX: box.left + last[0], clientY: box.top + last[1] };
  target.dispatchEvent(new MouseEvent("click", { ...place, bubbles: true, composed: true }));
}

test("a page is dragged over, and the states say so", async () => {
  const seen = await compare(async (made) => {
    const shown = await opened(made, { startPage: 2 });
    const { book, log } = shown;
    log.length = 0;
    await drag(shown, [
      [160, 75],
      [110, 75],
      [60, 75],
      [20, 75],
    ]);
    await hasRead(log, 0);
    return { log: [...log], index: book.getCurrentPageIndex() };
  });
  expect(seen).toMatchObject({ index: 4 });
});

test.each([
  { options: {}, at: [150, 75], index: 4 },
  { options: {}, at: [50, 75], index: 0 },
  { options: { disableFlipByClick: true }, at: [150, 75], index: 2 },
  { options: { disableFlipByClick: true }, at: [195, 145], index: 4 },
  { options: { useMouseEvents: false }, at: [195, 75], index: 2 },
] as const)("a click at $at with $options", async ({ options, at, index }) => {
  await compare(async (made) => {
    const given = { startPage: 2, showPageCorners: false, ...options };
    const shown = await opened(made, given);
    const { book } = shown;
    await drag(shown, [[at[0], at[1]]]);
    await eventually(() => book.getCurrentPageIndex()).toBe(index);
    await clock.pass(300);
    return book.getCurrentPageIndex();
  });
});

test("the element has what the options say", async () => {
  const { book } = make(PageFlip, {
    flippingTime: 700,
    drawShadow: true,
    maxShadowOpacity: 0.4,
    swipeDistance: 55,
    showPageCorners: false,
    mobileScrollSupport: false,
    startZIndex: 7,
  });
  book.loadFromHTML(htmlPages(7));
  const element = book.getBook();
  expect(element?.duration).toBe(700);
  expect(element?.shadows).toBe(0.4);
  expect(element?.swipeDistance).toBe(55);
  expect(element?.gestures).toBe("drag");
  expect(element?.hardPages).toBe("1,7");
  const host = element?.closest<HTMLElement>(".stf__parent");
  expect(host?.style.touchAction).toBe("none");
  expect(host?.querySelector<HTMLElement>(".stf__wrapper")?.style.zIndex).toBe("7");
  const flat = make(PageFlip, { drawShadow: false, showCover: true });
  flat.book.loadFromHTML(htmlPages(8));
  expect(flat.book.getBook()?.shadows).toBe(0);
  expect(flat.book.getBook()?.hardPages).toBe("1,8");
});

test("the open book fills page-flip's rectangle", async () => {
  for (const style of ["width: 400px", "width: 150px"]) {
    const { book, host } = await opened(PageFlip, {}, style);
    const element = book.getBook() as NonNullable<ReturnType<typeof book.getBook>>;
    const { left, top, height, pageWidth } = book.getBoundsRect();
    const isPortrait = book.getOrientation() === "portrait";
    await fillsRect(book);
    const bounds = element.bookBounds as DOMRect;
    const box = element.getBoundingClientRect();
    const outside = host.getBoundingClientRect();
    expect(box.left + bounds.left - outside.left).toBeCloseTo(
      left + (isPortrait ? pageWidth : 0),
      -0.5,
    );
    expect(box.top + bounds.top - outside.top).toBeCloseTo(top, -0.5);
    expect(Math.abs(bounds.height - height)).toBeLessThan(3);
  }
});

const places: readonly [Partial<FlipSetting>, string, shown: number[]][] = [
  [{}, "width: 400px", [0, 1]],
  [{ startPage: 6 }, "width: 400px", [6]],
  [{ showCover: true }, "width: 400px", [0]],
  [{ showCover: true, startPage: 2 }, "width: 400px", [1, 2]],
  [{ showCover: true, startPage: 7 }, "width: 400px", [7]],
  [{ showCover: true }, "width: 150px", [0]],
  [{ showCover: true, startPage: 7 }, "width: 150px", [7]],
  [{ showCover: true, autoSize: false }, "width: 260px; height: 300px", [0]],
  [{ showCover: true, size: "stretch", minWidth: 80, maxWidth: 400 }, "width: 500px", [0]],
];

/** Where elements of pages lie in their host: their edges, CSS pixels. */
function edgesIn(host: HTMLElement, page: HTMLElement) {
  const [outer, inner] = [host.getBoundingClientRect(), page.getBoundingClientRect()];
  return [
    inner.left - outer.left,
    inner.top - outer.top,
    inner.right - outer.left,
    inner.bottom - outer.top,
  ];
}

test.each(places)(
  "pages lie where page-flip's do, with %j in %s",
  async (options, style, shown) => {
    const [original, ours] = await Promise.all(
      classes.map(async ([, made]) => {
        const { book, host, pages } = await opened(made, options, style, options.showCover ? 8 : 7);
        if (book instanceof PageFlip) await fillsRect(book);
        return {
          edges: () => shown.flatMap((page) => edgesIn(host, pages[page])),
          classes: () => shown.map((page) => [...pages[page].classList].sort()),
        };
      }),
    );
    expect(ours.classes()).toEqual(original.classes());
    expect(original.classes()[0]).toContain("stf__item");
    // A cover lies as high over the table as the book is thick, and is seen that much larger.
    const edges = original.edges();
    const most = 0.04 * (edges[2] - edges[0]);
    // Laid out once, the book is measured and laid out anew.
    await eventually(() => {
      const distances = ours.edges().map((edge, side) => Math.abs(edge - edges[side]));
      return Math.max(...distances);
    }).toBeLessThan(most);
  },
);

test("a host that was emptied gets nothing back; one that was refilled keeps that", async () => {
  const emptied = await opened(PageFlip);
  emptied.host.replaceChildren();
  emptied.book.destroy();
  expect(emptied.host.childNodes.length).toBe(0);
  expect(emptied.host.hasAttribute("class")).toBe(false);
  const refilled = await opened(PageFlip);
  refilled.host.innerHTML = "<p>Another</p>";
  refilled.book.destroy();
  expect(refilled.host.innerHTML).toBe("<p>Another</p>");
  // One page that somebody took away is not brought back.
  const taken = await opened(PageFlip);
  document.body.append(taken.pages[3]);
  taken.book.destroy();
  expect([...taken.host.children]).toEqual(taken.pages.filter((_, k) => k !== 3));
  expect(taken.pages[3].parentElement).toBe(document.body);
  expect(taken.pages[3].className).toBe("page");
});

test("an emptied host gets the book anew when pages are loaded", async () => {
  const { book, host, log } = await opened(PageFlip);
  host.replaceChildren();
  log.length = 0;
  book.loadFromHTML(htmlPages(4));
  await eventually(() => log.some(([name]) => name === "init")).toBe(true);
  expect(host.contains(book.getBook())).toBe(true);
  expect(book.getPageCount()).toBe(4);
});

test("destroy leaves what others have set meanwhile", async () => {
  const { book, host, pages } = await opened(PageFlip);
  host.style.color = "red";
  host.style.width = "70%";
  pages[0].style.background = "gold";
  pages[0].classList.add("read");
  book.destroy();
  expect(host.getAttribute("style")).toBe("width: 70%; color: red;");
  expect(pages[0].getAttribute("style")).toBe("background: gold;");
  expect(pages[0].className).toBe("page read");
});

// What page-flip does otherwise, and is a fault there.
test("one listener of several is removed; the host outlives the book, and has its pages again", async () => {
  const { book, log, host, pages } = await opened(PageFlip, {}, "width: 400px; color: red");
  const flips: number[] = [];
  const listener = ({ data }: { data: number }): void => void flips.push(data);
  book.on("flip", listener);
  log.length = 0;
  book.turnToPage(2);
  book.off("flip", listener);
  book.turnToPage(4);
  expect(flips).toEqual([2]);
  expect(log).toEqual([
    ["flip", 2],
    ["flip", 4],
  ]);
  book.off("flip");
  book.turnToPage(0);
  expect(log.length).toBe(2);
  book.destroy();
  expect(host.isConnected).toBe(true);
  expect([...host.children]).toEqual(pages);
  expect(host.getAttribute("style")).toBeNull();
  expect(pages[0].getAttribute("style")).toBeNull();
  book.destroy();
  // The same elements in another book.
  const again = new PageFlip(host, pageSize);
  const opens = new Promise((resolve) => again.on("init", resolve));
  again.loadFromHTML(host.querySelectorAll<HTMLElement>(".page"));
  await opens;
  again.clear();
  expect([...host.querySelectorAll(":scope > .page")]).toEqual(pages);
  expect(again.getPageCount()).toBe(0);
});

test("commands that come before the book is open wait for it", async () => {
  const { book, log } = make(PageFlip);
  book.loadFromHTML(htmlPages(7));
  book.flipNext();
  await eventually(() => log.filter(([name]) => name === "flip").length).toBe(2);
  expect(book.getCurrentPageIndex()).toBe(2);
});
