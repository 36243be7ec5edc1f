import { execFile } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { publint } from "publint";
import { formatMessage } from "publint/utils";
import { expect, test } from "vitest";

test("the built package is imported on a server, where it does nothing", async () => {
  const script = `const turnleaf = await import("turnleaf");
    console.log(typeof turnleaf.TurnleafBook, typeof globalThis.customElements);`;
  // In a process of its own: other tests may define a DOM.
  const { stdout, stderr } = await promisify(execFile)(
    process.execPath,
    ["--input-type=module", "--eval", script],
    { cwd: fileURLToPath(new URL("..", import.meta.url)) },
  );
  expect([stdout.trim(), stderr]).toEqual(["function undefined", ""]);
});

test.each([
  ["index", "declare class TurnleafBook"],
  ["models", "declare class"],
  ["keyframes", "declare"],
  ["leaf-stage", "declare class LeafStage"],
  ["links", "declare function openLinks"],
])("the public types of %s need none of another package", (name, declared) => {
  const types = readFileSync(new URL(`../../turnleaf/dist/${name}.d.ts`, import.meta.url), "utf8");
  expect(types).toContain(declared);
  expect(types.match(/from "[^"]+"|import\("[^"]+"\)/g)).toBeNull();
});

test.each([
  ["page-flip", ["turnleaf"]],
  ["react-pageflip", ["react", "turnleaf/page-flip"]],
  ["react", ["react", "turnleaf"]],
  ["vue", ["turnleaf", "vue"]],
  ["svelte/index", ["./book_props.js", "svelte", "svelte/elements", "turnleaf"]],
])("the public types of %s need those of %j alone", (name, others) => {
  const types = readFileSync(new URL(`../../turnleaf/dist/${name}.d.ts`, import.meta.url), "utf8");
  const named = [...types.matchAll(/from "([^"]+)"/g)].map(([, other]) => other);
  expect([...new Set(named)].sort()).toEqual(others);
});

test("the other entries are imported on a server too, with the list of what they offer", async () => {
  const script = `for (const name of ["page-flip", "react-pageflip", "react", "vue", "links", "standalone"])
    console.log(Object.keys(await import("turnleaf/" + name)).sort().join());`;
  const { stdout, stderr } = await promisify(execFile)(
    process.execPath,
    ["--input-type=module", "--eval", script],
    { cwd: fileURLToPath(new URL("..", import.meta.url)) },
  );
  const offered = [
    "PageFlip",
    "HTMLFlipBook,default",
    "TurnleafBook",
    "TurnleafBook",
    "openLinks",
    "BookError,TurnleafBook,addLanguage,openSource",
  ];
  expect([stdout.trim(), stderr]).toEqual([offered.join("\n"), ""]);
});

test.each(["react", "react-pageflip"])("React frameworks see that %s is for browsers", (name) => {
  expect(rootFile(`packages/turnleaf/dist/${name}.js`).startsWith('"use client";')).toBe(true);
});

test.each(["turnleaf", "cli"])("publint finds no fault in packages/%s", async (folder) => {
  const pkgDir = fileURLToPath(new URL(`../../${folder}`, import.meta.url));
  const { messages, pkg } = await publint({ pkgDir, strict: true });
  expect(messages.map((message) => formatMessage(message, pkg, { color: false }))).toEqual([]);
});

const rootFile = (path: string): string =>
  readFileSync(new URL(`../../../${path}`, import.meta.url), "utf8");

test.each(["turnleaf", "cli"])("what npm packs of packages/%s", async (folder) => {
  const about = JSON.parse(rootFile(`packages/${folder}/package.json`));
  expect(about).toMatchObject({ license: "MIT", author: "The Turnleaf authors" });
  expect(about.keywords.length).toBeGreaterThan(4);
  // Written only by scripts/set_repository.mjs, once there is one.
  expect(about.repository?.url).toBe(JSON.parse(rootFile("package.json")).repository?.url);
  const [, oldest] = /Node (\d+\.\d+) or later/.exec(rootFile("README.md")) ?? [];
  expect(about.engines.node).toBe(`>=${oldest}`);
  expect(rootFile(`packages/${folder}/LICENSE`)).toBe(rootFile("LICENSE"));

  const { stdout } = await promisify(execFile)(
    "npm",
    ["pack", "--dry-run", "--json", "--ignore-scripts"],
    { cwd: fileURLToPath(new URL(`../../${folder}`, import.meta.url)) },
  );
  const [{ files }] = JSON.parse(stdout) as [{ files: { path: string; size: number }[] }];
  const paths = files.map(({ path }) => path);
  for (const path of ["LICENSE", "README.md", "package.json"]) expect(paths).toContain(path);
  expect(
    paths.filter((path) => !/^(dist\/|LICENSE$|README\.md$|package\.json$)/.test(path)),
  ).toEqual([]);
  // What builds leave for themselves.
  expect(paths.filter((path) => /(^|\/)\./.test(path))).toEqual([]);
  const sizeOf = (ofWhat: RegExp): number =>
    files.reduce((sum, { path, size }) => sum + (ofWhat.test(path) ? size : 0), 0);
  let own = 0;
  for (const path of paths.filter((path) => path.endsWith(".map"))) {
    const { sources, sourcesContent } = JSON.parse(rootFile(`packages/${folder}/${path}`));
    expect(sources.every((source: string) => source.includes("/node_modules/"))).toBe(false);
    for (const [k, source] of sources.entries()) {
      if (/node_modules|\.wasm$/.test(source)) expect(sourcesContent[k]).toBeNull();
      else own += Buffer.byteLength(sourcesContent[k] ?? "");
    }
  }
  // Maps hold the package's sources, and where what is built of them is, which is less.
  expect(sizeOf(/\.map$/)).toBeLessThanOrEqual(2 * own);
});

test("the licences of all that is within the built files are in both packages", () => {
  const built = new URL("../../turnleaf/dist/", import.meta.url);
  const sources = readdirSync(built)
    .filter((name) => name.endsWith(".js.map"))
    .flatMap((name) => JSON.parse(readFileSync(new URL(name, built), "utf8")).sources as string[]);
  const named = sources.flatMap((source) => {
    return /.*node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(source)?.[1] ?? [];
  });
  // Their maps are left out.
  const packages = [...new Set([...named, "pdfjs-dist", "three"])].sort();
  for (const name of ["@zip.js/zip.js", "foliate-js", "marked"]) expect(packages).toContain(name);
  for (const folder of ["turnleaf", "cli"]) {
    const notices = rootFile(`packages/${folder}/dist/licenses.txt`);
    for (const name of packages) {
      expect(notices, name).toContain(rootFile(`node_modules/${name}/LICENSE`).trim());
    }
    // Within a worker, which has no map.
    for (const name of ["utif2", "utif2/node_modules/pako"]) {
      expect(notices, name).toContain(rootFile(`node_modules/${name}/LICENSE`).trim());
    }
  }
  expect(rootFile("packages/turnleaf/dist/license-unpacker.txt")).toContain("libarchive");
});
