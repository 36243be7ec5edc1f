/** What systems and shared drives leave in archives beside their files: folders and hidden files. */

const litter =
  /^(\.|__MACOSX$|@eaDir$|@__thumb$|#recycle$|\$RECYCLE\.BIN$|lost\+found$|System Volume Information$)/i;

/** Returns whether a path in an archive is of a file that a system or a shared drive left there. */
export function isLitter(path: string): boolean {
  return path.split("/").some((step) => litter.test(step));
}
