import { constants } from "node:fs";
import { type FileHandle, open } from "node:fs/promises";
import { fileProblem, Problem, printable } from "./problem.ts";

/**
 * Opens a file for reading; null if it is not a regular one. A pipe or a device
 * is opened without waiting for its other end, and never read: it might not
 * end.
 *
 * @param flags more flags of `open`, such as `O_NOFOLLOW`
 */
export async function openRegular(path: string, flags = 0): Promise<FileHandle | null> {
  const { O_RDONLY, O_NONBLOCK = 0 } = constants;
  const handle = await open(path, O_RDONLY | O_NONBLOCK | flags);
  try {
    if ((await handle.stat()).isFile()) return handle;
  } catch (error) {
    await handle.close();
    throw error;
  }
  await handle.close();
  return null;
}

/**
 * Opens a regular file for reading that a user has named.
 *
 * @throws Problem if it cannot be opened or is not regular
 */
export async function openNamed(path: string): Promise<FileHandle> {
  const handle = await openRegular(path).catch((error: unknown) => {
    throw fileProblem(path, error);
  });
  if (!handle) throw new Problem(`${printable(path)} is not a regular file; name another.`);
  return handle;
}

/**
 * Reads a whole regular file, of at most `most` bytes.
 *
 * @throws Problem if it cannot be read, is not regular, or is larger
 */
export async function readRegular(path: string, most: number): Promise<Buffer> {
  const handle = await openNamed(path);
  try {
    const { size } = await handle.stat();
    if (size > most) throw tooLarge(path, most);
    // No more than its size when it was checked, in case it grows meanwhile.
    const bytes = Buffer.alloc(size);
    let length = 0;
    while (length < size) {
      const { bytesRead } = await handle.read(bytes, length, size - length, length);
      if (bytesRead === 0) break;
      length += bytesRead;
    }
    return bytes.subarray(0, length);
  } catch (error) {
    throw error instanceof Problem ? error : fileProblem(path, error);
  } finally {
    await handle.close();
  }
}

/** Returns the error for a file of more than `most` bytes. */
export function tooLarge(path: string, most: number): Problem {
  const size = most >= 1e9 ? `${Math.floor(most / 1e9)} GB` : `${Math.floor(most / 1e6)} MB`;
  return new Problem(`${printable(path)} is larger than ${size}; name a smaller file.`);
}
