import { afterEach, describe, expect, test } from "vitest";
import { openSource } from "../open.ts";
import type { Narration, PageSource } from "../page_source.ts";
import { ownTypography } from "../typeset/typography.ts";
import { secondsOf } from "./media_overlays.ts";
import { prose, type TinyEpub, tinyEpub } from "./tiny_epub.ts";

const never = new AbortController().signal;
const opened: PageSource[] = [];

afterEach(() => {
  for (const source of opened.splice(0)) source.close();
});

const smil = (...parts: string[]): string =>
  `<smil xmlns="http://www.w3.org/ns/SMIL" version="3.0"><body><seq>${parts.join("")}</seq></body></smil>`;
const part = (text: string, audio = ""): string => `<par><text src="${text}"/>${audio}</par>`;
const voice = (times: string, src = "voice.mp3"): string => `<audio src="${src}" ${times}/>`;

/** Returns a book whose second chapter is read aloud as an overlay says. */
const overlaid = (overlay: string, body: string, more: Partial<TinyEpub> = {}): TinyEpub => ({
  chapters: [prose(1)],
  items:
    '<item id="o" href="o.smil" media-type="application/smil+xml"/><item id="v" href="voice.mp3" media-type="audio/mpeg"/><item id="w" href="words.txt" media-type="text/plain"/><item id="m" href="m.xhtml" media-type="application/xhtml+xml" media-overlay="o"/>',
  itemrefs: '<itemref idref="m"/>',
  raw: {
    "OEBPS/o.smil": overlay,
    "OEBPS/voice.mp3": "sound",
    "OEBPS/words.txt": "words",
    "OEBPS/m.xhtml": `<html xmlns="http://www.w3.org/1999/xhtml"><head><style>.now { background: rgb(0, 200, 0) } .playing { background: rgb(200, 200, 255) }</style></head><body>${body}</body></html>`,
  },
  ...more,
});

async function open(epub: TinyEpub): Promise<PageSource & { narration: Narration }> {
  const source = await openSource(tinyEpub(epub));
  opened.push(source);
  await source.settle?.();
  if (!source.narration) throw new Error("Nothing is read aloud.");
  return source as PageSource & { narration: Narration };
}

test.each([
  ["0:01:24.3", 84.3],
  ["01:24", 84],
  ["84.3s", 84.3],
  ["1.5min", 90],
  ["2h", 7200],
  [" 250ms ", 0.25],
  ["12", 12],
  ["", null],
  ["-3", null],
  ["soon", null],
])("the clock value %s is %s seconds", (value, seconds) => {
  expect(secondsOf(value)).toBe(seconds);
});

