/** Broken and hostile PDFs, and books that are closed at any moment, leave nothing uncaught behind. */

import { afterEach, beforeEach, expect, test } from "vitest";
import { commands } from "vitest/browser";
import { clock } from "../for_tests/clock.ts";
import { hostilePdfs } from "../for_tests/hostile_pdfs.ts";
import { isLong } from "../for_tests/long.ts";
import { messageOf } from "../for_tests/source_pages.ts";
import { limits } from "./limits.ts";
import { openSource } from "./open.ts";
import { BookError, type PageSource } from "./page_source.ts";
import { jpeg2000, latin1, type TinyPdf, tinyPdf } from "./tiny_pdf.ts";

const never = new AbortController().signal;
const text = "BT /F1 16 Tf 30 230 Td (Call me Ishmael) Tj ET\n";
const image = "q 200 0 0 300 0 0 cm /I1 Do Q\n";
const helvetica = "/Font << /F1 << /Type /Font /Subtype /Type1 /BaseFont /Helvetica >> >>";
const fontFile = (kind: string, bytes: string): string[] => [
  `<< /Type /Font /Subtype /TrueType /BaseFont /A /FirstChar 32 /LastChar 34 /Widths [500 500 500] /FontDescriptor 11 0 R >>`,
  `<< /Type /FontDescriptor /FontName /A /Flags 4 /${kind} 12 0 R >>`,
  stream("", bytes),
];
const stream = (entries: string, bytes: string): string =>
  `<< ${entries} /Length ${bytes.length} >>\nstream\n${bytes}\nendstream`;
const picture = (entries: string, bytes = "rubbish"): string =>
  stream(`/Type /XObject /Subtype /Image /Width 9 /Height 9 ${entries}`, bytes);
const grey = "/ColorSpace /DeviceGray /BitsPerComponent 8";

const whole: TinyPdf = { pages: [text, text, image], resources: helvetica };
const changed = (change: (pdf: string) => string, pdf = whole): Uint8Array<ArrayBuffer> =>
  latin1(change(Array.from(tinyPdf(pdf), (byte) => String.fromCharCode(byte)).join("")));
const withFont = (kind: string, bytes: string): Uint8Array<ArrayBuffer> =>
  tinyPdf({ pages: [text], resources: "/Font << /F1 10 0 R >>", objects: fontFile(kind, bytes) });
const withImage = (...objects: string[]): Uint8Array<ArrayBuffer> =>
  tinyPdf({ pages: [image], resources: "/XObject << /I1 10 0 R >>", objects });

