import { expect, test } from "vitest";
import { formatSamples } from "../for_tests/format_samples.ts";
import {
  archiveOfName,
  type FileStart,
  formatOfFile,
  formatOfName,
  formats,
  listFormats,
  listImages,
} from "./formats.ts";

const images = {
  "image/png": ["\x89PNG\r\n\x1a\n\0"],
  "image/jpeg": ["\xff\xd8\xff\xe0"],
  "image/gif": ["GIF87a", "GIF89a"],
  "image/webp": ["RIFF\0\0\0\0WEBPVP8 "],
  "image/tiff": ["II*\0\x08", "MM\0*\0"],
  "image/jp2": ["\0\0\0\x0cjP  \r\n\x87\n", "\xff\x4f\xff\x51"],
  "image/jxl": ["\0\0\0\x0cJXL \r\n\x87\n", "\xff\x0a"],
  "image/heic": ["\0\0\0\x18ftypheic", "\0\0\0\x18ftypmif1\0\0\0\0mif1heic"],
  "image/bmp": [
    "BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0",
    // What stands where nothing is to stand, and the header of OS/2.
    "BM\x36\x01\0\0\x07\0\x01\0\x1a\0\0\0\x0c\0\0\0",
  ],
  "image/svg+xml": [
    "<svg xmlns=",
    '<?xml version="1.0"?>\n<svg>',
    "<!doctype svg><svg>",
    "\xff\xfe<\0s\0v\0g\0 \0",
  ],
  // The first of its brands may be that of all such images.
  "image/avif": ["\0\0\0\x20ftypavif", "\0\0\0\x20ftypavis", "\0\0\0\x18ftypmif1\0\0\0\0mif1avif"],
};

const startOf = (text: string): FileStart => ({
  start: Uint8Array.from(text, (letter) => letter.charCodeAt(0)),
  type: "",
});

test("a format is found by the first bytes", () => {
  for (const [kind, { starts }] of Object.entries(formatSamples)) {
    for (const start of starts) {
      expect(formatOfFile(startOf(start))?.kind ?? "unknown", JSON.stringify(start)).toBe(kind);
    }
  }
  for (const [type, starts] of Object.entries(images)) {
    for (const start of starts) {
      expect(formatOfFile(startOf(start)), start).toMatchObject({ kind: "image", type });
    }
  }
});

test.each(["<!-- a drawing --><svg>", "<svg><circle/></svg>\n# A"])(
  "Markdown may begin as a drawing does: %s",
  (text) => {
    expect(formatOfFile({ ...startOf(text), type: "text/markdown" })?.kind).toBe("text");
    expect(formatOfFile({ ...startOf(text), name: "a.md" })?.kind).toBe("text");
    expect(formatOfFile(startOf(text))?.type).toBe("image/svg+xml");
  },
);

test("bytes after the first ones do not change what a file is", () => {
  const start = startOf(`${"a".repeat(1029)}\0\xff`);
  expect(formatOfFile(start)?.kind).toBe("text");
});

test("a format is found by the ending of a name, the longest first", () => {
  const kindOf = (name: string) => formatOfName(name)?.kind;
  expect(kindOf("a.PDF")).toBe("pdf");
  expect(kindOf("novel.fb2.zip")).toBe("fb2");
  expect(kindOf("v1.0/hero.cbz")).toBe("zip");
  expect(kindOf("scans.jfif")).toBe("image");
  expect(kindOf("pdf")).toBeUndefined();
  // What is in a ZIP its name does not say.
  expect(kindOf("a.zip")).toBeUndefined();
  expect(archiveOfName("a.zip")?.kind).toBe("zip");
});

test("a ZIP behind other bytes, of any number, is one by its name", () => {
  const of = (text: string, name?: string) => formatOfFile({ ...startOf(text), name })?.kind;
  const program = `\x7fELF${"\0".repeat(1024)}`;
  expect(of(program)).toBeUndefined();
  for (const name of ["a.zip", "A.CBZ", "a.epub", "a.fb2.zip"])
    expect(of(program, name)).toBe("zip");
  for (const name of ["a.pdf", "a.cbr", "zip"]) expect(of(program, name)).toBeUndefined();
  // What bytes say counts first.
  expect(of("<html>", "a.epub")).toBe("html");
  expect(of("\0".repeat(1024), "a.cbz")).toBe("zeros");
});

