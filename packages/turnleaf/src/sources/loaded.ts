/** Parts of the viewer that are loaded when there is a use for them. */

import { BookError } from "./page_source.ts";

/** What a lazy import resolves to. Rejects with a `BookError` where it fails: the network, or a server without the file. */
export async function loaded<Part>(part: Promise<Part>): Promise<Part> {
  try {
    return await part;
  } catch {
    throw new BookError("A part of the reader could not be loaded; load the web page again.");
  }
}
