/**
 * A sample of every format of files, for tests only. By it are tested: that the format is found by first
 * bytes, that its books fulfil the contract of a source, and that they may be changed in any byte.
 */

import { zipSync } from "fflate";
import { tinyEpub } from "../sources/epub/tiny_epub.ts";
import { tinyFb2 } from "../sources/fb2/tiny_fb2.ts";
import type { Kind, OpenedKind } from "../sources/formats.ts";
import { tinyKf8, tinyMobi } from "../sources/kindle/tiny_kindle.ts";
import { tinyPdf } from "../sources/tiny_pdf.ts";
import { rar4, rar5, sevenZip, tar, xz } from "./stored_archives.ts";

/** What a file is made of. */
type Bytes = Uint8Array<ArrayBuffer> | string;

/** A sample of a format. */
export interface FormatSample {
  /** First bytes of such files, as Latin-1. Those of what is in an archive are the archive's. */
  readonly starts: readonly string[];
  /** Small books of it, by how a sentence calls them. */
  readonly books?: Readonly<Record<string, () => Bytes | Promise<Bytes>>>;
}

/** Returns an image as PNG. */
export async function png(width: number, height: number): Promise<Uint8Array<ArrayBuffer>> {
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext("2d");
  return new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
}

async function comic(
  pack: (files: Record<string, Uint8Array>) => Uint8Array,
): Promise<Uint8Array<ArrayBuffer>> {
  const [tall, wide] = [await png(40, 60), await png(80, 60)];
  const files = { "1.png": tall, "2.png": wide, "3.png": tall, "4.png": wide };
  return pack(files) as Uint8Array<ArrayBuffer>;
}

async function gzip(text: string): Promise<Uint8Array<ArrayBuffer>> {
  const packed = new Blob([text]).stream().pipeThrough(new CompressionStream("gzip"));
  return new Uint8Array(await new Response(packed).arrayBuffer());
}

/** Returns a text of less than 256 letters as Zstandard has what it does not pack. */
function zstd(text: string): Uint8Array<ArrayBuffer> {
  // One segment, its length, and one block of bytes as they are: the last.
  const [low, high] = [((text.length << 3) | 1) & 255, text.length >> 5];
  const head = [0x28, 0xb5, 0x2f, 0xfd, 0x20, text.length, low, high, 0];
  return Uint8Array.from([...head, ...new TextEncoder().encode(text)]);
}

async function manifest(): Promise<string> {
  const src = `data:image/png;base64,${btoa(String.fromCharCode(...(await png(40, 60))))}`;
  return JSON.stringify({ title: "Atlas", pages: [src, src] });
}

const tarStart = String.fromCharCode(...tar({ "a.pdf": "%PDF-" }).subarray(0, 1029));

/** A sample of each kind of files that are opened. */
const opened: Readonly<Record<OpenedKind, FormatSample>> = {
  pdf: {
    starts: ["%PDF-1.7\n", `${"\0".repeat(1024)}%PDF-1.4`],
    books: {
      "a PDF": () =>
        tinyPdf({
          pages: Array<string>(3).fill("BT /F0 20 Tf 20 250 Td (Call me Ishmael.) Tj ET"),
          resources: "/Font << /F0 << /Type /Font /Subtype /Type1 /BaseFont /Helvetica >> >>",
        }),
    },
  },
  epub: {
    starts: [],
    books: { "an EPUB": () => tinyEpub({ chapters: ["<p>One</p>", "<p>Two</p>"] }) },
  },
  kindle: {
    starts: [`${"a".padEnd(60, "\0")}BOOKMOBI`],
    books: {
      "a MOBI": () => tinyMobi({ text: "<h1>One</h1><mbp:pagebreak/><p>Two</p>" }),
      "a KF8": () => tinyKf8({ text: ["<h1>One</h1>", "<p>Two</p>", "<p>Three</p>"] }),
    },
  },
  fb2: {
    starts: [
      "<FictionBook>",
      '<?xml version="1.0"?>\n<FictionBook xmlns="">',
      "\xef\xbb\xbf<!-- a --><fictionbook>",
      "\xff\xfe<\0F\0i\0c\0t\0i\0o\0n\0B\0o\0o\0k\0>\0",
    ],
    books: { "a FictionBook": () => tinyFb2("<section><p>One</p></section><section/>") },
  },
  zip: {
    starts: ["PK\x03\x04\x14\0", "PK\x05\x06\0\0", "MZ\0 and PK\x03\x04"],
    books: { "a comic": () => comic(zipSync) },
  },
  rar: {
    starts: ["Rar!\x1a\x07\x01\0"],
    books: { "a comic in RAR 4": () => comic(rar4), "a comic in RAR 5": () => comic(rar5) },
  },
  "7z": {
    starts: ["7z\xbc\xaf\x27\x1c\0\x04"],
    books: { "a comic in 7-Zip": () => comic(sevenZip) },
  },
  tar: { starts: [tarStart], books: { "a comic in a tar": () => comic(tar) } },
  gzip: { starts: ["\x1f\x8b\x08\0"], books: { "a text in gzip": () => gzip("Call me Ishmael.") } },
  zstd: {
    starts: ["\x28\xb5\x2f\xfd\0"],
    books: { "a text in Zstandard": () => zstd("Call me Ishmael.") },
  },
  xz: {
    starts: ["\xfd7zXZ\0\0"],
    books: { "a text in XZ": () => xz(new TextEncoder().encode("Call me Ishmael.")) },
  },
  image: {
    starts: ["\x89PNG\r\n\x1a\n\0"],
    books: {
      "an image": () => png(400, 300),
      "an SVG": () =>
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 30 40"><circle r="9"/></svg>',
    },
  },
  json: {
    starts: ['{"pages": []}', "[]", '\n[ "1.png"]', "\xef\xbb\xbf[{", "{"],
    books: { "a manifest": manifest },
  },
  text: {
    starts: ["[a link](b.md)", "Call me Ishmael.", "[1] a note", "\xff\xfea\0", "\xc3\xa9", "<p>"],
    books: { "a text": () => "Call me Ishmael.\n\nSome years ago" },
  },
};

/** A sample of each kind. */
export const formatSamples: Readonly<Record<Kind, FormatSample>> = {
  ...opened,
  bzip2: { starts: ["BZh11AY&SY\0", "BZh91AY&SY\0"] },
  zeros: { starts: ["\0".repeat(1024)] },
  palmdoc: { starts: [`${"a".padEnd(60, "\0")}TEXtREAd`] },
  html: {
    starts: ["<!doctype html>", "<HTML>", '<?xml version="1.0"?><html>', "<!-- a -->", "<body>"],
  },
  unread: {
    starts: [
      ...["{\\rtf1", "%!PS-Adobe-3.0 EPSF-3.0\n", '<?xml version="1.0"?>', "<!DOCTYPE ncx>"],
      '<TEI xmlns="http://www.tei-c.org/ns/1.0">',
    ],
  },
  unknown: { starts: ["\0\0\0", "\x7fELF", "caf\xe9"] },
};

/** The books among the samples, each with its kind, and what makes it. */
export const sampleBooks: readonly (readonly [
  name: string,
  kind: OpenedKind,
  make: () => Promise<Bytes>,
])[] = Object.entries(opened).flatMap(([kind, { books = {} }]) =>
  Object.entries(books).map(
    ([name, make]) => [name, kind as OpenedKind, async () => await make()] as const,
  ),
);
