/** The built components for frameworks on a server, where there is no DOM, and that they have all that the element has. */

import { readFileSync } from "node:fs";
import { createElement } from "react";
import { renderToString } from "react-dom/server";
import { render } from "svelte/server";
import { TurnleafBook as ReactBook } from "turnleaf/react";
import { TurnleafBook as VueBook } from "turnleaf/vue";
import { expect, test } from "vitest";
import { h } from "vue";
import { renderToString as renderVue } from "vue/server-renderer";
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

/** A field or a method of the element in its manifest. */
interface Member {
  readonly kind: string;
  readonly name: string;
  readonly type: { readonly text: string };
  readonly readonly?: boolean;
}

/** The element as the build describes it: reading it of the sources again takes the compiler some seconds. */
const [element] = JSON.parse(
  readFileSync(new URL("../../turnleaf/dist/custom-elements.json", import.meta.url), "utf8"),
).modules[0].declarations as [{ members: Member[]; events: { name: string }[] }];

test("they have every property that can be set, and every event", () => {
  const settable = element.members.filter(({ kind, readonly }) => kind === "field" && !readonly);
  expect([...bookProps].sort()).toEqual(settable.map(({ name }) => name).sort());
  const isBoolean = settable.filter(({ type }) => type.text === "boolean");
  expect([...booleanProps].sort()).toEqual(isBoolean.map(({ name }) => name).sort());
  expect(Object.values(eventOf).sort()).toEqual(element.events.map(({ name }) => name).sort());
  for (const [listener, event] of Object.entries(eventOf)) {
    expect(listener.toLowerCase()).toBe(`on${event}`);
  }
});
