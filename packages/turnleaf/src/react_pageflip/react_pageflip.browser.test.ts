/** `HTMLFlipBook` in React's StrictMode, which mounts everything twice. */

import { createElement, createRef, type ReactElement, type ReactNode, StrictMode } from "react";
import { createRoot, type Root } from "react-dom/client";
import { afterEach, expect, test, vi } from "vitest";
import { clock } from "../for_tests/clock.ts";
import { eventually } from "../for_tests/eventually.ts";
import HTMLFlipBook, { type HTMLFlipBookProps, type HTMLFlipBookRef } from "./index.ts";

let root: Root | null = null;

afterEach(() => {
  root?.unmount();
  root = null;
  document.body.replaceChildren();
  vi.restoreAllMocks();
});

/** Renders under StrictMode, into a place that stays the same. */
function show(element: ReactElement): HTMLElement {
  if (!root) {
    const place = document.createElement("div");
    place.style.width = "400px";
    document.body.append(place);
    root = createRoot(place);
  }
  root.render(createElement(StrictMode, null, element));
  return document.body.firstElementChild as HTMLElement;
}

/** The pages of the README's first example, of which a page may be said to be another. */
const pages = (names: readonly string[]): ReactNode[] =>
  names.map((name) => createElement("div", { className: "demoPage", key: name }, name));

const size = { width: 100, height: 150, flippingTime: 200 };

function flipBook(
  props: Partial<HTMLFlipBookProps> & { ref?: React.Ref<HTMLFlipBookRef> },
  names: readonly string[],
): ReactElement {
  return createElement(HTMLFlipBook, { ...size, ...props }, ...pages(names));
}

const six = ["Page 1", "Page 2", "Page 3", "Page 4", "Page 5", "Page 6"];

test("the children are pages, events are called, and the ref has the book", async () => {
  const faults = vi.spyOn(console, "error");
  const ref = createRef<HTMLFlipBookRef>();
  const said: [string, unknown][] = [];
  const place = show(
    flipBook(
      {
        ref,
        className: "mine",
        style: { color: "red" },
        onInit: ({ data }) => said.push(["init", data]),
        onFlip: ({ data }) => said.push(["flip", data]),
        onChangeState: ({ data }) => said.push(["state", data]),
      },
      six,
    ),
  );
  await eventually(() => said.filter(([name]) => name === "init")).toHaveLength(1);
  // StrictMode's first book is gone, whatever it had begun.
  expect(place.querySelectorAll("turnleaf-book")).toHaveLength(1);
  expect(place.querySelector<HTMLElement>(".mine")?.style.color).toBe("red");
  const book = ref.current?.pageFlip();
  expect(book?.getPageCount()).toBe(6);
  said.length = 0;
  book?.flipNext();
  await eventually(() => said).toEqual([
    ["state", "flipping"],
    ["flip", 2],
    ["state", "read"],
  ]);
  expect(faults).not.toHaveBeenCalled();
});

test("pages change in place, come and go, and the book stays where it is", async () => {
  const faults = vi.spyOn(console, "error");
  const ref = createRef<HTMLFlipBookRef>();
  const said: unknown[] = [];
  const props = {
    ref,
    startPage: 2,
    onUpdate: () => said.push("update"),
    onInit: () => said.push("init"),
  };
  const place = show(flipBook(props, six));
  await eventually(() => said).toEqual(["init"]);
  // The same pages again: nothing is opened anew.
  show(flipBook(props, six));
  const changed = pages(six);
  changed[2] = createElement("div", { key: "Page 3" }, "Another text");
  show(createElement(HTMLFlipBook, { ...size, ...props }, ...changed));
  await eventually(() => place.textContent).toContain("Another text");
  expect(said).toEqual(["init"]);
  // Fewer, and one in another place.
  show(flipBook(props, ["Page 2", "Page 1", "Page 4", "Page 5"]));
  await eventually(() => said).toEqual(["init", "update"]);
  expect(ref.current?.pageFlip()?.getPageCount()).toBe(4);
  expect(ref.current?.pageFlip()?.getCurrentPageIndex()).toBe(2);
  expect(place.textContent).not.toContain("Page 6");
  show(flipBook(props, []));
  await eventually(() => ref.current?.pageFlip()?.getPageCount()).toBe(0);
  expect(faults).not.toHaveBeenCalled();
});

test("a first page that follows the open one makes no other book", async () => {
  const ref = createRef<HTMLFlipBookRef>();
  let times = 0;
  const props = { ref, onInit: () => times++ };
  show(flipBook({ ...props, startPage: 2 }, six));
  await eventually(() => times).toBe(1);
  const book = ref.current?.pageFlip();
  expect(book?.getCurrentPageIndex()).toBe(2);
  show(flipBook({ ...props, startPage: 4, className: "later" }, six));
  await eventually(() => document.querySelector(".later")).not.toBeNull();
  // Effects come after what is rendered.
  await clock.pass(200);
  expect(ref.current?.pageFlip()).toBe(book);
});

test("other options make another book, at the same page", async () => {
  const ref = createRef<HTMLFlipBookRef>();
  let times = 0;
  const props = { ref, onInit: () => times++ };
  show(flipBook(props, six));
  await eventually(() => times).toBe(1);
  ref.current?.pageFlip()?.turnToPage(4);
  show(flipBook({ ...props, width: 120, height: 180 }, six));
  await eventually(() => times).toBe(2);
  expect(ref.current?.pageFlip()?.getCurrentPageIndex()).toBe(4);
  expect(ref.current?.pageFlip()?.getSettings().width).toBe(120);
});

test("a book that is unmounted leaves nothing", async () => {
  const faults = vi.spyOn(console, "error");
  let isOpen = false;
  const place = show(
    flipBook(
      {
        onInit: () => {
          isOpen = true;
        },
      },
      six,
    ),
  );
  await eventually(() => isOpen).toBe(true);
  root?.unmount();
  root = null;
  expect(place.childNodes).toHaveLength(0);
  expect(faults).not.toHaveBeenCalled();
});
