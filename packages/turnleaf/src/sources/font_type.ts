/** First bytes of fonts, and their types. */
const fonts: readonly (readonly [mark: string, type: string])[] = [
  ["wOFF", "font/woff"],
  ["wOF2", "font/woff2"],
  ["OTTO", "font/otf"],
  ["\0\x01\0\0", "font/ttf"],
  ["true", "font/ttf"],
];

/** Returns the media type of a font by its first bytes; null if they are not a font's. */
export function fontType(bytes: Uint8Array): string | null {
  const head = String.fromCharCode(...bytes.subarray(0, 4));
  return fonts.find(([mark]) => head === mark)?.[1] ?? null;
}
