/**
 * Returns the bytes of parts one after another. A `Blob` of them would have all of them once more, in
 * another process.
 *
 * @param length of all parts
 */
export function joinBytes(parts: readonly Uint8Array[], length: number): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(length);
  let offset = 0;
  for (const part of parts) {
    bytes.set(part, offset);
    offset += part.length;
  }
  return bytes;
}
