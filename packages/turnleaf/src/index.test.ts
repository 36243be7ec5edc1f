import { expect, expectTypeOf, test } from "vitest";
import type { Edge, Layout, TurnDetail, TurnleafBook } from "./index.ts";

test("the package's public list, importable where there is no DOM", async () => {
  expect(globalThis.document).toBeUndefined();
  const turnleaf = await import("./index.ts");
  expect(Object.keys(turnleaf).sort()).toEqual([
    "BookError",
    "TurnleafBook",
    "addLanguage",
    "openSource",
  ]);
});

/** Checked by the compiler and never run: there is no DOM here. */
function types(): void {
  const book = document.createElement("turnleaf-book");
  expectTypeOf(book).toEqualTypeOf<TurnleafBook>();
  expectTypeOf(document.querySelector("turnleaf-book")).toEqualTypeOf<TurnleafBook | null>();
  book.addEventListener("pagechange", (event) => {
    expectTypeOf(event.detail).toEqualTypeOf<TurnDetail>();
  });
  book.addEventListener("layoutchange", ({ detail }) => {
    expectTypeOf(detail).toEqualTypeOf<{ layout: Layout; binding: Edge }>();
  });
  // These are every element's too, and have more details here.
  book.addEventListener("load", ({ detail }) => expectTypeOf(detail.pageCount).toBeNumber());
  book.addEventListener("error", ({ detail }) => expectTypeOf(detail.message).toBeString());
  book.addEventListener("click", (event) => expectTypeOf(event).toEqualTypeOf<PointerEvent>());
  book.addEventListener("my-own", (event) => expectTypeOf(event).toEqualTypeOf<Event>());
  // @ts-expect-error: no such binding
  book.binding = "middle";
  // @ts-expect-error: it is read only
  book.pageCount = 3;
}

test("the element, its properties and its events are typed", () => {
  expectTypeOf(types).toBeFunction();
});
