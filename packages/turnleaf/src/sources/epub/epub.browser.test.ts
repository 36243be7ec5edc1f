import { afterEach, describe, expect, test, vi } from "vitest";
import { expectConformance } from "../../for_tests/source_conformance.ts";
import { openSource } from "../open.ts";
import type { NewIndex, PageSource, Typography } from "../page_source.ts";
import { ownTypography } from "../typeset/typography.ts";
import { prose, type TinyEpub, tinyEpub } from "./tiny_epub.ts";

const never = new AbortController().signal;
const opened: PageSource[] = [];

afterEach(() => {
  for (const source of opened.splice(0)) source.close();
  expect(document.querySelectorAll("iframe").length).toBe(0);
});

async function open(epub: TinyEpub): Promise<PageSource> {
  const source = await openSource(tinyEpub(epub));
  opened.push(source);
  return source;
}

/** Returns a source all of whose pages are known. */
async function laidOut(epub: TinyEpub): Promise<PageSource> {
  const source = await open(epub);
  await source.settle?.();
  return source;
}

const textOf = async (source: PageSource, index: number): Promise<string> =>
  ((await source.text?.(index, never)) ?? [])
    .map(({ text, end }) => text + (end ? "\n" : ""))
    .join("");

/** Returns the colours of a page's pixels but for the margin at its foot, in a line. */
async function pixelsOf(source: PageSource, index: number): Promise<string> {
  const { width } = await source.size(index);
  const bitmap = (await source.draw(index, width, never)) as ImageBitmap;
  const pen = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
  pen?.drawImage(bitmap, 0, 0);
  return pen?.getImageData(0, 0, bitmap.width, bitmap.height * 0.8).data.join() ?? "";
}

describe("an EPUB", () => {
  test("fulfils the contract of a source", async () => {
    const chapters = [
      prose(20),
      '<h1>Two</h1><p>See <a href="c1.xhtml#p19">there</a> and <a href="https://example.org">the web</a>.</p>',
    ];
    await expectConformance(() => openSource(tinyEpub({ chapters })));
  });

  test("has its title, language and contents", async () => {
    const source = await laidOut({
      chapters: [prose(12), prose(1)],
      toc: '<li><a href="c1.xhtml">One</a><ol><li><a href="c1.xhtml#p11">Late</a></li></ol></li><li><a href="c2.xhtml">Two</a></li>',
    });
    expect([source.title, source.language, source.direction]).toEqual([
      "A small book",
      "en-GB",
      "ltr",
    ]);
    const [one, two] = (await source.outline?.(never)) ?? [];
    expect([one?.title, one?.page, two?.title]).toEqual(["One", 1, "Two"]);
    expect(await textOf(source, (one?.children[0]?.page ?? 0) - 1)).toContain("word11x0");
    expect(await textOf(source, (two?.page ?? 0) - 1)).toContain("word0x0");
    expect((two?.page ?? 0) - 1).toBe(source.pageCount - 1);
  });

  test("has every word on a page, once and in order", async () => {
    const source = await laidOut({ chapters: [prose(40), prose(2)] });
    let words: string[] = [];
    for (let index = 0; index < source.pageCount; index++) {
      words = [...words, ...(await textOf(source, index)).split(/\s+/)];
    }
    const expected = [40, 2].flatMap((count) =>
      Array.from({ length: count }, (_, p) =>
        Array.from({ length: 60 }, (_, w) => `word${p}x${w}`),
      ).flat(),
    );
    expect(words.filter((word) => word !== "").map((word) => word.replace(".", ""))).toEqual(
      expected,
    );
  });
});

/** Returns the colour of a place of a page, fractions of its size, as "r,g,b". */
async function colourAt(source: PageSource, index: number, x: number, y: number): Promise<string> {
  const picture = (await source.draw(index, 200, never)) as ImageBitmap;
  const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d")!;
  pen.drawImage(picture, 0, 0);
  const [left, top] = [Math.floor(x * picture.width), Math.floor(y * picture.height)];
  return [...pen.getImageData(left, top, 1, 1).data.slice(0, 3)].join(",");
}

