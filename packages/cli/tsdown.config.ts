import { defineConfig } from "tsdown";
import { changedPdfWorker } from "../turnleaf/changed_pdf_worker.js";

/** The command, with all its dependencies inside: installing it installs nothing else. */
export default defineConfig({
  entry: ["src/main.ts", "src/inspect_thread.ts"],
  platform: "node",
  target: "node20",
  format: "esm",
  dts: false,
  minify: true,
  fixedExtension: false,
  // Of all that the viewer has within it; the command has no more.
  copy: [{ from: "../turnleaf/dist/licenses.txt", to: "dist" }],
  plugins: [changedPdfWorker()],
  deps: { onlyBundle: ["image-size", "pdfjs-dist", "turnleaf"] },
});
