/**
 * Formats of files that are not opened, so that a sentence says what a file is and what to do. Loaded when
 * a file cannot be opened. It imports nothing of a browser, as the command reads it too.
 */

import {
  at,
  brandsOf,
  type FileFormat,
  type FileStart,
  formatOfFile,
  listFormats,
  pointer,
} from "./formats.ts";

/** Why a file is not opened, as the end of a sentence about it. */
export type Rejection = Required<Pick<FileFormat, "reason" | "remedy">>;

type Test = NonNullable<FileFormat["is"]>;

const row = (is: Test, reason: string, remedy: string): FileFormat => ({
  ...{ kind: "unread", type: "application/octet-stream", is, reason, remedy },
});

/** Returns the row of a book or a document. */
const document = (name: string, remedy: string, is: Test): FileFormat =>
  row(is, `is ${name}, which is not read`, remedy);

/** Returns the row of an image. */
const picture = (name: string, is: Test): FileFormat =>
  row(is, `is an image in ${name}, which cannot be shown`, "save it as PNG or JPEG");

/** Returns the row of an archive. */
const archive = (name: string, ...marks: readonly [offset: number, mark: string]): FileFormat =>
  row(at(...marks), `is packed by ${name}, which is not unpacked here`, "unpack it first");

const textOf =
  (pattern: RegExp): Test =>
  ({ words }) =>
    pattern.test(words);

const [toPdf, toEpub] = ["save it as PDF", "convert it to EPUB"] as const;

/** Returns a test for one of several marks at the beginning. */
const starts = (...marks: readonly string[]): Test => at(0, ...marks);

/** The name of a file that was cut into several, which are numbered. */
const partOfCut = /\.\d{3}$/;
const cutReason = "is, by its name, one part of a file that was cut into several";

