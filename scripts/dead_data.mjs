/**
 * Finds the data of machine code that nothing reads: a linker told to emit
 * relocations (wasm-ld's --emit-relocs) says which function and which datum names
 * which. The format is that of the WebAssembly tool conventions, "Object file
 * linking".
 */

/** Relocations that carry a number to be added to the address of their symbol. */
const withAddend = [3, 4, 5, 8, 9, 11];
/** Those for a type, which names no symbol, and for a function's address, which nothing calls. */
const passedOver = [1, 2, 6];

/**
 * The machine code with zeroes for the data that only dead functions name, or
 * none does, and without what the linker said.
 *
 * @param {Uint8Array} wasm linked with --emit-relocs
 * @param {(name: string) => boolean} isDead whether a function, by the name that the
 *   compiler gave it, and what it alone calls, reads nothing
 */
export function withoutDeadData(wasm, isDead) {
  const bytes = Buffer.from(wasm);
  const sections = readSections(bytes);
  const section = (name) => sections.find((section) => section.name === name);
  const symbols = readSymbols(bytes, section("linking"));
  const places = readPlaces(bytes, section(10), section(11), symbols);

  const named = new Map(symbols.map((symbol) => [symbol.key, new Set()]));
  const living = new Set(readExports(bytes, section(7)));
  for (const [relocations, { start }] of [
    [section("reloc.CODE"), section(10)],
    [section("reloc.DATA"), section(11)],
  ]) {
    for (const { offset, symbol } of readRelocations(bytes, relocations)) {
      const at = start + offset;
      const owner = places.find((place) => at >= place.start && at < place.end);
      // What has no owner is there for good.
      (owner ? named.get(owner.key) : living)?.add(symbols[symbol].key);
    }
  }

  const dead = new Set(symbols.filter(({ name }) => name && isDead(name)).map(({ key }) => key));
  // A set yields what is added while it is walked.
  for (const key of living)
    if (!dead.has(key)) for (const next of named.get(key) ?? []) living.add(next);

  for (const { key, start, end } of places) {
    if (key.startsWith("data") && !living.has(key)) bytes.fill(0, start, end);
  }
  const kept = sections.filter(({ name }) => !/^(linking|reloc\..*)$/.test(name));
  return Buffer.concat([
    bytes.subarray(0, 8),
    ...kept.map(({ from, end }) => bytes.subarray(from, end)),
  ]);
}

/** Reads numbers and names one after the other. */
class Reader {
  constructor(bytes, at) {
    this.bytes = bytes;
    this.at = at;
  }

  number() {
    let [value, shift, byte] = [0, 0, 0];
    do {
      byte = this.bytes[this.at++];
      value |= (byte & 127) << shift;
      shift += 7;
    } while (byte & 128);
    return value >>> 0;
  }

  text() {
    const length = this.number();
    this.at += length;
    return this.bytes.toString("utf8", this.at - length, this.at);
  }

  list(read) {
    return Array.from({ length: this.number() }, () => read());
  }
}

/** Sections by number, custom ones by name: where their heads and contents begin and end. */
function readSections(bytes) {
  const reader = new Reader(bytes, 8);
  const sections = [];
  while (reader.at < bytes.length) {
    const from = reader.at;
    const id = bytes[reader.at++];
    const length = reader.number();
    const start = reader.at;
    const end = start + length;
    sections.push({ name: id === 0 ? reader.text() : id, from, start, body: reader.at, end });
    reader.at = end;
  }
  return sections;
}

/** Functions, data and the rest, as relocations count them; `key` is the same for all names of one thing. */
function readSymbols(bytes, linking) {
  const reader = new Reader(bytes, linking.body);
  reader.number();
  while (bytes[reader.at++] !== 8) reader.at = reader.number() + reader.at;
  reader.number();
  return reader.list(() => {
    const kind = bytes[reader.at++];
    const flags = reader.number();
    const isDefined = (flags & 0x10) === 0;
    if (kind !== 1) {
      const index = reader.number();
      const name = kind !== 3 && (isDefined || flags & 0x40) ? reader.text() : "";
      return { key: `${kind === 0 ? "code" : kind} ${index}`, name };
    }
    const name = reader.text();
    if (!isDefined) return { key: `no data ${name}`, name };
    const [segment, offset, length] = [reader.number(), reader.number(), reader.number()];
    return { key: `data ${segment} ${offset}`, name, segment, offset, length };
  });
}

function readExports(bytes, section) {
  const reader = new Reader(bytes, section.body);
  return reader.list(() => {
    reader.text();
    const kind = bytes[reader.at++];
    return `${kind === 0 ? "code" : kind} ${reader.number()}`;
  });
}

/** Where the bytes of each function and each datum lie. */
function readPlaces(bytes, code, data, symbols) {
  const reader = new Reader(bytes, code.body);
  const functions = reader.list(() => {
    const length = reader.number();
    reader.at += length;
    return { start: reader.at - length, end: reader.at };
  });
  reader.at = data.body;
  const segments = reader.list(() => {
    // Flags 0 (active, memory 0), then an address as i32.const ... end.
    const isPlain = reader.number() === 0 && bytes[reader.at++] === 0x41;
    reader.number();
    if (!isPlain || bytes[reader.at++] !== 0x0b)
      throw new Error("data of a kind that Rust never wrote");
    const length = reader.number();
    reader.at += length;
    return reader.at - length;
  });
  return [
    ...functions.map((place, i) => ({ key: `code ${i}`, ...place })),
    ...symbols.flatMap(({ key, segment, offset, length }) => {
      if (segment === undefined) return [];
      const start = segments[segment] + offset;
      return { key, start, end: start + length };
    }),
  ];
}

function readRelocations(bytes, section) {
  const reader = new Reader(bytes, section.body);
  reader.number();
  return reader
    .list(() => {
      const kind = bytes[reader.at++];
      const [offset, symbol] = [reader.number(), reader.number()];
      if (withAddend.includes(kind)) reader.number();
      return { kind, offset, symbol };
    })
    .filter(({ kind }) => !passedOver.includes(kind));
}
