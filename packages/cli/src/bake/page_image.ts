import { imageType } from "../../../turnleaf/src/sources/formats.ts";
import { Problem, printable } from "../problem.ts";
import { readRegular } from "../regular_file.ts";

/** The picture of a page, as in its file. */
export interface PageImage {
  readonly type: "image/png" | "image/jpeg";
  readonly bytes: Uint8Array;
}

/** Maximum of bytes of a picture, which is embedded whole in the output. */
const mostBytes = 100_000_000;

/**
 * Reads a picture for a side; null if none is named.
 *
 * @throws Problem if it cannot be read, is larger than 100 MB, or is neither
 * PNG nor JPEG
 */
export async function readPageImage(path: string | undefined): Promise<PageImage | null> {
  if (path === undefined) return null;
  const bytes = await readRegular(path, mostBytes);
  const type = imageType(bytes);
  if (type === "image/png" || type === "image/jpeg") return { type, bytes };
  throw new Problem(`${printable(path)} is neither PNG nor JPEG; glTF takes no other picture.`);
}
