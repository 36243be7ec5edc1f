import { readFile } from "node:fs/promises";

/**
 * Lets TypeScript import a recorded turn as text: `import turn from "./sheet.tlkf"`
 * yields its file in base64. It is packed as it is. Serves both tsdown and vite,
 * as a plugin of either.
 */
export function turnInline() {
  return {
    name: "turnleaf-turn-inline",
    enforce: "pre",
    async load(id) {
      if (!id.endsWith(".tlkf")) return null;
      const base64 = (await readFile(id)).toString("base64");
      return { code: `export default ${JSON.stringify(base64)};`, moduleType: "js", map: null };
    },
  };
}
