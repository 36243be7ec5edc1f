/** The table of the files that can be opened, for docs/sources.md. */
import { join } from "node:path";
import { runnerImport } from "vite";

const source = join(import.meta.dirname, "../packages/turnleaf/src/sources/formats.ts");

/** Returns its rows of cells, the first of them headings. */
export async function formatsTable() {
  const { module } = await runnerImport(source, { configFile: false, logLevel: "error" });
  const code = (words) => words.map((word) => `\`${word}\``).join(", ");
  const rows = module.formats.flatMap(({ labels, family, endings = [], type }) =>
    family === undefined
      ? []
      : [[labels.join(", "), code(endings.map((ending) => `.${ending}`)), code([type])]],
  );
  return [
    ["format", "endings of names", "media type"],
    ...rows.sort(([a], [b]) => (a < b ? -1 : 1)),
  ];
}
