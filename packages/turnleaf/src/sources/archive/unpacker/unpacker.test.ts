import { describe, expect, it } from "vitest";
import { isLong } from "../../../for_tests/long.ts";
import { rar4, rar5, sevenZip, xz } from "../../../for_tests/stored_archives.ts";
import { unpack } from "../../../packed.ts";
import { fixture } from "./fixtures_for_tests.ts";
import type { Unpacked } from "./unpack_all.ts";
import { bounds, unpacked } from "./unpacked_for_tests.ts";
import packed from "./unpacker.wasm";

/** Returns the files by name as their texts, and the last message. */
async function contents(all: Promise<Unpacked[]>) {
  const messages = await all;
  const files: Record<string, string> = {};
  for (const message of messages) {
    if (message.kind === "file") files[message.path] = await message.bytes.text();
  }
  return { files, last: messages.at(-1) };
}

const end = { kind: "end" };

describe("libarchive's own archives", () => {
  it("RAR 4: folders and links are left out", async () => {
    const { files, last } = await contents(unpacked(fixture("rar.rar")));
    expect(Object.keys(files)).toEqual(["test.txt", "testdir/test.txt"]);
    expect(files["test.txt"]).toBe("test text document\r\n");
    expect(last).toEqual(end);
  });

  it("RAR 4, compressed", async () => {
    const { files, last } = await contents(unpacked(fixture("rar_compress_normal.rar")));
    expect(Object.keys(files)).toEqual([
      "LibarchiveAddingTest.html",
      "testdir/test.txt",
      "testdir/LibarchiveAddingTest.html",
    ]);
    expect(files["LibarchiveAddingTest.html"]).toHaveLength(20111);
    expect(files["LibarchiveAddingTest.html"]).toMatch(/<\/HTML>\s*$/i);
    expect(last).toEqual(end);
  });

  it.each([
    [
      "rar_unicode.rar",
      [
        "表だよ/新しいフォルダ/新規テキスト ドキュメント.txt",
        "表だよ/漢字長いファイル名long-filename-in-漢字.txt",
        "abcdefghijklmnopqrsテスト.txt",
      ],
    ],
    ["rar5_unicode.rar", ["👋🌎.txt"]],
  ])("%s has its names", async (name, names) => {
    const { files } = await contents(unpacked(fixture(name)));
    expect(Object.keys(files)).toEqual(names);
  });

  it.each(["rar5_stored.rar", "rar5_compressed.rar"])("%s", async (name) => {
    const { files, last } = await contents(unpacked(fixture(name)));
    expect(Object.keys(files)).toHaveLength(1);
    expect(last).toEqual(end);
  });

  it("RAR 5, solid", async () => {
    const all = await unpacked(fixture("rar5_multiple_files_solid.rar"));
    expect(all.map((one) => [one.kind, "bytes" in one && one.bytes.size])).toEqual([
      ...Array.from({ length: 4 }, () => ["file", 4096]),
      ["end", false],
    ]);
  });

  it.each([
    "7zip_copy.7z",
    "7zip_lzma1.7z",
    "7zip_lzma2.7z",
    "7zip_ppmd.7z",
    "7zip_lzma1_lzma2.7z",
  ])("%s", async (name) => {
    const { files, last } = await contents(unpacked(fixture(name)));
    expect(Object.values(files).every((text) => text.length > 0)).toBe(true);
    expect(Object.keys(files).length).toBeGreaterThan(0);
    expect(last).toEqual(end);
  });

  it("an empty one has nothing", async () => {
    expect(await unpacked(fixture("7zip_empty_archive.7z"))).toEqual([end]);
  });

  it.each([
    "rar4_encrypted.rar",
    "rar_encryption_header.rar",
    "rar5_encrypted.rar",
    "rar5_encrypted_filenames.rar",
    "7zip_encryption.7z",
    "7zip_encryption_header.7z",
  ])("%s is encrypted", async (name) => {
    expect((await unpacked(fixture(name))).at(-1)).toMatchObject({
      kind: "failed",
      stop: "encrypted",
    });
  });

  it("a way of packing that is not supported is named", async () => {
    expect(await unpacked(fixture("7zip_deflate.7z"))).toContainEqual(
      expect.objectContaining({ kind: "damaged", detail: expect.stringMatching(/support/i) }),
    );
  });

  it.each([
    "rar5_loop_bug.rar",
    "rar5_bytes_remaining_underflow.rar",
    "rar5_unpacked_size_exceeds_declared.rar",
    "rar_invalid1.rar",
    "rar_symlink_huge.rar",
    "rar_newsub_huge.rar",
    "rar_ppmd_use_after_free.rar",
    "rar5_symlink.rar",
    "rar5_hardlink.rar",
    "7zip_entries_oom.7z",
    "7zip_folders_oom.7z",
    "7zip_malformed_numfiles_oom.7z",
    "7zip_malformed.7z",
  ])("%s, which broke readers, comes to an end", async (name) => {
    const all = await unpacked(fixture(name));
    expect(["end", "failed"]).toContain(all.at(-1)?.kind);
  });
});

