import { expect, test, vi } from "vitest";
import { checkBudget, checkSvg } from "./budget.ts";
import { prose } from "./epub/tiny_epub.ts";

const times = (count: number, make: (k: number) => string): string =>
  Array.from({ length: count }, (_, k) => make(k)).join("");
const svg = (content: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink">${content}</svg>`;
const png =
  "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==";
const shape = '<path d="M0 0L9 9"/>';

test.each([
  [
    "a map with a symbol at each place",
    `<symbol id="s">${shape.repeat(10)}</symbol>${'<use xlink:href="#s"/>'.repeat(5000)}`,
  ],
  ["a drawing of many paths", shape.repeat(100_000)],
  [
    "clips within each other",
    `<clipPath id="c"><rect width="9" height="9"/></clipPath>${'<g clip-path="url(#c)">'.repeat(30)}${shape}${"</g>".repeat(30)}`,
  ],
  [
    "a gradient for each part",
    `<linearGradient id="g"><stop/><stop/></linearGradient>${'<rect fill="url(#g)"/>'.repeat(5000)}`,
  ],
  [
    "effects that lie beside each other",
    `<filter id="f"><feGaussianBlur/></filter>${'<g filter="url(#f)" opacity="0.5"><rect/></g>'.repeat(1000)}`,
  ],
  [
    "arrows at the ends of lines",
    `<marker id="m">${shape}</marker>${'<path d="M0 0 9 9 5 5" marker-end="url(#m)"/>'.repeat(3000)}`,
  ],
  [
    "pictures and a style with a font",
    `<style>@font-face { font-family: x; src: url("data:application/font-woff;base64,AAAA"); } .a { fill: url(#g) }</style>${`<image xlink:href="${png}"/>`.repeat(50)}`,
  ],
  [
    "what names itself",
    '<g id="a"><use href="#a"/><g mask="url(#m)"/></g><mask id="m"><use href="#a"/></mask>',
  ],
])("%s is within the budget", async (_, content) => {
  await checkSvg(svg(content), "It");
});

/** Counts a chapter against the budget. */
async function check(body: string, css: string): Promise<void> {
  const { documentElement } = new DOMParser().parseFromString(body, "text/html");
  await checkBudget(documentElement, [css], "It");
}

test("a long chapter with the style of a framework is within the budget", async () => {
  const css = [
    times(
      2000,
      (k) =>
        `.c${k} > p.x${k}, .d${k} a:hover { margin: 1.28125em; box-shadow: 0 1px 2px red, 0 0 1px blue; }`,
    ),
    times(10, (k) => `h${k} ~ p { text-indent: 0 } section:has(.e${k}) { color: red }`),
    ":root { --ink: #123456; --gap: 1.28125em } p { color: var(--ink); column-gap: var(--gap) }",
    "div { display: grid; grid-template-columns: repeat(12, 1fr); grid-area: 1 / 2 / 3 / 4 }",
    'li::before { content: "\\2022 " attr(data-x) }',
  ].join("");
  await check(`<h1 data-x="1">One</h1>${prose(5000)}`, css);
});

test("a short chapter with a detailed drawing is within the budget, with a thousand of them it is not", async () => {
  const drawing = svg(times(5000, (k) => `<path d="M${k} 0v1"/>`));
  const picture = `<img src="data:image/svg+xml,${encodeURIComponent(drawing)}">`;
  await check(picture, "");
  await expect(check(picture.repeat(1000), "")).rejects.toThrow("stand for too many others");
});

test("a chain of references that is longer than the stack is rejected in a sentence", async () => {
  const chain = times(30_000, (k) => `<g id="a${k}"><use href="#a${k + 1}"/></g>`);
  await expect(checkSvg(svg(chain), "It")).rejects.toThrow(
    "It takes more time or memory than a page may: its elements stand for too many others; make it simpler.",
  );
});

/** Returns an address of data that a style sheet names as a font, after blanks. */
const asFont = (base64: string, blanks = 0): string =>
  `@font-face { font-family: x; src: url("data:font/ttf;base64,${" ".repeat(blanks)}${base64}") }`;

test("a font is not unpacked to be counted, but for its first bytes", async () => {
  const unpack = vi.spyOn(globalThis, "atob");
  await check("<p>A</p>", asFont("AAEAAAAA".repeat(100_000)));
  expect(Math.max(...unpack.mock.calls.map(([letters]) => letters.length), 0)).toBeLessThan(5000);
  unpack.mockRestore();
});

test("a picture that calls itself a font is counted, whatever stands before it", async () => {
  // Its header claims 30,000 x 30,000 pixels.
  const huge = Uint8Array.from(atob(png.split(",")[1] as string), (one) => one.charCodeAt(0));
  new DataView(huge.buffer).setUint32(16, 30_000);
  new DataView(huge.buffer).setUint32(20, 30_000);
  const base64 = btoa(String.fromCharCode(...huge, ...new Uint8Array(6000)));
  for (const blanks of [0, 6000]) {
    const css = asFont(base64, blanks)
      .replace("src", "background-image")
      .replace("@font-face", "p");
    await expect(check("<p>A</p>", css)).rejects.toThrow("its pictures have too many pixels");
  }
});
