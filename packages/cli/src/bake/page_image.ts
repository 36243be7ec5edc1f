import { readFile } from "node:fs/promises";
import { imageType } from "../image_types.ts";
import { fileProblem, Problem, printable } from "../problem.ts";

/** The picture of a page, as its file is. */
export interface PageImage {
  readonly type: "image/png" | "image/jpeg";
  readonly bytes: Uint8Array;
}

/**
 * Reads a picture for a side; null where none is named.
 * @throws Problem where it cannot be read, or is neither PNG nor JPEG
 */
export async function readPageImage(path: string | undefined): Promise<PageImage | null> {
  if (path === undefined) return null;
  const bytes = await readFile(path).catch((error: unknown) => {
    throw fileProblem(path, error);
  });
  const type = imageType(bytes.toString("latin1", 0, 16));
  if (type === "image/png" || type === "image/jpeg") return { type, bytes };
  throw new Problem(`${printable(path)} is neither PNG nor JPEG; glTF takes no other picture.`);
}
