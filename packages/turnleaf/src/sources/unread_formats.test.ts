import { expect, test } from "vitest";
import { sniffLength } from "./formats.ts";
import { joiningOf, rejectionOf } from "./unread_formats.ts";

const sentence = (text: string): string => {
  const start = Uint8Array.from(text.slice(0, sniffLength), (letter) => letter.charCodeAt(0));
  const { reason, remedy } = rejectionOf({ start, type: "" });
  return `It ${reason}; ${remedy}.`;
};

test.each([
  ["[InternetShortcut]\r\nURL=https://example.org/", /what leads to a file .*, not the file; /],
  ["d8:announce35:udp://tracker", /what leads to a file/],
  ["#EXTM3U\na.mp3", /what leads to a file/],
  ["[Desktop Entry]\nType=Link", /what leads to a file/],
  ["magnet:?xt=urn:btih:1", /what leads to a file/],
  ["bplist00\xd1", /what leads to a file/],
  ['<?xml version="1.0"?>\n<!DOCTYPE plist PUBLIC "">', /what leads to a file/],
  ["{\\rtf1\\ansi", /a Rich Text document \(RTF\).*; save it as PDF\.$/],
  ["%!PS-Adobe-3.0 EPSF-3.0", /PostScript/],
  ["\xc5\xd0\xd3\xc6\x20\0\0\0", /PostScript/],
  ['<fulfillmentToken xmlns="http://ns.adobe.com/adept">', /\(ACSM\), not the book; /],
  ["<?xml version='1.0'?><rss>", /is XML of a kind that is not read; /],
  ["<!DOCTYPE ncx><ncx>", /is XML/],
  ["\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", /Office/],
  ["AT&TFORM\0\0\0\x10DJVM", /a DjVu document, which is not read; convert it to PDF\.$/],
  ["ITOLITLS\x01", /\(LIT\)/],
  ["CONT\x02\0", /KFX/],
  ["\xeaDRMION\xee", /protected \(DRM\); /],
  [`${"a".padEnd(60, "\0")}PNRdPPrs`, /Palm/],
  ["8BPS\0\x01", /an image in Photoshop's format \(PSD\).*; save it as PNG or JPEG\.$/],
  ["\0\0\x01\0\x01\0", /icons/],
  ["\0\0\x02\0\0\0\0\0\0\0", /Targa/],
  ["P6\n2 3\n255\n\0", /PNM/],
  ["\x0a\x05\x01\x08\0", /PCX/],
  [`\x01\0\0\0${"\0".repeat(36)} EMF`, /metafile/],
  ["\0\0\0\x18ftypcrx \0\0\0\x01crx isom", /raw/],
  ["\0\0\0\x18ftypmp42\0\0\0\0mp42isom", /a sound or a film/],
  ["\x1aE\xdf\xa3\x9f\x42", /a sound or a film/],
  ["RIFF\0\0\0\0AVI LIST", /a sound or a film/],
  ["MZ\x90\0", /is a program; if it unpacks a book, open what it unpacks\.$/],
  ["\x7fELF\x02", /a program/],
  ["\0\x01\0\0\0\x0f", /a font/],
  ["\0\x05\x16\x07\0\x02", /a Mac keeps beside a file/],
  [
    "\x00\x01\x02\x03\x04\x05\x06**ACE**",
    /is packed by ACE \(as CBA\), which is not unpacked here; unpack it first\.$/,
  ],
  ["\x1f\x9d\x90", /compress/],
  ["BZh91AY&SY", /bzip2.*; PDF, .* can be read\.$/],
  ["<!doctype html>", /is a web page, not a book; PDF, .* can be read\.$/],
  ["\x02\x03\x04", /is of an unknown format; PDF, .* can be read\.$/],
  ["", /is of an unknown format; /],
])("of a file that begins with %j it is said what it is, and what to do", (text, expected) => {
  expect(sentence(text)).toMatch(expected);
});

test("a later part of an archive is known by its name alone", () => {
  const start = Uint8Array.of(2, 3, 4);
  for (const name of ["a.7z.002", "a.z01", "a.R00"]) {
    expect(rejectionOf({ start, type: "", name }).reason, name).toMatch(/one part of a/);
  }
});

test("of a part of a file that was cut it is said how to join it", () => {
  expect(joiningOf("book.cbz.001")).toBe(
    'is, by its name, one part of a file that was cut into several; join them in order (by "cat book.cbz.* > book.cbz", on Windows by "copy /b book.cbz.* book.cbz"), and open book.cbz.',
  );
  expect(joiningOf("book.cbz")).toBe(null);
});
