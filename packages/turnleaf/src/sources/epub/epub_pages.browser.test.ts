/** What EPUBs show on their pages: pictures, letters, fonts, and where pages break. */

import { describe, expect, test, vi } from "vitest";
import {
  closeEpubs,
  colourAt,
  laidOutEpub,
  pixelsOf,
  png,
  textOf,
} from "../../for_tests/epub_books.ts";
import { prose } from "./tiny_epub.ts";

const never = new AbortController().signal;

closeEpubs();

describe("its pages", () => {
  test("show pictures, colours and the style of the book", async () => {
    const source = await laidOutEpub({
      chapters: [
        '<div class="a"></div><img src="red.png" alt="A red square"/>',
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="100%" viewBox="0 0 10 10"><image width="10" height="10" xlink:href="red.png"/></svg>',
        '<p style="background: url(red.png); height: 300px"></p>',
      ],
      css: ":root { background: #ff0 } .a { height: 200px; background: #00f } img { display: block; width: 200px; height: 200px }",
      files: { "red.png": await png("#f00") },
    });
    expect(source.pageCount).toBe(3);
    const places = [
      [0.02, 0.02],
      [0.2, 0.2],
      [0.2, 0.4],
      [0.8, 0.5],
    ] as const;
    const found = await Promise.all(places.map(([x, y]) => colourAt(source, 0, x, y)));
    expect(found).toEqual(["255,255,0", "0,0,255", "255,0,0", "255,255,0"]);
    expect(await source.alt?.(0, never)).toBe("A red square");
    expect(await colourAt(source, 1, 0.5, 0.3)).toBe("255,0,0");
    expect(await colourAt(source, 2, 0.5, 0.3)).toBe("255,0,0");
  });

  test("understand the prefixed properties of EPUB, and patterns of drawings", async () => {
    const bars =
      '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100" style="fill: url(#blue)"><pattern id="blue" width="1" height="1"><rect width="100" height="100" fill="#00f"/></pattern><rect width="100" height="100"/></svg>';
    const source = await laidOutEpub({
      chapters: [
        `<html xmlns="http://www.w3.org/1999/xhtml"><head><title>t</title><style>body { margin: 0 } p { -epub-text-align-last: right; -epub-text-combine: horizontal }</style></head><body>${bars}<p>one</p><p style="-epub-text-transform: uppercase">two</p></body></html>`,
      ],
    });
    expect(await colourAt(source, 0, 0.15, 0.12)).toBe("0,0,255");
    const runs = (await source.text?.(0, never)) ?? [];
    expect(runs.find(({ text }) => text === "one")?.x).toBeGreaterThan(300);
  });

  test("hold all forms of letters that a style asks for, and what the book wrote is their text", async () => {
    const text = "letter \u3041";
    const [wide, capitals] = ["\uff4c\uff45\uff54\uff54\uff45\uff52", "LETTER"];
    const wideCapitals = "\uff2c\uff25\uff34\uff34\uff25\uff32";
    const forms = [
      ["uppercase full-width", `${wideCapitals} \u3041`],
      ["FULL-WIDTH  uppercase", `${wideCapitals} \u3041`],
      ["full-size-kana uppercase full-width", `${wideCapitals} \u3042`],
      ["uppercase full-width !important", `${wideCapitals} \u3041`],
      ["-epub-fullwidth", `${wide} \u3041`],
      ["full-size-kana", "letter \u3042"],
      ["uppercase", `${capitals} \u3041`],
      ["none", text],
      ["var(--none, uppercase)", `${capitals} \u3041`],
    ] as const;
    const inherited = [`<p>${text}</p>`, ...["c6", "c7"].map((c) => `<p class="${c}">${text}</p>`)];
    const source = await laidOutEpub({
      chapters: [
        forms.map((_, k) => `<p class="c${k}">${text}</p>`).join(""),
        forms.map(([form]) => `<p style="text-transform: ${form}">${text}</p>`).join(""),
        forms.map(([, shown]) => `<p>${shown}</p>`).join(""),
        `<div class="c4">${inherited.join("")}</div>`,
        [forms[4][1], forms[6][1], text].map((shown) => `<p>${shown}</p>`).join(""),
      ],
      css: forms.map(([form], k) => `.c${k} { text-transform:${form} }`).join(""),
    });
    const lines = `${text}\n`;
    expect(await textOf(source, 0)).toBe(lines.repeat(forms.length));
    expect(await textOf(source, 1)).toBe(lines.repeat(forms.length));
    expect(await textOf(source, 3)).toBe(lines.repeat(3));
    // Each is drawn as if the book had written it in these forms.
    const [byRules, byAttributes, outright, inRules, inOutright] = await Promise.all(
      [0, 1, 2, 3, 4].map((page) => pixelsOf(source, page)),
    );
    expect(byRules).toBe(outright);
    expect(byAttributes).toBe(outright);
    expect(inRules).toBe(inOutright);
  });

  test("have blanks that are kept, and narrow and small kana, in the forms that a style asks for", async () => {
    const note = (text: string) =>
      `<a href="#n" role="doc-noteref">${text}</a><aside id="n">${text}</aside>`;
    const source = await laidOutEpub({
      chapters: [
        `<div style="text-transform: full-width"><pre>a b</pre><p>\uff76\uff9e\uffa1\uffe9&#xa5;</p></div><div style="text-transform: full-size-kana">\u3063${note("\uff6f")}</div>`,
        `<div><pre>\uff41\u3000\uff42</pre><p>\u30ab\u3099\u3131\u2190\uffe5</p></div><div>\u3064${note("\uff82")}</div>`,
      ],
    });
    expect(await textOf(source, 0)).toBe(
      "a b\n\uff76\uff9e\uffa1\uffe9\u00a5\n\u3063\uff6f\n\uff6f\n",
    );
    expect(await pixelsOf(source, 0)).toBe(await pixelsOf(source, 1));
    const [link] = (await source.links?.(0, never)) ?? [];
    expect([link?.title, link?.note]).toEqual(["\uff6f", "\uff6f"]);
  });

  test("show each picture on its own page, and none that is on another", async () => {
    const big = await png("#0a0", 400, 600);
    const source = await laidOutEpub({
      chapters: ['<img src="a.png" alt=""/><p>Between.</p><img src="b.png" alt=""/>'],
      css: "img { display: block; width: 380px; height: 560px }",
      files: { "a.png": big, "b.png": await png("#00a", 400, 600) },
    });
    expect(source.pageCount).toBe(2);
    expect(await colourAt(source, 0, 0.5, 0.5)).toBe("0,170,0");
    expect(await colourAt(source, 1, 0.5, 0.5)).toBe("0,0,170");
  });

  test("hold a picture larger than themselves", async () => {
    const source = await laidOutEpub({
      chapters: [prose(1), '<img src="a.png" alt=""/>'],
      files: { "a.png": await png("#0a0", 3000, 3000) },
    });
    expect(source.pageCount).toBe(2);
    expect(await colourAt(source, 1, 0.5, 0.3)).toBe("0,170,0");
    expect(await colourAt(source, 1, 0.97, 0.3)).toBe("255,255,255");
  });

  test("are cut where the text is, in every direction of writing", async () => {
    const scripts: readonly [css: string, body: string, spine: string][] = [
      [
        "html { writing-mode: vertical-rl }",
        `<p>${"吾輩は猫である。".repeat(300)}</p>`,
        'page-progression-direction="rtl"',
      ],
      [
        "body { direction: rtl }",
        `<p>${"שלום עולם ".repeat(800)}</p>`,
        'page-progression-direction="rtl"',
      ],
      ["body { writing-mode: vertical-lr }", `<p>${"word ".repeat(1500)}</p>`, ""],
    ];
    for (const [css, body, spine] of scripts) {
      const source = await laidOutEpub({ chapters: [body], css, spine });
      expect(source.direction).toBe(spine === "" ? "ltr" : "rtl");
      expect(source.pageCount).toBeGreaterThan(2);
      let letters = 0;
      const { width, height } = await source.size(0);
      for (let index = 0; index < source.pageCount; index++) {
        const runs = (await source.text?.(index, never)) ?? [];
        letters += runs
          .map(({ text }) => text)
          .join("")
          .replaceAll(" ", "").length;
        for (const { x, y, width: across, height: down } of runs) {
          expect(x >= 0 && y >= 0 && x + across <= width + 1 && y + down <= height + 1).toBe(true);
        }
      }
      expect(letters).toBe(body.replaceAll(" ", "").length - "<p></p>".length);
    }
  });

  test("hold a table, floats and a block that does not break", async () => {
    const rows = "<tr><td>left</td><td>right</td></tr>".repeat(100);
    const source = await laidOutEpub({
      chapters: [
        `<table>${rows}</table><div style="float: left; width: 50%">${prose(3)}</div>${prose(5)}`,
      ],
    });
    let text = "";
    for (let index = 0; index < source.pageCount; index++) text += await textOf(source, index);
    expect(text.split("left").length - 1).toBe(100);
    expect(text).toContain("word4x59");
  });
});

