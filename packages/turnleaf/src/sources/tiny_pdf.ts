/** The contents of a tiny PDF; for tests only. */
export interface TinyPdf {
  /** A content stream a page, in points of a page 200 wide and 300 high. */
  readonly pages: readonly string[];
  /** Entries of the catalog, such as `/Lang (en)`. */
  readonly catalog?: string;
  /** Entries of the pages' resources. */
  readonly resources?: string;
  /** Further objects, numbered from 10 on. */
  readonly objects?: readonly string[];
  /** Entries of the document's information. */
  readonly info?: string;
  readonly mediaBox?: string;
  /** Entries of the tree of pages, which are the objects 10, 12 and so on, or come after `objects`. */
  readonly tree?: string;
  /** Entries of each page, which may have other contents. */
  readonly entries?: readonly string[];
}

/** Builds a small and valid PDF, each byte a character of latin-1. */
export function tinyPdf(pdf: TinyPdf): Uint8Array<ArrayBuffer> {
  const first = 10 + (pdf.objects?.length ?? 0);
  const kids = pdf.pages.map((_, i) => `${first + 2 * i} 0 R`).join(" ");
  const objects = new Map<number, string>([
    [1, `<< /Type /Catalog /Pages 2 0 R ${pdf.catalog ?? ""} >>`],
    [2, `<< /Type /Pages ${pdf.tree ?? `/Count ${pdf.pages.length} /Kids [${kids}]`} >>`],
    [3, `<< ${pdf.info ?? ""} >>`],
  ]);
  pdf.objects?.forEach((object, i) => {
    objects.set(10 + i, object);
  });
  pdf.pages.forEach((content, i) => {
    const number = first + 2 * i;
    const box = pdf.mediaBox ?? "[0 0 200 300]";
    const resources = `/Resources << ${pdf.resources ?? ""} >>`;
    const entries = pdf.entries?.[i] ?? "";
    const contents = entries.includes("/Contents") ? "" : `/Contents ${number + 1} 0 R`;
    objects.set(
      number,
      `<< /Type /Page /Parent 2 0 R /MediaBox ${box} ${resources} ${contents} ${entries} >>`,
    );
    objects.set(number + 1, `<< /Length ${content.length} >>\nstream\n${content}\nendstream`);
  });
  return latin1(write(objects));
}

function write(objects: ReadonlyMap<number, string>): string {
  const size = [...objects.keys()].reduce((most, number) => Math.max(most, number), 0) + 1;
  const offsets = new Array<number>(size).fill(0);
  let text = "%PDF-1.7\n";
  for (const [number, object] of objects) {
    offsets[number] = text.length;
    text += `${number} 0 obj\n${object}\nendobj\n`;
  }
  const entry = (offset: number): string =>
    offset === 0 ? "0000000000 65535 f \n" : `${String(offset).padStart(10, "0")} 00000 n \n`;
  const start = text.length;
  const trailer = `trailer\n<< /Size ${size} /Root 1 0 R /Info 3 0 R >>\n`;
  return `${text}xref\n0 ${size}\n${offsets.map(entry).join("")}${trailer}startxref\n${start}\n%%EOF\n`;
}

/** Returns text of latin-1 as bytes. Text may have millions of letters, so it is not read by its code points. */
export function latin1(text: string): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < bytes.length; k++) bytes[k] = text.charCodeAt(k);
  return bytes;
}

/** An image of 16 by 16 pixels, all of them 200, 30, 30. */
const jp2 = atob(
  "AAAADGpQICANCocKAAAAFGZ0eXBqcDIgAAAAAGpwMiAAAAAtanAyaAAAABZpaGRyAAAAEAAAABAAAwcHAAAAAAAPY29scgEAAAAAABAAAACtanAyY/9P/1EALwAAAAAAEAAAABAAAAAAAAAAAAAAABAAAAAQAAAAAAAAAAAAAwcBAQcBAQcBAf9SAAwAAAABAAQEBAAB/1wAEEBASEhQSEhQSEhQSEhQ/2QAJQABQ3JlYXRlZCBieSBPcGVuSlBFRyB2ZXJzaW9uIDIuNS40/5AACgAAAAAAKQAB/5PPtAgET8+0CAifz7QICJ+AgICAgICAgICAgID/2Q==",
);

/** A page that is one image in JPEG 2000, of the colour 200, 30, 30. */
export const jpeg2000: TinyPdf = {
  pages: ["200 0 0 300 0 0 cm /I Do"],
  resources: "/XObject << /I 10 0 R >>",
  objects: [
    `<< /Type /XObject /Subtype /Image /Width 16 /Height 16 /Filter /JPXDecode /Length ${jp2.length} >>\nstream\n${jp2}\nendstream`,
  ],
};
