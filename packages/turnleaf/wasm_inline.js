import { readFile } from "node:fs/promises";
import { packCode } from "./pack_code.js";

/**
 * Lets TypeScript import the engine's machine code as text: `import code from
 * "./turnleaf.wasm"` yields it packed, in base64. Inlined, so that whoever bundles the
 * package has no file to copy and no fetch to configure; packed, as what a page
 * loads is counted. Serves both tsdown and vite, whose plugins share this shape.
 */
export function wasmInline() {
  return {
    name: "turnleaf-wasm-inline",
    enforce: "pre",
    async load(id) {
      const file = id.split("?")[0];
      if (!file.endsWith(".wasm")) return null;
      const base64 = Buffer.from(await packCode(await readFile(file))).toString("base64");
      return { code: `export default ${JSON.stringify(base64)};`, moduleType: "js", map: null };
    },
  };
}
