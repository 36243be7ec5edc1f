/** Kindle books: MOBI and KF8 (AZW3), set by `FlowSource`. */

import { cleanLanguage } from "../book_text.ts";
import { unknownFailure } from "../failures.ts";
import { limits } from "../limits.ts";
import { BookError, type PageSource, type Typography } from "../page_source.ts";
import type { FlowBook } from "../typeset/flow_book.ts";
import { FlowSource } from "../typeset/flow_source.ts";
import { isRightToLeft } from "../typeset/writing_direction.ts";
import { warningOf } from "../warnings.ts";
import { readIndex } from "./index_table.ts";
import { openKf8 } from "./kf8.ts";
import { type KindleHeader, readHeader } from "./kindle_header.ts";
import { KindleResources } from "./kindle_resources.ts";
import { type KindleParts, plainText } from "./kindle_text.ts";
import { openMobi6 } from "./mobi6.ts";
import { damaged, PalmDatabase } from "./palm_database.ts";
import { type ReadRecord, readText, recordLength } from "./text_records.ts";

/** Opens a Kindle book. Rejects with a `BookError`. */
export async function openKindle(
  file: Blob,
  name: string,
  typography?: Typography,
): Promise<PageSource> {
  try {
    return await FlowSource.open(await readKindle(file, name), typography);
  } catch (error) {
    throw unknownFailure(
      `${name} is damaged or no Kindle book`,
      error,
      "repair it or get it again",
      { code: "damaged", source: name },
    );
  }
}

async function readKindle(file: Blob, name: string): Promise<FlowBook> {
  const database = await PalmDatabase.open(file, name);
  const first = readHeader(await database.record(0, recordLength));
  if (!first) throw damaged(name);
  const { start, header: own } = await newestPart(database, first);
  if (first.isEncrypted || own.isEncrypted) {
    throw new BookError(
      `${name} is protected against copying (DRM); open it in its shop's reader.`,
      { code: "copyProtected", source: name },
    );
  }
  const read: ReadRecord = (index) => database.record(start + index, recordLength);
  const tooLong = (): BookError => {
    const megabytes = Math.floor(limits.markupBytes / 1e6);
    return new BookError(`${name} has more than ${megabytes} MB of text; split it.`, {
      code: "tooLarge",
      source: name,
    });
  };
  const text = await readText(own, read, name, tooLong);
  const resources = new KindleResources((index, most) =>
    database.record(first.firstResource + index, most),
  );
  // A cover that is not there covers nothing.
  const isCoverLost = own.cover !== null && (await resources.data(own.cover)) === null;
  const header = isCoverLost ? { ...own, cover: null } : own;
  const parts: KindleParts = {
    name,
    header,
    text,
    resources,
    read,
    table: (record) => readIndex(record, read, header.encoding, name),
  };
  const { sections, outline, resolve, isCovered } = await (header.version >= 8
    ? openKf8
    : openMobi6)(parts);
  if (sections.length === 0)
    throw new BookError(`${name} has no text; get it again.`, { code: "empty", source: name });
  const language = cleanLanguage(header.language);
  return {
    name,
    title: plainText(header.title) || name,
    language,
    direction: header.direction === "rtl" || isRightToLeft(language) ? "rtl" : "ltr",
    details: header.authors.map((author) => ({ label: "", value: plainText(author) })),
    ...(isCovered === undefined ? {} : { cover: isCovered ? "picture" : "stamped" }),
    warnings: isCoverLost ? [warningOf("image", "cover", name)] : [],
    sections,
    outline,
    asksToLeave: true,
    resolve: (_section, href) => resolve(href),
    file: async () => new Blob([file], { type: "application/x-mobipocket-ebook" }),
    close: () => {},
  };
}

/** Returns the book of KF8 in a file that has one of MOBI before it; otherwise the only one. */
async function newestPart(
  database: PalmDatabase,
  first: KindleHeader,
): Promise<{ readonly start: number; readonly header: KindleHeader }> {
  const { boundary } = first;
  if (boundary !== null) {
    const second = await database.record(boundary, recordLength).then(readHeader, () => null);
    if (second && second.version >= 8) return { start: boundary, header: second };
  }
  return { start: 0, header: first };
}
