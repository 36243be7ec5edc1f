/** The component for Svelte, mounted and on a server's HTML. */

import { hydrate, mount, unmount } from "svelte";
import { render } from "svelte/server";
import { afterEach, expect, test, vi } from "vitest";
import { scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import Reader from "../for_tests/Reader.svelte";
import ServerReader from "../for_tests/Reader.svelte?server";
import type { TurnleafBook as BookElement } from "../index.ts";

const mounted: object[] = [];

afterEach(async () => {
  for (const component of mounted.splice(0)) await unmount(component);
  document.body.replaceChildren();
  vi.restoreAllMocks();
});

const theBook = () => document.querySelector("turnleaf-book") as BookElement;

interface State {
  page: number;
  count: number;
  theme: string | undefined;
  label: string;
}

test("properties and events are the element's, and bind:page has its page", async () => {
  const faults = [vi.spyOn(console, "warn"), vi.spyOn(console, "error")];
  const said: string[] = [];
  let state = {} as State;
  let element: () => unknown = () => null;
  const props = {
    images: scans(8),
    handOut: (its: State, itsElement: () => unknown) => {
      state = its;
      element = itsElement;
    },
    onload: ({ detail }: CustomEvent<{ pageCount: number }>) =>
      said.push(`load ${detail.pageCount}`),
  };
  mounted.push(mount(Reader, { target: document.body, props }));
  await eventually(() => said).toEqual(["load 8"]);
  expect(element()).toBe(theBook());
  const { page, theme, sound, assist, className } = theBook();
  expect([page, theme, sound, assist, className]).toEqual([3, "night", true, true, "mine"]);
  await theBook().next();
  await settled(theBook());
  expect([state.page, theBook().page]).toEqual([5, 5]);
  state.page = 7;
  await eventually(() => theBook().page).toBe(7);
  state.theme = undefined;
  state.label = "Two";
  await eventually(() => theBook().ariaLabel).toBe("Two");
  expect(theBook().hasAttribute("theme")).toBe(false);
  expect(said).toEqual(["load 8"]);
  state.count = 4;
  await eventually(() => said).toEqual(["load 8", "load 4"]);
  expect(faults.flatMap(({ mock }) => mock.calls)).toEqual([]);
});

test("a server's HTML becomes the book, without a fault of hydration", async () => {
  const faults = [vi.spyOn(console, "warn"), vi.spyOn(console, "error")];
  const loads: number[] = [];
  const props = {
    src: `data:application/json,${encodeURIComponent(JSON.stringify({ pages: scans(4) }))}`,
    onload: ({ detail }: CustomEvent<{ pageCount: number }>) => loads.push(detail.pageCount),
  };
  const host = document.createElement("div");
  document.body.append(host);
  host.innerHTML = render(ServerReader, { props }).body;
  const book = theBook();
  expect([book.page, book.hardPages, book.theme, book.sound]).toEqual([3, "1-2", "night", true]);
  // Open before Svelte is there.
  await eventually(() => book.pageCount).toBe(4);
  mounted.push(hydrate(Reader, { target: host, props }));
  await eventually(() => loads).toEqual([4]);
  expect(theBook()).toBe(book);
  expect(faults.flatMap(({ mock }) => mock.calls)).toEqual([]);
});
