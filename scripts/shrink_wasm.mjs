import binaryen from "binaryen";
import { clearLocations } from "./clear_locations.mjs";
import { withoutDeadData } from "./dead_data.mjs";

/**
 * What runs once Rust has decided to panic, by the names that the compiler
 * gives it: it would put a sentence together that nobody sees, as WASM has
 * nowhere to print it, and then trap.
 */
const panics =
  /4core9panicking|3std9panicking|rust_begin_unwind|slice_(error|index)_fail|(unwrap|expect)_failed|len_mismatch_fail|assert_failed|capacity_overflow|handle_alloc_error|7raw_vec12handle_error/;

/**
 * Takes quarter turns off an angle of more than a million radians, at length. No
 * leaf has one; the angle left is 0 then.
 */
const hugeAngles = /rem_pio2_large/;

/** A square root in software: the machine's is exact to the last bit as well. */
const softRoot = /4libm4math(7generic)?4sqrt4sqrt/;

/**
 * Machine code as small as it can be made without slowing it: panics trap at
 * once, and what they would have said goes with them. The same bytes always
 * give the same.
 *
 * @param {Uint8Array} wasm with the names of its functions and the linker's relocations
 * @returns {Uint8Array} without names
 */
export function shrinkWasm(wasm) {
  const isDead = (name) => [panics, hugeAngles, softRoot].some((kind) => kind.test(name));
  const module = binaryen.readBinary(clearLocations(withoutDeadData(wasm, isDead)));
  module.setFeatures(binaryen.Features.SIMD128 | module.getFeatures());
  for (let i = 0; i < module.getNumFunctions(); i++) {
    const known = module.getFunctionByIndex(i);
    const { name } = binaryen.getFunctionInfo(known);
    if (panics.test(name)) binaryen.Function(known).body = module.unreachable();
    if (softRoot.test(name)) {
      binaryen.Function(known).body = module.f64.sqrt(module.local.get(0, binaryen.f64));
    }
    if (hugeAngles.test(name)) binaryen.Function(known).body = module.i32.const(0);
  }
  // Only formatting takes functions by their address, and only panics format.
  while (module.getNumElementSegments() > 0) {
    module.removeElementSegment(
      binaryen.getElementSegmentInfo(module.getElementSegmentByIndex(0)).name,
    );
  }
  for (const unused of ["__data_end", "__heap_base"]) module.removeExport(unused);
  binaryen.setOptimizeLevel(3);
  binaryen.setShrinkLevel(2);
  // The compiler has inlined what is worth it for speed.
  binaryen.setAlwaysInlineMaxSize(1);
  binaryen.setFlexibleInlineMaxSize(1);
  binaryen.setOneCallerInlineMaxSize(1);
  binaryen.setDebugInfo(false);
  // Once trapping is inlined, arguments that only panics used are found unused.
  for (let round = 0; round < 2; round++) module.optimize();
  module.runPasses(["strip-producers", "strip-target-features"]);
  if (/call_indirect/.test(module.emitText())) {
    throw new Error("what the viewer calls formats text or takes functions by address: let it not");
  }
  if (!module.validate()) throw new Error("binaryen made machine code that is not valid");
  const shrunk = module.emitBinary();
  module.dispose();
  return shrunk;
}
