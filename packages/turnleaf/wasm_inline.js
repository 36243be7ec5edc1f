import { readFile } from "node:fs/promises";
import { gzipSync } from "node:zlib";

/**
 * Lets TypeScript import a WASM as text: `import code from "./turnleaf.wasm"` yields gzip
 * in base64, which src/packed.ts unpacks. Inlined, so that a bundler
 * has no file to copy and no fetch to configure; compressed, as base64 of the bare file
 * is a quarter larger once a server compresses it. Serves both tsdown and vite, whose
 * plugin of either.
 */
export function wasmInline() {
  return {
    name: "turnleaf-wasm-inline",
    enforce: "pre",
    async load(id) {
      const file = id.split("?")[0];
      if (!file.endsWith(".wasm")) return null;
      const base64 = gzipSync(await readFile(file), { level: 9 }).toString("base64");
      return { code: `export default ${JSON.stringify(base64)};`, moduleType: "js", map: null };
    },
  };
}