describe.each([
  ["RAR 4", rar4],
  ["RAR 5", rar5],
  ["7-Zip", sevenZip],
])("a stored archive of %s", (_, pack) => {
  it("is unpacked in its order", async () => {
    const big = "0123456789".repeat(50_000);
    const { files, last } = await contents(unpacked(pack({ "b/ü.txt": "one", a: big, c: "x" })));
    expect(files).toEqual({ "b/ü.txt": "one", a: big, c: "x" });
    expect(Object.keys(files)).toEqual(["b/ü.txt", "a", "c"]);
    expect(last).toEqual(end);
  });

  it("ends at too many entries, and too many bytes; a file that is too large is left out", async () => {
    const files = { a: "a".repeat(1000), b: "b", c: "c" };
    expect((await unpacked(pack(files), { entries: 2 })).at(-1)).toMatchObject({ stop: "entries" });
    expect((await unpacked(pack(files), { allBytes: 1001 })).at(-1)).toMatchObject({
      stop: "bytes",
    });
    const { files: kept } = await contents(unpacked(pack(files), { fileBytes: 10 }));
    expect(kept).toEqual({ b: "b", c: "c" });
    expect(await unpacked(pack(files), { fileBytes: 10 })).toContainEqual({
      kind: "large",
      path: "a",
    });
  });

  it("has names of a bounded length", async () => {
    const { files } = await contents(unpacked(pack({ ["n".repeat(301)]: "a", b: "b" })));
    expect(files).toEqual({ b: "b" });
  });

  it("may claim any size without memory of that size", async () => {
    for (const size of [0, 1, 1000, 2 ** 31 - 1, 2 ** 32 - 1]) {
      const all = await unpacked(pack({ a: "0123456789", b: "b" }, { size }));
      expect(["end", "failed"]).toContain(all.at(-1)?.kind);
      for (const one of all) {
        if (one.kind === "file") expect(one.bytes.size).toBeLessThanOrEqual(bounds.fileBytes);
      }
    }
  });
});

/** 2,000 times "page ", packed by `xz -9e` with a sum of CRC-64, and by `xz -C sha256`. */
const packedByXz = [
  "/Td6WFoAAATm1rRGAgAhARwAAAAQz1jM4CcPADFdADgYSSrCxGJgsIREsAWsd06wya2FjSpwFe55fbpLubCsiL0I8sCHTJJmtiDaZv6tDwAAAAAA8p1g3Wx4NJsAAU2QTgAAAHHFXtqxxGf7AgAAAAAEWVo=",
  "/Td6WFoAAArh+wyhAgAhARYAAAB0L+Wj4CcPADFdADgYSSrCxGJgsIREsAWsd06wya2FjSpwFe55fbpLubCsiL0I8sCHTJJmtiDaZv6tDwAAAAAAFmtdLqKXUpfNtBfgDWNZLKNiCOmFE4Y+35IjPgn4py8AAWWQTgAAACpCoTG26d8cAgAAAAAKWVo=",
].map((text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)));

