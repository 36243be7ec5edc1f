/** What the command finds in the first bytes of a file, beside what the viewer finds in them. */

import { expect, test } from "vitest";
import { tar } from "../../turnleaf/src/for_tests/stored_archives.ts";
import { type Kind, sniff } from "../../turnleaf/src/sources/sniff.ts";
import { bookType, isJson, rejectionOf } from "../src/file_types.ts";

const tarStart = Buffer.from(tar({ "a.pdf": "%PDF-" })).toString("latin1", 0, 1029);

/** The first bytes of files of each kind (latin-1), and the type as which the command serves them. */
const kinds: Readonly<Record<Exclude<Kind, "image">, readonly [string | undefined, string[]]>> = {
  pdf: ["application/pdf", ["%PDF-1.7\n", `${"\0".repeat(1024)}%PDF-1.4`]],
  zip: ["application/zip", ["PK\x03\x04\x14\0", "PK\x05\x06\0\0"]],
  rar: ["application/vnd.rar", ["Rar!\x1a\x07\x01\0"]],
  "7z": ["application/x-7z-compressed", ["7z\xbc\xaf\x27\x1c\0\x04"]],
  tar: ["application/x-tar", [tarStart]],
  gzip: ["application/gzip", ["\x1f\x8b\x08\0"]],
  zstd: ["application/zstd", ["\x28\xb5\x2f\xfd\0"]],
  xz: ["application/x-xz", ["\xfd7zXZ\0\0"]],
  bzip2: [undefined, ["BZh11AY&SY\0", "BZh91AY&SY\0"]],
  zeros: [undefined, ["\0".repeat(1024)]],
  kindle: ["application/x-mobipocket-ebook", [`${"a".padEnd(60, "\0")}BOOKMOBI`]],
  palmdoc: [undefined, [`${"a".padEnd(60, "\0")}TEXtREAd`]],
  fb2: [
    "application/x-fictionbook+xml",
    [
      "<FictionBook>",
      '<?xml version="1.0"?>\n<FictionBook xmlns="">',
      "\xef\xbb\xbf<!-- a --><fictionbook>",
      "\xff\xfe<\0F\0i\0c\0t\0i\0o\0n\0B\0o\0o\0k\0>\0",
    ],
  ],
  json: [undefined, ['{"pages": []}', "[]", '\n[ "1.png"]', "\xef\xbb\xbf[{", "{"]],
  html: [undefined, ["<!doctype html>", "<HTML>", '<?xml version="1.0"?>', "<!-- a -->", "<body>"]],
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
  "image/heic": ["\0\0\0\x18ftypheic"],
  "image/avif": ["\0\0\0\x20ftypavif", "\0\0\0\x20ftypavis"],
};

const kindOf = (start: string): Kind => sniff({ start: Buffer.from(start, "latin1"), type: "" });

test("the command takes a file for what the viewer takes it for", () => {
  for (const [kind, [type, starts]] of Object.entries(kinds)) {
    for (const start of starts) {
      expect(kindOf(start), JSON.stringify(start)).toBe(kind);
      expect(bookType(start, "file"), JSON.stringify(start)).toBe(type);
      expect(isJson(start), JSON.stringify(start)).toBe(kind === "json");
    }
  }
  for (const [type, starts] of Object.entries(images)) {
    for (const start of starts) {
      expect(kindOf(start)).toBe("image");
      expect(bookType(start, "file")).toBe(type);
    }
  }
});

test("the command serves no SVG, which the viewer shows", () => {
  for (const start of ["<svg xmlns=", '<?xml version="1.0"?>\n<svg>', "<!doctype svg><svg>"]) {
    expect(kindOf(start)).toBe("image");
    expect(bookType(start, "file.svg")).toBeUndefined();
  }
});

test("comments before a root are gone through once, however many there are", () => {
  const comments = "<!---->".repeat(147);
  expect(bookType(comments, "file")).toBeUndefined();
  expect(rejectionOf(comments)).toBe("is a web page, not a book");
  const drawing = `<?xml version="1.0"?>\n${"<!-- a > b -->\n".repeat(60)}<SVG>`;
  expect(rejectionOf(drawing)).toBe("is an SVG, which may hold scripts");
});
