/** No page is blank that a book does not ask for. */

import { expect, test } from "vitest";
import { closeBooks, laidOut, pagesOf } from "../../for_tests/laid_out_books.ts";
import { tinyEpub } from "./tiny_epub.ts";

closeBooks();

const css =
  ".new { break-before: page } .end { page-break-after: always } .low { margin-top: 40em } .c::after { content: '' }";

/** Words that fit on a page, one after the other. */
const [one, two, three] = ["<p>one</p>", "<p>two</p>", '<p class="new">three</p>'];

test.each<[string, string, string[]]>([
  [
    "the first item of a flexible box",
    `<div style="display: flex; flex-direction: column"><h2 class="new">one</h2>${two}</div>${three}`,
    ["one two", "three"],
  ],
  [
    "the first item of a grid within a flexible box",
    `${one}<div style="display: flex"><div style="display: grid"><i hidden="">x</i><p class="new">two</p></div></div>${three}`,
    ["one", "two", "three"],
  ],
  [
    "the last item of a grid",
    `<div style="display: grid">${one}<p class="end">two</p></div><p>three</p>`,
    ["one two", "three"],
  ],
  ["empty boxes", `${one}<div class="new"></div><div class="new"/>${three}`, ["one", "three"]],
  ["an empty box at the end", `${one}<div class="new"></div>`, ["one"]],
  [
    "empty boxes after each other",
    `${one}<div class="end"/><div class="end"/>${two}`,
    ["one", "two"],
  ],
  ["blank paragraphs", `${one}${"<p>&#160;</p>".repeat(90)}${two}`, ["one", "two"]],
  ["ends of lines", `<p>one</p>${"<br/>".repeat(190)}${two}`, ["one", "two"]],
  ["blank lines in a box", `${one}<div>${"<br/>".repeat(90)}</div>${two}`, ["one", "two"]],
  ["ends of lines within one", `<p>one${"<br/>&#160;".repeat(190)}<br/>two</p>`, ["one", "two"]],
  ["paragraphs of the end of a line", `${one}${"<p><br/></p>".repeat(90)}${two}`, ["one", "two"]],
  [
    "paragraphs of blank parts",
    `${one}${'<p class="c"><span>&#160;</span><!-- c --> </p>'.repeat(90)}${two}`,
    ["one", "two"],
  ],
  ["lines of a listing", `<pre>one${"\n \n".repeat(90)}two</pre>`, ["one", "two"]],
  ["room above the first words", `<h1 class="low">one</h1>${two}${three}`, ["one two", "three"]],
])("%s leave no page blank", async (_, body, pages) => {
  const source = await laidOut(tinyEpub({ chapters: [body], css }));
  expect(await pagesOf(source)).toEqual(pages);
});

test.each<[string, string, string[]]>([
  ["a blank line", `${one}<p class="new">&#160;</p>${three}`, ["one", "", "three"]],
  [
    "lines to write on",
    `${one}<div class="new" style="border: 1px solid">${"<p>&#160;</p>".repeat(8)}</div>${three}`,
    ["one", "", "three"],
  ],
  [
    "a painted box",
    `${one}<div class="new" style="height: 50px; background: #ccc"></div>${three}`,
    ["one", "", "three"],
  ],
])("a page that is to have %s has it", async (_, body, pages) => {
  const source = await laidOut(tinyEpub({ chapters: [body], css }));
  expect(await pagesOf(source)).toEqual(pages);
});