/** Files by what is wrong with them. */
const broken: Readonly<Record<string, () => Uint8Array<ArrayBuffer>>> = {
  ...Object.fromEntries(
    Array.from({ length: 12 }, (_, k) => [
      `ends after ${k + 1} thirteenths`,
      () => changed((pdf) => pdf.slice(0, ((k + 1) * pdf.length) / 13)),
    ]),
  ),
  "a table of references that is elsewhere": () =>
    changed((pdf) => pdf.replace(/startxref\n\d+/, "startxref\n7")),
  "references to other objects": () =>
    changed((pdf) => pdf.replace(/\d{10} 00000 n/g, "0000000011 00000 n")),
  "no trailer": () => changed((pdf) => pdf.replace("trailer", "tr")),
  "pages that are their own parents": () =>
    changed((pdf) => pdf.replace(/\/Kids \[[^\]]*\]/, "/Kids [2 0 R 2 0 R]")),
  "more pages than there are": () => changed((pdf) => pdf.replace("/Count 3", "/Count 9000")),
  "a page that is none": () => changed((pdf) => pdf.replace("/Type /Page ", "/Type /Font ")),
  "contents of another length": () =>
    changed((pdf) => pdf.replace(/\/Length \d+/g, "/Length 99999999")),
  "contents that are no stream": () => changed((pdf) => pdf.replace(/endstream/g, "x")),
  "contents of an unknown filter": () =>
    changed((pdf) => pdf.replace(/\/Length/g, "/Filter /Unknown /Length")),
  "contents that are not compressed as they say": () =>
    changed((pdf) => pdf.replace(/\/Length/g, "/Filter /FlateDecode /Length")),
  "operators without operands": () =>
    tinyPdf({ pages: ["Tj TJ Do sh cm re scn BI ID EI gs Q Q Q q"], resources: helvetica }),
  "no operators": () => tinyPdf({ pages: ["\x00\xff<<[(("] }),
  "encrypted in an unknown way": () =>
    changed((pdf) => pdf.replace("/Root", "/Encrypt << /Filter /Other /V 9 >> /Root")),
  "a font of rubbish": () => withFont("FontFile2", "rubbish"),
  "an empty font": () => withFont("FontFile2", ""),
  "a font that is a head only": () => withFont("FontFile2", "\x00\x01\x00\x00\xff\xff".repeat(20)),
  "a font of CFF rubbish": () => withFont("FontFile3", "\x01\x00\x04\x04".repeat(40)),
  "a font of Type 1 rubbish": () => withFont("FontFile", "%!PS-AdobeFont-1.0 eexec zz"),
  "a font that draws itself": () =>
    tinyPdf({
      pages: [text],
      resources: "/Font << /F1 10 0 R >>",
      objects: [
        "<< /Type /Font /Subtype /Type3 /FontBBox [0 0 9 9] /FontMatrix [1 0 0 1 0 0] /CharProcs << /a 11 0 R >> /Encoding << /Differences [67 /a] >> /FirstChar 67 /LastChar 67 /Widths [9] /Resources << /Font << /F1 10 0 R >> >> >>",
        stream("", "9 0 d0 BT /F1 9 Tf (C) Tj ET"),
      ],
    }),
  ...Object.fromEntries(
    ["DCTDecode", "JPXDecode", "JBIG2Decode", "CCITTFaxDecode", "FlateDecode", "LZWDecode"].map(
      (filter) => [
        `an image that is no ${filter}`,
        () => withImage(picture(`${grey} /Filter /${filter}`)),
      ],
    ),
  ),
  "an image of another size": () =>
    withImage(picture(`${grey} /Width 60000 /Height 60000 /Filter /DCTDecode`)),
  "an image that is half there": () =>
    changed(
      (pdf) =>
        pdf.replace(
          /\/Filter \/JPXDecode([\s\S]*?)stream\n([\s\S]{60})[\s\S]*?endstream/,
          "/Filter /JPXDecode$1stream\n$2\nendstream",
        ),
      jpeg2000,
    ),
  "an image masked by itself": () => withImage(picture(`${grey} /SMask 10 0 R`, "x".repeat(81))),
  "an image of no colours": () => withImage(picture("/ColorSpace [/Indexed 9 9 9]")),
  "a form that draws itself": () =>
    withImage(
      stream(
        "/Type /XObject /Subtype /Form /BBox [0 0 9 9] /Resources << /XObject << /I1 10 0 R >> >>",
        image,
      ),
    ),
};

/** What was left uncaught in the page; its workers' comes from the browser's driver. */
let uncaught: unknown[] = [];
/** Workers that have not ended. */
const working = new Set<Worker>();
globalThis.Worker = class extends Worker {
  constructor(...how: ConstructorParameters<typeof Worker>) {
    super(...how);
    working.add(this);
  }
  override terminate(): void {
    working.delete(this);
    super.terminate();
  }
};
const note = (event: PromiseRejectionEvent): void => void uncaught.push(event.reason);

beforeEach(async () => {
  uncaught = [];
  addEventListener("unhandledrejection", note);
  await commands.consoleMessages();
});
afterEach(() => removeEventListener("unhandledrejection", note));

/** Fails if anything was left uncaught, or written on the console. */
async function expectQuiet(): Promise<void> {
  await clock.until(() => working.size === 0);
  // What has a timer: three seconds are more than any.
  clock.frames(180);
  // Rejections are reported once their task is over.
  await clock.task();
  expect([...uncaught, ...(await commands.consoleMessages())]).toEqual([]);
}

