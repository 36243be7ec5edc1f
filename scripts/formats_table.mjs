/** The table of the files that can be opened, for docs/sources.md. */
import { importTs } from "./import_ts.mjs";

/** Returns its rows of cells, the first of them headings. */
export async function formatsTable() {
  const { formats } = await importTs("sources/formats.ts");
  const code = (words) => words.map((word) => `\`${word}\``).join(", ");
  const rows = formats.flatMap(({ labels, family, endings = [], type }) =>
    family === undefined
      ? []
      : [[labels.join(", "), code(endings.map((ending) => `.${ending}`)), code([type])]],
  );
  return [
    ["format", "endings of names", "media type"],
    ...rows.sort(([a], [b]) => (a < b ? -1 : 1)),
  ];
}
