import { expect, test } from "vitest";
import { servedFormat } from "../src/served_formats.ts";

const found = (start: string, name = "file") => servedFormat(Buffer.from(start, "latin1"), name);

test("no SVG and no JSON is served, which the viewer opens", () => {
  for (const start of ["<svg xmlns=", '<?xml version="1.0"?>\n<svg>', "<!doctype svg><svg>"]) {
    expect(found(start, "file.svg")).toBe("is an SVG, which may hold scripts");
  }
  const drawing = `<?xml version="1.0"?>\n${"<!-- a > b -->\n".repeat(60)}<SVG>`;
  expect(found(drawing)).toBe("is an SVG, which may hold scripts");
  expect(found('{"pages":[]}')).toMatch(/^is JSON /);
});

test("images are served that browsers show, and those that the viewer decodes", () => {
  expect(found(`BM${"\0".repeat(12)}\x28\0\0\0`)).toMatchObject({
    kind: "image",
    type: "image/bmp",
  });
  expect(found("II*\0\x08")).toMatchObject({ kind: "image", type: "image/tiff" });
});

test("what the viewer does not open fails for the same reason", () => {
  expect(found("<!---->".repeat(147))).toBe("is a web page, not a book");
  expect(found("BZh91AY&SY\0")).toBe("is packed by bzip2, which is not unpacked here");
  expect(found("\x7fELF")).toBe("is of an unknown format");
});

test("a name tells text and Markdown apart, and what else text is", () => {
  expect(found("<!-- a --><svg>", "a.md")).toMatchObject({ type: "text/markdown" });
  expect(found("Caf\xe9", "a.txt")).toMatchObject({ type: "text/plain" });
  expect(found("Caf\xe9", "a")).toBe("is of an unknown format");
  expect(found("%PDF-1.7", "a.md")).toMatchObject({ type: "application/pdf" });
});

test("what is not known by its bytes is no ZIP by its name", () => {
  expect(found(`\x7fELF${"\0".repeat(2000)}`, "a.epub")).toBe("is of an unknown format");
});
