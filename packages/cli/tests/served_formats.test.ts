import { expect, test } from "vitest";
import { servedFormat } from "../src/served_formats.ts";

const found = (start: string, name = "file") => servedFormat(Buffer.from(start, "latin1"), name);

test("no SVG and no JSON is served, which the viewer opens", () => {
  for (const start of ["<svg xmlns=", '<?xml version="1.0"?>\n<svg>', "<!doctype svg><svg>"]) {
    expect(found(start, "file.svg")).toMatchObject({ reason: "is an SVG, which may hold scripts" });
  }
  const drawing = `<?xml version="1.0"?>\n${"<!-- a > b -->\n".repeat(60)}<SVG>`;
  expect(found(drawing)).toMatchObject({ reason: "is an SVG, which may hold scripts" });
  expect(found('{"pages":[]}')).toMatchObject({ reason: expect.stringMatching(/^is JSON /) });
});

test("images are served that browsers show, and those that the viewer decodes", () => {
  expect(found(`BM${"\0".repeat(12)}\x28\0\0\0`)).toMatchObject({
    kind: "image",
    type: "image/bmp",
  });
  expect(found("II*\0\x08")).toMatchObject({ kind: "image", type: "image/tiff" });
});

test("what the viewer does not open fails for the same reason", () => {
  const read = expect.stringMatching(/^PDF, EPUB, .* folders of images can be read$/);
  expect(found("<!---->".repeat(147))).toEqual({
    reason: "is a web page, not a book",
    remedy: read,
  });
  expect(found("BZh91AY&SY\0")).toEqual({
    reason: "is packed by bzip2, which is not unpacked here",
    remedy: read,
  });
  expect(found("\x02\x03")).toEqual({ reason: "is of an unknown format", remedy: read });
  expect(found("AT&TFORM\0\0\x01\0DJVM", "a.djvu")).toEqual({
    reason: "is a DjVu document, which is not read",
    remedy: "convert it to PDF",
  });
});

test("a name tells text and Markdown apart, and what else text is", () => {
  expect(found("<!-- a --><svg>", "a.md")).toMatchObject({ type: "text/markdown" });
  expect(found("Caf\xe9", "a.txt")).toMatchObject({ type: "text/plain" });
  expect(found("Caf\xe9", "a")).toMatchObject({ reason: "is of an unknown format" });
  expect(found("%PDF-1.7", "a.md")).toMatchObject({ type: "application/pdf" });
});

test("what is not known by its bytes is no ZIP by its name", () => {
  expect(found(`\x02${"\0".repeat(2000)}`, "a.epub")).toMatchObject({
    reason: "is of an unknown format",
  });
});
