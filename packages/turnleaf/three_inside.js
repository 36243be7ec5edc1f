import { readFile } from "node:fs/promises";

/** Ends the ids of modules that are in the build twice, in the copies with three.js inside. */
export const copyMark = "?three-inside";

/**
 * What draws with three.js, what leads to it, and what nothing else imports (shared, that would be
 * files of its own, which books without three.js inside load too). All else is in it once.
 */
const drawing = new RegExp(
  `/src/(${[
    "webgl/[^/]+",
    "webgl_backend",
    "engine/wasm_book",
    "leaf_models/(leaf_models|model_choice|photographs|photograph_row)",
  ].join("|")})[.]ts$`,
);

/** Free of three.js, and of use before it is loaded. */
const shared = /\/src\/webgl\/context\.ts$/;

/**
 * Gives one entry three.js inside, while the others of the same build leave it to be found by its
 * name: what draws is copied for that entry, and the rest is shared. So a file for a script tag costs
 * the package three.js and the code that draws, and no second viewer.
 *
 * @param {RegExp} entry the module whose imports have three.js inside
 * @returns {import("rolldown").Plugin}
 */
export function threeInside(entry) {
  return {
    name: "turnleaf-three-inside",
    async resolveId(id, importer, options) {
      const isInside = importer?.endsWith(copyMark);
      if (id === "three" && !isInside) return { id, external: true };
      if (!importer || !(isInside || entry.test(importer))) return null;
      const from = importer.replace(copyMark, "");
      const resolved = await this.resolve(id, from, { ...options, skipSelf: true });
      if (!resolved || !drawing.test(resolved.id) || shared.test(resolved.id)) return resolved;
      return { ...resolved, id: resolved.id + copyMark };
    },
    async load(id) {
      if (!id.endsWith(copyMark)) return null;
      return { code: await readFile(id.slice(0, -copyMark.length), "utf8"), moduleType: "ts" };
    },
  };
}
