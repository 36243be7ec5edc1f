import { defineConfig } from "tsdown";
import { bundledLicenses } from "./bundled_licenses.js";
import { changedPdfWorker } from "./changed_pdf_worker.js";
import { packedFiles } from "./packed_files.js";
import { slimMaps } from "./slim_maps.js";
import { slimShaders } from "./slim_shaders.js";
import { copyMark, threeInside } from "./three_inside.js";
import { turnInline } from "./turn_inline.js";
import { wasmInline } from "./wasm_inline.js";
import { workerInline } from "./worker_inline.js";

const common = {
  platform: "browser",
  target: "es2022",
  format: "esm",
  // What is for classes of the package alone is left out, and with it the types behind it.
  dts: { compilerOptions: { stripInternal: true } },
  minify: true,
  sourcemap: true,
} as const;

const viewer = defineConfig({
  ...common,
  entry: ["src/index.ts", "src/links.ts", "src/standalone.ts"],
  // The types of standalone are those of index.
  dts: { ...common.dts, entry: ["src/index.ts", "src/links.ts"] },
  plugins: [
    threeInside(/\/src\/standalone\.ts$/),
    wasmInline(),
    turnInline(),
    packedFiles(),
    workerInline(),
    slimShaders(),
    slimMaps(),
    bundledLicenses(),
  ],
  copy: [
    // For pages that serve the engine themselves.
    { from: "src/engine/turnleaf.wasm", to: "dist" },
    {
      from: "src/sources/archive/unpacker/LICENSES.txt",
      to: "dist",
      rename: "license-unpacker.txt",
    },
    {
      from: "src/sources/typeset/hyphenation/LICENSES.txt",
      to: "dist",
      rename: "license-hyphenation.txt",
    },
  ],
  deps: {
    // By threeInside, which leaves it out of all but standalone.
    alwaysBundle: ["three"],
    onlyBundle: [
      "three",
      "pdfjs-dist",
      "image-size",
      "@zip.js/zip.js",
      "dompurify",
      "foliate-js",
      "marked",
      "htmlparser2",
      "entities",
      "chardet",
      "fzstd",
      "hyphen",
    ],
  },
  outputOptions: {
    // A name of its own for what standalone alone loads, which is in the build twice.
    chunkFileNames: ({ moduleIds }) =>
      moduleIds.some((id) => id.endsWith(copyMark))
        ? "standalone_[name]-[hash].js"
        : "[name]-[hash].js",
    codeSplitting: {
      // What every page loads is one file, which packs better than many. But for
      // the entries: a file with an effect has the one name that package.json
      // says has one.
      groups: [
        {
          name: "viewer",
          tags: ["$initial"],
          test: /\/src\/(?!(index|links|standalone)\.)(?!.*\.d\.ts)/,
        },
        // What opens any book is one file too, for a file that is imported by an imported one is
        // asked for later.
        {
          name: "open",
          test: /\/src\/sources\/(archive\/tar_header|epub\/epub_names|open|open_file|formats|book_file|fetch_bytes|handed_out|manifest\w*|page_list|page_order|shared_tasks|trusted_script)\.ts/,
        },
      ],
    },
  },
});

/** An entry of its own, built apart: it has no file in common with the viewer, which has other machine code. */
const models = defineConfig({
  ...common,
  entry: { models: "src/models/models.ts" },
  clean: false,
  plugins: [wasmInline(), slimMaps()],
});

/** Another: a player of recorded turns needs neither the viewer nor the engine. */
const keyFrames = defineConfig({
  ...common,
  entry: { keyframes: "src/key_frames/key_frames.ts" },
  clean: false,
});

/** Another: it draws one leaf, with the same code for paper as the viewer. */
const leafStage = defineConfig({
  ...common,
  entry: { "leaf-stage": "src/leaf_stage/leaf_stage.ts" },
  clean: false,
  plugins: [slimShaders()],
  deps: { neverBundle: ["three"] },
});

/** Imports other entries by their public names, in place of copies of them. */
const entriesByName = {
  name: "turnleaf-entries-by-name",
  resolveId(id: string, importer?: string) {
    if (importer && id === "../index.ts") return { id: "turnleaf", external: true };
    if (id === "../page_flip/index.ts") return { id: "turnleaf/page-flip", external: true };
    // In a script tag, by the address of the script.
    if (id === "../standalone.ts") return { id: "./standalone.js", external: true };
    return null;
  },
};

/** Others: they show a book by the viewer, behind other interfaces. */
const pageFlip = defineConfig({
  ...common,
  entry: { "page-flip": "src/page_flip/index.ts" },
  clean: false,
  plugins: [entriesByName],
  deps: { neverBundle: ["turnleaf"] },
});

/** The global of page-flip, for a script tag. Its map would be that of page-flip.js. */
const pageFlipGlobal = defineConfig({
  ...common,
  sourcemap: false,
  format: "iife",
  entry: { "page-flip.browser": "src/page_flip/global.ts" },
  clean: false,
  dts: false,
  plugins: [entriesByName],
  outputOptions: { entryFileNames: "[name].js" },
});

const reactPageFlip = defineConfig({
  ...common,
  entry: { "react-pageflip": "src/react_pageflip/index.ts" },
  clean: false,
  plugins: [entriesByName],
  deps: { neverBundle: ["react", "react-dom", "turnleaf/page-flip"] },
  banner: { js: '"use client";' },
});

/** The element as a component of a framework, which imports the element by its name. */
const react = defineConfig({
  ...common,
  entry: { react: "src/frameworks/react.ts" },
  clean: false,
  plugins: [entriesByName],
  deps: { neverBundle: ["react", "turnleaf"] },
  banner: { js: '"use client";' },
});

const vue = defineConfig({
  ...common,
  entry: { vue: "src/frameworks/vue.ts" },
  clean: false,
  plugins: [entriesByName],
  deps: { neverBundle: ["vue", "turnleaf"] },
});

/** Svelte's is compiled where it is used: its version has to be that of the rest of the page. */
const svelte = defineConfig({
  ...common,
  entry: { book_props: "src/frameworks/book_props.ts" },
  outDir: "dist/svelte",
  plugins: [entriesByName],
  deps: { neverBundle: ["turnleaf"] },
  copy: ["TurnleafBook.svelte", "index.js", "index.d.ts"].map((name) => {
    return { from: `src/frameworks/svelte/${name}`, to: "dist/svelte" };
  }),
});

/** One file, for sites that serve it themselves: pdf.js's workers. */
const pdfWorker = defineConfig({
  ...common,
  entry: { "pdf-worker": "pdf_worker.js" },
  clean: false,
  dts: false,
  sourcemap: false,
  plugins: [changedPdfWorker()],
  deps: { onlyBundle: ["pdfjs-dist"] },
  outputOptions: { codeSplitting: false },
});

export default [
  viewer,
  models,
  keyFrames,
  leafStage,
  pageFlip,
  pageFlipGlobal,
  reactPageFlip,
  react,
  vue,
  svelte,
  pdfWorker,
];
