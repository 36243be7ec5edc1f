/**
 * Builds the engine as WASM, by cargo and binaryen's wasm-opt. The files are committed
 * beside the viewer's sources, each with a stamp of the Rust sources it was built from,
 * so that a clone needs no Rust to read a book: turnleaf.wasm holds books, creases.wasm
 * books whose leaves can be creased, models.wasm loose leaves of every model. target/trials.wasm, books and the scenes of benches and
 * golden tests, is in no package.
 *
 *   node scripts/build_wasm.mjs            build all four
 *   node scripts/build_wasm.mjs --update   build the committed files if the Rust sources
 *                                          have changed and the wasm32 target is installed
 *   node scripts/build_wasm.mjs --verify   fail if a stamp is stale; if the target is
 *                                          installed, rebuild, compare, and build the trials
 *   node scripts/build_wasm.mjs --trials   build the trials
 *
 * Two are built at a time: the compiler optimises each as a whole, which takes one core.
 */
import { execFile, execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { homedir } from "node:os";
import { basename, dirname, join } from "node:path";
import { promisify } from "node:util";
import { absolutePaths } from "./wasm_paths.mjs";

const run = promisify(execFile);

const root = join(import.meta.dirname, "..");
const target = "wasm32-unknown-unknown";
const targetFolder = process.env.CARGO_TARGET_DIR ?? join(root, "target");

/**
 * What is built, and the features of the crate `turnleaf-wasm` that each has. Files of one lane are
 * built one after another, in a target folder of the lane's own, as cargo locks it. The trials and the
 * creases need the engine with the same features, which is so compiled once.
 */
const trials = { file: join(root, "target/trials.wasm"), features: ["books", "trials"], lane: 1 };
const committed = [
  { file: join(root, "packages/turnleaf/src/engine/turnleaf.wasm"), features: ["books"], lane: 2 },
  { file: join(root, "packages/turnleaf/src/engine/creases.wasm"), features: ["creases"], lane: 1 },
  { file: join(root, "packages/turnleaf/src/models/models.wasm"), features: ["models"], lane: 2 },
];

const stampOf = (file) => `${file}.stamp.json`;
const sha256 = (bytes) => createHash("sha256").update(bytes).digest("hex");

/** Every file whose change may change the WASM. */
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
    "scripts/build_wasm.mjs",
    ...under("engine/src"),
    ...under("wasm/src"),
  ].sort();
}

function sourcesHash() {
  const { devDependencies } = JSON.parse(readFileSync(join(root, "package.json"), "utf8"));
  const hash = createHash("sha256").update(`binaryen ${devDependencies.binaryen}\0`);
  // Line ends may differ between checkouts; what is built does not.
  for (const name of sources()) {
    hash
      .update(`${name}\0`)
      .update(readFileSync(join(root, name), "utf8").replaceAll("\r\n", "\n"));
  }
  return hash.digest("hex");
}

/** Output of the compiler that cargo takes. */
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
 * Fixed names for the folders of this machine that the places of panics would carry.
 * Where the sources of the standard library are installed (rust-src), the compiler names
 * them by their folder, else by the commit it was built from: here always the latter.
 */
function remappedFolders() {
  const cargoHome = process.env.CARGO_HOME ?? join(homedir(), ".cargo");
  const [, commit] = /^commit-hash: (\w+)$/m.exec(rustc("--version", "--verbose")) ?? [];
  const library = join(rustc("--print", "sysroot"), "lib/rustlib/src/rust");
  // The folders of registries are there once crates are.
  execFileSync("cargo", ["fetch", "--quiet", "--locked", "--target", target], { cwd: root });
  const registries = join(cargoHome, "registry/src");
  return [
    ...readdirSync(registries).map((name) => [join(registries, name), "crates"]),
    [root, "."],
    [library, `/rustc/${commit}`],
  ].map(([from, to]) => `--remap-path-prefix=${from}=${to}`);
}

