import { defineConfig } from "tsdown";
import { wasmInline } from "./wasm_inline.js";

export default defineConfig({
  entry: ["src/index.ts"],
  platform: "browser",
  target: "es2022",
  format: "esm",
  dts: true,
  minify: true,
  sourcemap: true,
  plugins: [wasmInline()],
  deps: { neverBundle: ["three", /^pdfjs-dist/] },
});
