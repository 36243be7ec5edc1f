/**
 * Checks the licence of every npm package, as package-lock.json states it, and of what is in
 * unpacker.wasm. Crates are cargo-deny's to check (deny.toml).
 *
 *   node scripts/check_licences.mjs           fails if one is not accepted, or none is stated
 *   node scripts/check_licences.mjs --list    prints each as well
 *
 * Home-made, because license-checker sees less: it takes "MIT AND GPL-3.0" for MIT, and it reads what is
 * installed, which leaves out packages for other platforms: a quarter of the lock.
 */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { clones, libraries } from "./unpacker_sources.mjs";

const root = join(import.meta.dirname, "..");

/** Licences that ask for no more than that their text comes along. */
const permissive = new Set([
  "MIT",
  "MIT-0",
  "ISC",
  "0BSD",
  "BSD-2-Clause",
  "BSD-3-Clause",
  "Apache-2.0",
  "Zlib",
  "CC0-1.0",
  "Unlicense",
]);

/** Of type: OFL-1.1 lets it be embedded and shipped with software of any licence, with its text. */
const forShipped = new Set(["OFL-1.1", ...permissive]);

/**
 * Licences of tools that build and test, of which nothing is shipped: MPL-2.0 asks
 * for the source of its own files alone, BlueOak-1.0.0 for as little as MIT.
 */
const forTools = new Set(["MPL-2.0", "BlueOak-1.0.0", ...forShipped]);

/** Packages whose code is in what is shipped, though the lock calls them development's. */
const shipped = new Set([
  "@fontsource/atkinson-hyperlegible",
  "@fontsource/opendyslexic",
  "@zip.js/zip.js",
  "dompurify",
  "foliate-js",
  "chardet",
  "fzstd",
  "hyphen",
  "image-size",
  "marked",
  "pako",
  "pdfjs-dist",
  "three",
  "utif2",
]);

/** Packages that state their licence in their text alone, with what it says there. */
const stated = { "png-js": "MIT" };

/**
 * Whether a licence expression is satisfied by a set: one choice of each "OR", all of each "AND".
 * Without parentheses an expression asks for more, never for less.
 */
function satisfies(expression, allowed) {
  const all = expression.replaceAll(/[()]/g, "").split(/ AND /);
  return all.every((part) => part.split(/ OR |\//).some((name) => allowed.has(name.trim())));
}

function npmPackages() {
  const lock = JSON.parse(readFileSync(join(root, "package-lock.json"), "utf8"));
  return Object.entries(lock.packages)
    .filter(([place, entry]) => place.includes("node_modules/") && !entry.link)
    .map(([place, entry]) => {
      const name = place.slice(place.lastIndexOf("node_modules/") + "node_modules/".length);
      return { name, version: entry.version, licence: entry.license ?? stated[name] };
    });
}

/** What is in unpacker.wasm: shipped, so that its licences have to be permissive. */
const unpacker = [...clones, ...libraries].map(({ name, version, licence }) => {
  shipped.add(name);
  return { name, version, licence };
});

const packages = [...npmPackages(), ...unpacker];
let failed = false;
for (const { name, version, licence } of packages) {
  const allowed = shipped.has(name) ? forShipped : forTools;
  if (process.argv.includes("--list")) console.log(`${name} ${version}: ${licence}`);
  if (licence !== undefined && satisfies(licence, allowed)) continue;
  failed = true;
  console.error(`${name} ${version}: ${licence ?? "no licence stated"}`);
}
if (failed) {
  console.error("These licences are not among those that the project accepts.");
  process.exit(1);
}
console.log(`${packages.length} dependencies, each under a licence that the project accepts.`);
