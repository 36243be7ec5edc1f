/** Files that are packed each by itself, by gzip, Zstandard or XZ. */

import type { Kind } from "../formats.ts";
import { limits } from "../limits.ts";
import { loadPart } from "../load_part.ts";
import { BookError } from "../page_source.ts";
import { ZstdStream } from "./zstd_stream.ts";

/**
 * Returns the file that is packed in another. Rejects with a `BookError` if it is damaged, or too large,
 * or with the signal's reason.
 *
 * @param kind how it is packed: "zstd" or "xz", otherwise by gzip
 * @param name the file's name in sentences
 */
export async function unpackedFile(
  file: Blob,
  kind: Kind,
  name: string,
  signal?: AbortSignal,
): Promise<Blob> {
  if (kind === "xz") {
    const { unpackXz } = await loadPart(import("./unpacked_archive.ts"));
    return await unpackXz(file, name, signal);
  }
  const unpacking = kind === "zstd" ? new ZstdStream() : new DecompressionStream("gzip");
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let length = 0;
  try {
    const pieces = file
      .stream()
      .pipeThrough(unpacking as ReadableWritablePair<Uint8Array<ArrayBuffer>>);
    for (const reader = pieces.getReader(); ; ) {
      const { done, value } = await reader.read();
      if (done) return new Blob(parts);
      length += value.length;
      parts.push(value);
      if (length <= limits.unpackedBytes) continue;
      await reader.cancel();
      break;
    }
  } catch (cause) {
    throw new BookError(`${name} is damaged: it cannot be unpacked; get it again.`, {
      code: "damaged",
      source: name,
      cause,
    });
  }
  throw new BookError(
    `${name} is larger than ${Math.floor(limits.unpackedBytes / (1 << 20))} MB when unpacked; split it and open a part.`,
    { code: "tooLarge", source: name },
  );
}
