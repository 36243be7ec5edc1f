/** Hashes by which a book is found unchanged. */

import { createHash } from "node:crypto";
import type { ServedBook } from "../book.ts";
import { fileProblem } from "../problem.ts";
import { openNamed } from "../regular_file.ts";

/** Returns a hash of values that can be written as JSON. */
export function hashOf(...values: readonly unknown[]): string {
  return createHash("sha256").update(JSON.stringify(values)).digest("hex").slice(0, 32);
}

/**
 * Returns a hash of all bytes of a book, wherever it lies.
 *
 * @throws Problem if a file cannot be read
 */
export async function contentHash(book: ServedBook): Promise<string> {
  const hash = createHash("sha256");
  for (const [address, file] of book.files) {
    hash.update(JSON.stringify([address, file.type]));
    if ("text" in file) hash.update(file.text);
    else await addFile(hash, file.path);
  }
  return hash.digest("hex");
}

async function addFile(hash: ReturnType<typeof createHash>, path: string): Promise<void> {
  const handle = await openNamed(path);
  try {
    for await (const piece of handle.createReadStream({ autoClose: false })) {
      hash.update(piece as Buffer);
    }
  } catch (error) {
    throw fileProblem(path, error);
  } finally {
    await handle.close();
  }
}