async function png(colour: string, width = 40, height = 60): Promise<Uint8Array> {
  const canvas = new OffscreenCanvas(width, height);
  const pen = canvas.getContext("2d")!;
  pen.fillStyle = colour;
  pen.fillRect(0, 0, width, height);
  return new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
}

describe("its pages", () => {
  test("show pictures, colours and the style of the book", async () => {
    const source = await laidOut({
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
    const source = await laidOut({
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
    const source = await laidOut({
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
    const source = await laidOut({
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
    const source = await laidOut({
      chapters: ['<img src="a.png" alt=""/><p>Between.</p><img src="b.png" alt=""/>'],
      css: "img { display: block; width: 380px; height: 560px }",
      files: { "a.png": big, "b.png": await png("#00a", 400, 600) },
    });
    expect(source.pageCount).toBe(2);
    expect(await colourAt(source, 0, 0.5, 0.5)).toBe("0,170,0");
    expect(await colourAt(source, 1, 0.5, 0.5)).toBe("0,0,170");
  });

  test("hold a picture larger than themselves", async () => {
    const source = await laidOut({
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
      const source = await laidOut({ chapters: [body], css, spine });
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
    const source = await laidOut({
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
    const source = await laidOut({
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

describe("its files", () => {
  test("leave out a picture that few browsers show, and nothing else of its chapter", async () => {
    const tiff = Uint8Array.from("II*\0".padEnd(100, "\0"), (letter) => letter.charCodeAt(0));
    const source = await laidOut({
      chapters: ['<p>Before</p><img src="a.tif" alt="none"/><p>After</p>'],
      files: { "a.tif": tiff },
    });
    expect((await textOf(source, 0)).replace(/\s+/g, " ")).toBe("Before After ");
    await source.draw(0, 50, never);
  });

  test("are those that its manifest lists, and no others", async () => {
    const red = await png("#f00");
    const source = await laidOut({
      chapters: ['<img src="red.png" alt="" style="width: 300px; height: 300px"/>'],
      raw: { "OEBPS/red.png": red },
    });
    expect(await colourAt(source, 0, 0.3, 0.2)).not.toBe("255,0,0");
  });

  test("of another kind are read in their fallback, and the first of several alike is linked", async () => {
    const source = await laidOut({
      chapters: ['<p><a href="c2.xhtml">there</a></p>', "<p>Two.</p>"],
      raw: { "OEBPS/a.xyz": "?", "OEBPS/b.xyz": "?" },
      items:
        '<item id="a" href="a.xyz" media-type="x/y" fallback="b"/><item id="b" href="b.xyz" media-type="x/y" fallback="c1"/><item id="bad" href="b.xyz" media-type="x/y" fallback="bad"/>',
      itemrefs: '<itemref idref="a"/><itemref idref="bad"/>',
    });
    // The last one is a page that says that it cannot be read.
    expect(source.pageCount).toBe(4);
    expect((await source.links?.(0, never))?.map(({ to }) => to)).toEqual([{ page: 2 }]);
    expect(await textOf(source, 2)).toBe("Two.\n");
  });
});

describe("the package", () => {
  test("has what is beside the way of reading last, unless it comes before all of it", async () => {
    const source = await laidOut({
      chapters: ["<p>One.</p>", "<p>Two.</p>"],
      raw: {
        "OEBPS/package.opf": `<package xmlns="http://www.idpf.org/2007/opf" version="3.0"><metadata/><manifest>${["cover", "note", "c1", "c2"].map((id) => `<item id="${id}" href="${id}.xhtml" media-type="application/xhtml+xml"/>`).join("")}</manifest><spine><itemref idref="cover" linear="no"/><itemref idref="c1"/><itemref idref="note" linear="no"/><itemref idref="c2"/></spine></package>`,
        "OEBPS/cover.xhtml":
          '<html xmlns="http://www.w3.org/1999/xhtml"><body><p>Cover.</p></body></html>',
        "OEBPS/note.xhtml":
          '<html xmlns="http://www.w3.org/1999/xhtml"><body><p>Note.</p></body></html>',
      },
    });
    const texts = await Promise.all([0, 1, 2, 3].map((index) => textOf(source, index)));
    expect(texts.map((text) => text.trim())).toEqual(["Cover.", "One.", "Two.", "Note."]);
  });

  test("names its authors in order, and the directions of them and of its title", async () => {
    const source = await open({
      chapters: ["<p>One.</p>"],
      metadata: '<dc:creator> Ann \n  Arbor </dc:creator><dc:creator dir="rtl">Bo</dc:creator>',
    });
    expect(source.details?.map(({ value, direction }) => [value, direction])).toEqual([
      ["Ann Arbor", undefined],
      ["Bo", "rtl"],
    ]);
    expect(source.titleDirection).toBe("auto");
    const raw = (title: string, dir: string): TinyEpub => ({
      chapters: ["<p>One.</p>"],
      raw: {
        "OEBPS/package.opf": `<package xmlns="http://www.idpf.org/2007/opf" version="3.0" ${dir}><metadata xmlns:dc="http://purl.org/dc/elements/1.1/">${title}</metadata><manifest><item id="c" href="c1.xhtml" media-type="application/xhtml+xml"/></manifest><spine><itemref idref="c"/></spine></package>`,
      },
    });
    const directions = [];
    for (const [title, dir] of [
      ['<dc:title dir="rtl">A</dc:title>', 'dir="ltr"'],
      ["<dc:title>A</dc:title>", 'dir="rtl"'],
      ['<dc:title dir="auto">A</dc:title>', 'dir="rtl"'],
    ] as const) {
      directions.push((await open(raw(title, dir))).titleDirection);
    }
    expect(directions).toEqual(["rtl", "rtl", "auto"]);
  });

  test("may ask for single pages, or of fixed layout for two, and ask for nothing otherwise", async () => {
    const layouts = [];
    for (const layout of ["reflowable", "pre-paginated"]) {
      for (const spread of ["none", "auto", "landscape", "both"]) {
        const metadata = `<meta property="rendition:layout">${layout}</meta><meta property="rendition:spread">${spread}</meta>`;
        layouts.push((await open({ chapters: ["<p>One.</p>"], metadata })).layout);
      }
    }
    const [nothing, single] = [undefined, "single"];
    expect(layouts).toEqual([
      ...[single, nothing, nothing, nothing],
      ...[single, nothing, nothing, "spread"],
    ]);
  });

  test("show a chapter that is no XML, and say in which line one breaks off", async () => {
    const chapter = (body: string): string =>
      `<html xmlns="http://www.w3.org/1999/xhtml">\n<body>\n${body}</body></html>`;
    const source = await laidOut({
      chapters: [
        chapter("<p>Unclosed").slice(0, -14),
        chapter("<p::p>Colons</p::p>"),
        chapter("<p>Well</p>"),
      ],
    });
    const sentence = "This chapter is damaged in line 3; something in it may be missing.";
    const texts = await Promise.all([0, 1, 2].map((index) => textOf(source, index)));
    expect(texts.map((text) => text.trim().replaceAll(/\s+/g, " "))).toEqual([
      `${sentence} Unclosed`,
      "Colons",
      "Well",
    ]);
  });

  test("show what stands in a frame as a picture, in its own style, without frames in it", async () => {
    const framed = (body: string): string =>
      `<html xmlns="http://www.w3.org/1999/xhtml"><head><style>body { margin: 0; background: #0f0 }</style></head><body style="height: 100px">${body}<script>parent.ran = 1</script></body></html>`;
    const frame = (src: string): string =>
      `<iframe src="${src}" width="300" height="100" style="display: block; margin: 0"></iframe>`;
    const source = await laidOut({
      chapters: [
        `${frame("f.xhtml")}<p>After.</p>`,
        `${frame("https://elsewhere.invalid/f.xhtml")}${frame("f.css")}<p>Nothing.</p>`,
      ],
      files: {
        "f.xhtml": framed(`<p style="color: #0f0">Framed.</p>${frame("g.xhtml")}`),
        "g.xhtml": framed('<p style="background: #f00">Within.</p>'),
        "f.css": "",
      },
    });
    expect(await colourAt(source, 0, 0.3, 0.12)).toBe("0,255,0");
    expect(await colourAt(source, 0, 0.3, 0.17)).toBe("0,255,0");
    expect(await source.alt?.(0, never)).toContain("Framed.");
    expect([await textOf(source, 0), await textOf(source, 1)]).toEqual(["After.\n", "Nothing.\n"]);
    expect("ran" in globalThis).toBe(false);
  });

  test("have sounds and films where the book has them, if it lists them and the browser plays them", async () => {
    const source = await laidOut({
      chapters: [
        '<audio id="a" controls="" src="a.mp3"/><video poster="red.png" src="b.webm" title="A film"/><video src="b.webm" width="200" height="100"/><audio src="a.mp3"/><audio controls="" src="missing.mp3"/><audio controls="" src="https://elsewhere.invalid/a.mp3"/><span data-turnleaf-medium="style.css">x</span>',
      ],
      files: { "red.png": await png("#f00") },
      raw: { "OEBPS/a.mp3": "sound", "OEBPS/b.webm": "film", "OEBPS/missing.mp3": "unlisted" },
      items:
        '<item id="m" href="a.mp3" media-type="audio/mpeg"/><item id="b" href="b.webm" media-type="video/webm"/>',
      css: "audio, video, img { display: block }",
    });
    const media = (await source.media?.(0, never)) ?? [];
    expect(media.map(({ kind, title }) => [kind, title])).toEqual([
      ["audio", "a.mp3"],
      ["video", "A film"],
      ["video", "b.webm"],
      ["audio", "style.css"],
    ]);
    expect(media.map(({ width, height }) => [width, height]).slice(0, 3)).toEqual([
      [300, 40],
      [40, 60],
      [200, 100],
    ]);
    expect(await (await media[0]?.load())?.text()).toBe("sound");
    const film = await media[1]?.load();
    expect([film?.type, await film?.text()]).toEqual(["video/webm", "film"]);
    await expect(media[3]?.load()).rejects.toThrow("style.css in this book is no recording");
    // The film without a poster is a dark box.
    const { x = 0, y = 0 } = media[2] ?? {};
    expect(await colourAt(source, 0, (x + 100) / 488, (y + 50) / 748)).toBe("0,0,0");
  });

  test("replaces what needs scripts, and pictures of foreign types, by their fallbacks", async () => {
    const chapters = ['<img src="a.psd"/>', "<p>Plain.</p>"];
    const source = await laidOut({
      chapters,
      files: { "green.png": await png("#0f0") },
      raw: {
        "OEBPS/a.psd": "8BPS",
        "OEBPS/s.xhtml": "<p>scripted</p>",
        "OEBPS/x.xml": "<x>foreign</x>",
      },
      items:
        '<item id="a" href="a.psd" media-type="image/psd" fallback="f1"/><item id="s" href="s.xhtml" media-type="application/xhtml+xml" properties="scripted" fallback="c1"/><item id="x" href="x.xml" media-type="application/xml" fallback="c1"/>',
      itemrefs: '<itemref idref="s"/><itemref idref="x"/>',
      css: "img { display: block; width: 200px; height: 300px }",
    });
    expect(await colourAt(source, 0, 0.2, 0.2)).toBe("0,255,0");
    expect([await textOf(source, 2), await textOf(source, 3)]).toEqual(["Plain.\n", "Plain.\n"]);
  });

  test("pictures in the contents are named by what they show", async () => {
    const toc = '<li><a href="c1.xhtml"><img src="a.png" alt="An abbey"/></a></li>';
    const source = await open({ chapters: ["<p>One.</p>"], toc });
    expect((await source.outline?.(never))?.[0]?.title).toBe("An abbey");
  });
});

describe("links", () => {
  test("to notes have their text, without the links back", async () => {
    const note = (id: string, meaning: string): string =>
      `<aside id="${id}" ${meaning}>The  ${id} note. <a role="doc-backlink" href="#r">back</a></aside>`;
    const source = await laidOut({
      chapters: [
        `<p><a epub:type="noteref" href="#first">1</a> <a role="doc-noteref" href="c2.xhtml#second">2</a> <a href="#first">3</a> <a epub:type="noteref" href="#none">4</a> <a epub:type="noteref" href="c2.xhtml#arrow">5</a></p>${note("first", 'epub:type="footnote"')}`,
        `${note("second", 'role="doc-endnote"')}<aside epub:type="footnote" id="arrow">An arrow \u2192 <a href="#x">\u2192 that</a>. <a href="c1.xhtml#r5">\u21a9\ufe0e</a></aside>`,
      ],
    });
    const notes = (await source.links?.(0, never))?.slice(0, 5).map(({ note }) => note);
    // An arrow alone leads back, whatever it does not say of itself.
    const arrow = "An arrow \u2192 \u2192 that.";
    expect(notes).toEqual(["The first note.", "The second note.", undefined, undefined, arrow]);
  });

  test("lead to pages of the book and to the web, and nowhere else", async () => {
    const source = await laidOut({
      chapters: [
        '<p><a href="c2.xhtml#p9">in</a> <a href="https://example.org/">out</a> <a href="javascript:alert(1)">run</a> <a href="missing.xhtml">no</a> <a href="file:///etc/passwd">no</a> <a href="data:text/html,x">no</a> <a id="x" href="#x">here</a></p>',
        prose(10),
      ],
    });
    const links = (await source.links?.(0, never)) ?? [];
    expect(links.map(({ to }) => to)).toEqual([
      { page: source.pageCount },
      { href: "https://example.org/" },
      { page: 1 },
    ]);
    expect(await textOf(source, source.pageCount - 1)).toContain("word9x0");
  });
});

describe("pages of fixed layout", () => {
  const fixed = (body: string, width = 600, height = 800): string =>
    `<html xmlns="http://www.w3.org/1999/xhtml"><head><title>t</title><meta name="viewport" content="width=${width}, height=${height}"/><style>body { margin: 0 } p { position: absolute; left: 300px; top: 400px; width: 100px; height: 100px; background: #0f0 }</style></head><body>${body}</body></html>`;
  const metadata = '<meta property="rendition:layout">pre-paginated</meta>';

  test("have the sizes that they name, and what stands where", async () => {
    const source = await laidOut({
      chapters: [fixed("<p>A</p>"), fixed("", 1000, 500)],
      metadata,
    });
    expect(source.pageCount).toBe(2);
    expect(source.typeset).toBeUndefined();
    expect(await source.size(0)).toEqual({ width: 600, height: 800 });
    expect(await source.size(1)).toEqual({ width: 1000, height: 500 });
    expect(await colourAt(source, 0, 0.6, 0.6)).toBe("0,255,0");
    expect(await colourAt(source, 0, 0.4, 0.6)).toBe("255,255,255");
    const [run] = (await source.text?.(0, never)) ?? [];
    expect(run?.x).toBeCloseTo(300, 0);
  });

  test.each([
    [
      ...["ltr", { 0: "page-spread-right", 1: "page-spread-right", 2: "page-spread-left" }],
      ["second", "second", "first"],
    ],
    ["ltr", { 0: "rendition:page-spread-left" }, ["first", undefined, undefined]],
    ["rtl", { 0: "page-spread-left", 1: "page-spread-right" }, ["second", "first", undefined]],
    [
      ...["ltr", { 0: "page-spread-center", 1: "rendition:page-spread-center" }],
      ["single", "single", undefined],
    ],
    ["rtl", { 1: "rendition:spread-none" }, [undefined, "single", undefined]],
  ] as [string, Record<number, string>, (string | undefined)[]][])(
    "lie on the side of a spread that they name, or by themselves, read %s: %j",
    async (way, properties, places) => {
      const source = await laidOut({
        chapters: [fixed("<p>one</p>"), fixed("<p>two</p>"), fixed("<p>three</p>")],
        metadata,
        properties,
        spine: `page-progression-direction="${way}"`,
      });
      expect(source.pageCount).toBe(3);
      expect([0, 1, 2].map((index) => source.inSpread?.(index))).toEqual(places);
    },
  );

  test("begin on a side, and flowing text is not shown by itself", async () => {
    const source = await laidOut({
      chapters: [prose(30), prose(1)],
      properties: { 0: "page-spread-left", 1: "page-spread-center" },
    });
    expect([0, 1, source.pageCount - 1].map((index) => source.inSpread?.(index))).toEqual([
      "first",
      undefined,
      undefined,
    ]);
  });

  test("may stand among flowing text", async () => {
    const source = await laidOut({
      chapters: [fixed("<p>A</p>"), prose(10)],
      properties: { 0: "rendition:layout-pre-paginated" },
    });
    expect(await source.size(0)).toEqual({ width: 600, height: 800 });
    expect(await source.size(1)).toEqual({ width: 488, height: 748 });
  });
});

describe("text that is set anew", () => {
  /** Returns what a change of the typography does to the pages. */
  const change = async (source: PageSource, typography: Partial<Typography>): Promise<NewIndex> => {
    const changed = new Promise<NewIndex>((resolve) => {
      source.watchPages?.((apply) => resolve(apply()));
    });
    await source.typeset?.({ ...ownTypography, ...typography });
    return await changed;
  };

  test("has another number of pages, and each place is on the page that has its words", async () => {
    const source = await laidOut({ chapters: [prose(30), prose(10)] });
    const before = source.pageCount;
    const height = (await source.text?.(0, never))?.[0]?.height ?? 0;
    const first = await Promise.all(
      Array.from(
        { length: before },
        async (_, index) => (await textOf(source, index)).split(" ")[1],
      ),
    );
    const larger = await change(source, { size: 1.5 });
    await source.draw(source.pageCount - 1, 50, never);
    for (let index = 0; index < 3; index++) {
      const now = larger.placeOf?.(index) ?? -1;
      expect(larger(index)).toBeNull();
      expect(await textOf(source, now)).toContain(first[index]);
    }
    expect(source.pageCount).toBeGreaterThan(1.5 * before);
    // The paper stays as large as it was, the type on it is larger.
    expect(await source.size(0)).toEqual({ width: 488, height: 748 });
    expect((await source.text?.(0, never))?.[0]?.height).toBeCloseTo(1.5 * height, 0);
  });

  test("keeps the places in chapters that are set later", async () => {
    const source = await laidOut({ chapters: [prose(20), prose(20), prose(20)] });
    // The last words of the first chapter, while only the third is in sight.
    let page = 0;
    while (!(await textOf(source, page)).includes("word19x59")) page++;
    const [start] = (await textOf(source, page)).split(/\s/);
    for (const index of [4, 3, 2, 1]) await source.draw(source.pageCount - index, 50, never);
    const changes: NewIndex[] = [];
    const settled = new Promise<void>((resolve) => {
      source.watchPages?.((apply) => {
        changes.push(apply());
        if (changes.length > 1) resolve();
      });
    });
    await source.typeset?.({ ...ownTypography, size: 1.7 });
    await settled;
    for (const change of changes) page = change.placeOf?.(page) ?? -1;
    expect(await textOf(source, page)).toContain(start);
  });

  test("comes back to the page where the reader was", async () => {
    const source = await laidOut({ chapters: [prose(30)] });
    let page = 3;
    for (const size of [1.3, 0.8, 2, 0.6, 1])
      page = (await change(source, { size })).placeOf?.(page) ?? -1;
    expect(page).toBe(3);
  });

  test("has the typeface, lines and margins that are chosen", async () => {
    const source = await laidOut({ chapters: [prose(2)], css: "p { color: #f00; margin: 0 }" });
    const before = (await source.text?.(0, never)) ?? [];
    await change(source, { font: "sans-serif", lineHeight: 2, margins: 2 });
    const after = (await source.text?.(0, never)) ?? [];
    expect((after[1]?.y ?? 0) - (after[0]?.y ?? 0)).toBe(32);
    expect(after[0]?.x).toBeCloseTo(2 * (before[0]?.x ?? 0), -1);
  });

  test("is that of the last choice, however many are made at once", async () => {
    const source = await laidOut({ chapters: [prose(10)] });
    const before = (await source.text?.(0, never))?.[0]?.height ?? 0;
    const changed = new Promise<void>((resolve) => {
      source.watchPages?.((apply) => {
        apply();
        resolve();
      });
    });
    const all = [0.5, 2, 0.7, 3].map((size) => source.typeset?.({ ...ownTypography, size }));
    await Promise.all(all);
    await changed;
    const height = (await source.text?.(0, never))?.[0]?.height ?? 0;
    expect(height / before).toBeCloseTo(3, 1);
  });
});
