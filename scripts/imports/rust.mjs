/**
 * Which module of a Rust crate uses which, found from its sources: `use`
 * declarations and paths in code, through `crate::`, `self::`, `super::` and the
 * names of child modules. A path is followed through re-exports to the module
 * that defines its item, so that a façade counts as what stands behind it.
 */
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

const declaration =
  /(?:^|\n)\s*(?:pub(?:\([^)]*\))?\s+)?(?:const\s+|unsafe\s+|extern\s+"C"\s+)*(?:fn|struct|enum|trait|type|const|static|union)\s+(\w+)/g;

/**
 * Returns the modules of the crate whose sources lie in `folder`, by path
 * ("book::draw"; "" for the root), each with its file and the modules it uses.
 * Code under `#[cfg(test)]` and files named tests.rs are left out.
 */
export function modulesOf(folder) {
  const modules = new Map();
  for (const name of readdirSync(folder, { recursive: true })) {
    const file = name.replaceAll("\\", "/");
    if (!file.endsWith(".rs") || /(^|[/_])tests\.rs$/.test(file)) continue;
    const path = file
      .replace(/\.rs$/, "")
      .replace(/(^|\/)(mod|lib|main)$/, "")
      .split("/")
      .filter(Boolean);
    modules.set(path.join("::"), read(join(folder, name), path));
  }
  for (const { path, forTests } of [...modules.values()]) {
    for (const name of forTests) modules.delete([...path, name].join("::"));
  }
  for (const module of modules.values()) {
    module.uses = new Set();
    for (const path of module.paths) {
      const target = resolve(modules, module, path);
      if (target !== null && target !== module) module.uses.add(target.name);
    }
  }
  return modules;
}

function read(file, path) {
  const whole = readFileSync(file, "utf8").replace(/\/\/.*$/gm, "");
  const text = whole.split(/#\[cfg\(test\)\]\s*\n\s*(?:pub(?:\([^)]*\))?\s+)?mod \w+ \{/)[0];
  const forTests = new Set([...text.matchAll(/#\[cfg\(test\)\]\s*mod (\w+);/g)].map((m) => m[1]));
  const children = new Set(
    [...text.matchAll(/(?:^|\n)\s*(?:pub(?:\([^)]*\))?\s+)?mod (\w+);/g)].map((m) => m[1]),
  );
  for (const name of forTests) children.delete(name);
  const imports = new Map();
  const paths = [];
  let rest = text;
  for (const [line, shown, tree] of text.matchAll(
    /(?:^|\n)\s*(pub(?:\([^)]*\))?\s+)?use ([^;]+);/g,
  )) {
    rest = rest.replace(line, "\n");
    for (const [steps, name] of flatten(tree.replace(/\s+/g, " "))) {
      imports.set(name, steps);
      // What is only handed on is no use of it.
      if (shown === undefined) paths.push(steps);
      else paths.push({ steps, name });
    }
  }
  const code = rest;
  const own = paths.filter((path) => Array.isArray(path));
  for (const path of paths) {
    if (!Array.isArray(path) && new RegExp(`\\b${path.name}\\b`).test(code)) own.push(path.steps);
  }
  for (const [path] of code.matchAll(/\b\w+(?:::\w+)+/g)) own.push(path.split("::"));
  const items = new Set([...text.matchAll(declaration)].map((m) => m[1]));
  for (const [, name] of text.matchAll(/macro_rules! (\w+)/g)) items.add(name);
  return { name: path.join("::"), path, file, children, forTests, imports, items, paths: own };
}

/** Every path of a `use` tree, with the name under which it is known. */
function flatten(tree, before = []) {
  const text = tree.trim();
  const brace = text.indexOf("{");
  if (brace >= 0 && text.endsWith("}")) {
    const head = text
      .slice(0, brace)
      .split("::")
      .map((s) => s.trim())
      .filter(Boolean);
    return split(text.slice(brace + 1, -1)).flatMap((part) => flatten(part, [...before, ...head]));
  }
  const [path, alias] = text.split(" as ").map((s) => s.trim());
  const steps = [...before, ...path.split("::").map((s) => s.trim())];
  if (steps.at(-1) === "self") steps.pop();
  return [[steps, alias ?? steps.at(-1)]];
}

function split(list) {
  const parts = [];
  let [depth, start] = [0, 0];
  for (let k = 0; k <= list.length; k++) {
    if (list[k] === "{") depth++;
    if (list[k] === "}") depth--;
    if ((list[k] === "," && depth === 0) || k === list.length) {
      if (list.slice(start, k).trim()) parts.push(list.slice(start, k));
      start = k + 1;
    }
  }
  return parts;
}

/** The module that defines what a path names; null where that is another crate's. */
function resolve(modules, from, steps, depth = 0) {
  if (depth > 8) return null;
  let at = from;
  for (const [index, step] of steps.entries()) {
    const isFirst = index === 0;
    const child = [...at.path, step].join("::");
    if (isFirst && step === "crate") at = modules.get("");
    else if (step === "super") at = modules.get(at.path.slice(0, -1).join("::"));
    else if (step === "self") continue;
    else if (at.children.has(step) && modules.has(child)) at = modules.get(child);
    else if (at.imports.has(step)) {
      const target = at.imports.get(step);
      // A name that stands for itself is another crate's.
      if (target.length === 1) return null;
      const found = resolve(modules, at, target, depth + 1);
      if (found === null) return null;
      // A module that was imported: the path goes on in it.
      if (found.path.at(-1) === target.at(-1) && index < steps.length - 1) at = found;
      else return found;
    } else if (at.items.has(step)) return at;
    else return isFirst ? null : at;
    if (at === undefined) return null;
  }
  return at;
}

/** Returns each cycle of modules once, as the list of their names. */
export function cyclesOf(modules) {
  const [index, low, stack, cycles] = [new Map(), new Map(), [], []];
  const visit = (name) => {
    index.set(name, index.size);
    low.set(name, index.get(name));
    stack.push(name);
    for (const next of modules.get(name).uses) {
      if (!index.has(next)) visit(next);
      if (stack.includes(next)) low.set(name, Math.min(low.get(name), low.get(next)));
    }
    if (low.get(name) !== index.get(name)) return;
    const group = stack.splice(stack.indexOf(name));
    if (group.length > 1) cycles.push(group);
  };
  for (const name of modules.keys()) if (!index.has(name)) visit(name);
  return cycles;
}
