/**
 * Imports run one way. Each part names the parts it may import from; anything
 * else, and any cycle among the modules of a Rust crate (`super::` and re-exports
 * included), fails the check. Cycles between TypeScript files, of types too, are
 * the linter's to find.
 */
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { cyclesOf, modulesOf } from "./imports/rust.mjs";

const root = join(import.meta.dirname, "..");

/** The viewer's parts, lowest first, and what each may import. A folder, or a file at the top. */
const viewer = {
  "creased_mesh.ts": [],
  "model_names.ts": [],
  "packed.ts": [],
  engine: ["creased_mesh.ts", "packed.ts"],
  sources: ["packed.ts"],
  words: [],
  models: ["creased_mesh.ts", "model_names.ts", "packed.ts"],
  key_frames: ["creased_mesh.ts", "model_names.ts"],
  book: ["engine"],
  picking: ["engine"],
  pages: ["sources"],
  stage: ["book", "engine", "sources"],
  webgl: ["creased_mesh.ts", "engine", "sources", "stage", "book"],
  canvas2d: ["book", "engine", "sources", "stage"],
  leaf_stage: ["creased_mesh.ts", "webgl", "engine", "picking", "sources"],
  leaf_models: [
    "book",
    "engine",
    "key_frames",
    "model_names.ts",
    "models",
    "sources",
    "stage",
    "webgl",
  ],
  viewer: ["book", "engine", "picking", "leaf_models", "pages", "sources", "stage"],
  "webgl_backend.ts": ["engine", "leaf_models", "viewer", "webgl"],
  "canvas2d_backend.ts": ["canvas2d", "viewer"],
  "open_viewer.ts": [
    "canvas2d_backend.ts",
    "engine",
    "sources",
    "viewer",
    "webgl",
    "webgl_backend.ts",
  ],
  input: ["book", "engine", "stage", "viewer"],
  text: ["pages", "sources"],
  sound: ["engine", "stage"],
  read_aloud: ["sources"],
  element: [
    "book",
    "engine",
    "sources",
    "words",
    "leaf_models",
    "viewer",
    "open_viewer.ts",
    "input",
    "text",
    "sound",
    "read_aloud",
  ],
  controls: ["element", "sources", "words"],
  "element.ts": ["book", "controls", "element", "engine", "sources", "text", "words", "viewer"],
  "index.ts": [
    "book",
    "element",
    "engine",
    "element.ts",
    "sources",
    "text",
    "leaf_models",
    "words",
  ],
  "links.ts": ["index.ts"],
  "standalone.ts": ["index.ts", "links.ts", "open_viewer.ts", "webgl_backend.ts"],
  // Other interfaces to the element.
  page_flip: ["index.ts", "standalone.ts"],
  react_pageflip: ["page_flip"],
  frameworks: ["index.ts"],
  // Helpers of tests.
  for_tests: [
    "controls",
    "element",
    "element.ts",
    "index.ts",
    "leaf_models",
    "open_viewer.ts",
    "sources",
    "viewer",
  ],
};

/** Packages that only these places of the viewer may import: heavy ones stay where they are used. */
const packages = {
  three: /^(webgl|leaf_stage)\//,
  "pdfjs-dist": /^sources\/pdf/,
  "foliate-js": /^sources\/epub\//,
  "@zip.js/zip.js": /^sources\/archive\//,
  dompurify: /^sources\/markup\//,
  marked: /^sources\/text\//,
};

/** The engine's modules that nothing below them may use. */
const engine = ["key_frames", "loose", "book", "trials"];

const errors = [];

function filesUnder(folder, ending) {
  return readdirSync(join(root, folder), { recursive: true })
    .map((name) => name.replaceAll("\\", "/"))
    .filter((name) => name.endsWith(ending) && !name.includes("node_modules/"));
}

function checkViewer() {
  const base = "packages/turnleaf/src";
  for (const file of filesUnder(base, ".ts")) {
    if (/\.test\.ts$|\.d\.ts$/.test(file)) continue;
    const part = file.split("/")[0];
    const text = readFileSync(join(root, base, file), "utf8");
    for (const [, target] of text.matchAll(/(?:from|import)\s*\(?\s*"([^"]+)"/g)) {
      if (target.startsWith("node:")) errors.push(`${base}/${file}: the viewer knows no Node`);
      for (const [name, place] of Object.entries(packages)) {
        if ((target === name || target.startsWith(`${name}/`)) && !place.test(file)) {
          errors.push(`${base}/${file}: ${name} is imported elsewhere alone`);
        }
      }
      if (!target.startsWith(".")) continue;
      const to = relative(base, join(base, dirname(file), target)).split("/")[0];
      if (to === part || target.endsWith(".wasm")) continue;
      if (!(part in viewer)) errors.push(`${base}/${file}: ${part} is not in the list of parts`);
      else if (!viewer[part].includes(to)) {
        errors.push(`${base}/${file}: ${part} may not import from ${to}`);
      }
    }
  }
}

/** Cycles among the viewer's parts as they are listed above. */
function checkParts() {
  const parts = new Map();
  for (const [name, uses] of Object.entries(viewer)) parts.set(name, { uses: new Set(uses) });
  for (const cycle of cyclesOf(parts)) {
    errors.push(`scripts/check_imports.mjs: a cycle of parts: ${cycle.join(", ")}`);
  }
}

function checkRust() {
  for (const crate of ["engine/src", "wasm/src", "lab/src"]) {
    const modules = modulesOf(join(root, crate));
    for (const cycle of cyclesOf(modules)) {
      const uses = cycle.flatMap((from) =>
        [...modules.get(from).uses]
          .filter((to) => cycle.includes(to))
          .map((to) => `\n  ${from || "(root)"} uses ${to || "(root)"}`),
      );
      errors.push(`${crate}: a cycle of modules:${uses.join("")}`);
    }
    if (crate === "engine/src") checkEngine(modules);
  }
}

function checkEngine(modules) {
  for (const [name, { file, uses }] of modules) {
    const from = engine.indexOf(name.split("::")[0]);
    for (const target of uses) {
      const to = engine.indexOf(target.split("::")[0]);
      if (to >= 0 && from < to) errors.push(`engine: ${name} may not use ${target}`);
    }
    const text = readFileSync(file, "utf8").split("#[cfg(test)]")[0];
    if (/\bstd::(fs|net|thread|time|env|process)\b/.test(text)) {
      errors.push(`${file}: the engine knows no file, clock, thread or network`);
    }
  }
}

function checkWalls() {
  for (const file of filesUnder("packages/cli/src", ".ts")) {
    const text = readFileSync(join(root, "packages/cli/src", file), "utf8");
    if (/\bwindow\.|\bdocument\.(querySelector|createElement|body)\b/.test(text))
      errors.push(`packages/cli/src/${file}: Node has no DOM`);
  }
}

checkViewer();
checkParts();
checkRust();
checkWalls();
for (const error of errors) console.error(error);
if (errors.length > 0) process.exit(1);
console.log("Imports run one way.");
