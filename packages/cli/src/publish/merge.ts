/** Shards of a site, published on several machines, merged into one. */

import { constants } from "node:fs";
import { copyFile, mkdir, readdir } from "node:fs/promises";
import { join } from "node:path";
import { Problem, printable } from "../problem.ts";
import { makeFolder } from "./draw_book.ts";
import { readJson, readRecord } from "./record.ts";
import { type Failure, shardNoteName } from "./write_site.ts";

/** What a shard says of itself when all its books are done. */
export interface ShardNote {
  /** From 1. */
  readonly number: number;
  readonly count: number;
  /** All books of the site in their order, of all shards. */
  readonly ids: readonly string[];
  readonly failures: readonly Failure[];
}

/** Maximum of bytes of a note. */
const longest = 64_000_000;

/**
 * Puts the books of all shards into one site.
 *
 * @throws Problem if a shard is missing, or is of other books
 */
export async function mergeShards(
  folders: readonly string[],
  out: string,
  signal: AbortSignal,
): Promise<{ readonly ids: readonly string[]; readonly failures: readonly Failure[] }> {
  const shards = await Promise.all(
    folders.map(async (folder) => ({ folder, note: await readNote(folder) })),
  );
  shards.sort((a, b) => a.note.number - b.note.number);
  const [first] = shards;
  if (!first) throw new Problem("Name the folders of the shards.");
  const { count, ids } = first.note;
  for (const { folder, note } of shards) {
    if (note.count !== count || note.ids.join("/") !== ids.join("/")) {
      throw new Problem(`${printable(folder)} is a shard of other books than the others.`);
    }
  }
  for (let number = 1; number <= count; number++) {
    const found = shards.filter(({ note }) => note.number === number);
    if (found.length === 0) throw new Problem(`Shard ${number} of ${count} is missing.`);
    if (found.length > 1) throw new Problem(`Shard ${number} of ${count} is named twice.`);
  }
  for (const [index, id] of ids.entries()) {
    signal.throwIfAborted();
    const shard = shards[index % count];
    if (shard) await takeBook(join(shard.folder, "books", id), out, id);
  }
  return { ids, failures: shards.flatMap(({ note }) => note.failures) };
}

/** Copies a book that is not there yet as it is in the shard. One that failed there stays as it was merged before. */
async function takeBook(from: string, out: string, id: string): Promise<void> {
  const record = await readRecord(from);
  if (!record) return;
  const folder = join(out, "books", id);
  const there = await readRecord(folder);
  if (there?.drawn === record.drawn && there.written === record.written) return;
  await makeFolder(folder, join(out, `.part-${id}`), (part) => copyAll(from, part));
}

/** Copies a folder, without copying bytes where the file system can do so. */
async function copyAll(from: string, to: string): Promise<void> {
  await mkdir(to, { recursive: true });
  for (const entry of await readdir(from, { withFileTypes: true })) {
    const [source, target] = [join(from, entry.name), join(to, entry.name)];
    if (entry.isDirectory()) await copyAll(source, target);
    else if (entry.isFile()) {
      await copyFile(source, target, constants.COPYFILE_FICLONE);
    }
  }
}

async function readNote(folder: string): Promise<ShardNote> {
  const note = (await readJson(join(folder, shardNoteName), longest)) as ShardNote | null;
  const isNote =
    Number.isInteger(note?.number) &&
    Number.isInteger(note?.count) &&
    Array.isArray(note?.ids) &&
    note.ids.every((id) => typeof id === "string" && /^[^/\\]+$/.test(id) && !/^\.+$/.test(id)) &&
    Array.isArray(note.failures);
  if (note && isNote) return note;
  throw new Problem(`${printable(folder)} is no complete shard; publish it with --shard first.`);
}
