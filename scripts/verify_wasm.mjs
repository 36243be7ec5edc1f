/**
 * Checks that the committed WASM is what the Rust sources give, wherever it is built: fails if a stamp is
 * stale, or if building it in another folder, with another home of cargo, gives other bytes. If the
 * sources of the standard library (rust-src) are installed it is built without them, else with a sign of
 * them, as the compiler names places by them. Where `make wasm` built the committed files is one folder
 * and this is another, so a build in the project's own folder would show nothing more.
 *
 * Leaves target/trials.wasm, which the golden tests of wasm/tests read. What is built stays in
 * target/elsewhere, so that a second run compiles only what has changed.
 *
 *   node scripts/verify_wasm.mjs
 */
import { execFileSync, spawnSync } from "node:child_process";
import {
  chmodSync,
  copyFileSync,
  cpSync,
  existsSync,
  mkdirSync,
  readdirSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import { homedir } from "node:os";
import { dirname, join } from "node:path";

const root = join(import.meta.dirname, "..");
const target = "lib/rustlib/wasm32-unknown-unknown";
/** The compiler takes this one file for the sign that all sources are there. */
const sourcesSign = "lib/rustlib/src/rust/library/std/src/lib.rs";

const sysroot = findSysroot();
if (process.platform === "win32" || !sysroot || !existsSync(join(sysroot, target))) {
  // Compilers are wrapped by a shell script here, and without the target only stamps can be compared.
  process.exit(verify(root));
}

const folder = join(root, "target/elsewhere");
const built = join(folder, "target");
const copy = join(folder, "a copy/turnleaf");
for (const name of readdirIfThere(folder)) {
  if (join(folder, name) !== built) rmSync(join(folder, name), { recursive: true });
}
// With their times, by which cargo knows what has changed since the last run.
const options = { recursive: true, preserveTimestamps: true };
for (const name of [
  ...["Cargo.toml", "Cargo.lock", "rust-toolchain.toml", "package.json"],
  ...["engine", "lab", "wasm", "bench/engine", "scripts"],
  ...["packages/turnleaf/src/engine", "packages/turnleaf/src/models"],
]) {
  cpSync(join(root, name), join(copy, name), options);
}
symlinkSync(join(root, "node_modules"), join(copy, "node_modules"));
const cargoHome = join(folder, "cargo");
linkTo(cargoHome, process.env.CARGO_HOME ?? join(homedir(), ".cargo"));
const hasSources = !existsSync(join(sysroot, sourcesSign));
console.log(`In another folder, ${hasSources ? "with" : "without"} rust-src:`);
const status = verify(copy, {
  CARGO_HOME: cargoHome,
  CARGO_TARGET_DIR: built,
  RUSTC: compiler(folder, hasSources),
});
if (status === 0) {
  copyFileSync(join(copy, "target/trials.wasm"), join(root, "target/trials.wasm"));
}
process.exit(status);

/** Returns the exit status of `build_wasm.mjs --verify` in a folder of the project. */
function verify(cwd, env = {}) {
  const { status } = spawnSync(process.execPath, ["scripts/build_wasm.mjs", "--verify"], {
    cwd,
    stdio: "inherit",
    env: { ...process.env, ...env },
  });
  return status ?? 1;
}

function findSysroot() {
  try {
    return execFileSync("rustc", ["--print", "sysroot"], { cwd: root, encoding: "utf8" }).trim();
  } catch {
    return undefined;
  }
}

function readdirIfThere(folder) {
  return existsSync(folder) ? readdirSync(folder) : [];
}

/** Makes a folder of links to all that another has but for some names. */
function linkTo(folder, from, except = []) {
  mkdirSync(folder, { recursive: true });
  for (const name of readdirSync(from)) {
    if (!except.includes(name)) symlinkSync(join(from, name), join(folder, name));
  }
}

/** Makes the compiler as it is where rust-src is installed, or is not. Returns its path. */
function compiler(folder, hasSources) {
  const copy = join(folder, hasSources ? "with-rust-src" : "without-rust-src");
  linkTo(copy, sysroot, ["lib"]);
  linkTo(join(copy, "lib"), join(sysroot, "lib"), ["rustlib"]);
  linkTo(join(copy, "lib/rustlib"), join(sysroot, "lib/rustlib"), ["src"]);
  if (hasSources) {
    mkdirSync(dirname(join(copy, sourcesSign)), { recursive: true });
    writeFileSync(join(copy, sourcesSign), "");
  }
  const script = join(copy, "rustc.sh");
  writeFileSync(script, `#!/bin/sh\nexec '${sysroot}/bin/rustc' --sysroot '${copy}' "$@"\n`);
  chmodSync(script, 0o755);
  return script;
}
