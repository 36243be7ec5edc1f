/** PDFs of few bytes, or of many things alike, that would take any time and memory. */

import { latin1, type TinyPdf, tinyPdf } from "../sources/tiny_pdf.ts";

const helvetica = "/Font << /F1 << /Type /Font /Subtype /Type1 /BaseFont /Helvetica >> >>";
const ordinary = "0.2 0.4 0.8 rg 20 20 160 260 re f\n";
const times = (count: number, make: (k: number) => string): string =>
  Array.from({ length: count }, (_, k) => make(k)).join("");
const stream = (entries: string, bytes: string): string =>
  `<< ${entries} /Length ${bytes.length} >>\nstream\n${bytes}\nendstream`;

/** Returns megabytes of one letter, packed so many times over. */
async function bomb(megabytes: number, rounds: number, letter = " "): Promise<string> {
  let parts = new Array<Uint8Array<ArrayBuffer>>(megabytes).fill(
    new Uint8Array(1 << 20).fill(letter.charCodeAt(0)),
  );
  for (let k = 0; k < rounds; k++) {
    const pack = new CompressionStream("deflate");
    const packed = new Response(pack.readable).arrayBuffer();
    const writer = pack.writable.getWriter();
    for (const part of parts) await writer.write(part);
    await writer.close();
    parts = [new Uint8Array(await packed)];
  }
  return textOf(parts[0] as Uint8Array);
}

/** Returns bytes as text of latin-1. */
function textOf(bytes: Uint8Array): string {
  let text = "";
  for (let at = 0; at < bytes.length; at += 8192) {
    text += String.fromCharCode(...bytes.subarray(at, at + 8192));
  }
  return text;
}

/** Returns a PDF of a first page and an ordinary one. */
const two = (first: string, more: Partial<TinyPdf> = {}): Uint8Array<ArrayBuffer> =>
  tinyPdf({ pages: [first, ordinary], ...more });

/** Returns forms, each of which shows the next so many times; the last has `innermost`. */
function forms(depth: number, count: number, innermost: string, entries = ""): string[] {
  return Array.from({ length: depth }, (_, k) =>
    stream(
      `/Type /XObject /Subtype /Form /BBox [0 0 200 300] ${entries} /Resources << ${helvetica} /XObject << /X ${11 + k} 0 R >> >>`,
      k === depth - 1 ? innermost : "/X Do ".repeat(count),
    ),
  );
}

const shown = { resources: `${helvetica} /XObject << /X 10 0 R >>` };
const rect = "0 0 9 9 re f ";
const text = "BT /F1 9 Tf 20 20 Td (whale) Tj ET ";
const image = (entries: string, bytes: string): string =>
  stream(`/Type /XObject /Subtype /Image ${entries}`, bytes);
const fillPattern = "/Pattern cs /P scn 0 0 200 300 re f";
const pattern = { resources: `${helvetica} /Pattern << /P 10 0 R >>` };
const tile = (entries: string, content: string, resources = ""): string =>
  stream(
    `/Type /Pattern /PatternType 1 /PaintType 1 /TilingType 1 ${entries} /Resources << ${resources} >>`,
    content,
  );

/** Numbers of a mesh of patches, or triangles. */
const meshOf = (type: number, bytes: string): string[] => [
  stream(
    `/ShadingType ${type} /ColorSpace /DeviceRGB /BitsPerCoordinate 8 /BitsPerComponent 8 /BitsPerFlag 8 /VerticesPerRow 2 /Decode [0 200 0 300 0 1 0 1 0 1]`,
    bytes,
  ),
];
const noise = (length: number): string => {
  let seed = 1;
  return times(length, () => {
    seed = (seed * 48271) % 0x7fffffff;
    return String.fromCharCode(seed & 0xff);
  });
};
const shading = { resources: "/Shading << /S 10 0 R >>" };

/** Returns a PDF whose tree of pages is so deep. */
function deepTree(depth: number): Uint8Array<ArrayBuffer> {
  const objects = Array.from(
    { length: depth },
    (_, k) =>
      `<< /Type /Pages /Count 1 /Parent ${k === 0 ? 2 : 9 + k} 0 R /Kids [${k === depth - 1 ? 10 + depth : 11 + k} 0 R] >>`,
  );
  const bytes = tinyPdf({ pages: [ordinary], objects });
  return changed(bytes, (pdf) => pdf.replace(/\/Kids \[\d+ 0 R\]/, "/Kids [10 0 R]"));
}

