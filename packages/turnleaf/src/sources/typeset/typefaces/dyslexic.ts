/** OpenDyslexic: its letters are heavy at the foot, for readers with dyslexia. */

import regularItalic from "packed:@fontsource/opendyslexic/files/opendyslexic-latin-400-italic.woff2";
import regular from "packed:@fontsource/opendyslexic/files/opendyslexic-latin-400-normal.woff2";
import boldItalic from "packed:@fontsource/opendyslexic/files/opendyslexic-latin-700-italic.woff2";
import bold from "packed:@fontsource/opendyslexic/files/opendyslexic-latin-700-normal.woff2";
import { file, type TypefaceFile } from "./files.ts";

/** Its files. */
export const files: readonly TypefaceFile[] = [
  file(regular, 400, "normal"),
  file(regularItalic, 400, "italic"),
  file(bold, 700, "normal"),
  file(boldItalic, 700, "italic"),
];
