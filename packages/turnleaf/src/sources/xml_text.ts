/** Bytes of XML documents and style sheets as text. */

/** An encoding as a document declares it: in XML, in a style sheet, and as web pages do. */
const declaration =
  /^(?:\xef\xbb\xbf)?\s*(?:<\?xml[^>]{0,200}\bencoding\s*=\s*["']|@charset ")([\w:.-]{1,40})/;

/** Bytes in which a declaration is looked for. */
const headLength = 300;

/** Encodings of bytes below 128, in which the others are no UTF-8. */
const sevenBit = /^iso-2022-/;

/**
 * Returns the text of an XML document or a style sheet. Its bytes say in which encoding it is; what it
 * declares is asked where they do not, as many declare one that they were converted from.
 */
export function decodeXml(bytes: Uint8Array): string {
  const wide = wideEncoding(bytes);
  if (wide) return new TextDecoder(wide).decode(bytes);
  const declared = declaredEncoding(bytes);
  if (sevenBit.test(declared)) return new TextDecoder(declared).decode(bytes);
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    // One damaged byte of UTF-8 is one letter.
    return new TextDecoder(declared || "utf-8").decode(bytes);
  }
}

/** Returns the encoding of bytes that are two a character; null for others. */
function wideEncoding([first, second, third]: Uint8Array): string | null {
  if (first === 0xfe && second === 0xff) return "utf-16be";
  if (first === 0xff && second === 0xfe) return "utf-16le";
  // Without a mark, "<" tells.
  if (first === 0 && second === 0x3c) return "utf-16be";
  return first === 0x3c && second === 0 && third !== 0 ? "utf-16le" : null;
}

/** Returns the encoding that a document of one byte a character, or more, declares; "" if none is known. */
function declaredEncoding(bytes: Uint8Array): string {
  const head = String.fromCharCode(...bytes.subarray(0, headLength));
  try {
    const { encoding } = new TextDecoder(declaration.exec(head)?.[1] ?? "x-none");
    // Its declaration could not be read if it were.
    return encoding.startsWith("utf-16") ? "" : encoding;
  } catch {
    return "";
  }
}
