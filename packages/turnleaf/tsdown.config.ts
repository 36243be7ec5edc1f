import { defineConfig } from "tsdown";
import { packedFiles } from "./packed_files.js";
import { wasmInline } from "./wasm_inline.js";

export default defineConfig({
  entry: ["src/index.ts"],
  platform: "browser",
  target: "es2022",
  format: "esm",
  dts: true,
  minify: true,
  sourcemap: true,
  plugins: [wasmInline(), packedFiles()],
  deps: { neverBundle: ["three"], onlyBundle: ["pdfjs-dist"] },
});
