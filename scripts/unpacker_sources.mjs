/** What packages/turnleaf/src/sources/archive/unpacker/unpacker.wasm is made of. */

/** The clones it is built from, each at one commit. An environment variable may name a clone that is at hand. */
export const clones = [
  {
    name: "libarchive",
    version: "3.8.9",
    licence: "BSD-2-Clause",
    url: "https://github.com/libarchive/libarchive",
    commit: "27cbc7827172698143e440801fc0ba39ccb4f1f5",
    variable: "LIBARCHIVE",
    texts: ["COPYING"],
  },
  {
    name: "liblzma",
    version: "5.8.3",
    licence: "0BSD",
    url: "https://github.com/tukaani-project/xz",
    commit: "4b73f2ec19a99ef465282fbce633e8deb33691b3",
    variable: "XZ",
    texts: ["COPYING.0BSD"],
  },
];

/** The C compiler, with the C library that comes with it: the Python package `ziglang`. */
export const zig = "0.17.0";

/** What the compiler puts in. */
export const libraries = [
  { name: "wasi-libc", version: `of zig ${zig}`, licence: "MIT" },
  { name: "Zig's runtime library", version: `of zig ${zig}`, licence: "MIT" },
  { name: "musl", version: `of zig ${zig}`, licence: "MIT" },
];
