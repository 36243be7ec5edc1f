/** A path from a root, of two names or more: /home/me, C:\\Users\\me. */
const absolutePath = /(?:\/[\w.+@-]{2,}){2,}|\b[A-Z]:(?:\\[\w .+@-]{2,}){2,}/g;

/** Places that are the same on every machine: by build_wasm.mjs's names for folders, or the compiler's. */
const samePlace = /(?:\/rustc\/[0-9a-f]{40}\/library|crates|engine|wasm)\/[\w.+@/-]+?\.rs/g;

/**
 * Returns the absolute paths in a WASM, which show where it was built.
 *
 * @param {Uint8Array} wasm
 * @returns {string[]}
 */
export function absolutePaths(wasm) {
  const text = Buffer.from(wasm).toString("latin1").replace(samePlace, "\0");
  return text.match(absolutePath) ?? [];
}