test("a page is drawn in the fonts of the book, and carries those alone that it needs", async () => {
  const folder = "/node_modules/@expo-google-fonts/eb-garamond/";
  const load = async (name: string): Promise<Uint8Array> =>
    new Uint8Array(await (await fetch(folder + name)).arrayBuffer());
  const files = {
    "a.ttf": await load("400Regular/EBGaramond_400Regular.ttf"),
    "b.ttf": await load("800ExtraBold/EBGaramond_800ExtraBold.ttf"),
  };
  const css = (family: string): string =>
    `@font-face { font-family: A; src: url(a.ttf) } @font-face { font-family: B; src: url(b.ttf) } p { font-family: ${family}, monospace }`;
  const widths: number[] = [];
  const addresses = vi.spyOn(HTMLImageElement.prototype, "src", "set");
  for (const family of ["A", "B", "C"]) {
    const source = await laidOutEpub({
      chapters: ["<p>Call me Ishmael.</p>"],
      css: css(family),
      files,
    });
    await source.draw(0, 50, never);
    widths.push(Math.round((await source.text?.(0, never))?.[0]?.width ?? 0));
  }
  expect(new Set(widths).size).toBe(3);
  const lengths = addresses.mock.calls.map(([address]) => String(address).length);
  const one = (4 / 3) * Math.min(...Object.values(files).map(({ length }) => length));
  expect(lengths.map((length) => Math.floor(length / one))).toEqual([1, 1, 0]);
  vi.restoreAllMocks();
});
