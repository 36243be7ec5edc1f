/** The options and the catalogue of `turnleaf publish`, and what it rejects of them. */

import { join } from "node:path";
import { describe, expect, it, test } from "vitest";
import { parseCommand } from "../src/arguments.ts";
import { listBooks } from "../src/publish/catalogue.ts";
import { folder, removeFolders } from "./publishing.ts";

removeFolders();

describe("what cannot be published ends with one sentence", () => {
  it.each([
    [[], "Name the site's folder: --out site"],
    [["--out", "site"], "Name a book to publish."],
    [["--out", "site", "--merge"], "Name the folders of the shards."],
    [["a.pdf", "--out", "site", "--shard", "3/2"], "--shard is a part of all, such as 2/8."],
    [["a.pdf", "--out", "site", "--shard", "0/2"], "--shard is a part of all, such as 2/8."],
    [["a.pdf", "--out", "s", "--merge", "--shard", "1/2"], "--merge takes the folders of shards"],
    [["a.pdf", "--out", "site", "--format", "gif"], "--format is jpeg or webp."],
    [["a.pdf", "--out", "site", "--quality", "0"], "--quality takes a number from 1 to 100."],
    [["a.pdf", "--out", "site", "--workers", "1.5"], "--workers takes a whole number"],
    [["a.pdf", "--out", "site", "--url", "javascript:1"], "--url is the site's address"],
  ])("%j", (args, sentence) => {
    expect(() => parseCommand(["publish", ...args])).toThrow(sentence);
  });

  it.each([
    ["{", "is no valid JSON; correct it."],
    ['{"pages": []}', 'has no list of "books"; add one.'],
    ['{"books": [{}]}', 'book 1 has no "file".'],
    [
      '{"books": ["a.pdf", {"file": "b.pdf", "rights": "CC0"}]}',
      'book 2 has an unknown member "rights".',
    ],
    ['{"books": [{"file": "a.pdf", "id": "../a"}]}', "has an id that is not of lower-case letters"],
    ['{"books": [{"file": "a.pdf", "id": "con"}]}', "has an id that is not of lower-case letters"],
    [
      '{"books": [{"file": "a.pdf", "id": "a"}, {"file": "b.pdf", "id": "a"}]}',
      "the id a is given twice",
    ],
    ['{"books": [{"file": "a.pdf", "language": "not a tag"}]}', "has a language that is no tag"],
    [
      '{"books": [{"file": "a.pdf", "direction": "up"}]}',
      'has a direction that is neither "ltr" nor "rtl".',
    ],
    ['{"books": [{"file": "a.pdf", "title": 7}]}', "has a title that is no text"],
    ['{"books": [{"file": "a.pdf", "authors": [7]}]}', "has authors that are no list of names"],
  ])("a catalogue %s", async (text, sentence) => {
    const path = folder({ "catalogue.json": text });
    await expect(listBooks([], join(path, "catalogue.json"))).rejects.toThrow(sentence);
  });
});

test("a book's name in the site is one part of a path, whatever its file is called", async () => {
  const names = [
    "../../etc/passwd",
    "/a/..",
    "a/CON.pdf",
    "Ein Buch!.pdf",
    "ein-buch.epub",
    "本.pdf",
    "?.pdf",
  ];
  const long = `${"長".repeat(60)}.pdf`;
  const books = await listBooks([...names, long, long], undefined);
  const ids = books.map(({ id }) => id);
  expect(ids).toEqual([
    ...["passwd", "book", "book-con", "ein-buch", "ein-buch-2", "本", "book-2"],
    ...["長".repeat(33), `${"長".repeat(33)}-2`],
  ]);
});
