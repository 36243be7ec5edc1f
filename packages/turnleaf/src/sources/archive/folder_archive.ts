import type { Archive } from "./archive.ts";

/**
 * Returns the files in a folder of an archive as an archive of their own.
 *
 * @param folder its path with "/" at the end; "" for the whole archive
 */
export function folderOf(archive: Archive, folder: string): Archive {
  if (folder === "") return archive;
  const inside = archive.names.filter((name) => name.startsWith(folder));
  return {
    names: inside.map((name) => name.slice(folder.length)),
    size: (name) => archive.size(folder + name),
    read: (name, most) => archive.read(folder + name, most),
    readStart: (name, length) => archive.readStart(folder + name, length),
    close: () => archive.close(),
  };
}
