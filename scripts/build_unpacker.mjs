/**
 * Builds what reads RAR, 7-Zip and XZ: libarchive's readers of them, liblzma's decoders and
 * unpacker.c as one WASM, by `zig cc` (pip install ziglang, in the version of unpacker_sources.mjs).
 * It is committed beside unpacker.c, with a stamp of what it was built from and the licences of what
 * is in it, so that a clone needs no C compiler.
 *
 *   node scripts/build_unpacker.mjs             build it
 *   node scripts/build_unpacker.mjs --verify    fail if the stamp is stale
 *
 * The sources are fetched into target/unpacker, from where the environment's LIBARCHIVE and XZ say (a
 * clone), else from their own addresses. ZIG may name the compiler.
 */
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { clones, zig } from "./unpacker_sources.mjs";

const root = join(import.meta.dirname, "..");
const folder = join(root, "packages/turnleaf/src/sources/archive/unpacker");
const work = join(root, "target/unpacker");
const wasm = join(folder, "unpacker.wasm");
const stamp = `${wasm}.stamp.json`;

/** Bytes of memory that the WASM may have: 7-Zip's largest usual dictionary, 256 MB, and what is around it. */
const memory = 384 << 20;

/** What is compiled of libarchive and of liblzma. What nothing calls is left out by the linker. */
const archiveFiles = [
  ...["acl", "check_magic", "entry", "entry_sparse", "entry_stat", "entry_strmode", "entry_xattr"],
  ...["blake2s_ref", "blake2sp_ref", "ppmd7", "rb", "read", "string", "string_sprintf", "time"],
  ...["read_support_format_rar", "read_support_format_rar5", "read_support_format_7zip"],
  ...["read_support_filter_xz", "read_support_format_raw", "read_support_format_empty"],
  ...["util", "virtual", "read_add_passphrase"],
].map((name) => `libarchive/archive_${name}.c`);
const lzmaFiles = [
  ...["common/common", "common/filter_common", "common/filter_decoder", "lz/lz_decoder"],
  ...["stream_decoder", "stream_flags_common", "stream_flags_decoder", "block_decoder"].map(
    (name) => `common/${name}`,
  ),
  ...["block_header_decoder", "block_util", "filter_flags_decoder", "index_hash"].map(
    (name) => `common/${name}`,
  ),
  ...["alone_decoder", "vli_decoder", "vli_size"].map((name) => `common/${name}`),
  ...["check", "crc32_fast", "crc64_small", "sha256"].map((name) => `check/${name}`),
  ...["lzma/lzma_decoder", "lzma/lzma2_decoder", "delta/delta_common", "delta/delta_decoder"],
  ...["simple_coder", "simple_decoder", "x86", "powerpc", "ia64", "arm", "armthumb", "arm64"].map(
    (name) => `simple/${name}`,
  ),
  "simple/sparc",
].map((name) => `src/liblzma/${name}.c`);
const lzmaFolders = ["api", "common", "lz", "lzma", "rangecoder", "delta", "simple", "check"].map(
  (name) => `src/liblzma/${name}`,
);

const sha256 = (bytes) => createHash("sha256").update(bytes).digest("hex");
const run = (command, args, options = {}) =>
  execFileSync(command, args, { encoding: "utf8", maxBuffer: 1 << 26, ...options });

/** The hash of everything whose change may change the WASM. */
function sourcesHash() {
  const files = [
    join(folder, "unpacker.c"),
    join(folder, "config.h"),
    join(import.meta.dirname, "build_unpacker.mjs"),
    join(import.meta.dirname, "unpacker_sources.mjs"),
  ];
  return sha256(
    files.map((file) => readFileSync(file, "utf8").replaceAll("\r\n", "\n")).join("\0"),
  );
}

/** Fetches a commit into its folder, and returns that. */
function fetched({ name, url, commit, variable }) {
  const into = join(work, name);
  mkdirSync(into, { recursive: true });
  const git = (...args) => run("git", ["-C", into, ...args]);
  git("init", "--quiet");
  git("fetch", "--quiet", "--depth", "1", process.env[variable] ?? url, commit);
  git("checkout", "--quiet", "--force", commit);
  return into;
}

