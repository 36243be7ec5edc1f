/**
 * Completes package-lock.json with the optional packages of other platforms.
 *
 * A registry mirror may hold the binaries of its own platform alone; npm then
 * writes a lock that `npm ci` rejects everywhere. For every optional dependency
 * without an entry this adds one with its exact version and its platform, read off
 * its name; and to every entry without an integrity, that which the registry
 * states, if it has the package.
 * Run it after every change of dependencies: node scripts/complete_lock.mjs
 */
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const file = join(import.meta.dirname, "../package-lock.json");
const lock = JSON.parse(readFileSync(file, "utf8"));

const systems = [
  "android",
  "darwin",
  "linux",
  "win32",
  "freebsd",
  "openbsd",
  "netbsd",
  "sunos",
  "aix",
  "openharmony",
];
const processors = [
  "arm64",
  "x64",
  "ia32",
  "arm",
  "s390x",
  "ppc64",
  "riscv64",
  "loong64",
  "wasm32",
  "mips64el",
];

/** The platform that a binary package is for, by the words of its name. */
function platformOf(name) {
  const words = name.split("/").at(-1).split("-");
  const system = systems.find((word) => words.includes(word));
  const processor = processors.find((word) => words.includes(word));
  const libc = words.includes("musl") ? "musl" : words.includes("gnu") ? "glibc" : undefined;
  return {
    ...(processor ? { cpu: [processor] } : {}),
    ...(system === "linux" && libc ? { libc: [libc] } : {}),
    ...(system ? { os: [system] } : {}),
  };
}

let added = 0;
for (const [place, entry] of Object.entries(lock.packages)) {
  for (const [name, version] of Object.entries(entry.optionalDependencies ?? {})) {
    const nested = `${place}/node_modules/${name}`;
    const hoisted = `node_modules/${name}`;
    if (lock.packages[nested] || lock.packages[hoisted] || !/^\d/.test(version)) continue;
    lock.packages[hoisted] = {
      version,
      ...(entry.dev ? { dev: true } : {}),
      license: entry.license,
      optional: true,
      ...platformOf(name),
    };
    added++;
  }
}

/** The hash of a package's file as the registry states it; undefined where it has none of that version. */
function integrityOf(name, version) {
  try {
    const given = ["view", `${name}@${version}`, "dist.integrity"];
    const said = execFileSync("npm", given, {
      encoding: "utf8",
      stdio: ["ignore", "pipe", "ignore"],
    });
    return /^sha512-\S+$/.exec(said.trim())?.[0];
  } catch {
    return undefined;
  }
}

let without = 0;
for (const [place, entry] of Object.entries(lock.packages)) {
  if (!place.startsWith("node_modules/") || entry.link || entry.integrity) continue;
  entry.integrity = integrityOf(place.slice("node_modules/".length), entry.version);
  if (entry.integrity === undefined) without++;
}
lock.packages = Object.fromEntries(
  Object.entries(lock.packages).sort(([a], [b]) => (a < b ? -1 : a > b ? 1 : 0)),
);
writeFileSync(file, `${JSON.stringify(lock, null, 2)}\n`);
console.log(`${added} packages of other platforms added; ${without} have no integrity.`);
