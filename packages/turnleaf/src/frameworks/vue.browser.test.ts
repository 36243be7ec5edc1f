/** The component for Vue, mounted and on a server's HTML. */

import { afterEach, expect, test, vi } from "vitest";
import { type App, createApp, createSSRApp, h, nextTick, reactive } from "vue";
import { renderToString } from "vue/server-renderer";
import { scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import type { TurnleafBook as BookElement } from "../index.ts";
import { TurnleafBook } from "./vue.ts";

const style = { width: "300px", height: "220px" };
const apps: App[] = [];

afterEach(() => {
  for (const app of apps.splice(0)) app.unmount();
  document.body.replaceChildren();
  vi.restoreAllMocks();
});

const theBook = () => document.querySelector("turnleaf-book") as BookElement;

/** Mounts what a function renders. Returns the place. */
function show(render: () => ReturnType<typeof h>): void {
  const app = createApp({ render });
  apps.push(app);
  const place = document.createElement("div");
  document.body.append(place);
  app.mount(place);
}

test("properties and events are the element's, and v-model has its page", async () => {
  const faults = [vi.spyOn(console, "warn"), vi.spyOn(console, "error")];
  const images = scans(8);
  const state = reactive({ page: 3, count: 8, theme: "night" as "night" | undefined, style });
  const said: string[] = [];
  show(() =>
    h(TurnleafBook, {
      // Written anew at every rendering.
      pages: images.slice(0, state.count).map(({ src }) => ({ src })),
      page: state.page,
      "onUpdate:page": (page: number) => {
        state.page = page;
      },
      theme: state.theme,
      cover: "none",
      offset: 0,
      sound: true,
      duration: 0,
      class: "mine",
      style: state.style,
      onLoad: ({ detail }) => said.push(`load ${detail.pageCount}`),
      onPagechange: ({ detail }) => said.push(`page ${detail.to}`),
    }),
  );
  await eventually(() => said).toEqual(["load 8"]);
  const { page, theme, sound, assist, className } = theBook();
  expect([page, theme, sound, assist, className]).toEqual([3, "night", true, true, "mine"]);
  await theBook().next();
  await settled(theBook());
  expect([state.page, theBook().page]).toEqual([5, 5]);
  state.page = 7;
  await eventually(() => theBook().page).toBe(7);
  state.theme = undefined;
  await nextTick();
  expect(theBook().hasAttribute("theme")).toBe(false);
  expect(said).toEqual(["load 8", "page 5", "page 7"]);
  state.count = 4;
  await eventually(() => said.at(-1)).toBe("load 4");
  expect(faults.flatMap(({ mock }) => mock.calls)).toEqual([]);
});

test("a template ref has the element", async () => {
  const refs: { element?: BookElement | null }[] = [];
  show(() =>
    h(TurnleafBook, { ref: (it) => it && refs.push(it as never), style, pages: scans(2) }),
  );
  await eventually(() => refs[0]?.element?.pageCount).toBe(2);
  expect(refs[0].element).toBe(theBook());
});

test("a server's HTML becomes the book, without a fault of hydration", async () => {
  const faults = [vi.spyOn(console, "warn"), vi.spyOn(console, "error")];
  const loads: number[] = [];
  const src = `data:application/json,${encodeURIComponent(JSON.stringify({ pages: scans(4) }))}`;
  const page = () =>
    createSSRApp({
      render: () =>
        h(TurnleafBook, {
          style,
          src,
          page: 2,
          hardPages: "1-2",
          theme: "night",
          controls: true,
          sound: true,
          assist: false,
          onLoad: ({ detail }) => loads.push(detail.pageCount),
        }),
    });
  const host = document.createElement("div");
  document.body.append(host);
  host.innerHTML = await renderToString(page());
  const [book] = host.children as unknown as BookElement[];
  expect([book.page, book.hardPages, book.theme]).toEqual([2, "1-2", "night"]);
  expect([book.controls, book.sound, book.assist]).toEqual([true, true, false]);
  // Open before Vue is there.
  await eventually(() => book.pageCount).toBe(4);
  const app = page();
  apps.push(app);
  app.mount(host);
  await eventually(() => loads).toEqual([4]);
  expect(host.firstElementChild).toBe(book);
  expect(faults.flatMap(({ mock }) => mock.calls)).toEqual([]);
});
