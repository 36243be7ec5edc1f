/** Returns the text of an XML document or a style sheet, in the encoding that it declares. */
export function decodeXml(bytes: Uint8Array): string {
  return new TextDecoder(encodingOf(bytes)).decode(bytes);
}

function encodingOf(bytes: Uint8Array): string {
  if (bytes[0] === 0xfe && bytes[1] === 0xff) return "utf-16be";
  if (bytes[0] === 0xff && bytes[1] === 0xfe) return "utf-16le";
  const head = String.fromCharCode(...bytes.subarray(0, 200));
  const name = /^(?:\xef\xbb\xbf)?\s*(?:<\?xml[^>]*encoding\s*=\s*["']|@charset ")([\w-]+)/.exec(
    head,
  )?.[1];
  try {
    return name ? new TextDecoder(name).encoding : "utf-8";
  } catch {
    return "utf-8";
  }
}
