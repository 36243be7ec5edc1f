import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { rar4, rar5, sevenZip, xz } from "../../for_tests/stored_archives.ts";
import { messageOf } from "../message_of.ts";
import { openUnpacked, type UnpackedBounds, unpackXz, usualBounds } from "./unpacked_archive.ts";
import { fixture } from "./unpacker/fixtures_for_tests.ts";

const text = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);
const packers = [
  ["RAR 4", rar4],
  ["RAR 5", rar5],
  ["7-Zip", sevenZip],
] as const;

const started: Worker[] = [];
const ended: Worker[] = [];
let onStart: () => void;

beforeEach(() => {
  const Original = Worker;
  onStart = () => {};
  vi.stubGlobal(
    "Worker",
    class extends Original {
      constructor(address: string | URL, options?: WorkerOptions) {
        super(address, options);
        started.push(this);
        onStart();
      }
      override terminate(): void {
        ended.push(this);
        super.terminate();
      }
    },
  );
});
afterEach(() => {
  vi.unstubAllGlobals();
  // No worker outlives what it unpacks.
  expect(ended).toEqual(started);
  started.length = 0;
  ended.length = 0;
});

test.each(packers)("the files of %s are listed and read", async (_, pack) => {
  const file = new Blob([pack({ "b/ü.txt": "hello", a: "<p>" })]);
  const archive = await openUnpacked(file, "book.cbr");
  expect(archive.names).toEqual(["b/ü.txt", "a"]);
  expect(archive.size("b/ü.txt")).toBe(5);
  expect(text(await archive.read("b/ü.txt"))).toBe("hello");
  expect(text(await archive.readStart("b/ü.txt", 2))).toBe("he");
  expect(await messageOf(archive.read("c"))).toBe("book.cbr has no file c; get it again.");
  expect(await messageOf(archive.read("a", 2))).toMatch(/^a in book\.cbr is larger than 0 MB/);
  archive.close();
  expect(await messageOf(archive.read("a"))).toBe("book.cbr has no file a; get it again.");
});

test("a link among the files of a RAR is no file less, and says what it is", async () => {
  const archive = await openUnpacked(new Blob([fixture("rar5_hardlink.rar")]), "book.cbr");
  expect(archive.names).toEqual(["file.txt", "hardlink.txt"]);
  expect(await messageOf(archive.read("hardlink.txt"))).toBe(
    "hardlink.txt in book.cbr is a link, which is not followed; pack it again with the whole file.",
  );
});

test.each(packers)(
  "names that lead out of an archive of %s are names from its root",
  async (_, pack) => {
    const names = ["../a", "/etc/passwd", "c:/b", "x/../../y", "./good", "a//b"];
    const file = new Blob([pack(Object.fromEntries(names.map((name) => [name, "1"])))]);
    const { names: paths } = await openUnpacked(file, "b");
    expect(paths).toEqual(["a", "etc/passwd", "b", "y", "good", "a/b"]);
  },
);

test.each(packers)("an archive of %s beyond the bounds says so", async (_, pack) => {
  const file = new Blob([pack({ a: "a".repeat(3_000_000), b: "b" })]);
  const open = (bounds: Partial<UnpackedBounds>) =>
    openUnpacked(file, "many.cbr", undefined, { ...usualBounds, ...bounds });
  expect(await messageOf(open({ entries: 1 }))).toBe(
    "many.cbr has more than 1 files; split it and open a part.",
  );
  expect(await messageOf(open({ allBytes: 2 << 20 }))).toBe(
    "many.cbr is larger than 2 MB when unpacked; split it and open a part.",
  );
  expect(await messageOf(open({ time: 0 }))).toBe(
    "many.cbr took more than 0 seconds to unpack; pack it again as ZIP (CBZ).",
  );
  const archive = await open({ fileBytes: 1 << 20 });
  expect(archive.names).toEqual(["a", "b"]);
  expect(await messageOf(archive.read("a"))).toBe(
    "a in many.cbr is larger than 1 MB when unpacked; make it smaller.",
  );
  expect(text(await archive.read("b"))).toBe("b");
});

