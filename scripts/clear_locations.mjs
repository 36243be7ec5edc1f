/**
 * Zeroes the places in the sources that panics name, which WASM has nowhere to
 * print: records of four words in the data (address and length of a file's name,
 * line, column) whose name ends in ".rs", and these names. Zeroes pack to nothing,
 * and no folder of the machine that built the code remains.
 *
 * @param {Uint8Array} wasm
 */
export function clearLocations(wasm) {
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
