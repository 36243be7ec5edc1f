/** What is left of markup that names members of its document, or anything that could be loaded. */

import { expect, test } from "vitest";
import { cleanMarkup, type MarkupFiles } from "./clean_markup.ts";
import { type MarkupType, parseMarkup } from "./parse_markup.ts";

const files: MarkupFiles = {
  data: async (address) => (address === "in.png" ? "data:image/png;base64,AA==" : null),
  style: async () => [],
};

const types = ["text/html", "application/xhtml+xml"] as const;

async function cleaned(body: string, type: MarkupType = "text/html"): Promise<string> {
  const markup = `<html xmlns="http://www.w3.org/1999/xhtml"><body>${body}</body></html>`;
  const { root } = await cleanMarkup(parseMarkup(markup, type), files, "A chapter");
  return new XMLSerializer().serializeToString(root);
}

const members = [
  ...["attributes", "childNodes", "children", "documentElement", "firstChild", "getAttribute"],
  ...["getElementsByTagName", "hasAttribute", "localName", "namespaceURI", "nodeType", "nodeName"],
  ...[
    "parentNode",
    "querySelectorAll",
    "querySelector",
    "remove",
    "removeAttribute",
    "setAttribute",
  ],
  ...[
    "body",
    "createElementNS",
    "ownerDocument",
    "append",
    "replaceWith",
    "tagName",
    "insertBefore",
  ],
];

test.each(types)(
  "names that stand for members of forms and documents harm nothing: %s",
  async (type) => {
    for (const member of members) {
      const fields = ["input", "button", "select", "object", "img", "fieldset"].map((tag) => {
        return `<${tag} name="${member}"></${tag}><${tag} id="${member}"></${tag}>`;
      });
      const markup =
        type === "text/html"
          ? fields.join("")
          : fields.join("").replace(/<(input|img) ([^>]*)><\/\1>/g, "<$1 $2/>");
      const script = `<a href="javascript:ran" onclick="ran">`;
      const text = await cleaned(
        `<form name="${member}"><p>Before.</p>${markup}${script}After.</a></form><form id="${member}"></form>`,
        type,
      );
      expect(text, member).toContain("Before.");
      expect(text, member).toContain("After.");
      expect(text, member).not.toContain("ran");
      expect(text, member).not.toMatch(new RegExp(`(name|id)="${member}"`));
    }
  },
);

test("other names stay, and so do those of elements that are no properties", async () => {
  const text = await cleaned('<a name="body"></a><p id="title">A</p><img id="cover" alt=""/>');
  for (const kept of ['name="body"', 'id="title"', 'id="cover"']) expect(text).toContain(kept);
});

test.each([
  'fill="url(https://elsewhere.invalid/a.svg#b)"',
  'filter="url(//elsewhere.invalid/a.svg#b)"',
  "mask=\"URL( 'https://elsewhere.invalid/a.svg#b' ) luminance\"",
  'clip-path="u\\72l(https://elsewhere.invalid/a.svg#b)"',
  'cursor="image-set(&quot;https://elsewhere.invalid/a.png&quot; 1x), auto"',
  'marker-end="url(&quot;https://elsewhere.invalid/a.svg&quot;)"',
])("a drawing with %s loads nothing", async (attribute) => {
  for (const type of types) {
    const text = await cleaned(
      `<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h9" ${attribute}/></svg>`,
      type,
    );
    expect(text).toContain("M0 0h9");
    expect(text).not.toContain("elsewhere");
  }
});

test("a drawing keeps what is within it, and pictures of the book", async () => {
  const attributes =
    'fill="url(#g) red" mask="url(#m)" transform="translate(3)" stroke="rgb(1,2,3)"';
  const text = await cleaned(
    `<svg xmlns="http://www.w3.org/2000/svg"><title>url(https://a.example)</title><path ${attributes} filter="url(in.png)" aria-label="url(x)"/></svg>`,
  );
  for (const kept of ['transform="translate(3)"', 'stroke="rgb(1,2,3)"', 'aria-label="url(x)"']) {
    expect(text).toContain(kept);
  }
  expect(text).toMatch(/fill="url\(&quot;#g&quot;\) (red|rgb\(255, 0, 0\))"/);
  expect(text).toContain("#m");
  expect(text).toContain("data:image/png;base64,AA==");
});

test("a background that is an address is left out", async () => {
  const text = await cleaned(
    '<table background="https://elsewhere.invalid/a.png"><tr><td background="b.png">A</td></tr></table>',
  );
  expect(text).toContain("A</td>");
  expect(text).not.toContain("background");
});

test("more nodes beside each other than a function takes arguments are all there", async () => {
  const count = 150_000;
  for (const body of ["<br/>".repeat(count), `<noscript>${"<br/>".repeat(count)}</noscript>`]) {
    expect((await cleaned(body, "application/xhtml+xml")).split("<br").length - 1).toBe(count);
  }
});
