import { expectBytes } from "./src/engine/machine_code.ts";

/** Machine code packed as `unpackCode` unpacks it. Any bytes can be packed, but none as well. */
export async function packCode(bytes) {
  const start = startOfFunctions(bytes);
  const head = Buffer.alloc(8);
  head.writeUInt32LE(bytes.length, 0);
  head.writeUInt32LE(start, 4);
  const packed = [...head];
  let [low, high, at] = [0, 2 ** 32 - 1, 0];
  await expectBytes(bytes.length, start, (odds) => {
    const bit = (bytes[at >> 3] >> (7 - (at & 7))) & 1;
    at++;
    const middle = low + Math.floor((high - low) * odds);
    if (bit === 1) high = middle;
    else low = middle + 1;
    while ((low ^ high) >>> 24 === 0) {
      packed.push(low >>> 24);
      low = (low << 8) >>> 0;
      high = ((high << 8) | 255) >>> 0;
    }
    return bit;
  });
  const end = Buffer.alloc(4);
  end.writeUInt32BE(low);
  return Uint8Array.from([...packed, ...end]);
}

/** Where the first function of a WASM module begins: its length; the end where there is none. */
function startOfFunctions(bytes) {
  let at = 8;
  const number = () => {
    let [value, shift] = [0, 0];
    do {
      value |= (bytes[at] & 127) << shift;
      shift += 7;
    } while (bytes[at++] & 128);
    return value >>> 0;
  };
  while (at < bytes.length) {
    const section = bytes[at++];
    const length = number();
    if (section === 10) {
      number();
      return at;
    }
    at += length;
  }
  return bytes.length;
}
