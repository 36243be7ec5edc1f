/** Where an EPUB's package is in its archive. */

import type { Archive } from "../archive/archive.ts";
import { FilePaths } from "../archive/file_paths.ts";
import { decodeText } from "../decode_text.ts";
import { limits } from "../limits.ts";
import { readMarkup } from "../markup/read_markup.ts";
import { containerName, packageName } from "./epub_names.ts";

/** Returns the folder of an archive in which an EPUB's files are, with "/" at its end; "" for all of it. */
export function folderOfEpub(names: readonly string[]): string {
  return shortest(names, containerName)?.replace(/META-INF\/container\.xml$/i, "") ?? "";
}

/**
 * Returns the name of an EPUB's package: that which its container names, or else the uppermost that it
 * has. Resolves to null if there is none.
 */
export async function packageOf(archive: Archive): Promise<string | null> {
  const { names } = archive;
  const paths = new FilePaths(names);
  const path = shortest(names, containerName);
  const bytes = path === undefined ? null : await archive.read(path, limits.markupBytes);
  const document = bytes && (await readMarkup(await decodeText(bytes), "application/xml")).document;
  for (const root of document?.getElementsByTagNameNS("*", "rootfile") ?? []) {
    const type = root.getAttribute("media-type") ?? "";
    const named = paths.resolve(root.getAttribute("full-path") ?? "", "");
    if (named !== null && /oebps-package/i.test(type)) return named;
  }
  return shortest(names, packageName) ?? null;
}

/** Returns the uppermost of the names that a pattern finds, of several the first. */
function shortest(names: readonly string[], pattern: RegExp): string | undefined {
  const depth = (name: string): number => name.split("/").length;
  return names.filter((name) => pattern.test(name)).sort((a, b) => depth(a) - depth(b))[0];
}
