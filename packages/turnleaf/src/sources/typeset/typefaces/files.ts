/** A font file of a typeface that comes with the package. */

/** A font file, packed as `unpack` reads it. */
export interface TypefaceFile {
  readonly packed: string;
  readonly weight: number;
  readonly style: "normal" | "italic";
  /** The characters for which it is used, as CSS has them. */
  readonly range: string;
}

/** Letters beyond those of Western European languages. */
export const extended =
  "U+0100-02BA,U+02BD-02C5,U+02C7-02CC,U+02CE-02D7,U+02DD-02FF,U+0304,U+0308,U+0329,U+1D00-1DBF,U+1E00-1E9F,U+1EF2-1EFF,U+2020,U+20A0-20AB,U+20AD-20C0,U+2113,U+2C60-2C7F,U+A720-A7FF";

/** Returns a file; its range is all characters by default. */
export function file(
  packed: string,
  weight: number,
  style: TypefaceFile["style"],
  range = "U+0-10FFFF",
): TypefaceFile {
  return { packed, weight, style, range };
}
