import { strToU8, type Zippable, zipSync } from "fflate";
import { expect, test } from "vitest";
import { limits } from "../limits.ts";
import { messageOf } from "../message_of.ts";
import { openZip } from "./zip.ts";

const text = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);
const zip = (files: Record<string, string>): Blob =>
  new Blob([
    zipSync(
      Object.fromEntries(Object.entries(files).map(([name, all]) => [name, strToU8(all)])),
    ) as Uint8Array<ArrayBuffer>,
  ]);

test("a ZIP's files are listed and read", async () => {
  const archive = await openZip(zip({ mimetype: "a/b", "OEBPS/é.xhtml": "<p>" }), "book.epub");
  expect(archive.names).toEqual(["mimetype", "OEBPS/é.xhtml"]);
  expect(archive.size("OEBPS/é.xhtml")).toBe(3);
  expect(text(await archive.read("OEBPS/é.xhtml"))).toBe("<p>");
  expect(await messageOf(archive.read("b"))).toBe("book.epub has no file b; get it again.");
});

test("names that lead out of the archive are names from its root", async () => {
  const names = ["../a", "/etc/passwd", "c:/b", "x/../../y", "..\\z", "./good", "a//b"];
  const archive = await openZip(zip(Object.fromEntries(names.map((name) => [name, "1"]))), "b");
  expect(archive.names).toEqual(["a", "etc/passwd", "b", "y", "z", "good", "a/b"]);
});

test("several files of one name are there under names of their own, and those that are alike once", async () => {
  // The names are exchanged in the bytes: fflate writes no name twice.
  const bytes = zipSync(
    Object.fromEntries(
      ["1.png", "2.png", "3.png"].map((name, k) => [name, strToU8(["a", "b", "a"][k]!)]),
    ),
  );
  for (let at = 0; at + 5 < bytes.length; at++) {
    const name = text(bytes.subarray(at, at + 5));
    if (/^[23]\.png$/.test(name)) bytes[at] = "1".charCodeAt(0);
  }
  const archive = await openZip(new Blob([bytes as Uint8Array<ArrayBuffer>]), "a.cbz");
  expect(archive.names).toEqual(["1.png", "1 (2).png"]);
  expect(text(await archive.read("1 (2).png"))).toBe("b");
  const many = await openZip(zip({ "../a": "1", "/a": "2", "a (2)": "3", a: "4" }), "a.zip");
  expect(many.names).toEqual(["a", "a (2)", "a (2) (2)", "a (3)"]);
});

test("a link says that it is one, and so does a part of an archive", async () => {
  const link = { "2.png": [strToU8("1.png"), { os: 3, attrs: 0o120777 << 16 }] } as const;
  const bytes = zipSync({ "1.png": strToU8("a"), ...link } as unknown as Zippable);
  const archive = await openZip(new Blob([bytes as Uint8Array<ArrayBuffer>]), "a.cbz");
  expect(await messageOf(archive.read("2.png"))).toBe(
    "2.png in a.cbz is a link, which is not followed; pack it again with the whole file.",
  );
  const part = new Blob(["PK\x07\x08", zip({ a: "b" }).slice(0, 40)]);
  expect(await messageOf(openZip(part, "a.z01"))).toBe(
    "a.z01 is one part of an archive in several; unpack all its parts together, and pack them as one.",
  );
});

test("a file that unpacks to more than its bound is rejected, whatever it claims", async () => {
  const bytes = zipSync({ bomb: new Uint8Array(3_000_000) });
  const archive = await openZip(new Blob([bytes as Uint8Array<ArrayBuffer>]), "bomb.zip");
  expect(await messageOf(archive.read("bomb", 1 << 20))).toBe(
    "bomb in bomb.zip is larger than 1 MB when unpacked; make it smaller.",
  );
  // The directory says 1,000 bytes.
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  for (let at = 0; at + 4 < bytes.length; at++) {
    if (view.getUint32(at, true) === 3_000_000) view.setUint32(at, 1000, true);
  }
  const lying = await openZip(new Blob([bytes as Uint8Array<ArrayBuffer>]), "bomb.zip");
  expect(lying.size("bomb")).toBe(1000);
  // It ends where more comes than is claimed.
  expect(await messageOf(lying.read("bomb", 1 << 20))).toMatch(
    /^bomb in bomb\.zip is damaged[: ].*; repair it or get it again\.$/,
  );
});

