import { afterEach, expect, test } from "vitest";
import { tinyEpub } from "../epub/tiny_epub.ts";
import { HtmlPages } from "../html/html_pages.ts";
import { tinyKf8, tinyMobi } from "../kindle/tiny_kindle.ts";
import { openSource } from "../open.ts";
import type { PageSource } from "../page_source.ts";

const never = new AbortController().signal;

afterEach(() => document.body.replaceChildren());

/** Draws a book's first page and returns its text. */
async function read(source: PageSource): Promise<string> {
  try {
    const picture = await source.draw(0, 60, never);
    if ("close" in picture) picture.close();
    return ((await source.text?.(0, never)) ?? []).map(({ text }) => text).join("");
  } finally {
    source.close();
  }
}

const file = (name: string, text: string): Promise<PageSource> =>
  openSource(new File([text], name));

/** Every control character but tab and line break, and what is no character. */
const codes = Array.from({ length: 32 }, (_, code) => code)
  .filter((code) => code !== 9 && code !== 10 && code !== 13)
  .concat(0x7f, 0x85, 0xfffe, 0xffff);
const forbidden = String.fromCharCode(...codes);

/** As much as is looked at to know that a file is text, which has no such characters. */
const start = "word ".repeat(1000);

/** Attributes that HTML has and XML cannot write. */
const names =
  'data-× data-\u2001x data-\ufffe a"b a<b epub:type="noteref" xlink:href="#" x:y xmlns:q="r"';

test.each([
  ["text", () => file("a.txt", `Before after.\n\n${start}\n\n${forbidden}`)],
  // A long word is divided, here between the halves of a character.
  ["text of one word", () => file("a.txt", `a${"\u{1f600}".repeat(40_000)}`)],
  ["Markdown", () => file("a.md", `Before after.\n\n${start}\n\n${forbidden} \`${forbidden}\``)],
  ["Markdown of escapes", () => file("a.md", "Before &#1; &#xFFFE; &#xD800; after.")],
  [
    "Markdown of names",
    () =>
      file("a.md", `<p ${names}>Before after.</p>\n\n${start}\n\n<p title="${forbidden}">.</p>`),
  ],
  [
    "an EPUB's style",
    () =>
      openSource(
        tinyEpub({
          chapters: ["<p>Before <b>after.</b></p>"],
          css: 'p::before { content: "\\1\\B\\FFFE\\FFFF\\D800" } b::after { content: "\ufffe\u0001" }',
        }),
      ),
  ],
  [
    "an EPUB that is no XML",
    () =>
      openSource(
        tinyEpub({
          chapters: [`<p ${names}>Before ${forbidden} &nope; <svg ${names}></svg>after.</p>`],
        }),
      ),
  ],
  ["a MOBI", () => openSource(tinyMobi({ text: `<p>Before ${forbidden} after.</p>` }))],
  ["a KF8", () => openSource(tinyKf8({ text: [`<p>Before ${forbidden} after.</p>`] }))],
  [
    "an element",
    async () => {
      const page = document.createElement("div");
      page.innerHTML = `<p ${names}>Before <svg ${names}></svg>after.</p>`;
      page.style.cssText = "width: 200px; height: 300px";
      page.firstElementChild?.prepend(`${forbidden}\ud800`);
      document.body.append(page);
      return new HtmlPages([page]);
    },
  ],
  [
    "a frame of an EPUB",
    () =>
      openSource(
        tinyEpub({
          chapters: ['<p>Before</p><iframe src="f.xhtml"></iframe><p>after.</p>'],
          files: { "f.xhtml": `<p>${forbidden}` },
        }),
      ),
  ],
])("characters and names that XML forbids spoil no page of %s", async (_, open) => {
  const source = await open();
  expect(await read(source)).toMatch(/Before.*after\.|^a/);
});
