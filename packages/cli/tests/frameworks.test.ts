/** The built components for frameworks on a server, where there is no DOM, and that they have all that the element has. */

import { createElement } from "react";
import { renderToString } from "react-dom/server";
import { render } from "svelte/server";
import { TurnleafBook as ReactBook } from "turnleaf/react";
import { TurnleafBook as VueBook } from "turnleaf/vue";
import { expect, test } from "vitest";
import { h } from "vue";
import { renderToString as renderVue } from "vue/server-renderer";
import { readReference } from "../../../scripts/reference/read.mjs";
import { bookProps, booleanProps, eventOf } from "../../turnleaf/dist/svelte/book_props.js";
import SvelteBook from "../../turnleaf/dist/svelte/TurnleafBook.svelte";

const props = {
  src: "/book.pdf",
  page: 5,
  hardPages: "1-2",
  theme: "night",
  controls: true,
  remember: false,
  assist: false,
  pages: null,
  paper: null,
  password: "secret",
  id: "book",
} as const;

/** Returns the attributes of an element's HTML; a name alone and "true" are the same to the element. */
const attributesIn = (html: string): string[] =>
  [...html.matchAll(/ ([a-z-]+)(?:="([^"]*)")?/g)]
    .map(([, name, value]) => (value && value !== "true" ? `${name}=${value}` : name))
    .sort();

test.each([
  ["React", () => renderToString(createElement(ReactBook, props))],
  ["Vue", () => renderVue(h(VueBook, props))],
  ["Svelte", () => render(SvelteBook, { props }).body.replaceAll(/<!--.*?-->/g, "")],
])("%s renders the element with its attributes, and no more", async (_, rendered) => {
  const html = (await rendered()).trim();
  expect(html).toMatch(/^<turnleaf-book [^<>]*><\/turnleaf-book>$/);
  expect(attributesIn(html)).toEqual([
    "assist=off",
    "controls",
    "hard-pages=1-2",
    "id=book",
    "page=5",
    "src=/book.pdf",
    "theme=night",
  ]);
});

test("they have every property that can be set, and every event", () => {
  const { attributes, properties, events } = readReference();
  const settable = [...attributes, ...properties.filter(({ isWritten }) => isWritten)];
  expect([...bookProps].sort()).toEqual(settable.map(({ name }) => name).sort());
  const isBoolean = settable.filter(({ type }) => type === "boolean");
  expect([...booleanProps].sort()).toEqual(isBoolean.map(({ name }) => name).sort());
  expect(Object.values(eventOf).sort()).toEqual(events.map(({ name }) => name).sort());
  for (const [listener, event] of Object.entries(eventOf)) {
    expect(listener.toLowerCase()).toBe(`on${event}`);
  }
});
