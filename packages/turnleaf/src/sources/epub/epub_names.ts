/** What the names of an archive's files say of an EPUB in it. */

/** An EPUB's container, in the folder that it is zipped in. */
export const containerName: RegExp = /^(?:.*\/)?META-INF\/container\.xml$/i;

/** A package. */
export const packageName: RegExp = /\.opf$/i;

const chapterName = /\.x?html?$/i;

/** Returns whether the files of an archive are an EPUB: it may be zipped in its folder, or its container may be missing. */
export function isEpub(names: readonly string[]): boolean {
  const has = (pattern: RegExp): boolean => names.some((name) => pattern.test(name));
  // Programs that sort books put a package beside the pictures of comics too.
  return has(containerName) || (has(packageName) && has(chapterName));
}