/** Reads all of the first pages at once. Errors are to be of the viewer. */
async function read(source: PageSource): Promise<void> {
  const readings = Array.from({ length: Math.min(source.pageCount, 3) }, (_, k) => [
    source.size(k),
    ...[source.draw(k, 60, never), source.text?.(k, never), source.links?.(k, never)],
    ...[source.fields?.(k, never), source.alt?.(k, never), source.text?.(k, never, true)],
  ]);
  const rest = [source.outline?.(never), source.file?.()];
  for (const result of await Promise.allSettled([...readings.flat(), ...rest])) {
    if (result.status === "rejected") expect(result.reason).toBeInstanceOf(BookError);
  }
}

test.each(Object.keys(broken))("a PDF with %s", async (what) => {
  const bytes = (broken[what] as () => Uint8Array<ArrayBuffer>)();
  const source = await openSource(bytes, { askPassword: async () => null }).catch(
    (error: unknown) => error,
  );
  if (source instanceof Error) expect(source).toBeInstanceOf(BookError);
  else {
    await read(source as PageSource);
    (source as PageSource).close();
  }
  await expectQuiet();
});

/** Returns a branch of a tree of pages. */
const branch = (count: number, kids: string): string =>
  `<< /Type /Pages /Count ${count} /Kids [${kids}] >>`;

/** Trees of the pages "One" to "Three", and what is on their pages; null for one that says that it is damaged. */
const trees: readonly (readonly [string, readonly (string | null)[]])[] = [
  ["/Count 0 /Kids [10 0 R 12 0 R 14 0 R]", ["One", "Two", "Three"]],
  ["/Count -3 /Kids [10 0 R 12 0 R 14 0 R]", ["One", "Two", "Three"]],
  ["/Count 1 /Kids [10 0 R 12 0 R 14 0 R]", ["One", "Two", "Three"]],
  ["/Count 2 /Kids [10 0 R 12 0 R 14 0 R]", ["One", "Two", "Three"]],
  ["/Count 9 /Kids [10 0 R 12 0 R 14 0 R]", ["One", "Two", "Three"]],
  ["/Count 3 /Kids [10 0 R 99 0 R 14 0 R]", ["One", null, "Three"]],
  ["/Count 3 /Kids [10 0 R null 14 0 R]", ["One", null, "Three"]],
  ["/Count 3 /Kids [10 0 R 13 0 R 14 0 R]", ["One", null, "Three"]],
  ["/Count 3 /Kids [99 0 R 12 0 R 14 0 R]", [null, "Two", "Three"]],
  ["/Count 9 /Kids [10 0 R 10 0 R 14 0 R]", ["One", "One", "Three"]],
  ["/Count 9 /Kids [10 0 R << /Type /Pages /Kids 3 0 R >> 14 0 R]", ["One", null, "Three"]],
  // Branches with fewer and with more pages than they say.
  [`/Count 2 /Kids [${branch(1, "10 0 R 12 0 R")} 14 0 R]`, ["One", "Two", "Three"]],
  [`/Count 2 /Kids [${branch(1, branch(2, "10 0 R 12 0 R"))} 14 0 R]`, ["One", "Two", "Three"]],
  [
    `/Count 3 /Kids [${branch(2, "10 0 R")} ${branch(1, "12 0 R 14 0 R")}]`,
    ["One", "Two", "Three"],
  ],
  [`/Count 3 /Kids [${branch(-2, "10 0 R 12 0 R")} 14 0 R]`, ["One", "Two", "Three"]],
];

test.each(trees)("the tree of pages %s has its pages", async (tree, expected) => {
  const words = ["One", "Two", "Three"];
  const pages = words.map((word) => `BT /F1 16 Tf 30 230 Td (${word}) Tj ET`);
  const source = await openSource(tinyPdf({ pages, resources: helvetica, tree }));
  const texts = Array.from({ length: source.pageCount }, async (_, k) => {
    const runs = await source.text?.(k, never).catch((error: BookError) => error);
    if (!Array.isArray(runs)) return (runs as BookError).code === "damaged" ? null : runs;
    return runs.map(({ text }) => text).join("");
  });
  expect(await Promise.all(texts)).toEqual(expected);
  source.close();
});

