/**
 * The committed machine code is the same wherever it is built: in another folder,
 * with another home of cargo, and with the sources of the standard library
 * (rust-src) installed or not. And it names no folder of the machine that built it.
 */
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import {
  chmodSync,
  cpSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import { homedir, tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import test from "node:test";
import { absolutePaths } from "../../scripts/wasm_paths.mjs";

const root = join(import.meta.dirname, "../..");
const committed = ["engine/turnleaf.wasm", "engine/creases.wasm", "models/models.wasm"];

for (const file of committed) {
  test(`${basename(file)} names no folder of a machine`, () => {
    const wasm = readFileSync(join(root, "packages/turnleaf/src", file));
    assert.deepEqual(absolutePaths(wasm), []);
  });
}

test("absolute paths are found among machine code", () => {
  const bytes = Buffer.from([0, 255, 47, 65, 66, 0, 1]);
  const sample = (text) => Buffer.concat([bytes, Buffer.from(text, "latin1"), bytes]);
  for (const path of [
    "/home/ann/.rustup/toolchains/1.95.0/lib/rustlib/src/rust/library/core/src/str.rs",
    "/home/me/turnleaf",
    "C:\\Users\\me\\turnleaf",
  ]) {
    assert.deepEqual(absolutePaths(sample(path)), [path]);
  }
  for (const place of [
    "/rustc/59807616e1fa2540724bfbac14d7976d7e4a3860/library/core/src/num/bignum.rs",
    "engine/src/book/leaf.rswasm/src/live.rs",
    "crates/libm-0.2.16/src/math/exp.rs",
  ]) {
    assert.deepEqual(absolutePaths(sample(place)), []);
  }
  assert.deepEqual(absolutePaths(sample("engine/src/book.rs/home/ann/x.rs")), ["/home/ann/x.rs"]);
  assert.deepEqual(absolutePaths(sample("3 to 16 columns and/or rows")), []);
});

const sysroot = () =>
  execFileSync("rustc", ["--print", "sysroot"], { cwd: root, encoding: "utf8" });
const target = "lib/rustlib/wasm32-unknown-unknown";
/** The compiler takes this one file for the sign that all sources are there. */
const sourcesSign = "lib/rustlib/src/rust/library/std/src/lib.rs";
function reasonToSkip() {
  try {
    if (process.platform === "win32") return "compilers are wrapped by a shell script";
    return existsSync(join(sysroot().trim(), target)) ? false : "no wasm32-unknown-unknown target";
  } catch {
    return "no Rust";
  }
}

/** A folder of links to all that another has but for some names. */
function linkTo(folder, from, except = []) {
  mkdirSync(folder, { recursive: true });
  for (const name of readdirSync(from)) {
    if (!except.includes(name)) symlinkSync(join(from, name), join(folder, name));
  }
}

/** The compiler as it is where rust-src is installed, or is not. */
function compiler(folder, hasSources) {
  const real = sysroot().trim();
  const copy = join(folder, hasSources ? "with-rust-src" : "without-rust-src");
  linkTo(copy, real, ["lib"]);
  linkTo(join(copy, "lib"), join(real, "lib"), ["rustlib"]);
  linkTo(join(copy, "lib/rustlib"), join(real, "lib/rustlib"), ["src"]);
  if (hasSources) {
    mkdirSync(dirname(join(copy, sourcesSign)), { recursive: true });
    writeFileSync(join(copy, sourcesSign), "");
  }
  const script = join(copy, "rustc.sh");
  writeFileSync(script, `#!/bin/sh\nexec '${real}/bin/rustc' --sysroot '${copy}' "$@"\n`);
  chmodSync(script, 0o755);
  return script;
}

// As this machine has it, `scripts/build_wasm.mjs --verify` builds the code in its own folder.
test("another folder, another home of cargo and rust-src, or none, give the same bytes", {
  skip: reasonToSkip(),
}, (t) => {
  const folder = mkdtempSync(join(tmpdir(), "turnleaf-elsewhere-"));
  t.after(() => rmSync(folder, { recursive: true, force: true }));
  const copy = join(folder, "a copy/turnleaf");
  for (const name of ["Cargo.toml", "Cargo.lock", "rust-toolchain.toml", "package.json"]) {
    cpSync(join(root, name), join(copy, name));
  }
  for (const name of ["engine", "lab", "wasm", "scripts"]) {
    cpSync(join(root, name), join(copy, name), { recursive: true });
  }
  for (const file of committed.flatMap((name) => [name, `${name}.stamp.json`])) {
    cpSync(join(root, "packages/turnleaf/src", file), join(copy, "packages/turnleaf/src", file));
  }
  symlinkSync(join(root, "node_modules"), join(copy, "node_modules"));
  const cargoHome = join(folder, "cargo");
  linkTo(cargoHome, process.env.CARGO_HOME ?? join(homedir(), ".cargo"));
  const hasSources = !existsSync(join(sysroot().trim(), sourcesSign));
  const { status, stdout, stderr } = spawnSync(
    process.execPath,
    ["scripts/build_wasm.mjs", "--verify"],
    {
      cwd: copy,
      encoding: "utf8",
      env: {
        ...process.env,
        CARGO_HOME: cargoHome,
        CARGO_TARGET_DIR: join(folder, "target"),
        RUSTC: compiler(folder, hasSources),
      },
    },
  );
  const where = hasSources ? "with rust-src" : "without rust-src";
  assert.equal(status, 0, `${where}: ${stderr}${stdout}`);
  assert.equal(
    stdout.match(/rebuilding gave the same bytes/g)?.length,
    committed.length,
    `${where}: ${stdout}`,
  );
});
