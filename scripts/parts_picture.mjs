/**
 * A picture of the viewer's and the engine's parts and of the imports among them, as a
 * Mermaid graph: an arrow runs from a part to one that it imports, and is left out where
 * another way through the graph leads there. Thick arrows are those of a cycle.
 *
 *   node scripts/parts_picture.mjs            writes the graphs into docs/architecture.md
 *   node scripts/parts_picture.mjs --check    fails if they are not those of the code
 *   node scripts/parts_picture.mjs --of DIR   prints those of another checkout
 */
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { cruise } from "dependency-cruiser";
import rules from "../.dependency-cruiser.mjs";
import { modulesOf } from "./imports/rust.mjs";

const root = join(import.meta.dirname, "..");

/** Parts of the viewer, folders and files at the top, with the parts that each imports. */
async function viewerParts(checkout) {
  const source = "packages/turnleaf/src/";
  const isLeftOut = String.raw`(\.test|\.d)\.ts$|/for_tests/`;
  const { output } = await cruise([source], {
    ...rules.options,
    baseDir: resolve(checkout),
    includeOnly: `^${source}`,
    exclude: isLeftOut,
  });
  const partOf = (file) => file.slice(source.length).split("/")[0];
  const parts = new Map();
  for (const { source: file, dependencies } of output.modules) {
    const part = partOf(file);
    const uses = parts.get(part) ?? new Set();
    parts.set(part, uses);
    for (const { resolved } of dependencies)
      if (partOf(resolved) !== part) uses.add(partOf(resolved));
  }
  return parts;
}

/** The engine's modules at the top of its crate, with the modules that each uses. */
function engineParts(checkout) {
  const parts = new Map();
  for (const [module, { uses }] of modulesOf(join(checkout, "engine/src"))) {
    const part = module.split("::")[0];
    if (part === "" || part === "trials") continue;
    const own = parts.get(part) ?? new Set();
    parts.set(part, own);
    for (const to of uses) {
      const other = to.split("::")[0];
      if (other !== part && other !== "") own.add(other);
    }
  }
  return parts;
}

/** The parts that can be reached from one, not by way of `skipped`'s own arrow. */
function reached(parts, from, skipped) {
  const seen = new Set();
  const next = [...(parts.get(from) ?? [])].filter((to) => to !== skipped);
  for (const part of next) {
    if (seen.has(part)) continue;
    seen.add(part);
    next.push(...(parts.get(part) ?? []));
  }
  return seen;
}

function graph(parts) {
  const id = (part) => part.replace(/\W/g, "_");
  const lines = ["graph TD"];
  for (const [part, uses] of [...parts].sort(([a], [b]) => (a < b ? -1 : 1))) {
    lines.push(`  ${id(part)}["${part}"]`);
    for (const to of [...uses].sort()) {
      const isOfCycle = reached(parts, to).has(part);
      if (!isOfCycle && reached(parts, part, to).has(to)) continue;
      lines.push(`  ${id(part)} ${isOfCycle ? "==>" : "-->"} ${id(to)}`);
    }
  }
  return `\`\`\`mermaid\n${lines.join("\n")}\n\`\`\`\n`;
}

const of = async (checkout) => ({
  viewer: graph(await viewerParts(checkout)),
  engine: graph(engineParts(checkout)),
});

const [mode, checkout] = process.argv.slice(2);
if (mode === "--of") {
  if (!existsSync(checkout ?? "")) throw new Error("--of needs the folder of a checkout.");
  const { viewer, engine } = await of(checkout);
  console.log(`${viewer}\n${engine}`);
} else {
  const path = join(root, "docs/architecture.md");
  const text = readFileSync(path, "utf8");
  const graphs = await of(root);
  const written = text.replace(
    /(<!-- parts of the (\w+) -->\n)[\s\S]*?(<!-- \/parts -->)/g,
    (_, open, name, close) => `${open}${graphs[name]}${close}`,
  );
  if (mode === "--check") {
    if (written !== text) {
      console.error("docs/architecture.md: run node scripts/parts_picture.mjs");
      process.exit(1);
    }
  } else writeFileSync(path, written);
}
