/** What a book's folder says of itself, so that it need not be done again. */

import { join } from "node:path";
import { readRegular } from "../regular_file.ts";
import type { GivenDetails } from "./catalogue.ts";

/** What shelf, search and merging need of a book. */
export interface BookDetails extends GivenDetails {
  readonly title: string;
  readonly language: string;
  readonly direction: "ltr" | "rtl";
  readonly pageCount: number;
  /** Address relative to the book's folder, and pixels, of a picture of the first page. */
  readonly cover: { readonly src: string; readonly width: number; readonly height: number } | null;
  /** Pages that could not be drawn. */
  readonly failures: readonly { readonly page: number; readonly message: string }[];
}

/** `record.json`, written when all of a book is. */
export interface BookRecord {
  /** Hash of all that its pictures and texts are made of. */
  readonly drawn: string;
  /** Hash of all that its HTML and manifests are made of. */
  readonly written: string;
  readonly details: BookDetails;
}

/** Maximum of bytes of one. */
const longest = 16_000_000;

/** Returns the record in a book's folder; null if there is none that can be used. */
export async function readRecord(folder: string): Promise<BookRecord | null> {
  const record = (await readJson(join(folder, "record.json"))) as BookRecord | null;
  const isRecord =
    typeof record?.drawn === "string" &&
    typeof record.written === "string" &&
    typeof record.details?.title === "string" &&
    Number.isInteger(record.details.pageCount) &&
    Array.isArray(record.details.failures);
  return isRecord ? record : null;
}

/** Returns the value in a JSON file; null if it cannot be read. */
export async function readJson(file: string, most = longest): Promise<unknown> {
  try {
    return JSON.parse((await readRegular(file, most)).toString());
  } catch {
    return null;
  }
}
