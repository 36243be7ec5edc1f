import { expect, test } from "vitest";
import { FilePaths } from "./file_paths.ts";

const names = [
  "OEBPS/a&b.xhtml",
  "OEBPS/k%l.xhtml",
  "OEBPS/k%26l.xhtml",
  "OEBPS/q?r.xhtml",
  "OEBPS/text/One.xhtml",
  "OEBPS/o\u0308.xhtml",
  "mailto:x",
  "Äpfel.png",
];

test.each([
  ["a%26b.xhtml", "OEBPS/a&b.xhtml"],
  ["a&b.xhtml#x", "OEBPS/a&b.xhtml"],
  ["k%25l.xhtml", "OEBPS/k%l.xhtml"],
  ["k%l.xhtml", "OEBPS/k%l.xhtml"],
  ["k%2526l.xhtml", "OEBPS/k%26l.xhtml"],
  ["k%26l.xhtml", "OEBPS/k%26l.xhtml"],
  ["q%3Fr.xhtml", "OEBPS/q?r.xhtml"],
  ["q?r.xhtml", "OEBPS/q?r.xhtml"],
  [" text/one.XHTML?print#id ", "OEBPS/text/One.xhtml"],
  ["text\\One.xhtml", "OEBPS/text/One.xhtml"],
  ["./text/../text//One.xhtml", "OEBPS/text/One.xhtml"],
  ["/OEBPS/text/One.xhtml", "OEBPS/text/One.xhtml"],
  ["../../../OEBPS/text/One.xhtml", "OEBPS/text/One.xhtml"],
  ["%C3%B6.xhtml", "OEBPS/o\u0308.xhtml"],
  ["../a\u0308pfel.png", "Äpfel.png"],
  ["text%252FOne%252Exhtml", "OEBPS/text/One.xhtml"],
  ["../%C4pfel.png", "Äpfel.png"],
  ["", null],
  ["#id", null],
  ["none.xhtml", null],
  ["https://example.org/OEBPS/text/One.xhtml", null],
  ["//example.org/text/One.xhtml", null],
  ["mailto:x", null],
  ["%ff%fe", null],
])("%j leads to %j", (address, name) => {
  expect(new FilePaths(names).resolve(address, "OEBPS/content.opf")).toBe(name);
});
