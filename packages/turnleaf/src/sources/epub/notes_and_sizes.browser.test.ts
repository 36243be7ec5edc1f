/** Notes of several paragraphs, pages of fixed layout that name no size, and what is folded up. */

import { expect, test } from "vitest";
import { closeBooks, laidOut, wordsOf } from "../../for_tests/laid_out_books.ts";
import { tinyEpub } from "./tiny_epub.ts";

const never = new AbortController().signal;

closeBooks();

async function notesOf(ids: readonly string[], notes: string): Promise<(string | undefined)[]> {
  const links = ids.map((id) => `<a epub:type="noteref" href="c2.xhtml#${id}">*</a>`).join(" ");
  const source = await laidOut(tinyEpub({ chapters: [`<p>x ${links}</p>`, notes] }));
  return ((await source.links?.(0, never)) ?? []).map(({ note }) => note);
}

test("a note has all its paragraphs, a line each, however it is marked", async () => {
  expect(
    await notesOf(
      ["aside", "li", "term", "cell", "head", "between"],
      `<aside id="aside" epub:type="footnote"><p>One.</p><p>Two
 lines.</p></aside><ol><li id="li"><p>Three.</p><ul><li>Four.</li></ul></li></ol>
<dl><dt id="term">5</dt><dd><p>Five.</p><p>Six.</p></dd><dt>6</dt></dl>
<table><tr><td id="cell">7</td><td>Seven.</td></tr></table>
<h4 id="head">8</h4><p>Eight.</p><p>Nine.</p><h4>9</h4><p>No.</p><hr/>
<a id="between"></a><p>Ten.</p>`,
    ),
  ).toEqual([
    "One.\nTwo lines.",
    "Three.\nFour.",
    "5\nFive.\nSix.",
    "7 Seven.",
    "8\nEight.\nNine.",
    "Ten.",
  ]);
});

test("a paragraph in a list of notes goes on up to the next note; one in the text does not", async () => {
  const back = (id: string): string => `<p><a id="${id}" href="c1.xhtml">${id}</a>`;
  expect(
    await notesOf(
      ["n1", "n2", "inner"],
      `<h2>Notes</h2>${back("n1")} One.</p><p>More of it.</p><blockquote>Said.</blockquote>${back("n2")} Two.</p><h2>Text</h2><p>Text.</p>${back("inner")} In the text.</p><p>More text.</p>`,
    ),
  ).toEqual(["n1 One.\nMore of it.\nSaid.", "n2 Two.", "inner In the text."]);
});

const fixed = '<meta property="rendition:layout">pre-paginated</meta>';
const page = (head: string, body: string): string =>
  `<html xmlns="http://www.w3.org/1999/xhtml"><head><title>t</title>${head}</head><body>${body}</body></html>`;

test("a page of fixed layout without a viewport is as large as what stands on it", async () => {
  const svg = '<svg xmlns="http://www.w3.org/2000/svg" width="300" height="500"/>';
  const source = await laidOut(
    tinyEpub({
      chapters: [
        page("<style>body { margin: 0 }</style>", '<img src="p.svg" alt=""/>'),
        page(
          "",
          '<div style="position: absolute; left: 100px; top: 0; width: 500px; height: 900px">x</div>',
        ),
        page("<style>body { margin: 0; width: 640px; height: 480px }</style>", "x"),
        page(
          '<meta name="Viewport" content="width=device-width"/><meta name="original-resolution" content="700x1000"/>',
          "<p>x</p>",
        ),
        page("", "<p>only text</p>"),
        page('<meta name="viewport" content="WIDTH=400px; HEIGHT=600px"/>', "<p>x</p>"),
        page("<style>body { margin: 0 } img { width: 100% }</style>", '<img src="p.svg" alt=""/>'),
      ],
      files: { "p.svg": svg },
      metadata: fixed,
    }),
  );
  const sizes = [];
  for (let index = 0; index < source.pageCount; index++) {
    const { width, height } = await source.size(index);
    sizes.push([width, height]);
  }
  expect(sizes).toEqual([
    [300, 500],
    [600, 900],
    [640, 480],
    [700, 1000],
    [768, 1024],
    [400, 600],
    [300, 500],
  ]);
  const named = await laidOut(
    tinyEpub({
      chapters: [page("", "<p>x</p>")],
      metadata: `${fixed}<meta property="rendition:viewport">width=900, height=700</meta>`,
    }),
  );
  expect(await named.size(0)).toEqual({ width: 900, height: 700 });
});

test("what is folded up in <details> is read: nothing on paper opens it", async () => {
  const source = await laidOut(
    tinyEpub({
      chapters: [
        "<details><summary>Result</summary><p>Forty-two.</p><details><p>Inner.</p></details></details>",
      ],
    }),
  );
  expect(await wordsOf(source, 0)).toMatch(/Result.*Forty-two\..*Inner\./);
});
