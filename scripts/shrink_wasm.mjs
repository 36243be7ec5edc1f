import binaryen from "binaryen";
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

/**
 * Zeroes the places in the sources that panics name, which pack to nothing
 * then: records of four words in the data (address and length of a file's name,
 * line, column) whose name ends in ".rs", and these names.
 */
function clearLocations(wasm) {
  const bytes = Buffer.from(wasm);
  const segments = dataSegments(bytes);
  const offsetOf = (address) => {
    const of = segments.find((s) => address >= s.address && address < s.address + s.length);
    return of && of.offset + address - of.address;
  };
  const names = [];
  for (const { address, offset, length } of segments) {
    for (let at = offset + (-address & 3); at + 16 <= offset + length; at += 4) {
      const [name, letters, line, column] = [0, 4, 8, 12].map((k) => bytes.readUInt32LE(at + k));
      if (letters < 4 || letters > 200 || line > 1e5 || column > 1e3) continue;
      const start = offsetOf(name);
      if (start && bytes.toString("latin1", start, start + letters).endsWith(".rs")) {
        names.push([start, letters]);
        bytes.fill(0, at, at + 16);
      }
    }
  }
  for (const [start, letters] of names) bytes.fill(0, start, start + letters);
  return bytes;
}

/** Where active data lies: its address in memory, and its offset and length in the file. */
function dataSegments(bytes) {
  let at = 8;
  const number = () => {
    let [value, shift, byte] = [0, 0, 0];
    do {
      byte = bytes[at++];
      value |= (byte & 127) << shift;
      shift += 7;
    } while (byte & 128);
    return value >>> 0;
  };
  const found = [];
  while (at < bytes.length) {
    const section = bytes[at++];
    const length = number();
    const end = at + length;
    if (section === 11) {
      for (let count = number(); count > 0; count--) {
        // Flags 0 (active, memory 0), then an address as i32.const ... end.
        const plain = number() === 0 && bytes[at++] === 0x41;
        const address = number();
        if (!plain || bytes[at++] !== 0x0b) throw new Error("data of a kind that Rust never wrote");
        const size = number();
        found.push({ address, offset: at, length: size });
        at += size;
      }
    }
    at = end;
  }
  return found;
}