describe("XZ", () => {
  const text = "page ".repeat(2000);
  const ofXz = (bytes: Uint8Array, within = {}) => unpacked(bytes, within, "xz");

  it.each([
    ["CRC-64", packedByXz[0] as Uint8Array],
    ["SHA-256", packedByXz[1] as Uint8Array],
    ["CRC-32, in chunks as they are", xz(new TextEncoder().encode(text))],
  ])("is unpacked with sums of %s", async (_, bytes) => {
    const { files, last } = await contents(ofXz(bytes));
    expect([Object.values(files), last]).toEqual([[text], end]);
    expect(
      Object.values((await contents(ofXz(Uint8Array.from([...bytes, ...bytes])))).files),
    ).toEqual([text + text]);
  });

  it("ends at too many bytes, and where it is damaged or cut off", async () => {
    const [bytes] = packedByXz as [Uint8Array];
    expect((await ofXz(bytes, { allBytes: 9999 })).at(-1)).toMatchObject({ stop: "bytes" });
    // Behind its mark; a setting that changes nothing in this text may be another.
    for (let at = 6; at < bytes.length; at += isLong ? 1 : 7) {
      expect(Object.keys((await contents(ofXz(bytes.slice(0, at)))).files), String(at)).toEqual([]);
      const { files } = await contents(ofXz(bytes.with(at, bytes[at] ^ 1)));
      for (const file of Object.values(files)) expect(file, String(at)).toBe(text);
    }
  });
});

it("a damaged file is named, and the next are unpacked", async () => {
  const stored = sevenZip({ a: "aaaaaaaaaa", b: "bbbbbbbbbb", c: "cccccccccc" });
  const at = new TextDecoder("latin1").decode(stored).indexOf("bbbbbbbbbb");
  const kinds = (await unpacked(stored.with(at, 0))).map(({ kind }) => kind);
  expect(kinds).toEqual(["file", "damaged", "file", "end"]);
  const compressed = fixture("rar_compress_normal.rar");
  const all = await unpacked(compressed.with(3000, compressed[3000] ^ 0xff));
  const found = all.filter(({ kind }) => kind !== "other");
  expect(found.map((one) => [one.kind, "path" in one && one.path])).toEqual([
    ["damaged", "LibarchiveAddingTest.html"],
    ["file", "testdir/test.txt"],
    ["file", "testdir/LibarchiveAddingTest.html"],
    ["end", false],
  ]);
});

it.each([
  ["rar5_symlink.rar", ["symlink.txt", "dirlink", "dir"]],
  ["rar5_hardlink.rar", ["hardlink.txt"]],
])("the links and folders of %s are named", async (name, expected) => {
  const all = await unpacked(fixture(name));
  expect(all.flatMap((one) => (one.kind === "other" ? [one.path] : []))).toEqual(expected);
});

it("the machine code asks for nothing but the archive's bytes, and a bounded memory", async () => {
  const code = await unpack(packed);
  const module = await WebAssembly.compile(code);
  const imports = WebAssembly.Module.imports(module);
  expect(imports.filter(({ module: from }) => from === "page").map(({ name }) => name)).toEqual([
    "read",
  ]);
  for (const { module: from, kind } of imports) {
    expect(["page", "wasi_snapshot_preview1"]).toContain(from);
    expect(kind).toBe("function");
  }
  const rejected = Object.fromEntries(imports.map(({ name }) => [name, () => 52]));
  const { exports } = await WebAssembly.instantiate(module, {
    page: rejected,
    wasi_snapshot_preview1: rejected,
  });
  const memory = exports.memory as WebAssembly.Memory;
  const pages = memory.buffer.byteLength / 65536;
  expect(() => memory.grow((384 << 20) / 65536 - pages)).not.toThrow();
  expect(() => memory.grow(1)).toThrow();
});
