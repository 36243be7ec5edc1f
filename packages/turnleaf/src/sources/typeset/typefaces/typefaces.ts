/** The typefaces that come with the package, openly licensed: each is loaded when it is first chosen. */

import { unpack } from "../../../packed.ts";
import { dataUrl } from "../../data_url.ts";
import { loadPart } from "../../load_part.ts";
import { loadedOnce } from "../../loaded_once.ts";
import type { Typography } from "../../page_source.ts";
import { serif } from "../serif.ts";
import type { TypefaceFile } from "./files.ts";

/** The names of all. */
export const typefaceNames = ["legible", "dyslexic"] as const;

/** The name of one. */
export type TypefaceName = (typeof typefaceNames)[number];

/** What loads the files of each. */
const typefaces: Readonly<
  Record<TypefaceName, () => Promise<{ readonly files: readonly TypefaceFile[] }>>
> = {
  legible: () => import("./legible.ts"),
  dyslexic: () => import("./dyslexic.ts"),
};

/** Returns whether the package has a typeface of this name. */
export function isTypeface(name: string): name is TypefaceName {
  return Object.hasOwn(typefaces, name);
}

/** Returns the name of one in style sheets, which no font of the reader's own has. */
export function familyOf(name: TypefaceName): string {
  return `turnleaf-${name}`;
}

/** Returns what text is set in by a reader's choice, as CSS has it, with what stands in for letters that are missing. */
export function stackOf(font: Typography["font"]): string {
  if (font === "") return serif;
  return isTypeface(font) ? `${familyOf(font)}, sans-serif` : font;
}

/** A font file's bytes, and what it is for. */
export interface TypefaceFont extends Omit<TypefaceFile, "packed"> {
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** Returns the fonts of a typeface. Rejects with a `BookError` if they cannot be loaded. */
export async function fontsOf(name: TypefaceName): Promise<TypefaceFont[]> {
  const { files } = await loadPart(typefaces[name]());
  return await Promise.all(
    files.map(async ({ packed, ...font }) => ({ ...font, bytes: await unpack(packed) })),
  );
}

/** Returns the style sheet that has the fonts of a typeface in it. Rejects as `fontsOf` does. */
export const typefaceRules: (name: TypefaceName) => Promise<string> = loadedOnce(async (name) => {
  const fonts = await fontsOf(name);
  const made = await Promise.all(
    fonts.map(async ({ bytes, weight, style, range }) => {
      const address = await dataUrl(bytes, "font/woff2");
      return `@font-face { font-family: ${familyOf(name)}; font-weight: ${weight}; font-style: ${style}; unicode-range: ${range}; src: url(${address}) format("woff2"); }`;
    }),
  );
  return made.join("\n");
});
