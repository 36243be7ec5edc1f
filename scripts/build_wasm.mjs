/**
 * Builds the engine as WASM and commits to it: the file goes beside the viewer's
 * sources with a stamp of the Rust sources it was built from, so that a clone
 * needs no Rust to read a book. It holds what the viewer calls; the scenes of
 * benches and golden tests are in a second one, target/trials.wasm, which has
 * the viewer's exports too and is in no package. Loose leaves of every model are
 * in a third one, beside the viewer's models/, with a stamp of its own.
 *
 *   node scripts/build_wasm.mjs            build, write the file and its stamp, and
 *                                          the trials
 *   node scripts/build_wasm.mjs --verify   fail when the stamp is stale; where the
 *                                          wasm32 target is there, rebuild and compare,
 *                                          and write the trials
 *   node scripts/build_wasm.mjs --trials   write the trials
 */
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { homedir } from "node:os";
import { basename, join } from "node:path";
import { onlyLeaves } from "./leaves_wasm.mjs";
import { shrinkWasm } from "./shrink_wasm.mjs";
import { absolutePaths } from "./wasm_paths.mjs";

const root = join(import.meta.dirname, "..");
const target = "wasm32-unknown-unknown";
const cargoTarget = process.env.CARGO_TARGET_DIR ?? join(root, "target");
const built = join(cargoTarget, target, "wasm/turnleaf_wasm.wasm");
const trials = join(root, "target/trials.wasm");
const kept = join(root, "packages/turnleaf/src/engine/turnleaf.wasm");
const models = join(root, "packages/turnleaf/src/models/models.wasm");
const stampOf = (file) => `${file}.stamp.json`;

const sha256 = (bytes) => createHash("sha256").update(bytes).digest("hex");

/** Every file whose change may change the machine code, the tool that shrinks it among them. */
function sources() {
  const under = (folder) =>
    readdirSync(join(root, folder), { recursive: true })
      .map((name) => `${folder}/${name}`.replaceAll("\\", "/"))
      .filter((name) => statSync(join(root, name)).isFile());
  return [
    "Cargo.toml",
    "Cargo.lock",
    "rust-toolchain.toml",
    "engine/Cargo.toml",
    "wasm/Cargo.toml",
    "scripts/clear_locations.mjs",
    "scripts/dead_data.mjs",
    "scripts/leaves_wasm.mjs",
    "scripts/shrink_wasm.mjs",
    ...under("engine/src"),
    ...under("wasm/src"),
  ].sort();
}

function sourcesHash() {
  const { devDependencies } = JSON.parse(readFileSync(join(root, "package.json"), "utf8"));
  const hash = createHash("sha256").update(`binaryen ${devDependencies.binaryen}\0`);
  // Line ends may differ between checkouts; machine code does not.
  for (const name of sources()) {
    hash
      .update(`${name}\0`)
      .update(readFileSync(join(root, name), "utf8").replaceAll("\r\n", "\n"));
  }
  return hash.digest("hex");
}

/** What the compiler that cargo takes says. */
function rustc(...args) {
  return execFileSync(process.env.RUSTC ?? "rustc", args, { cwd: root, encoding: "utf8" }).trim();
}

function hasTarget() {
  try {
    return existsSync(join(rustc("--print", "sysroot"), "lib/rustlib", target));
  } catch {
    return false;
  }
}

/**
 * Names for the folders of this machine that panic messages would carry. Where the
 * sources of the standard library are installed (rust-src), the compiler names them
 * by their folder, else by the commit it was built from, as the library's own machine
 * code does: here always the latter.
 */
function remappedFolders() {
  const cargoHome = process.env.CARGO_HOME ?? join(homedir(), ".cargo");
  const [, commit] = /^commit-hash: (\w+)$/m.exec(rustc("--version", "--verbose")) ?? [];
  const library = join(rustc("--print", "sysroot"), "lib/rustlib/src/rust");
  return [
    [cargoHome, "cargo"],
    [root, "."],
    [library, `/rustc/${commit}`],
  ].map(([from, to]) => `--remap-path-prefix=${from}=${to}`);
}

/** The machine code, with the scenes of benches and golden tests or without. */
function build(features = []) {
  const flags = [
    "-Ctarget-feature=+simd128",
    // Say which function reads which data.
    "-Clink-arg=--emit-relocs",
    // What makes other machines quicker is of no use here, and takes 1.3 kB more when packed.
    ...["-inline-threshold=75", "-unroll-runtime=false", "-unroll-allow-peeling=false"].map(
      (argument) => `-Cllvm-args=${argument}`,
    ),
    ...remappedFolders(),
  ];
  execFileSync(
    "cargo",
    [
      ...["build", "--profile", "wasm", "--quiet", "--locked", "-p", "turnleaf-wasm"],
      ...["--target", target, "--features", features.join(",")],
    ],
    {
      cwd: root,
      stdio: ["ignore", "inherit", "inherit"],
      env: { ...process.env, CARGO_ENCODED_RUSTFLAGS: flags.join("\x1f") },
    },
  );
  return readFileSync(built);
}

function buildTrials() {
  mkdirSync(join(root, "target"), { recursive: true });
  writeFileSync(trials, build(["trials"]));
}

/** The committed files, and how each is made of the sources. */
const committed = [
  { file: kept, make: () => shrinkWasm(build()) },
  { file: models, make: () => onlyLeaves(build(["models"])) },
];

function requireNoPaths(file) {
  const [path] = absolutePaths(readFileSync(file));
  if (path) fail(`${basename(file)} names a folder of the machine that built it: ${path}`);
}

function fail(sentence) {
  console.error(sentence);
  process.exit(1);
}

if (process.argv.includes("--verify")) {
  const canBuild = hasTarget();
  for (const { file, make } of committed) {
    const name = basename(file);
    const stamp = JSON.parse(readFileSync(stampOf(file), "utf8"));
    if (stamp.sources !== sourcesHash()) {
      fail(`${name} is older than the Rust sources; run \`make wasm\` and commit the result.`);
    }
    if (stamp.wasm !== sha256(readFileSync(file))) {
      fail(
        `${name} is not the file that its stamp names; run \`make wasm\` and commit the result.`,
      );
    }
    requireNoPaths(file);
    if (!canBuild) {
      console.log(`${name} matches its stamp (not rebuilt: no ${target} target here)`);
    } else if (sha256(make()) !== stamp.wasm) {
      fail(`Rebuilding ${name} gave other bytes; run \`make wasm\` and commit the result.`);
    } else {
      console.log(`${name} matches its stamp, and rebuilding gave the same bytes`);
    }
  }
  if (canBuild) buildTrials();
} else {
  if (!hasTarget()) {
    fail(`Building the engine for the browser needs its target: rustup target add ${target}`);
  }
  buildTrials();
  if (process.argv.includes("--trials")) process.exit(0);
  for (const { file, make } of committed) {
    writeFileSync(file, make());
    const stamp = { sources: sourcesHash(), wasm: sha256(readFileSync(file)) };
    requireNoPaths(file);
    writeFileSync(stampOf(file), `${JSON.stringify(stamp, null, 2)}\n`);
    console.log(`${basename(file)}: ${statSync(file).size} bytes`);
  }
}