test("a file packed by XZ beyond the bounds says so, and is given up when its signal aborts", async () => {
  const file = new Blob([xz(new Uint8Array(3_000_000))]);
  expect((await unpackXz(file, "many.cbt")).size).toBe(3_000_000);
  const bounds = { ...usualBounds, allBytes: 2 << 20, fileBytes: 1 };
  expect(await messageOf(unpackXz(file, "many.cbt", undefined, bounds))).toBe(
    "many.cbt is larger than 2 MB when unpacked; split it and open a part.",
  );
  const given = AbortSignal.abort(new Error("given up"));
  await expect(unpackXz(file, "many.cbt", given)).rejects.toThrow("given up");
});

test("it is given up when its signal aborts, and its worker ends", async () => {
  const controller = new AbortController();
  const opening = openUnpacked(new Blob([rar5({ a: "a" })]), "a.cbr", controller.signal);
  controller.abort(new Error("given up"));
  await expect(opening).rejects.toThrow("given up");
  const later = new AbortController();
  onStart = () => queueMicrotask(() => later.abort(new Error("given up")));
  const waiting = openUnpacked(new Blob([rar5({ a: "a" })]), "a.cbr", later.signal);
  await expect(waiting).rejects.toThrow("given up");
  expect(started.length).toBe(1);
});

test("a damaged file fails alone", async () => {
  const bytes = fixture("rar_compress_normal.rar");
  bytes[3000] ^= 0xff;
  const archive = await openUnpacked(new Blob([bytes]), "a.cbr");
  expect(archive.names).toHaveLength(3);
  const [damaged, next] = archive.names;
  expect(await messageOf(archive.read(damaged))).toMatch(
    /^LibarchiveAddingTest\.html in a\.cbr is damaged \(.+\); repair it or get it again\.$/,
  );
  expect(text(await archive.read(next))).toBe("test text document\r\n");
});

test.each([
  ["rar4_encrypted.rar", "is protected by a password; unpack it first."],
  ["rar_encryption_header.rar", "is protected by a password; unpack it first."],
  ["rar5_encrypted.rar", "is protected by a password; unpack it first."],
  ["rar5_encrypted_filenames.rar", "is protected by a password; unpack it first."],
  ["7zip_encryption.7z", "is protected by a password; unpack it first."],
  ["7zip_encryption_header.7z", "is protected by a password; unpack it first."],
  [
    "rar_multivolume_single_file.part1.rar",
    "is one part of an archive in several; unpack all its parts together, and pack them as one.",
  ],
  [
    "rar5_multiarchive_solid.part04.rar",
    "is one part of an archive in several; unpack all its parts together, and pack them as one.",
  ],
])("%s %s", async (name, sentence) => {
  expect(await messageOf(openUnpacked(new Blob([fixture(name)]), "a.cbr"))).toBe(
    `a.cbr ${sentence}`,
  );
});

test("an archive cut off anywhere fails in a sentence or is read", async () => {
  for (const [, pack] of packers) {
    const whole = pack({ a: "hello ".repeat(20), b: "x" });
    for (let end = 8; end < whole.length; end += 17) {
      const opened = await openUnpacked(new Blob([whole.slice(0, end)]), "cut.cbr").catch(
        (error: Error) => error,
      );
      if (opened instanceof Error) {
        expect(opened.name).toBe("BookError");
        expect(opened.message).toMatch(/^cut\.cbr [^\n]+\.$/);
      }
    }
  }
});

test("a page that forbids the worker gets a sentence that names what to allow", async () => {
  vi.stubGlobal(
    "Worker",
    class {
      constructor() {
        throw new DOMException("Access denied", "SecurityError");
      }
    },
  );
  expect(await messageOf(openUnpacked(new Blob([rar5({ a: "a" })]), "a.cbr"))).toBe(
    "a.cbr cannot be read, as the browser did not start the script that unpacks it; allow blob: in worker-src of this page's Content-Security-Policy.",
  );
});