test("a ZIP behind other bytes, such as the program that unpacks it, is read", async () => {
  for (const length of [10, 100_000]) {
    const archive = await openZip(new Blob([new Uint8Array(length), zip({ a: "x" })]), "a.cbz");
    expect(text(await archive.read("a"))).toBe("x");
  }
});

test("what is wrong with a damaged file is said in plain words", async () => {
  const whole = new Uint8Array(await zip({ a: "hello ".repeat(100), b: "x" }).arrayBuffer());
  const said = (bytes: Uint8Array<ArrayBuffer>): Promise<string> =>
    messageOf(openZip(new Blob([bytes]), "cut.zip"));
  expect(await said(whole.slice(0, whole.length / 2))).toBe(
    "cut.zip is damaged: its end is missing, as if it was not fetched whole; repair it or get it again.",
  );
  expect(await said(whole.slice(0, 10))).not.toMatch(/central|Error/);
});

test("too many files are rejected", async () => {
  const names = Array.from({ length: limits.archiveEntries + 1 }, (_, k) => [String(k), ""]);
  expect(await messageOf(openZip(zip(Object.fromEntries(names)), "many.zip"))).toBe(
    `many.zip has more than ${limits.archiveEntries} files; split it and open a part.`,
  );
});

test("a ZIP cut off anywhere, or with any byte changed, fails in a sentence or is read", async () => {
  const whole = new Uint8Array(await zip({ a: "hello ".repeat(100), b: "x" }).arrayBuffer());
  const tries = [
    ...Array.from({ length: whole.length }, (_, end) => whole.slice(0, end)),
    ...Array.from(whole, (byte, at) => whole.with(at, byte ^ 0xff)),
  ];
  for (const bytes of tries) {
    try {
      const archive = await openZip(new Blob([bytes as Uint8Array<ArrayBuffer>]), "cut.zip");
      for (const name of archive.names) await archive.read(name, 1 << 20);
    } catch (error) {
      expect((error as Error).name).toBe("BookError");
    }
  }
});

/** ZIPs of one file, a.txt, packed otherwise than by Deflate. */
const packed = {
  Deflate64:
    "UEsDBD8AAAAJAAAAIQDLMoquPQAAAHsAAAAFAAAAYS50eHQFwbEJADAAw7BXckjpN4YMhvT/qdJ5t+hSdCm6FF2KLkWXokvRpehSdCm6FF2KLkWXokvRpehSdCm6FF0+UEsBAj8APwAAAAkAAAAhAMsyiq49AAAAewAAAAUAAAAAAAAAAAAAAAAAAAAAAGEudHh0UEsFBgAAAAABAAEAMwAAAGAAAAAAAA==",
  Zstandard:
    "UEsDBD8AAABdAAAAIQDLMoquGQAAAHsAAAAFAAAAYS50eHQotS/9IHuFAABIPHA+aGVsbG8gAQAvaTkCUEsBAj8APwAAAF0AAAAhAMsyiq4ZAAAAewAAAAUAAAAAAAAAAAAAAAAAAAAAAGEudHh0UEsFBgAAAAABAAEAMwAAADwAAAAAAA==",
  bzip2:
    "UEsDBD8AAAAMAAAAIQDLMoquNwAAAHsAAAAFAAAAYS50eHRCWmg5MUFZJlNZInXP4gAAChmAQAAABQJEwAAgACCpQPSEMCKRrKRuQ9SMEZ8XckU4UJAidc/iUEsBAj8APwAAAAwAAAAhAMsyiq43AAAAewAAAAUAAAAAAAAAAAAAAAAAAAAAAGEudHh0UEsFBgAAAAABAAEAMwAAAFoAAAAAAA==",
};
const packedZip = (name: keyof typeof packed): Blob =>
  new Blob([Uint8Array.from(atob(packed[name]), (letter) => letter.charCodeAt(0))]);

test.each(["Deflate64", "Zstandard"] as const)("a file packed by %s is read", async (name) => {
  const archive = await openZip(packedZip(name), "a.cbz");
  expect(text(await archive.read("a.txt"))).toBe(`<p>${"hello ".repeat(20)}`);
  expect(text(await archive.readStart("a.txt", 3))).toMatch(/^<p>/);
});

test("of a file packed by bzip2 it is said so", async () => {
  const archive = await openZip(packedZip("bzip2"), "a.cbz");
  expect(await messageOf(archive.read("a.txt"))).toBe(
    "a.txt in a.cbz is packed by bzip2, which cannot be unpacked here; pack it again as usual, by Deflate.",
  );
});
