/** What the first bytes of RAR and 7-Zip archives say of the whole. */

/** Bytes in which `obstacleIn` finds what it looks for. */
export const marksLength = 64;

/** What keeps an archive from being read: it is one of several volumes, cut off, or encrypted. */
export type Obstacle = "volume" | "short" | "encrypted";

/** Types of headers, and flags of the archive's own: RAR 1.5 to 4, and RAR 5. */
const [rar4Main, rar4Volume, rar4Encrypted] = [0x73, 0x01, 0x80];
const [rar5Main, rar5Encryption, rar5Volume] = [1, 4, 1];

/**
 * Returns what keeps an archive from being read, by its first `marksLength`
 * bytes and its length; null if nothing is seen there.
 */
export function obstacleIn(start: Uint8Array, length: number): Obstacle | null {
  const mark = String.fromCharCode(...start.subarray(0, 8));
  if (mark.startsWith("Rar!\x1a\x07\x01\x00")) return obstacleInRar5(start);
  if (mark.startsWith("Rar!\x1a\x07\x00")) return obstacleInRar4(start);
  return mark.startsWith("7z\xbc\xaf") ? obstacleIn7z(start, length) : null;
}

function obstacleInRar4(start: Uint8Array): Obstacle | null {
  const [type, flags] = [start[9], start[10] ?? 0];
  if (type !== rar4Main) return null;
  if (flags & rar4Encrypted) return "encrypted";
  return flags & rar4Volume ? "volume" : null;
}

function obstacleInRar5(start: Uint8Array): Obstacle | null {
  let at = 12;
  /** Returns a number in groups of seven bits, the lowest first. */
  const next = (): number => {
    let value = 0;
    for (let shift = 0; shift < 35; shift += 7) {
      const byte = start[at++] ?? 0;
      value += (byte & 127) * 2 ** shift;
      if (byte < 128) break;
    }
    return value;
  };
  next();
  const [type, flags] = [next(), next()];
  if (type === rar5Encryption) return "encrypted";
  if (type !== rar5Main) return null;
  if (flags & 1) next();
  if (flags & 2) next();
  return next() & rar5Volume ? "volume" : null;
}

function obstacleIn7z(start: Uint8Array, length: number): Obstacle | null {
  if (start.length < 32) return "short";
  const view = new DataView(start.buffer, start.byteOffset, start.byteLength);
  // Where the list of files begins, behind these 32 bytes, and how long it is.
  const end = 32n + view.getBigUint64(12, true) + view.getBigUint64(20, true);
  return end > BigInt(length) ? "short" : null;
}
