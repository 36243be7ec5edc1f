/** Atkinson Hyperlegible, of the Braille Institute: its letters are hard to take for each other. */

import regularItalic from "packed:@fontsource/atkinson-hyperlegible/files/atkinson-hyperlegible-latin-400-italic.woff2";
import regular from "packed:@fontsource/atkinson-hyperlegible/files/atkinson-hyperlegible-latin-400-normal.woff2";
import boldItalic from "packed:@fontsource/atkinson-hyperlegible/files/atkinson-hyperlegible-latin-700-italic.woff2";
import bold from "packed:@fontsource/atkinson-hyperlegible/files/atkinson-hyperlegible-latin-700-normal.woff2";
import extRegularItalic from "packed:@fontsource/atkinson-hyperlegible/files/atkinson-hyperlegible-latin-ext-400-italic.woff2";
import extRegular from "packed:@fontsource/atkinson-hyperlegible/files/atkinson-hyperlegible-latin-ext-400-normal.woff2";
import extBoldItalic from "packed:@fontsource/atkinson-hyperlegible/files/atkinson-hyperlegible-latin-ext-700-italic.woff2";
import extBold from "packed:@fontsource/atkinson-hyperlegible/files/atkinson-hyperlegible-latin-ext-700-normal.woff2";
import { extended, file, type TypefaceFile } from "./files.ts";

/** Its files. */
export const files: readonly TypefaceFile[] = [
  file(regular, 400, "normal"),
  file(regularItalic, 400, "italic"),
  file(bold, 700, "normal"),
  file(boldItalic, 700, "italic"),
  file(extRegular, 400, "normal", extended),
  file(extRegularItalic, 400, "italic", extended),
  file(extBold, 700, "normal", extended),
  file(extBoldItalic, 700, "italic", extended),
];
