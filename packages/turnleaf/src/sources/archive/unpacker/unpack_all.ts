/** All files of an archive, unpacked once and in order, as solid archives have to be. */

import { type ArchiveBytes, type Packing, Unpacker, UnpackingError } from "./unpacker.ts";

/** Bounds on what is unpacked. */
export interface UnpackingBounds {
  /** Entries, folders and links among them. */
  readonly entries: number;
  /** Bytes of one file. */
  readonly fileBytes: number;
  /** Bytes of all files together. */
  readonly allBytes: number;
  /** Bytes of a path. */
  readonly pathLength: number;
}

/** Why an archive is not unpacked further. */
export type Stop = "damaged" | "encrypted" | "entries" | "bytes";

/** What came of an archive: its files one by one, then an end or a failure. */
export type Unpacked =
  | { readonly kind: "file"; readonly path: string; readonly bytes: Blob }
  | { readonly kind: "large"; readonly path: string }
  /** A folder or a link. */
  | { readonly kind: "other"; readonly path: string }
  | { readonly kind: "damaged"; readonly path: string; readonly detail: string }
  | { readonly kind: "end" }
  | { readonly kind: "failed"; readonly stop: Stop; readonly detail: string };

/** Maximum of damaged files: after each the archive is opened anew and read up to the next file. */
const mostDamaged = 20;

/** Yields what is in an archive. It ends with `end` or `failed`, and throws nothing of the archive's. */
export async function* unpackAll(
  code: BufferSource,
  archive: ArchiveBytes,
  bounds: UnpackingBounds,
  packing: Packing = "archive",
): AsyncGenerator<Unpacked, void> {
  const unpacker = await Unpacker.start(code, archive, packing);
  try {
    yield* filesOf(unpacker, bounds);
  } catch (error) {
    // The machine code may break off as well.
    const stop = isEncrypted(unpacker) ? "encrypted" : "damaged";
    yield { kind: "failed", stop, detail: detailOf(error) };
  }
}

function* filesOf(unpacker: Unpacker, bounds: UnpackingBounds): Generator<Unpacked, void> {
  const failed = (stop: Stop): Unpacked => ({ kind: "failed", stop, detail: "" });
  let [entries, bytes, damaged] = [0, 0, 0];
  unpacker.open();
  while (unpacker.next()) {
    entries += 1;
    if (entries > bounds.entries) return yield failed("entries");
    if (unpacker.isEncrypted()) return yield failed("encrypted");
    const path = unpacker.path(bounds.pathLength);
    if (path === null) continue;
    if (!unpacker.isFile()) {
      yield { kind: "other", path };
      continue;
    }
    try {
      const parts: Uint8Array<ArrayBuffer>[] = [];
      let length = 0;
      // Sizes that headers claim are not used: bytes are counted as they come.
      for (let part = unpacker.unpack(); part !== null; part = unpacker.unpack()) {
        length += part.length;
        bytes += part.length;
        if (bytes > bounds.allBytes) return yield failed("bytes");
        if (length > bounds.fileBytes) break;
        parts.push(part);
      }
      if (length > bounds.fileBytes) yield { kind: "large", path };
      else yield { kind: "file", path, bytes: new Blob(parts) };
    } catch (error) {
      damaged += 1;
      if (!(error instanceof UnpackingError) || damaged > mostDamaged) throw error;
      yield { kind: "damaged", path, detail: detailOf(error) };
      unpacker.open();
      for (let index = 0; index < entries; index++) unpacker.next();
    }
  }
  yield { kind: "end" };
}

function isEncrypted(unpacker: Unpacker): boolean {
  try {
    return unpacker.isEncrypted();
  } catch {
    return false;
  }
}

function detailOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
