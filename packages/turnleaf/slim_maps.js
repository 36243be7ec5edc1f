import { copyMark } from "./three_inside.js";

/** Source maps of what is this package's own: no map of another's files, and no machine code written out in one. */

/**
 * Drops the maps of files that come whole from other packages, which are a third of all that is built, or are
 * copies; and what is in others' sources and in machine code from the maps that stay.
 *
 * @returns {import("rolldown").Plugin}
 */
export function slimMaps() {
  return {
    name: "turnleaf-slim-maps",
    generateBundle(_, bundle) {
      for (const [name, file] of Object.entries(bundle)) {
        if (file.type !== "asset" || !name.endsWith(".map")) continue;
        const map = JSON.parse(String(file.source));
        if (map.sources.every(isOthers)) {
          delete bundle[name];
          const chunk = bundle[name.slice(0, -".map".length)];
          if (chunk?.type === "chunk") {
            chunk.code = chunk.code.replace(/\n?\/\/# sourceMappingURL=.*\s*$/, "\n");
          }
        } else {
          map.sourcesContent = map.sources.map((source, k) =>
            isOthers(source) || !/\.[jt]s$/.test(source) ? null : map.sourcesContent[k],
          );
          file.source = JSON.stringify(map);
        }
      }
    },
  };
}

/** Of another package, or a copy of what has a map under its own name. */
const isOthers = (source) =>
  source.includes("/node_modules/") || source.startsWith("\0") || source.endsWith(copyMark);