/** Builds the WASM with features of the crate and writes it. */
async function build({ file, features, lane }, folders) {
  const flags = [
    "-Ctarget-feature=+simd128",
    // A twentieth smaller at the same speed.
    "-Cllvm-args=-inline-threshold=75",
    "-Cllvm-args=-unroll-runtime=false",
    ...folders,
  ];
  const laneFolder = join(targetFolder, `wasm-${lane}`);
  await run(
    "cargo",
    [
      ...["build", "--profile", "wasm", "--quiet", "--locked", "-p", "turnleaf-wasm"],
      ...["--target", target, "--no-default-features", "--features", features.join(",")],
    ],
    {
      cwd: root,
      env: {
        ...process.env,
        CARGO_ENCODED_RUSTFLAGS: flags.join("\x1f"),
        CARGO_TARGET_DIR: laneFolder,
      },
    },
  );
  mkdirSync(dirname(file), { recursive: true });
  await run(process.execPath, [
    join(root, "node_modules/binaryen/bin/wasm-opt"),
    join(laneFolder, target, "wasm/turnleaf_wasm.wasm"),
    ...["-Os", "--enable-simd", "--enable-bulk-memory", "--enable-nontrapping-float-to-int"],
    ...["--enable-sign-ext", "--enable-mutable-globals", "--enable-reference-types"],
    ...["--enable-multivalue", "--strip-debug", "--strip-producers"],
    ...["--strip-target-features", "-o", file],
  ]);
}

/** Builds several, and calls `built` with each. Fails once both lanes have ended. */
async function buildAll(all, built = () => {}) {
  const folders = remappedFolders();
  const buildLane = async (lane) => {
    for (const one of all.filter((one) => one.lane === lane)) {
      await build(one, folders);
      built(one);
    }
  };
  const ends = await Promise.allSettled([1, 2].map(buildLane));
  for (const { reason } of ends) if (reason) throw reason;
}

function finishCommitted({ file }) {
  const [path] = absolutePaths(readFileSync(file));
  if (path) throw new Error(`${basename(file)} names a folder of this machine: ${path}`);
  const stamp = { sources: sourcesHash(), wasm: sha256(readFileSync(file)) };
  writeFileSync(stampOf(file), `${JSON.stringify(stamp, null, 2)}\n`);
  console.log(`${basename(file)}: ${statSync(file).size} bytes`);
}

const stampIn = (file) => JSON.parse(readFileSync(stampOf(file), "utf8"));
const areSourcesNewer = () => committed.some(({ file }) => stampIn(file).sources !== sourcesHash());

async function verify(canBuild) {
  for (const { file } of committed) {
    const name = basename(file);
    const stamp = stampIn(file);
    if (stamp.sources !== sourcesHash()) {
      fail(`${name} is older than the Rust sources; run \`make wasm\` and commit the result.`);
    }
    if (stamp.wasm !== sha256(readFileSync(file))) {
      fail(
        `${name} is not the file that its stamp names; run \`make wasm\` and commit the result.`,
      );
    }
    if (!canBuild) console.log(`${name} matches its stamp (not rebuilt: no ${target} target here)`);
  }
  if (!canBuild) return;
  const rebuilt = committed.map(({ file, ...rest }) => ({
    file: join(targetFolder, "rebuilt", basename(file)),
    committedAs: file,
    ...rest,
  }));
  await buildAll([...rebuilt, trials], ({ file, committedAs }) => {
    if (!committedAs) return;
    const name = basename(file);
    if (sha256(readFileSync(file)) !== stampIn(committedAs).wasm) {
      throw new Error(
        `Rebuilding ${name} gave other bytes; run \`make wasm\` and commit the result.`,
      );
    }
    console.log(`${name} matches its stamp, and rebuilding gave the same bytes`);
  });
}

function fail(sentence) {
  console.error(sentence);
  process.exit(1);
}

const mode = process.argv[2];
const canBuild = hasTarget();
try {
  if (mode === "--verify") await verify(canBuild);
  else if (mode === "--update") {
    if (areSourcesNewer()) {
      if (canBuild) await buildAll(committed, finishCommitted);
      else {
        console.warn(
          `The Rust sources have changed, and the WASM has not: to build it, run rustup target add ${target}.`,
        );
      }
    }
  } else {
    if (!canBuild)
      fail(`Building the engine for the browser needs its target: rustup target add ${target}`);
    if (mode === "--trials") await buildAll([trials]);
    else await buildAll([...committed, trials], (one) => one !== trials && finishCommitted(one));
  }
} catch (error) {
  // What the compiler or wasm-opt wrote.
  fail(error.stderr || error.message);
}
