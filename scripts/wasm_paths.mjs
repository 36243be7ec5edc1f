/** A path from a root, of two names or more: /home/me, C:\Users\me. */
const absolutePath = /(?:\/[\w.+@-]{2,}){2,}|\b[A-Z]:(?:\\[\w .+@-]{2,}){2,}/g;

/**
 * Returns the absolute paths that machine code holds, which say where it was built.
 *
 * @param {Uint8Array} wasm
 * @returns {string[]}
 */
export function absolutePaths(wasm) {
  const text = Buffer.from(wasm).toString("latin1");
  return text.match(absolutePath) ?? [];
}
