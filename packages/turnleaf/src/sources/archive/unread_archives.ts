/** Documents and programs that are archives themselves and are not read, however many pictures are in them. */

/** What they are, by a file that each has, and what to do. */
const unread: readonly (readonly [file: RegExp, what: string, remedy: string])[] = [
  [/^word\/document\.xml$/, "a Word document (DOCX)", "save it as PDF"],
  [/^xl\/workbook\.(xml|bin)$/, "a table of Excel (XLSX)", "save it as PDF"],
  [/^ppt\/presentation\.xml$/, "a presentation of PowerPoint (PPTX)", "save it as PDF"],
  [/^(FixedDocSeq|FixedDocumentSequence)\.fdseq$/, "an XPS document", "convert it to PDF"],
  [/^Index\/(Document|Presentation)\.iwa$/, "a document of Pages or Keynote", "save it as PDF"],
  [/^visio\/document\.xml$/, "a drawing of Visio", "save it as PDF"],
  [/^designmap\.xml$/, "a document of InDesign (IDML)", "save it as PDF"],
  [/^maindoc\.xml$/, "a document of Krita (KRA)", "save it as PNG or PDF"],
  [/^AndroidManifest\.xml$/, "a program (APK)", "open a book"],
  [/^META-INF\/MANIFEST\.MF$/, "a program (JAR)", "open a book"],
];

/** A document of OpenDocument and the like has both: its text, and a list of what is in it. */
const openDocument = ["content.xml", "META-INF/manifest.xml"];

/** A web page that calibre packed with its pictures has both. */
const packedPage = ["index.html", "metadata.opf"];

/** Returns what an archive is that is not read, as the end of a sentence; null if it is none of these. */
export function unreadArchive(names: readonly string[]): string | null {
  const has = (all: readonly string[]): boolean => all.every((name) => names.includes(name));
  const rejection = (what: string, remedy: string): string =>
    `is ${what}, which is not read; ${remedy}.`;
  if (has(openDocument))
    return rejection("a document of LibreOffice (such as ODT)", "save it as PDF");
  if (has(packedPage))
    return rejection("a web page with its pictures (HTMLZ)", "convert it to EPUB");
  const found = unread.find(([file]) => names.some((name) => file.test(name)));
  return found ? rejection(found[1], found[2]) : null;
}
