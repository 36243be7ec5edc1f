/** Text of four bytes a character (UTF-32), which browsers do not read. */

/** Characters that are put together at a time: a call takes no more arguments. */
const atOnce = 4096;

/** The mark of byte order, and the last character that there is. */
const [mark, last] = [0xfeff, 0x10ffff];

/** Returns whether bytes begin as UTF-32, with a mark or a letter of ASCII; null if they do not. */
export function utf32Order(bytes: Uint8Array): "big" | "little" | null {
  if (bytes.length < 4) return null;
  const [a = 0, b = 0, c = 0, d = 0] = bytes;
  const isLetter = (byte: number): boolean => byte > 0 && byte < 0x80;
  if (a === 0 && b === 0 && ((c === 0xfe && d === 0xff) || (c === 0 && isLetter(d)))) return "big";
  const isLittle = c === 0 && d === 0 && ((a === 0xff && b === 0xfe) || (b === 0 && isLetter(a)));
  return isLittle ? "little" : null;
}

/** Returns text of UTF-32; what is no character becomes U+FFFD. */
export function decodeUtf32(bytes: Uint8Array, order: "big" | "little"): string {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length - (bytes.length % 4));
  const parts: string[] = [];
  for (let from = 0; from < view.byteLength; from += 4 * atOnce) {
    const codes: number[] = [];
    for (let at = from; at < Math.min(from + 4 * atOnce, view.byteLength); at += 4) {
      const code = view.getUint32(at, order === "little");
      const isNone = code > last || (code >= 0xd800 && code < 0xe000);
      if (at > 0 || code !== mark) codes.push(isNone ? 0xfffd : code);
    }
    parts.push(String.fromCodePoint(...codes));
  }
  return parts.join("");
}
