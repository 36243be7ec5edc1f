/** The component for React, in StrictMode, which mounts everything twice, and on a server's HTML. */

import {
  createElement,
  createRef,
  type ReactElement,
  StrictMode,
  useEffect,
  useLayoutEffect,
  useState,
} from "react";
import { createRoot, hydrateRoot, type Root } from "react-dom/client";
import { renderToString } from "react-dom/server.browser";
import { afterEach, expect, test, vi } from "vitest";
import { clock } from "../for_tests/clock.ts";
import { scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import type { TurnleafBook as BookElement } from "../index.ts";
import { TurnleafBook, type TurnleafBookProps } from "./react.ts";

const style = { width: "300px", height: "220px" };
let root: Root | null = null;

afterEach(() => {
  root?.unmount();
  root = null;
  document.body.replaceChildren();
  vi.restoreAllMocks();
});

function place(): HTMLElement {
  const element = document.createElement("div");
  document.body.append(element);
  return element;
}

function show(element: ReactElement): void {
  root ??= createRoot(place());
  root.render(createElement(StrictMode, null, element));
}

const theBook = () => document.querySelector("turnleaf-book") as BookElement;

test("properties, listeners and the ref are the element's", async () => {
  const faults = vi.spyOn(console, "error");
  const ref = createRef<BookElement>();
  const said: string[] = [];
  const book = (props: TurnleafBookProps) =>
    show(createElement(TurnleafBook, { ref, style, className: "mine", duration: 100, ...props }));
  const events: TurnleafBookProps = {
    onLoad: ({ detail }) => said.push(`load ${detail.pageCount}`),
    onTurnStart: ({ detail }) => said.push(`start ${detail.to}`),
    onPageChange: ({ detail }) => said.push(`page ${detail.to}`),
  };
  book({ ...events, pages: scans(8), cover: "none", offset: 0, sound: true, assist: false });
  await eventually(() => said).toEqual(["load 8"]);
  expect(ref.current).toBe(theBook());
  expect(theBook().className).toBe("mine");
  const { cover, sound, assist, duration } = theBook();
  expect([cover, sound, assist, duration]).toEqual(["none", true, false, 100]);
  expect(await ref.current?.next()).toBe(true);
  expect(said).toEqual(["load 8", "start 3", "page 3"]);

  // Others in place of them; what is no longer given is as it was.
  book({ pages: scans(8), offset: 0, layout: "single", "aria-label": "A book" });
  await eventually(() => theBook().layout).toBe("single");
  expect([theBook().cover, theBook().sound, theBook().assist]).toEqual(["auto", false, true]);
  expect(theBook().ariaLabel).toBe("A book");
  expect(await ref.current?.next()).toBe(true);
  expect(said.length).toBe(3);
  expect(faults.mock.calls).toEqual([]);
});

test("a list of pages written anew does not open the book anew, another does", async () => {
  const loads: number[] = [];
  const images = scans(6);
  const book = (count: number) =>
    show(
      createElement(TurnleafBook, {
        style,
        pages: images.slice(0, count).map(({ src }) => ({ src })),
        paper: { stock: "card" },
        onLoad: ({ detail }) => loads.push(detail.pageCount),
      }),
    );
  book(6);
  await eventually(() => loads).toEqual([6]);
  for (let k = 0; k < 3; k++) {
    book(6);
    await clock.pass(50);
  }
  expect(theBook().pageCount).toBe(6);
  book(4);
  await eventually(() => loads).toEqual([6, 4]);
});

/** Whether the parent lets the reader turn, and sets its page from outside. */
let mayTurn = true;
let setPage: (page: number) => void = () => {};

function Reader({ pages }: { pages: { src: string }[] }): ReactElement {
  const [page, set] = useState(3);
  useEffect(() => {
    setPage = set;
  }, []);
  return createElement(TurnleafBook, {
    style,
    pages,
    page,
    cover: "none",
    offset: 0,
    duration: 0,
    onPageChange: ({ detail }) => mayTurn && set(detail.to),
  });
}

test("a controlled page turns the book, and the book turns back if it is not let", async () => {
  show(createElement(Reader, { pages: scans(12) }));
  await eventually(() => theBook()?.pageCount).toBe(12);
  expect(theBook().page).toBe(3);
  setPage(7);
  await eventually(() => theBook().page).toBe(7);
  await theBook().next();
  await settled(theBook());
  expect(theBook().page).toBe(9);
  mayTurn = false;
  await theBook().next();
  await eventually(() => theBook().page).toBe(9);
  mayTurn = true;
  await theBook().next();
  await eventually(() => theBook().page).toBe(11);
  await settled(theBook());
  expect(theBook().page).toBe(11);
});

function TurnsOn({ pages }: { pages: { src: string }[] }): ReactElement {
  const [page, set] = useState(3);
  // The book turns on between the rendering of one turn and its effects.
  useLayoutEffect(() => {
    if (page === 5) void theBook().next();
  }, [page]);
  const onPageChange: TurnleafBookProps["onPageChange"] = ({ detail }) => set(detail.to);
  const place = { style, cover: "none", offset: 0, duration: 0 } as const;
  return createElement(TurnleafBook, { ...place, pages, page, onPageChange });
}

test("a turn made while the one before is rendered is not turned back", async () => {
  show(createElement(TurnsOn, { pages: scans(12) }));
  await eventually(() => theBook()?.pageCount).toBe(12);
  const changes: number[] = [];
  theBook().addEventListener("pagechange", ({ detail }) => changes.push(detail.to));
  await theBook().next();
  await eventually(() => changes.includes(7)).toBe(true);
  await settled(theBook());
  expect([theBook().page, changes]).toEqual([7, [5, 7]]);
});

test("a page without a listener, and a first page, leave the turning to the reader", async () => {
  for (const props of [{ page: 3 }, { defaultPage: 3 }]) {
    show(
      createElement(TurnleafBook, {
        ...props,
        key: JSON.stringify(props),
        style,
        duration: 0,
        pages: scans(8),
      }),
    );
    await eventually(() => theBook()?.pageCount).toBe(8);
    expect(theBook().page).toBe(2);
    await theBook().next();
    await settled(theBook());
    expect(theBook().page).toBe(4);
    root?.unmount();
    root = null;
    document.body.replaceChildren();
  }
});

test("children are pages, which React adds, changes and removes", async () => {
  const page = (name: string) =>
    createElement("section", { key: name, style: { width: "100px", height: "150px" } }, name);
  const faults = vi.spyOn(console, "error");
  const pages = (names: string[]) => show(createElement(TurnleafBook, { style }, names.map(page)));
  pages(["One", "Two", "Three", "Four"]);
  await eventually(() => theBook()?.pageCount).toBe(4);
  pages(["Zero", "One", "Two", "Three", "Four", "Five"]);
  await eventually(() => theBook().pageCount).toBe(6);
  pages(["Three"]);
  await eventually(() => theBook().pageCount).toBe(1);
  expect(theBook().textContent).toBe("Three");
  expect(faults.mock.calls).toEqual([]);
});

test("a server's HTML becomes the book, without a fault of hydration, open before or not", async () => {
  const faults = vi.spyOn(console, "error");
  for (const isOpenBefore of [false, true]) {
    const loads: number[] = [];
    const props: TurnleafBookProps = {
      style,
      src: "data:application/json,{}",
      page: 2,
      theme: "night",
      hardPages: "1-2",
      address: false,
      sound: true,
      onLoad: ({ detail }) => loads.push(detail.pageCount),
    };
    props.src = `data:application/json,${encodeURIComponent(JSON.stringify({ pages: scans(4) }))}`;
    const host = place();
    const element = createElement(StrictMode, null, createElement(TurnleafBook, props));
    host.innerHTML = renderToString(element);
    const [book] = host.children as unknown as BookElement[];
    expect(book.getAttribute("hard-pages")).toBe("1-2");
    expect([book.page, book.theme, book.sound, book.address]).toEqual([2, "night", true, false]);
    if (isOpenBefore) await eventually(() => book.pageCount).toBe(4);
    const hydrated = hydrateRoot(host, element);
    await eventually(() => loads[0]).toBe(4);
    expect(host.firstElementChild).toBe(book);
    hydrated.unmount();
  }
  expect(faults.mock.calls).toEqual([]);
});