test("takes text of other encodings where the name says that it is text", () => {
  const of = (bytes: number[], name: string, type = "") =>
    formatOfFile({ start: Uint8Array.from(bytes), type, name })?.kind;
  const inGbk = [0xb5, 0xda, 0xd2, 0xbb, 0xd5, 0xc2, 0x0a];
  const inUtf16 = [..."Chapter"].flatMap((letter) => [letter.charCodeAt(0), 0]);
  for (const bytes of [inGbk, inUtf16]) {
    for (const name of ["novel.txt", "novel.MD"]) expect(of(bytes, name)).toBe("text");
    expect(of(bytes, "novel.txt", "application/octet-stream")).toBe("text");
    for (const name of ["novel", "novel.bin", "txt"]) expect(of(bytes, name)).toBeUndefined();
  }
  // What bytes say counts first.
  expect(
    of(
      [..."%PDF-1.4"].map((letter) => letter.charCodeAt(0)),
      "a.txt",
    ),
  ).toBe("pdf");
});

test("a text that names a PDF's mark is text where its name says so, and what a ZIP holds does not make it one", () => {
  const of = (text: string, name?: string) => formatOfFile({ ...startOf(text), name })?.kind;
  const named = "A file begins with %PDF-1.7";
  expect([of(named, "a.md"), of(named, "a.txt"), of(named)]).toEqual(["text", "text", "pdf"]);
  expect([of("Listing:\n%PDF-1.7", "a.txt"), of("Junk\n%PDF-1.7")]).toEqual(["text", "pdf"]);
  const stored = `PK\x03\x04${"\0".repeat(26)}a.pdf%PDF-1.7`;
  expect(of(stored)).toBe("zip");
  expect(of(`MZ\0 the program ${stored}`)).toBe("zip");
});

test("every ending and every mark is of one format", () => {
  const endings = formats.flatMap((format) => [
    ...(format.endings ?? []),
    ...(format.archiveEndings ?? []),
  ]);
  expect(new Set(endings).size).toBe(endings.length);
  for (const format of formats) {
    expect(format.is ?? format.isIn, format.type).toBeDefined();
    // What is opened has a bound, and what is not says why.
    expect(format.most === undefined).toBe(format.reason !== undefined);
  }
});

test("lists of what can be read name formats by families", () => {
  const named = new Set(["PDF", "CBZ", "CBR", "PNG", "text", "MOBI"]);
  const some = formats.filter(({ labels = [] }) => labels.some((label) => named.has(label)));
  expect(listFormats(some)).toBe("PDF, MOBI, AZW3, comics (CBR, CBZ), text, images (PNG)");
  expect(listFormats()).toMatch(/^PDF, EPUB, .*, IIIF and JSON manifests$/);
  expect(listImages()).toMatch(/^PNG, JPEG, .* and [^,]+$/);
});

test.each([
  ["a.md", "<!-- of the licence -->\n# A"],
  ["README.markdown", "<body>A</body>\n\n# A"],
  ["a.txt", "<!-- an arrow <- "],
  ["a.txt", "{ of a brace"],
  ["a.md", "{{< a short code >}}\n\n# A"],
  ["a.txt", '["Yes", he said.'],
  ["a.txt", "Of files that begin with %PDF-1.4"],
  ["a.txt", "Something went wrong\0 here, as it was written."],
])("what is named %s is text, whatever it begins with: %j", (name, text) => {
  expect(formatOfFile({ ...startOf(text), name })?.family).toBe("text");
});

test.each([
  ["a.md", "text/html", "<!doctype html><title>Not found</title>", "html"],
  ["a.txt", "", "<!doctype html><title>Not found</title>", "html"],
  ["a.txt", "", "%PDF-1.4", "pdf"],
  ["a.txt", "text/plain", "\x01\0\x02\0\x03\0", undefined],
  ["a.json", "application/json", "\xff\xfe{\0}\0", "json"],
  ["a.json", "application/json", "// of no manifest\n{}", "json"],
])(
  "what is named %s, of type %j, and begins with %j, is of the kind %s",
  (name, type, text, kind) => {
    expect(formatOfFile({ ...startOf(text), name, type })?.kind).toBe(kind);
  },
);
