import binaryen from "binaryen";
import { clearLocations } from "./clear_locations.mjs";

/**
 * Machine code with loose leaves alone: the functions of books go, and what only
 * they use. Unlike the viewer's it may format text, as a leaf that cannot be made
 * says why. The same bytes always give the same.
 *
 * @param {Uint8Array} wasm with the exports of books and of leaves
 * @returns {Uint8Array} without names
 */
export function onlyLeaves(wasm) {
  const module = binaryen.readBinary(clearLocations(withoutCustomSections(wasm)));
  const { SIMD128, BulkMemory, SignExt, MutableGlobals } = binaryen.Features;
  const { NontrappingFPToInt, ReferenceTypes, Multivalue } = binaryen.Features;
  module.setFeatures(
    SIMD128 |
      BulkMemory |
      SignExt |
      MutableGlobals |
      NontrappingFPToInt |
      ReferenceTypes |
      Multivalue,
  );
  for (let i = module.getNumExports() - 1; i >= 0; i--) {
    const { name } = binaryen.getExportInfo(module.getExportByIndex(i));
    if (name !== "memory" && !name.startsWith("tl_leaf_")) module.removeExport(name);
  }
  binaryen.setOptimizeLevel(2);
  binaryen.setShrinkLevel(1);
  binaryen.setDebugInfo(false);
  module.optimize();
  module.runPasses(["strip-producers", "strip-target-features"]);
  if (!module.validate()) throw new Error("binaryen made machine code that is not valid");
  const shrunk = module.emitBinary();
  module.dispose();
  return shrunk;
}

/** Names, relocations and the like, which no machine runs, left out. */
function withoutCustomSections(wasm) {
  const parts = [wasm.subarray(0, 8)];
  let at = 8;
  while (at < wasm.length) {
    const start = at;
    const id = wasm[at++];
    let [length, shift, byte] = [0, 0, 0];
    do {
      byte = wasm[at++];
      length |= (byte & 127) << shift;
      shift += 7;
    } while (byte & 128);
    at += length >>> 0;
    if (id !== 0) parts.push(wasm.subarray(start, at));
  }
  return Buffer.concat(parts);
}
