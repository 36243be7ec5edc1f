/** Reads all files of an archive that say what a comic it is. */

import type { Archive } from "../archive/archive.ts";
import { FilePaths } from "../archive/file_paths.ts";
import { decodeText } from "../decode_text.ts";
import { readAcbf } from "./acbf.ts";
import { readComet } from "./comet.ts";
import { readComicBookInfo } from "./comic_book_info.ts";
import { readComicInfo } from "./comic_info.ts";
import { type ComicMetadata, joinedMetadata } from "./comic_metadata.ts";
import { readMetronInfo } from "./metron_info.ts";

/** Files, and what reads each: one that says more of a comic's pages first. */
const files: readonly (readonly [name: RegExp, read: (xml: string) => Promise<ComicMetadata>])[] = [
  [/(^|\/)ComicInfo\.xml$/i, readComicInfo],
  [/(^|\/)MetronInfo\.xml$/i, readMetronInfo],
  [/[^/]\.acbf$/i, readAcbf],
  [/(^|\/)CoMet\.xml$/i, readComet],
];

/** Bytes of such a file: some 100 for each page. */
const mostBytes = 4_000_000;

/**
 * Returns what the files of an archive say of the comic in it, with the paths of its images. A file is about the
 * images in its folder: where others are elsewhere, as those of several volumes are, it is left out.
 *
 * @param images the paths of all images
 * @param damaged called with each that cannot be read
 */
export async function statedMetadata(
  archive: Archive,
  images: readonly string[],
  damaged: (path: string) => void,
): Promise<ComicMetadata> {
  const paths = new FilePaths(archive.names);
  const folder = commonFolder(images);
  const found: ComicMetadata[] = [];
  for (const [name, read] of files) {
    const path = archive.names.find((one) => name.test(one) && folder.startsWith(folderOf(one)));
    if (path === undefined) continue;
    const resolved = (address: string): string => paths.resolve(address, path) ?? "";
    try {
      const said = await read(await decodeText(await archive.read(path, mostBytes)));
      const order = said.order.map(resolved).filter((one) => one !== "");
      found.push({ ...said, cover: resolved(said.cover), order });
    } catch {
      // It is about the pages; without it they are still there.
      damaged(path);
    }
  }
  return joinedMetadata([...found, readComicBookInfo(archive.comment ?? "")]);
}

const folderOf = (path: string): string => path.slice(0, path.lastIndexOf("/") + 1);

/** Returns the innermost folder in which all files are. */
function commonFolder(paths: readonly string[]): string {
  let common = folderOf(paths[0] ?? "");
  for (const path of paths) {
    while (!path.startsWith(common)) common = folderOf(common.slice(0, -1));
  }
  return common;
}