function compiler() {
  const [command, ...args] = process.env.ZIG ? [process.env.ZIG] : ["python3", "-m", "ziglang"];
  try {
    const found = run(command, [...args, "version"]).trim();
    if (found !== zig) fail(`This needs zig ${zig}, and ${command} has ${found}.`);
  } catch {
    fail(`This needs zig ${zig}: pip install ziglang==${zig}`);
  }
  return [command, ...args];
}

function build() {
  const [command, ...args] = compiler();
  const [archive, xz] = clones.map(fetched);
  const built = join(work, "unpacker.wasm");
  run(command, [
    ...[...args, "cc", "--target=wasm32-wasi", "-mexec-model=reactor", "-Os", "-flto"],
    // What browsers have that have WebGL 2.
    "-mcpu=mvp+bulk_memory+sign_ext+nontrapping_fptoint+mutable_globals",
    ...["-DNDEBUG", "-DHAVE_CONFIG_H", `-DPLATFORM_CONFIG_H="config.h"`],
    ...[
      "-ffunction-sections",
      "-fdata-sections",
      "-g0",
      "-w",
      "-Wno-implicit-function-declaration",
    ],
    `-I${folder}`,
    `-I${join(archive, "libarchive")}`,
    ...["src/common", ...lzmaFolders].map((name) => `-I${join(xz, name)}`),
    ...[
      `-Wl,--max-memory=${memory}`,
      "-Wl,--gc-sections",
      "-Wl,--strip-all",
      "-Wl,-z,stack-size=262144",
    ],
    join(folder, "unpacker.c"),
    ...archiveFiles.map((name) => join(archive, name)),
    ...lzmaFiles.map((name) => join(xz, name)),
    ...["-o", built],
  ]);
  run(process.execPath, [
    join(root, "node_modules/binaryen/bin/wasm-opt"),
    built,
    ...["-Os", "--enable-bulk-memory", "--enable-nontrapping-float-to-int", "--enable-sign-ext"],
    ...["--enable-mutable-globals", "--strip-debug", "--strip-producers"],
    ...["--strip-target-features", "-o", wasm],
  ]);
  writeFileSync(
    join(folder, "LICENSES.txt"),
    licences([archive, xz], libraryFolder(command, args)),
  );
  const stamped = { sources: sourcesHash(), wasm: sha256(readFileSync(wasm)) };
  writeFileSync(stamp, `${JSON.stringify(stamped, null, 2)}\n`);
  console.log(`unpacker.wasm: ${statSync(wasm).size} bytes`);
}

/** The folder of the C library that the compiler puts in. */
function libraryFolder(command, args) {
  const said = run(command, [...args, "env"]);
  return join(/"?lib_dir"?\s*[:=]\s*"([^"]+)"/.exec(said)?.[1] ?? "", "libc");
}

function licences(folders, libc) {
  const parts = clones.flatMap(({ name, version, texts }, index) =>
    texts.map((text) => [`${name} ${version}`, readFileSync(join(folders[index], text), "utf8")]),
  );
  for (const [name, file] of [
    ["wasi-libc", "wasi/LICENSE-MIT"],
    ["musl", "musl/COPYRIGHT"],
    ["Zig's runtime library", "../../LICENSE"],
  ]) {
    parts.push([name, readFileSync(join(libc, file), "utf8")]);
  }
  const head = `unpacker.wasm holds code of what follows. Files of libarchive in it, beside those of its authors, are\n${copyrights(folders[0])}`;
  const texts = parts.map(
    ([title, text]) => `${title}\n${"=".repeat(title.length)}\n\n${text.trim()}\n`,
  );
  return [head, ...texts].join("\n\n");
}

/** The lines of copyright of libarchive's files, which are under its licence, each once. */
function copyrights(archive) {
  const lines = archiveFiles.flatMap((name) => {
    const [comment] = readFileSync(join(archive, name), "utf8").split("*/", 1);
    return comment.match(/Copyright .*/g) ?? [];
  });
  return [...new Set(lines)].sort().join("\n");
}

function fail(sentence) {
  console.error(sentence);
  process.exit(1);
}

if (process.argv[2] === "--verify") {
  const { sources, wasm: hash } = JSON.parse(readFileSync(stamp, "utf8"));
  if (sources !== sourcesHash()) {
    fail("unpacker.wasm is older than its sources; run `make unpacker` and commit the result.");
  }
  if (hash !== sha256(readFileSync(wasm)))
    fail("unpacker.wasm is not the file that its stamp names.");
  console.log("unpacker.wasm matches its stamp");
} else build();