test.each([
  ["its table and trailer", /xref\n[\s\S]*$/],
  ["its trailer", /trailer\n[\s\S]*$/],
  ["its last page too", /14 0 obj[\s\S]*$/],
])("a PDF that has lost its end, %s, has its pages", async (_, end) => {
  const source = await openSource(changed((pdf) => pdf.replace(end, "")));
  const texts = await Promise.all([0, 1].map((index) => source.text?.(index, never)));
  expect(texts.map((runs) => runs?.map(({ text }) => text))).toEqual([
    ["Call me Ishmael"],
    ["Call me Ishmael"],
  ]);
  expect(source.pageCount).toBe(3);
  source.close();
});

test("of a PDF that has lost its end, a first page that is missing says so, and none is left without any", async () => {
  const cut = (lost: RegExp): Uint8Array<ArrayBuffer> =>
    changed((pdf) => pdf.replace(/trailer\n[\s\S]*$/, "").replace(lost, ""));
  const source = await openSource(cut(/10 0 obj[\s\S]*?endobj/));
  expect(source.pageCount).toBe(3);
  await expect(source.text?.(0, never)).rejects.toMatchObject({ code: "damaged" });
  expect((await source.text?.(1, never))?.[0]?.text).toBe("Call me Ishmael");
  source.close();
  const none = new File([cut(/10 0 obj[\s\S]*$/)], "a.pdf");
  expect(await messageOf(openSource(none))).toBe("a.pdf has no pages; choose another file.");
});

test.each(["/Count 7 /Kids []", "/Count 0", "/Count 0 /Kids []"])(
  "the tree of pages %s has none",
  async (tree) => {
    const sentence = await messageOf(openSource(new File([tinyPdf({ pages: [], tree })], "a.pdf")));
    expect(sentence).toBe("a.pdf has no pages; choose another file.");
  },
);

/** What stalls a page, or the opening of the book. */
const stalling: Readonly<Record<string, "page" | "book">> = {
  "forms tenfold nested": "page",
  "transparent forms tenfold nested": "page",
  "tiles in tiles": "page",
  "one link 300,000 times": "page",
  "an encryption of a huge key": "book",
};

test.each(Object.entries(stalling))(
  "with %s says so of the %s, and the rest is read",
  async (what, where) => {
    // An eighth of what a page may take suffices to see that it ends, and that the ordinary one is drawn.
    const { pdfTime, pdfSteps } = limits;
    Object.assign(limits, { pdfTime: 750, pdfSteps: 25_000 });
    try {
      const bytes = await hostilePdfs[what]?.();
      const opening = openSource(new File([bytes as Uint8Array<ArrayBuffer>], "a.pdf"));
      if (where === "book") {
        expect(await messageOf(opening)).toBe(
          "a.pdf takes more time or memory than a book may; make it simpler.",
        );
      } else {
        const source = await opening;
        const [drawing, others] = [messageOf(source.draw(0, 300, never)), read(source)];
        const picture = await source.draw(1, 300, never);
        expect(picture.width).toBe(300);
        const sentence =
          "Page 1 of a.pdf takes more time or memory than a page may; make it simpler.";
        expect(await drawing).toBe(sentence);
        expect(await messageOf(source.draw(0, 900, never))).toBe(sentence);
        await others;
        expect(await source.size(0)).toEqual({ width: 200, height: 300 });
        source.close();
      }
    } finally {
      Object.assign(limits, { pdfTime, pdfSteps });
    }
    await expectQuiet();
  },
);

test.skipIf(!isLong).each(Object.keys(hostilePdfs))(
  "%s ends in a page or a sentence",
  async (what) => {
    const bytes = await hostilePdfs[what]?.();
    const opening = openSource(new File([bytes as Uint8Array<ArrayBuffer>], "a.pdf"), {
      askPassword: async () => null,
    });
    const source = await opening.catch((error: unknown) => error);
    if (source instanceof Error) expect(source).toBeInstanceOf(BookError);
    else {
      await read(source as PageSource);
      (source as PageSource).close();
    }
    await expectQuiet();
  },
);

