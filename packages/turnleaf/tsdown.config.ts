import { defineConfig } from "tsdown";
import { packedFiles } from "./packed_files.js";
import { shortTexts } from "./short_texts.js";
import { wasmInline } from "./wasm_inline.js";

export default defineConfig({
  entry: ["src/index.ts"],
  platform: "browser",
  target: "es2022",
  format: "esm",
  dts: true,
  minify: true,
  sourcemap: true,
  plugins: [wasmInline(), packedFiles(), shortTexts()],
  deps: { neverBundle: ["three"], onlyBundle: ["pdfjs-dist"] },
  outputOptions: {
    codeSplitting: {
      // What every page loads is one file, which packs better than many. But for
      // the definition of the element: a file with an effect has the one name
      // that package.json says has one.
      groups: [{ name: "viewer", tags: ["$initial"], test: /\/src\/(?!index\.)(?!.*\.d\.ts)/ }],
    },
  },
});