function changed(
  bytes: Uint8Array<ArrayBuffer>,
  change: (pdf: string) => string,
): Uint8Array<ArrayBuffer> {
  return latin1(change(textOf(bytes)));
}

const outline = (count: number, next: (k: number) => string): string[] => [
  `<< /Type /Outlines /First 11 0 R /Last ${10 + count} 0 R /Count ${count} >>`,
  ...Array.from({ length: count }, (_, k) => `<< /Title (A ${k}) /Parent 10 0 R ${next(k)} >>`),
];

/** Returns a PDF whose first page has contents that unpack to megabytes. */
const contents = async (
  entry: string,
  megabytes: number,
  letter?: string,
): Promise<Uint8Array<ArrayBuffer>> =>
  two("", {
    entries: [entry],
    objects: [stream("/Filter [/FlateDecode /FlateDecode]", await bomb(megabytes, 2, letter))],
  });

/** PDFs by what is hostile in them. */
export const hostilePdfs: Readonly<
  Record<string, () => Uint8Array<ArrayBuffer> | Promise<Uint8Array<ArrayBuffer>>>
> = {
  "forms tenfold nested": () => two("/X Do", { ...shown, objects: forms(10, 10, rect) }),
  "empty forms tenfold nested": () => two("/X Do", { ...shown, objects: forms(10, 10, "") }),
  "text in forms tenfold nested": () => two("/X Do", { ...shown, objects: forms(10, 10, text) }),
  "transparent forms tenfold nested": () =>
    two("/X Do", {
      ...shown,
      objects: forms(10, 10, rect, "/Group << /S /Transparency >>"),
    }),
  "transparent forms 400 deep": () =>
    two("/X Do", {
      ...shown,
      objects: forms(400, 1, rect, "/Group << /S /Transparency /I true >>"),
    }),
  "300,000 links": () =>
    two(ordinary, {
      entries: [
        `/Annots [${times(300_000, (k) => `<< /Type /Annot /Subtype /Link /Rect [${k % 200} 0 9 9] /A << /S /URI /URI (https://a.org/${k}) >> >>`)}]`,
      ],
    }),
  "300,000 links, each an object": () =>
    two(ordinary, {
      entries: [`/Annots [${times(300_000, (k) => `${10 + k} 0 R `)}]`],
      objects: Array.from(
        { length: 300_000 },
        (_, k) =>
          `<< /Type /Annot /Subtype /Link /Rect [${k % 200} 0 9 9] /A << /S /URI /URI (https://a.org/${k}) >> >>`,
      ),
    }),
  "one link 300,000 times": () =>
    two(ordinary, {
      objects: [
        "<< /Type /Annot /Subtype /Link /Rect [0 0 9 9] /A << /S /URI /URI (https://a.org/) >> >>",
      ],
      entries: [`/Annots [${"10 0 R ".repeat(300_000)}]`],
    }),
  "100,000 marks without appearance": () =>
    two(ordinary, {
      entries: [
        `/Annots [${times(100_000, (k) => `<< /Type /Annot /Subtype /Text /Rect [${k % 200} 0 9 9] /Contents (a) >>`)}]`,
      ],
    }),
  "100,000 marks with an appearance": () =>
    two(ordinary, {
      objects: [stream("/Type /XObject /Subtype /Form /BBox [0 0 9 9]", rect)],
      entries: [
        `/Annots [${times(100_000, (k) => `<< /Type /Annot /Subtype /Square /Rect [${k % 190} 0 9 9] /AP << /N 10 0 R >> >>`)}]`,
      ],
    }),
  "100,000 fields": () =>
    two(ordinary, {
      entries: [
        `/Annots [${times(100_000, (k) => `<< /Type /Annot /Subtype /Widget /FT /Tx /T (a${k}) /Rect [${k % 200} 0 9 9] >>`)}]`,
      ],
    }),
  "a million rectangles": () => two(times(1_000_000, (k) => `${k % 200} ${k % 300} 3 3 re f\n`)),
  "a million strokes of one path": () =>
    two(`${times(1_000_000, (k) => `${k % 200} ${(k * 7) % 300} ${k % 2 ? "l" : "m"}\n`)}S`),
  "a path of a million dashes": () =>
    two(`[0.0001] 0 d 0.01 w ${times(5000, (k) => `0 ${k % 300} m 200 0 l `)} S`),
  "a million saves": () => two("q ".repeat(1_000_000)),
  "clips upon each other": () =>
    two(times(100_000, (k) => `${k % 20} 0 180 290 re W n 0 0 200 300 re f `)),
  "tiny tiles": () =>
    two(fillPattern, {
      ...pattern,
      objects: [tile("/BBox [0 0 1 1] /XStep 0.00001 /YStep 0.00001", rect)],
    }),
  "tiny tiles on a huge box": () =>
    two(fillPattern, {
      ...pattern,
      objects: [tile("/BBox [0 0 100000 100000] /XStep 0.001 /YStep 0.001", rect)],
    }),
  "tiles in tiles": () =>
    two(fillPattern, {
      ...pattern,
      objects: Array.from({ length: 10 }, (_, k) =>
        tile(
          "/BBox [0 0 200 300] /XStep 20 /YStep 20",
          k === 9 ? rect : `${fillPattern} `.repeat(10),
          `/Pattern << /P ${11 + k} 0 R >>`,
        ),
      ),
    }),
  "a tile filled 20,000 times": () =>
    two(`/Pattern cs ${"/P scn 0 0 200 300 re f ".repeat(20_000)}`, {
      ...pattern,
      objects: [tile("/BBox [0 0 200 300] /XStep 200 /YStep 300", rect)],
    }),
  "a mesh of 400,000 triangles": () =>
    two("/S sh", { ...shading, objects: meshOf(5, noise(2_000_000)) }),
  "a mesh of 60,000 patches": () =>
    two("/S sh", {
      ...shading,
      objects: meshOf(
        6,
        times(60_000, () => `\0${noise(36)}`),
      ),
    }),
  "shadings upon each other": () =>
    two("/S sh ".repeat(50_000), {
      resources:
        "/Shading << /S << /ShadingType 2 /ColorSpace /DeviceRGB /Coords [0 0 200 300] /Extend [true true] /Function << /FunctionType 2 /Domain [0 1] /C0 [1 0 0] /C1 [0 0 1] /N 1 >> >> >>",
    }),
  "a shading by a function that calculates much": () =>
    two("/S sh", {
      resources:
        "/Shading << /S << /ShadingType 1 /ColorSpace /DeviceRGB /Domain [0 200 0 300] /Function 10 0 R >> >>",
      objects: [
        stream(
          "/FunctionType 4 /Domain [0 200 0 300] /Range [0 1 0 1 0 1]",
          `{ ${"dup mul sqrt ".repeat(100_000)} dup }`,
        ),
      ],
    }),
  "a sampled function of a billion": () =>
    two("/S sh", {
      resources:
        "/Shading << /S << /ShadingType 2 /ColorSpace /DeviceRGB /Coords [0 0 200 300] /Function 10 0 R >> >>",
      objects: [
        stream(
          "/FunctionType 0 /Domain [0 1] /Size [1000000000] /BitsPerSample 8 /Range [0 1 0 1 0 1]",
          "x",
        ),
      ],
    }),
  "soft masks nested": () =>
    two("/G gs 0 0 200 300 re f", {
      resources: "/ExtGState << /G 10 0 R >>",
      objects: Array.from({ length: 60 }, (_, k) =>
        k % 2 === 0
          ? `<< /Type /ExtGState /SMask << /S /Luminosity /G ${11 + k} 0 R >> >>`
          : stream(
              `/Type /XObject /Subtype /Form /BBox [0 0 200 300] /Group << /S /Transparency /CS /DeviceGray >> /Resources << /ExtGState << /G ${11 + k} 0 R >> >>`,
              k === 59 ? rect : "/G gs 0 0 200 300 re f ".repeat(4),
            ),
      ),
    }),
  ...Object.fromEntries(
    ["JBIG2Decode", "JPXDecode", "DCTDecode", "CCITTFaxDecode", "FlateDecode"].map((filter) => [
      `an image of 60,000 x 60,000 by ${filter}`,
      async () =>
        two("200 0 0 300 0 0 cm /X Do", {
          ...shown,
          objects: [
            image(
              `/Width 60000 /Height 60000 /ColorSpace /DeviceGray /BitsPerComponent ${/JBIG|CCITT/.test(filter) ? 1 : 8} /Filter /${filter}`,
              filter === "FlateDecode" ? await bomb(10, 1, "\0") : noise(1000),
            ),
          ],
        }),
    ]),
  ),
  "an image of 100 megapixels, 1,000 times": async () =>
    two(
      times(1000, (k) => `q 200 0 0 300 0 0 cm /X${k} Do Q `),
      {
        resources: `/XObject << ${times(1000, (k) => `/X${k} ${10 + k} 0 R `)} >>`,
        objects: new Array<string>(1000).fill(
          image(
            "/Width 10000 /Height 10000 /ColorSpace /DeviceRGB /BitsPerComponent 8 /Filter /FlateDecode",
            await bomb(1, 1, "\0"),
          ),
        ),
      },
    ),
  "an image of 10,000 x 10,000 in CMYK": async () =>
    two("200 0 0 300 0 0 cm /X Do", {
      ...shown,
      objects: [
        image(
          "/Width 10000 /Height 10000 /ColorSpace /DeviceCMYK /BitsPerComponent 8 /Filter /FlateDecode",
          await bomb(381, 1, "\0"),
        ),
      ],
    }),
  "letters that are drawn by letters": () =>
    two("BT /F 9 Tf 20 20 Td (aaaaaaaaaa) Tj ET", {
      resources: "/Font << /F 10 0 R >>",
      objects: Array.from({ length: 20 }, (_, k) =>
        k % 2 === 0
          ? `<< /Type /Font /Subtype /Type3 /FontBBox [0 0 9 9] /FontMatrix [1 0 0 1 0 0] /CharProcs << /a ${11 + k} 0 R >> /Encoding << /Differences [97 /a] >> /FirstChar 97 /LastChar 97 /Widths [9] /Resources << /Font << /F ${12 + k} 0 R >> >> >>`
          : stream("", k === 19 ? `9 0 d0 ${rect}` : "9 0 d0 BT /F 9 Tf (aaaaaaaaaa) Tj ET"),
      ),
    }),
  "contents of four gigabytes": () => contents("/Contents [10 0 R 10 0 R 10 0 R 10 0 R]", 1000),
  "a number of a gigabyte": () => contents("/Contents 10 0 R", 1000, "1"),
  "contents of 10,000 streams of 100 MB": () =>
    contents(`/Contents [${"10 0 R ".repeat(10_000)}]`, 100),
  "100,000 filters": () =>
    two("", {
      entries: ["/Contents 10 0 R"],
      objects: [stream(`/Filter [${"/ASCIIHexDecode ".repeat(100_000)}]`, "20>")],
    }),
  "100,000 pages": () => tinyPdf({ pages: Array.from({ length: 100_000 }, () => ordinary) }),
  "15,000 pages": () => tinyPdf({ pages: Array.from({ length: 15_000 }, () => ordinary) }),
  "a tree of pages 5,000 deep": () => deepTree(5000),
  "a tree of pages 100,000 deep": () => deepTree(100_000),
  "two billion pages claimed": () =>
    changed(two(ordinary), (pdf) => pdf.replace("/Count 2", "/Count 2147483647")),
  "19,999 pages claimed": () =>
    changed(two(ordinary), (pdf) => pdf.replace("/Count 2", "/Count 19999")),
  "a tree of pages that branches tenfold without pages": () =>
    changed(
      tinyPdf({
        pages: [ordinary, ordinary],
        objects: Array.from(
          { length: 11 },
          (_, k) =>
            `<< /Type /Pages /Count 0 /Kids [${k === 10 ? "" : `${11 + k} 0 R `.repeat(10)}] >>`,
        ),
      }),
      (pdf) => pdf.replace("/Kids [", "/Kids [10 0 R "),
    ),
  "an outline that goes in a circle": () =>
    two(ordinary, {
      catalog: "/Outlines 10 0 R",
      objects: outline(3, (k) => `/Next ${11 + ((k + 1) % 3)} 0 R /First 11 0 R`),
    }),
  "an outline of 300,000 lines": () =>
    two(ordinary, {
      catalog: "/Outlines 10 0 R",
      objects: outline(300_000, (k) => (k < 299_999 ? `/Next ${12 + k} 0 R` : "")),
    }),
  "an outline 100,000 deep": () =>
    two(ordinary, {
      catalog: "/Outlines 10 0 R",
      objects: outline(100_000, (k) => (k < 99_999 ? `/First ${12 + k} 0 R` : "")),
    }),
  "names that go in a circle": () =>
    two(ordinary, {
      catalog: "/Names << /Dests 10 0 R >> /OpenAction << /S /GoTo /D (a) >>",
      objects: ["<< /Kids [10 0 R 11 0 R] >>", "<< /Kids [10 0 R 10 0 R] >>"],
    }),
  "names that branch tenfold": () =>
    two(ordinary, {
      catalog: "/Names << /Dests 10 0 R >> /Outlines 21 0 R",
      objects: [
        ...Array.from(
          { length: 11 },
          (_, k) =>
            `<< /Kids [${k === 10 ? "" : `${11 + k} 0 R `.repeat(10)}] ${k === 10 ? "/Names [(b) [0 /Fit]]" : ""} /Limits [(a) (z)] >>`,
        ),
        "<< /Type /Outlines /First 22 0 R /Last 22 0 R /Count 1 >>",
        "<< /Title (A) /Parent 21 0 R /Dest (b) >>",
      ],
    }),
  "labels of pages that branch tenfold": () =>
    two(ordinary, {
      catalog: "/PageLabels 10 0 R",
      objects: Array.from(
        { length: 11 },
        (_, k) =>
          `<< /Kids [${k === 10 ? "" : `${11 + k} 0 R `.repeat(10)}] /Nums [0 << /S /r >>] >>`,
      ),
    }),
  "a label of a page in Roman numbers of a billion": () =>
    two(ordinary, {
      catalog: "/PageLabels << /Nums [0 << /S /R /St 2000000000 >>] >>",
    }),
  "a label of a page in letters of a billion": () =>
    two(ordinary, {
      catalog: "/PageLabels << /Nums [0 << /S /A /St 2000000000 >>] >>",
    }),
  "arrays 100,000 deep": () =>
    two(ordinary, { catalog: `/Deep ${"[".repeat(100_000)}${"]".repeat(100_000)}` }),
  "arrays 100,000 deep on a page": () => two(`${"[".repeat(100_000)}${"]".repeat(100_000)} TJ`),
  "a tree of structure that branches tenfold": () =>
    two(`/P << /MCID 0 >> BDC ${ordinary} EMC`, {
      catalog: "/MarkInfo << /Marked true >> /StructTreeRoot 10 0 R",
      objects: [
        "<< /Type /StructTreeRoot /K 11 0 R /ParentTree << /Nums [0 [20 0 R]] >> >>",
        ...Array.from(
          { length: 10 },
          (_, k) =>
            `<< /Type /StructElem /S /Div /P ${10 + k} 0 R /K [${k === 9 ? "0" : `${12 + k} 0 R `.repeat(10)}] >>`,
        ),
      ],
      entries: ["/StructParents 0"],
    }),
  "an encryption of nonsense": () =>
    changed(two(ordinary), (pdf) =>
      pdf.replace(
        "/Root",
        `/ID [(a) (a)] /Encrypt << /Filter /Standard /V 5 /R 6 /Length 256 /O (${"o".repeat(48)}) /U (${"u".repeat(48)}) /OE (x) /UE (x) /P -1 /Perms (x) >> /Root`,
      ),
    ),
  "an encryption of a huge key": () =>
    changed(two(ordinary), (pdf) =>
      pdf.replace(
        "/Root",
        `/ID [(a) (a)] /Encrypt << /Filter /Standard /V 2 /R 3 /Length 2000000000 /O (${"o".repeat(32)}) /U (${"u".repeat(32)}) /P -1 >> /Root`,
      ),
    ),
  "tables of references that go in a circle": () =>
    changed(two(ordinary), (pdf) => {
      const at = Number(/startxref\n(\d+)/.exec(pdf)?.[1]);
      return pdf.replace("/Root", `/Prev ${at} /XRefStm ${at} /Root`);
    }),
  "a table of references of two billion": () =>
    changed(two(ordinary), (pdf) => pdf.replace(/xref\n0 \d+/, "xref\n0 2000000000")),
  "a stream of objects within itself": () =>
    changed(
      two(ordinary, {
        objects: [
          stream("/Type /ObjStm /N 1000000000 /First 9 /Extends 10 0 R", "10 0 11 5 << >> "),
        ],
      }),
      (pdf) => pdf,
    ),
  "a million characters": () =>
    two(
      `BT /F1 1 Tf 1 TL 0 300 Td ${"(abcdefghij klmnopqrs abcdefghij klmnopqrs) Tj T* ".repeat(25_000)} ET`,
      { resources: helvetica },
    ),
  "a million characters, each by itself": () =>
    two(
      `BT /F1 1 Tf ${times(1_000_000, (k) => `1 0 0 1 ${k % 199} ${(k * 7) % 299} Tm (a) Tj `)} ET`,
      { resources: helvetica },
    ),
  "a million characters beside the page": () =>
    two(
      `BT /F1 1 Tf ${times(1_000_000, (k) => `1 0 0 1 ${900 + (k % 199)} ${k % 299} Tm (a) Tj `)} ET`,
      { resources: helvetica },
    ),
  "a page of 200,000 x 200,000 points": () => two(ordinary, { mediaBox: "[0 0 200000 200000]" }),
};
