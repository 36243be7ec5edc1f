import { expect, test } from "vitest";
import { tar, tarWithLinks } from "../../for_tests/stored_archives.ts";
import { sniff } from "../formats.ts";
import { limits } from "../limits.ts";
import { messageOf } from "../message_of.ts";
import { openTar } from "./tar.ts";

const text = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);
const kindOf = (bytes: Uint8Array): string => sniff({ start: bytes.subarray(0, 1029), type: "" });

const long = `${"folder/".repeat(20)}ü.txt`;

test.each(["GNU", "POSIX"] as const)(
  "the files of a tar as %s writes it are listed and read",
  async (paths) => {
    const bytes = tar({ "/a/ü.txt": "hello", "b.txt": "<p>", [long]: "far", "../c": "x" }, paths);
    expect(kindOf(bytes)).toBe("tar");
    const archive = await openTar(new Blob([bytes]), "a.cbt");
    expect(archive.names).toEqual(["a/ü.txt", "b.txt", long, "c"]);
    expect(archive.size("a/ü.txt")).toBe(5);
    expect(text(await archive.read("b.txt"))).toBe("<p>");
    expect(text(await archive.read(long))).toBe("far");
    expect(text(await archive.readStart("a/ü.txt", 2))).toBe("he");
    expect(await messageOf(archive.read("d"))).toBe("a.cbt has no file d; get it again.");
    expect(await messageOf(archive.read("b.txt", 2))).toBe(
      "b.txt in a.cbt is larger than 0 MB when unpacked; make it smaller.",
    );
  },
);

test("links in a tar lead to the files that they name, and those that lead nowhere say so", async () => {
  const bytes = tarWithLinks({ "a/1": "one", [long]: "far" }, [
    ["hard", "1", "a/1"],
    ["a/beside", "2", "1"],
    ["b/up", "2", "../a/./1"],
    ["root", "2", "/a/1"],
    ["long", "1", long],
    ["twice", "2", "b/up"],
    ["lost", "2", "../../etc/passwd"],
    ["round", "2", "about"],
    ["about", "2", "round"],
  ]);
  const archive = await openTar(new Blob([bytes]), "a.cbt");
  expect(archive.names).toHaveLength(11);
  for (const name of ["hard", "a/beside", "b/up", "root", "twice"]) {
    expect(text(await archive.read(name)), name).toBe("one");
  }
  expect(text(await archive.read("long"))).toBe("far");
  expect(await messageOf(archive.read("lost"))).toBe(
    "lost in a.cbt is a link to etc/passwd, which is no file in it; pack it again with the whole file.",
  );
  expect(await messageOf(archive.read("round"))).toContain("is a link to");
});

test("of a tar that is cut off anywhere the files before are read", async () => {
  const bytes = tar({ a: "first", b: "second" });
  for (let length = 0; length < bytes.length; length += 100) {
    const archive = await openTar(new Blob([bytes.slice(0, length)]), "a.cbt");
    expect(archive.names).toEqual(length < 512 ? [] : length < 3 * 512 ? ["a"] : ["a", "b"]);
    for (const name of archive.names) await archive.read(name);
    // Each file has a header of 512 bytes, and is of fewer.
    const isWhole =
      length === 0 ||
      [5, 6].some((size, k) => length >= 1024 * k + 512 + size && length <= 1024 * (k + 1)) ||
      length > 2048;
    expect(archive.damage?.message, String(length)).toBe(
      isWhole
        ? undefined
        : "a.cbt is damaged or breaks off, and pages may be missing; get it again.",
    );
  }
});

test("a PDF within a tar does not make it one, and a block of anything else is no tar", () => {
  expect(kindOf(tar({ "a.pdf": "%PDF-1.7" }))).toBe("tar");
  // The end of a tar, before which there is nothing, or a file of nothing at all.
  expect(kindOf(new Uint8Array(1024))).toBe("zeros");
  expect(kindOf(tar({ a: "b" }).with(0, 0x7f))).toBe("unknown");
});

test("too many files are rejected", async () => {
  const bounds = limits as { archiveEntries: number };
  const { archiveEntries } = limits;
  bounds.archiveEntries = 2;
  try {
    const file = new Blob([tar({ a: "", b: "", c: "" })]);
    expect(await messageOf(openTar(file, "a.cbt"))).toBe(
      "a.cbt has more than 2 files; split it and open a part.",
    );
  } finally {
    bounds.archiveEntries = archiveEntries;
  }
});

test("headers that are of no file are counted too", async () => {
  // A folder, again and again: its header is all that there is of it.
  const folder = tar({ "a/": "" }).slice(0, 512);
  const most = 3 * limits.archiveEntries;
  const headers = new Blob(Array(most + 2).fill(folder));
  expect(await messageOf(openTar(headers, "a.cbt"))).toContain("more than");
});
