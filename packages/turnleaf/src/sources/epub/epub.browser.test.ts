/** What an EPUB says of itself: its contents, files, package and links. */

import { describe, expect, test } from "vitest";
import {
  closeEpubs,
  colourAt,
  laidOutEpub,
  openEpub,
  png,
  textOf,
} from "../../for_tests/epub_books.ts";
import { expectConformance } from "../../for_tests/source_conformance.ts";
import { openSource } from "../open.ts";
import { prose, type TinyEpub, tinyEpub } from "./tiny_epub.ts";

const never = new AbortController().signal;

closeEpubs();

describe("an EPUB", () => {
  test("fulfils the contract of a source", async () => {
    const chapters = [
      prose(20),
      '<h1>Two</h1><p>See <a href="c1.xhtml#p19">there</a> and <a href="https://example.org">the web</a>.</p>',
    ];
    await expectConformance(() => openSource(tinyEpub({ chapters })));
  });

  test("has its title, language and contents", async () => {
    const source = await laidOutEpub({
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
    const source = await laidOutEpub({ chapters: [prose(40), prose(2)] });
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

describe("its files", () => {
  test("leave out a picture that few browsers show, and nothing else of its chapter", async () => {
    const tiff = Uint8Array.from("II*\0".padEnd(100, "\0"), (letter) => letter.charCodeAt(0));
    const source = await laidOutEpub({
      chapters: ['<p>Before</p><img src="a.tif" alt="none"/><p>After</p>'],
      files: { "a.tif": tiff },
    });
    expect((await textOf(source, 0)).replace(/\s+/g, " ")).toBe("Before After ");
    await source.draw(0, 50, never);
  });

  test("are those that its manifest lists, and no others", async () => {
    const red = await png("#f00");
    const source = await laidOutEpub({
      chapters: ['<img src="red.png" alt="" style="width: 300px; height: 300px"/>'],
      raw: { "OEBPS/red.png": red },
    });
    expect(await colourAt(source, 0, 0.3, 0.2)).not.toBe("255,0,0");
  });

  test("of another kind are read in their fallback, and the first of several alike is linked", async () => {
    const source = await laidOutEpub({
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
    const source = await laidOutEpub({
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
    const source = await openEpub({
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
      directions.push((await openEpub(raw(title, dir))).titleDirection);
    }
    expect(directions).toEqual(["rtl", "rtl", "auto"]);
  });

  test("may ask for single pages, or of fixed layout for two, and ask for nothing otherwise", async () => {
    const layouts = [];
    for (const layout of ["reflowable", "pre-paginated"]) {
      for (const spread of ["none", "auto", "landscape", "both"]) {
        const metadata = `<meta property="rendition:layout">${layout}</meta><meta property="rendition:spread">${spread}</meta>`;
        layouts.push((await openEpub({ chapters: ["<p>One.</p>"], metadata })).layout);
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
    const source = await laidOutEpub({
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
    const source = await laidOutEpub({
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
    const source = await laidOutEpub({
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
    const source = await laidOutEpub({
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
    const source = await openEpub({ chapters: ["<p>One.</p>"], toc });
    expect((await source.outline?.(never))?.[0]?.title).toBe("An abbey");
  });
});

describe("links", () => {
  test("to notes have their text, without the links back", async () => {
    const note = (id: string, meaning: string): string =>
      `<aside id="${id}" ${meaning}>The  ${id} note. <a role="doc-backlink" href="#r">back</a></aside>`;
    const source = await laidOutEpub({
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
    const source = await laidOutEpub({
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
