/** Which of several languages of markup a chapter shows, and text in a language that is none of HTML's. */

import { expect, test } from "vitest";
import { cleanMarkup } from "./clean_markup.ts";
import { type MarkupType, parseMarkup } from "./parse_markup.ts";

const ops = "http://www.idpf.org/2007/ops";
const cml = "http://www.xml-cml.org/schema";
const mathml = "http://www.w3.org/1998/Math/MathML";

async function cleaned(body: string, type: MarkupType = "application/xhtml+xml") {
  const markup = `<html xmlns="http://www.w3.org/1999/xhtml" xmlns:epub="${ops}"><body>${body}</body></html>`;
  const files = { data: async () => null, style: async () => [] };
  const { root } = await cleanMarkup(parseMarkup(markup, type), files, "A chapter");
  return root.querySelector("body") as Element;
}

const foreign = `required-namespace="${cml}"><chem xmlns="${cml}">hydrogen</chem>`;
const formula = `required-namespace="${mathml}"><math xmlns="${mathml}"><mi>x</mi></math>`;
const drawing =
  'required-namespace="http://www.w3.org/2000/svg"><svg xmlns="http://www.w3.org/2000/svg"><text>drawn</text></svg>';
const water = '<p xmlns="http://www.w3.org/1999/xhtml" id="f">water</p>';

test.each([
  [
    "without prefixes",
    `<switch xmlns="${ops}"><case ${foreign}</case><default>${water}</default></switch>`,
    "water",
  ],
  [
    "with prefixes",
    `<epub:switch><epub:case ${foreign}</epub:case><epub:default>${water}</epub:default></epub:switch>`,
    "water",
  ],
  [
    "of which several cases cannot be shown",
    `<epub:switch><epub:case ${foreign}</epub:case><epub:case ${foreign}</epub:case><epub:default>${water}</epub:default></epub:switch>`,
    "water",
  ],
  [
    "with a case in no language",
    `<epub:switch><epub:case>no</epub:case><epub:default>${water}</epub:default></epub:switch>`,
    "water",
  ],
  [
    "with a formula",
    `<epub:switch><epub:case ${foreign}</epub:case><epub:case ${formula}</epub:case><epub:default>${water}</epub:default></epub:switch>`,
    "x",
  ],
  [
    "with a drawing",
    `<epub:switch><epub:case ${drawing}</epub:case><epub:default>${water}</epub:default></epub:switch>`,
    "drawn",
  ],
  [
    "within another's default",
    `<epub:switch><epub:case ${foreign}</epub:case><epub:default><switch xmlns="${ops}"><case ${foreign}</case><default>${water}</default></switch></epub:default></epub:switch>`,
    "water",
  ],
  [
    "within a case that is not shown",
    `<epub:switch><epub:case required-namespace="${cml}"><epub:switch><epub:default>no</epub:default></epub:switch></epub:case><epub:default>${water}</epub:default></epub:switch>`,
    "water",
  ],
])("of a switch %s one version is shown", async (_, markup, text) => {
  const body = await cleaned(`<p>Before.</p>${markup}<p>After.</p>`);
  expect(body.textContent).toBe(`Before.${text}After.`);
});

test("a switch in a chapter that is read as a web page is one too", async () => {
  const body = await cleaned(
    `<epub:switch><epub:case ${foreign}</epub:case><epub:default>${water}</epub:default></epub:switch>`,
    "text/html",
  );
  expect(body.textContent).toBe("water");
});

test("links to a switch lead to what is shown of it", async () => {
  const named = await cleaned(
    `<epub:switch id="s"><epub:default><p>water</p></epub:default></epub:switch><epub:switch id="t"><epub:default>${water}</epub:default></epub:switch>`,
  );
  expect(named.querySelector("#s")?.textContent).toBe("water");
  expect(named.querySelector("#t")?.nextElementSibling?.id).toBe("f");
});

test("a switch of which nothing can be shown is listed", async () => {
  const body = await cleaned(
    `<p>A</p><epub:switch><epub:case ${foreign}</epub:case></epub:switch>`,
  );
  expect(body.textContent).toBe("A");
  expect(body.innerHTML).toContain(`data-turnleaf-source="${cml}"`);
});

test("the switches of drawings are left to the browser", async () => {
  const svg = "http://www.w3.org/2000/svg";
  const body = await cleaned(
    `<svg xmlns="${svg}"><switch><text systemLanguage="en">a</text></switch></svg>`,
  );
  expect(body.querySelector("svg switch text")).not.toBeNull();
});

test.each([
  ["no namespace", '<p xmlns="" id="a">Text <i>of it</i></p>', "p"],
  ["another namespace", '<p xmlns="urn:other" id="a">Text <i>of it</i></p>', "span"],
  ["a prefix", '<o:p xmlns:o="urn:other" id="a">Text <o:i>of it</o:i></o:p>', "span"],
])("text of an element in %s is shown", async (_, markup, name) => {
  const body = await cleaned(`<div>Before. ${markup}</div>`);
  expect(body.textContent).toBe("Before. Text of it");
  expect(body.querySelector("#a")?.localName).toBe(name);
});

test("a script in no namespace is left out", async () => {
  const body = await cleaned('<p>A</p><script xmlns="">ran</script><style xmlns="">ran</style>');
  expect(body.innerHTML).not.toContain("ran");
});

test.each([
  [ops, "first"],
  [`${mathml} ${ops}`, "first"],
  [cml, "second"],
  [`${ops} ${cml}`, "second"],
  ["", "second"],
])("a drawing's switch shows what asks for a language that is shown: %s", async (asked, shown) => {
  const body = await cleaned(
    `<svg xmlns="http://www.w3.org/2000/svg"><switch><foreignObject requiredExtensions="${asked}"><p xmlns="http://www.w3.org/1999/xhtml">first</p></foreignObject><text>second</text></switch></svg>`,
  );
  const [first] = body.querySelector("switch")?.children ?? [];
  expect(first?.textContent).toBe(shown);
});
