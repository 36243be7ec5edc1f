import { expect, test } from "vitest";
import { tar } from "../for_tests/stored_archives.ts";
import {
  archiveOfName,
  type FileStart,
  formatOfFile,
  formatOfName,
  formats,
  type Kind,
  listFormats,
  listImages,
} from "./formats.ts";

const tarStart = String.fromCharCode(...tar({ "a.pdf": "%PDF-" }).subarray(0, 1029));

/** The first bytes of files of each kind (latin-1), and their media type. */
const kinds: Readonly<
  Record<Exclude<Kind, "image" | "epub">, readonly [string | undefined, string[]]>
> = {
  pdf: ["application/pdf", ["%PDF-1.7\n", `${"\0".repeat(1024)}%PDF-1.4`]],
  zip: ["application/zip", ["PK\x03\x04\x14\0", "PK\x05\x06\0\0"]],
  rar: ["application/vnd.rar", ["Rar!\x1a\x07\x01\0"]],
  "7z": ["application/x-7z-compressed", ["7z\xbc\xaf\x27\x1c\0\x04"]],
  tar: ["application/x-tar", [tarStart]],
  gzip: ["application/gzip", ["\x1f\x8b\x08\0"]],
  zstd: ["application/zstd", ["\x28\xb5\x2f\xfd\0"]],
  xz: ["application/x-xz", ["\xfd7zXZ\0\0"]],
  bzip2: ["application/x-bzip2", ["BZh11AY&SY\0", "BZh91AY&SY\0"]],
  zeros: ["application/octet-stream", ["\0".repeat(1024)]],
  kindle: ["application/x-mobipocket-ebook", [`${"a".padEnd(60, "\0")}BOOKMOBI`]],
  palmdoc: ["application/vnd.palm", [`${"a".padEnd(60, "\0")}TEXtREAd`]],
  fb2: [
    "application/x-fictionbook+xml",
    [
      "<FictionBook>",
      '<?xml version="1.0"?>\n<FictionBook xmlns="">',
      "\xef\xbb\xbf<!-- a --><fictionbook>",
      "\xff\xfe<\0F\0i\0c\0t\0i\0o\0n\0B\0o\0o\0k\0>\0",
    ],
  ],
  json: ["application/json", ['{"pages": []}', "[]", '\n[ "1.png"]', "\xef\xbb\xbf[{", "{"]],
  html: [
    "text/html",
    ["<!doctype html>", "<HTML>", '<?xml version="1.0"?>', "<!-- a -->", "<body>"],
  ],
  text: [
    "text/plain",
    ["[a link](b.md)", "Call me Ishmael.", "[1] a note", "\xff\xfea\0", "\xc3\xa9", "<p>"],
  ],
  unknown: [undefined, ["\0\0\0", "\x7fELF", "caf\xe9"]],
};

const images = {
  "image/png": ["\x89PNG\r\n\x1a\n\0"],
  "image/jpeg": ["\xff\xd8\xff\xe0"],
  "image/gif": ["GIF87a", "GIF89a"],
  "image/webp": ["RIFF\0\0\0\0WEBPVP8 "],
  "image/tiff": ["II*\0\x08", "MM\0*\0"],
  "image/jp2": ["\0\0\0\x0cjP  \r\n\x87\n", "\xff\x4f\xff\x51"],
  "image/jxl": ["\0\0\0\x0cJXL \r\n\x87\n", "\xff\x0a"],
  "image/heic": ["\0\0\0\x18ftypheic", "\0\0\0\x18ftypmif1"],
  "image/bmp": ["BM\0\0\0\0\0\0\0\0"],
  "image/svg+xml": [
    "<svg xmlns=",
    '<?xml version="1.0"?>\n<svg>',
    "<!doctype svg><svg>",
    "\xff\xfe<\0s\0v\0g\0 \0",
  ],
  "image/avif": ["\0\0\0\x20ftypavif", "\0\0\0\x20ftypavis"],
};

const startOf = (text: string): FileStart => ({
  start: Uint8Array.from(text, (letter) => letter.charCodeAt(0)),
  type: "",
});

test("a format is found by the first bytes, with the media type as which it is served", () => {
  for (const [kind, [type, starts]] of Object.entries(kinds)) {
    for (const start of starts) {
      const format = formatOfFile(startOf(start));
      expect(format?.kind ?? "unknown", JSON.stringify(start)).toBe(kind);
      expect(format?.type, JSON.stringify(start)).toBe(type);
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
  expect(listFormats(some)).toBe("PDF, MOBI, AZW3, comics (CBZ, CBR), text, images (PNG)");
  expect(listFormats()).toMatch(/^PDF, EPUB, .*, IIIF and JSON manifests$/);
  expect(listImages()).toMatch(/^PNG, JPEG, .* and [^,]+$/);
});