test("one that is given up while it is opened leaves nothing uncaught", async () => {
  const { pdfTime } = limits;
  const bytes = await hostilePdfs["300,000 links, each an object"]?.();
  Object.assign(limits, { pdfTime: 24 });
  try {
    const opening = openSource(new File([bytes as Uint8Array<ArrayBuffer>], "a.pdf"));
    expect(await messageOf(opening)).toBe(
      "a.pdf takes more time or memory than a book may; make it simpler.",
    );
  } finally {
    Object.assign(limits, { pdfTime });
  }
  await expectQuiet();
});

test("what is filled in a form is there after its worker was started anew", async () => {
  const { pdfSteps } = limits;
  const source = await openSource(
    tinyPdf({
      pages: ["0 0 m S ".repeat(600), ""],
      catalog: "/AcroForm << /Fields [10 0 R] >>",
      objects: [
        "<< /Type /Annot /Subtype /Widget /FT /Tx /T (name) /V (A) /Rect [20 20 180 40] >>",
      ],
      entries: ["", "/Annots [10 0 R]"],
    }),
  );
  expect(await source.fields?.(1, never)).toMatchObject([{ name: "name", value: "A" }]);
  source.fill?.(1, "name", "Ishmael");
  Object.assign(limits, { pdfSteps: 500 });
  try {
    expect(await messageOf(source.draw(0, 30, never))).toMatch(/more time or memory/);
  } finally {
    Object.assign(limits, { pdfSteps });
  }
  expect(await source.fields?.(1, never)).toMatchObject([{ name: "name", value: "Ishmael" }]);
  expect(await (await source.file?.())?.text()).toContain("(Ishmael)");
  source.close();
  await expectQuiet();
});

test("closed while its pages are drawn and read, at any moment", async () => {
  for (let moment = 0; moment < 12; moment++) {
    const source = await openSource(tinyPdf(whole));
    const reading = read(source);
    for (let k = 0; k < moment; k++) await Promise.resolve();
    if (moment > 8) await source.size(2);
    source.close();
    await reading;
  }
  await expectQuiet();
});

test("aborted while it opens, is drawn or waits for a password", async () => {
  for (const moment of [0, 1, 5, 20, 80]) {
    const controller = new AbortController();
    const opening = openSource(tinyPdf(whole), { signal: controller.signal });
    for (let k = 0; k < moment; k++) await Promise.resolve();
    controller.abort(new Error("another book"));
    await expect(opening).rejects.toThrow("another book");
  }
  const source = await openSource(tinyPdf(whole));
  const controller = new AbortController();
  const drawing = source.draw(0, 60, controller.signal);
  controller.abort(new Error("another page"));
  await expect(drawing).rejects.toThrow("another page");
  source.close();
  await expectQuiet();
});

test("whose worker ends while it is read", async () => {
  const source = await openSource(tinyPdf(whole));
  const workers = [...working];
  expect(workers.length).toBeGreaterThan(0);
  const reading = read(source);
  for (const worker of workers)
    worker.dispatchEvent(new ErrorEvent("error", { message: "It ended." }));
  await reading;
  for (const worker of workers) worker.terminate();
  source.close();
  await expectQuiet();
});

test("printed by Chromium is read without a word on the console", async () => {
  const bytes = await commands.printedPdf(
    `<h1>One</h1><p lang="ar">مرحبا</p><p>ﬁ 日本 é <b>bold</b> <i>italic</i></p><svg width="90" height="90"><linearGradient id="g"><stop stop-color="red"/><stop offset="1"/></linearGradient><circle r="40" cx="45" cy="45" fill="url(#g)" opacity=".5"/></svg><img src="data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="><a href="https://example.com">A link</a><form><input value="x"></form><p style="break-before: page; text-shadow: 1px 1px 2px red">Two</p>`,
  );
  const source = await openSource(latin1(atob(bytes)));
  await read(source);
  expect(source.pageCount).toBe(2);
  const picture = await source.draw(0, 900, never);
  expect(picture.width).toBe(900);
  source.close();
  await expectQuiet();
});
