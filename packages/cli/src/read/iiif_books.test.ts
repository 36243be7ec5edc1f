import { expect, test } from "vitest";
import { iiifBooks } from "./iiif_books.ts";

const url = "https://a.example/m.json";
const web = { fetchJson: () => Promise.reject(new Error("none")), isInner: async () => false };
const booksOf = (value: object) =>
  iiifBooks({ value, url, isPublic: true }, web, (sentence) => expect(sentence).toBe(""));

test.each([
  { "@context": "http://iiif.io/api/presentation/3/context.json", type: "Manifest" },
  { "@context": "http://www.shared-canvas.org/ns/context.json", "@type": "sc:Manifest" },
  { type: "Manifest" },
  { "@type": "sc:Manifest" },
  { protocol: "http://iiif.io/api/image", width: 3, height: 4 },
])("JSON is of IIIF by its context, its type or its protocol: %j", async (value) => {
  expect(await booksOf({ ...value, label: "A book" })).toEqual([{ title: "A book", url }]);
});

test("other JSON is not", async () => {
  await expect(booksOf({ type: "Book", pages: [] })).rejects.toThrow("is JSON, and no manifest");
});