describe("the narration of an EPUB", () => {
  test("has the overlays' clips in order, each with its text, page and part of a recording", async () => {
    const { narration, pageCount } = await open(
      overlaid(
        smil(
          part("m.xhtml#a", voice('clipBegin="0:00:01" clipEnd="2.5s"')),
          `<seq>${part("m.xhtml#b", voice('clipBegin="2.5s"'))}</seq>`,
          part("m.xhtml#c"),
        ),
        `<h1 id="a">One  thing</h1><p id="b">Another</p>${prose(14)}<p id="c">The last</p>`,
      ),
    );
    const clips = await Promise.all([0, 1, 2, 3].map((k) => narration.clip(k, never)));
    expect(clips.map((clip) => clip && [clip.text, clip.begin, clip.end])).toEqual([
      ["One thing", 1, 2.5],
      ["Another", 2.5, Number.POSITIVE_INFINITY],
      ["The last", 0, Number.POSITIVE_INFINITY],
      null,
    ]);
    expect(clips[0]?.recording?.type).toBe("audio/mpeg");
    expect(clips[1]?.recording).toBe(clips[0]?.recording);
    expect(clips[2]?.recording).toBe(null);
    expect(clips.map((clip) => clip?.pages.map(({ page }) => page))).toEqual([
      [1],
      [1],
      [pageCount - 1],
      undefined,
    ]);
  });

  test("begins at or after any page, and knows a passage over several pages", async () => {
    const { narration, pageCount } = await open(
      overlaid(
        smil(part("m.xhtml#a", voice("")), part("m.xhtml#long", voice("")), part("m.xhtml#c")),
        `<p id="a">A</p><div id="long">${prose(20)}</div><p id="c">The last</p>`,
      ),
    );
    expect(pageCount).toBeGreaterThan(4);
    expect(await narration.clipFrom(0, never)).toBe(0);
    expect(await narration.clipFrom(1, never)).toBe(0);
    expect(await narration.clipFrom(2, never)).toBe(1);
    expect(await narration.clipFrom(pageCount - 1, never)).toBe(2);
    const long = await narration.clip(1, never);
    expect(long?.pages.map(({ page }) => page)).toEqual(
      Array.from({ length: pageCount - 1 }, (_, k) => k + 1),
    );
    const fractions = long?.pages.map(({ from }) => from) ?? [];
    expect(fractions[0]).toBe(0);
    expect(fractions).toEqual(fractions.toSorted((a, b) => a - b));
    expect(fractions.at(-1)).toBeLessThan(1);
  });

  test("names nothing outside the book, no recording that is none, and no chapter that is not there", async () => {
    const { narration } = await open(
      overlaid(
        smil(
          part("m.xhtml#a", voice("", "https://elsewhere.invalid/voice.mp3")),
          part("m.xhtml#a", voice("", "../../voice.mp3")),
          part("m.xhtml#a", voice("", "blob:https://elsewhere.invalid/1")),
          part("elsewhere.xhtml#a", voice("")),
          part("m.xhtml#a", voice('clipBegin="3s" clipEnd="2s"')),
          part("m.xhtml#a", voice("", "words.txt")),
        ),
        '<p id="a">A</p>',
      ),
    );
    await expect(narration.clip(0, never)).rejects.toThrow(
      /^OEBPS\/words\.txt in .* is no recording; get the book again\.$/,
    );
    expect(await narration.clip(1, never)).toBe(null);
  });

  test("is rejected in one sentence where an overlay is no XML", async () => {
    const { narration } = await open(overlaid("<smil><body><par>", '<p id="a">A</p>'));
    await expect(narration.clip(0, never)).rejects.toThrow(
      /^OEBPS\/o\.smil in .* is damaged; get the book again\.$/,
    );
  });

  test.each([
    [
      "by the book's own classes",
      '<meta property="media:active-class">now</meta><meta property="media:playback-active-class">playing</meta>',
      [0, 200, 0],
      [200, 200, 255],
    ],
    ["by a colour where the book names no class", "", [255, 226, 122], [255, 255, 255]],
  ] as const)("marks what is read on its page %s", async (_, metadata, colour, around) => {
    const source = await open(
      overlaid(
        smil(part("m.xhtml#a", voice("")), part("m.xhtml#b", voice(""))),
        '<div id="a" style="height: 200px">A</div><div id="b" style="height: 200px">B</div>',
        { metadata },
      ),
    );
    const drawn: number[] = [];
    source.watchDrawings?.((index) => drawn.push(index));
    const colours = async (): Promise<number[][]> => {
      const picture = (await source.draw(1, 488, never)) as ImageBitmap;
      const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d")!;
      pen.drawImage(picture, 0, 0);
      picture.close();
      // Within the first block, the second, and below them.
      return [150, 350, 600].map((y) => [...pen.getImageData(300, y, 1, 1).data.slice(0, 3)]);
    };
    const plain = await colours();
    for (const number of [0, 1]) await source.narration.clip(number, never);
    source.narration.mark(0);
    expect(drawn).toContain(1);
    expect(await colours()).toEqual([colour, around, around]);
    drawn.length = 0;
    source.narration.mark(1);
    expect(drawn).toContain(1);
    expect(await colours()).toEqual([around, colour, around]);
    source.narration.mark(null);
    expect(await colours()).toEqual(plain);
  });
});

test("clips that are asked for as the book is set anew are those of the book as it then is", async () => {
  const epub = overlaid(
    smil(part("m.xhtml#a", voice("")), part("n.xhtml#b", voice(""))),
    `<div>${prose(20)}</div><p id="a">A</p>`,
    // So many that the chapter is not kept laid out.
    { chapters: Array.from({ length: 12 }, () => prose(1)) },
  );
  const source = await open(epub);
  const { narration } = source;
  // Past the last, for the list of all.
  await narration.clip(2, never);
  const change = await new Promise<() => unknown>((resolve) => {
    source.watchPages?.(resolve);
    void source.typeset?.({ ...ownTypography, size: 1.7 });
  });
  const asked = Promise.all([narration.clip(0, never), narration.clipFrom(0, never)]);
  // The chapter is being laid out by now.
  const { port1, port2 } = new MessageChannel();
  await new Promise((resolve) => {
    port1.onmessage = resolve;
    port2.postMessage(null);
  });
  port1.close();
  change();
  const [after, first] = await asked;
  expect(first).toBe(0);
  expect(after).toMatchObject({ text: "A" });
  expect(after).toEqual(await narration.clip(0, never));
});

test("a book without overlays has nothing to be read aloud", async () => {
  const source = await openSource(tinyEpub({ chapters: [prose(1)] }));
  opened.push(source);
  expect(source.narration).toBe(undefined);
});