const unread: readonly FileFormat[] = [
  document("a Rich Text document (RTF)", toPdf, textOf(/^\{\\rtf/)),
  document("PostScript (PS, EPS)", "convert it to PDF", starts("%!", "\x04%!", "\xc5\xd0\xd3\xc6")),
  row(
    textOf(/<(?:\w+:)?fulfillmentToken[\s>]/),
    "is a token by which Adobe's programs fetch a book (ACSM), not the book",
    "open a book that is not protected",
  ),
  row(
    textOf(pointer),
    "is what leads to a file (as URL, WEBLOC and TORRENT do), not the file",
    "fetch that with the program that opens this one, and open it here",
  ),
  row(textOf(/^</), "is XML of a kind that is not read", "open a book"),
  document("a document of Office (such as DOC)", toPdf, starts("\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1")),
  document("a document of WordPerfect", toPdf, starts("\xffWPC")),
  document("a document of InDesign", toPdf, starts("\x06\x06\xed\xf5")),
  document("a DjVu document", "convert it to PDF", starts("AT&TFORM")),
  document("a book of Microsoft Reader (LIT)", toEpub, starts("ITOLITLS")),
  document("compiled HTML help (CHM)", toEpub, starts("ITSF")),
  document("a book of Sony's readers (LRF)", toEpub, starts("L\0R\0F\0")),
  document("a Kindle book in Topaz", toEpub, starts("TPZ")),
  document("a Kindle book in KFX", toEpub, starts("CONT\x02\0")),
  row(
    starts("\xeaDRMION\xee"),
    "is a Kindle book that is protected (DRM)",
    "open a book that is not protected",
  ),
  document("a book of a Palm", toEpub, at(60, "PNRdPPrs", "DataPlkr", "zTXTGPlm", "ToGoToGo")),
  picture("Photoshop's format (PSD)", starts("8BPS\0")),
  picture("GIMP's format (XCF)", starts("gimp xcf")),
  // A Targa has no list of colours where an icon has the number of its images.
  picture("Targa (TGA)", (file) => {
    const [, , kind = 0] = file.start;
    return [2, 3, 10, 11].includes(kind) && at(3, "\0\0\0\0\0")(file);
  }),
  picture("the format of icons (ICO, ICNS)", starts("\0\0\x01\0", "\0\0\x02\0", "icns")),
  picture("PNM (PBM, PGM, PPM)", ({ text }) => /^P[1-7]\s/.test(text)),
  picture(
    "PCX",
    ({ start: [mark, version = 6, packing] }) => mark === 10 && version < 6 && packing === 1,
  ),
  picture("QOI", starts("qoif")),
  picture("DDS", starts("DDS ")),
  picture("OpenEXR", starts("\x76\x2f\x31\x01")),
  picture("Radiance HDR", starts("#?RADIANCE", "#?RGBE")),
  picture("JPEG XR", starts("II\xbc")),
  picture("JBIG2", starts("\x97JB2\r\n\x1a\n")),
  picture("a Windows metafile (WMF, EMF)", (file) =>
    [at(0, "\xd7\xcd\xc6\x9a"), at(40, " EMF")].some((is) => is(file)),
  ),
  picture("a camera's raw format", (file) =>
    [starts("FUJIFILM"), at(4, "ftypcrx ")].some((is) => is(file)),
  ),
  row(
    (file) =>
      brandsOf(file).length > 0 ||
      starts("RIFF")(file) ||
      starts("\x1aE\xdf\xa3", "OggS", "ID3", "\xff\xfb", "\xff\xf3", "fLaC", "FLV\x01")(file) ||
      starts("\0\0\x01\xba", "\0\0\x01\xb3", "\x30\x26\xb2\x75", "MThd")(file),
    "is a sound or a film, and has no pages",
    "open a book",
  ),
  row(
    starts("MZ", "\x7fELF", "\xcf\xfa\xed\xfe", "\xfe\xed\xfa", "\xca\xfe\xba\xbe"),
    "is a program",
    "if it unpacks a book, open what it unpacks",
  ),
  row(
    starts("\0\x01\0\0\0", "OTTO\0", "true\0", "ttcf\0", "wOFF", "wOF2"),
    "is a font",
    "open a book",
  ),
  row(starts("SQLite format 3\0"), "is a database (SQLite)", "open a book"),
  row(
    starts("\0\x05\x16\x07", "\0\x05\x16\0"),
    "is what a Mac keeps beside a file, not the file itself",
    "open the file of this name without ._ at its beginning",
  ),
  row(starts("L\0\0\0\x01\x14\x02\0"), "is a shortcut to a file", "open the file itself"),
  row(
    ({ name = "" }) => partOfCut.test(name),
    cutReason,
    "join its parts in order, and open the whole",
  ),
  row(
    ({ name = "" }) => /\.[rz]\d\d$/i.test(name),
    "is, by its name, one part of an archive in several",
    "unpack all its parts together, and pack them as one",
  ),
  archive("ACE (as CBA)", 7, "**ACE**"),
  archive("LHA", 2, "-lh"),
  archive("ARJ", 0, "\x60\xea"),
  archive("CAB", 0, "MSCF\0"),
  archive("StuffIt", 0, "StuffIt"),
  archive("lzip", 0, "LZIP"),
  archive("LZ4", 0, "\x04\x22\x4d\x18"),
  archive("LZMA", 0, "\x5d\0\0"),
  archive("compress (Z)", 0, "\x1f\x9d"),
];

/**
 * Returns the end of a sentence about a file that cannot be read, if by its name it is a part of one that was
 * cut, as `book.zip.001`; null for any other.
 */
export function joiningOf(name: string): string | null {
  if (!partOfCut.test(name)) return null;
  const whole = name.replace(partOfCut, "");
  return `${cutReason}; join them in order (by "cat ${whole}.* > ${whole}", on Windows by "copy /b ${whole}.* ${whole}"), and open ${whole}.`;
}

/**
 * Returns what a file is that is not opened, and what to do about it, by its first bytes.
 *
 * @param readable what can be read, for a sentence
 */
export function rejectionOf(file: FileStart, readable: string = listFormats()): Rejection {
  const known = formatOfFile(file);
  const found = known && known.kind !== "unread" ? known : (formatOfFile(file, unread) ?? known);
  const { reason = "is of an unknown format", remedy = `${readable} can be read` } = found ?? {};
  return { reason, remedy };
}
