/**
 * Which TypeScript and JavaScript file may import which: `npx depcruise`, in `make check`. Types
 * count as values do, `typeof import("…")` too.
 */

/**
 * The viewer's parts, lowest first, and what each may import: folders, or files at the top. A part
 * names only parts above it in this list, so that no parts form a cycle.
 */
const parts = {
  "paper_mesh.ts": [],
  "drawn_record.ts": ["paper_mesh.ts"],
  "element_plane.ts": [],
  "metres.ts": [],
  "model_names.ts": [],
  "packed.ts": [],
  "stocks.ts": [],
  "themes.ts": [],
  engine: ["paper_mesh.ts", "drawn_record.ts", "packed.ts", "stocks.ts"],
  sources: ["element_plane.ts", "metres.ts", "packed.ts", "themes.ts"],
  words: [],
  models: ["paper_mesh.ts", "drawn_record.ts", "model_names.ts", "packed.ts", "stocks.ts"],
  key_frames: ["paper_mesh.ts", "model_names.ts"],
  book: ["engine", "stocks.ts"],
  picking: ["engine"],
  pages: ["sources", "themes.ts"],
  stage: ["book", "engine", "sources", "themes.ts"],
  webgl: ["paper_mesh.ts", "engine", "sources", "stage", "book", "themes.ts"],
  canvas2d: ["book", "engine", "sources", "stage", "themes.ts"],
  leaf_stage: ["paper_mesh.ts", "webgl", "engine", "picking", "sources"],
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
  "attributes.ts": ["engine", "leaf_models", "themes.ts"],
  viewer: ["book", "engine", "picking", "leaf_models", "pages", "sources", "stage", "themes.ts"],
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
  input: ["book", "element_plane.ts", "engine", "stage", "viewer"],
  text: ["pages", "sources"],
  sound: ["engine", "stage", "stocks.ts"],
  read_aloud: ["sources"],
  element: [
    "attributes.ts",
    "book",
    "element_plane.ts",
    "metres.ts",
    "themes.ts",
    "engine",
    "sources",
    "stage",
    "words",
    "leaf_models",
    "viewer",
    "open_viewer.ts",
    "input",
    "text",
    "sound",
    "read_aloud",
  ],
  controls: ["attributes.ts", "element", "sources", "themes.ts", "words"],
  "element.ts": [
    "attributes.ts",
    "book",
    "controls",
    "element",
    "engine",
    "sources",
    "text",
    "themes.ts",
    "words",
    "viewer",
  ],
  "index.ts": [
    "attributes.ts",
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
  frameworks: ["attributes.ts", "index.ts"],
  // Helpers of tests.
  for_tests: [
    "controls",
    "element",
    "element.ts",
    "frameworks",
    "index.ts",
    "leaf_models",
    "open_viewer.ts",
    "page_flip",
    "sources",
    "stage",
    "viewer",
    "webgl",
  ],
};

/** Packages that only these places of the viewer may import: heavy ones stay where they are used. */
const packagePlaces = {
  three: "(webgl|leaf_stage)/",
  "pdfjs-dist": "sources/(pdf|rare_images/)",
  utif2: "sources/rare_images/",
  "foliate-js": "sources/epub/",
  "@zip.js/zip.js": "sources/archive/",
  dompurify: "sources/markup/",
  marked: "sources/text/",
};

const source = "^packages/turnleaf/src/";
const test = String.raw`\.test\.ts$|\.d\.ts$`;

/** Returns the pattern of a part's files. */
const filesOf = (part) =>
  source + (part.endsWith(".ts") ? `${part.replace(".", "[.]")}$` : `${part}/`);

const names = Object.keys(parts);
const partRules = Object.entries(parts).map(([part, uses], index) => {
  const higher = uses.find((use) => !names.slice(0, index).includes(use));
  if (higher) throw new Error(`${part} names ${higher}, which is not listed above it.`);
  return {
    name: `imports of ${part}`,
    comment: `It may import from ${uses.join(", ") || "no other part"}.`,
    severity: "error",
    from: { path: filesOf(part), pathNot: test },
    to: { path: source, pathNot: [part, ...uses].map(filesOf) },
  };
});

const packageRules = Object.entries(packagePlaces).map(([name, place]) => ({
  name: `imports of ${name}`,
  comment: `Only ${place} imports it.`,
  severity: "error",
  from: { path: source, pathNot: [test, source + place] },
  to: { path: `(^|[/:])${name}(/|$)` },
}));

export default {
  forbidden: [
    {
      name: "no cycle",
      comment: "Interfaces are written down where they are used, not where they are implemented.",
      severity: "error",
      from: {},
      to: { circular: true },
    },
    {
      name: "every part is listed",
      comment: "A part is listed in .dependency-cruiser.mjs, with what it may import.",
      severity: "error",
      from: { path: source, pathNot: [test, ...names.map(filesOf)] },
      to: {},
    },
    {
      name: "no Node in the viewer",
      severity: "error",
      from: { path: source, pathNot: test },
      to: { dependencyTypes: ["core"] },
    },
    {
      name: "the command uses the built viewer",
      comment:
        "Of its sources it reads the tables of attributes, formats and stocks alone, which use nothing of a browser.",
      severity: "error",
      from: { path: "^packages/cli/(src|app)/", pathNot: test },
      to: { path: source, pathNot: `${source}(attributes|sources/(unread_)?formats|stocks)[.]ts$` },
    },
    ...partRules,
    ...packageRules,
  ],
  options: {
    tsPreCompilationDeps: true,
    detectJSDocImports: true,
    doNotFollow: { path: "node_modules" },
    exclude: { path: "^(packages/[^/]+/dist|target|corpora)/" },
    enhancedResolveOptions: {
      exportsFields: ["exports"],
      conditionNames: ["import", "types", "default"],
    },
  },
};
