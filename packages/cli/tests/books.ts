import { deflateSync } from "node:zlib";

const crcTable = Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; k++) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c >>> 0;
});

function chunk(type: string, data: Uint8Array): Buffer {
  const body = Buffer.concat([Buffer.from(type), data]);
  let crc = 0xffffffff;
  for (const byte of body) crc = crcTable[(crc ^ byte) & 255]! ^ (crc >>> 8);
  const ends = Buffer.alloc(8);
  ends.writeUInt32BE(data.length, 0);
  ends.writeUInt32BE((crc ^ 0xffffffff) >>> 0, 4);
  return Buffer.concat([ends.subarray(0, 4), body, ends.subarray(4)]);
}

/** Returns a PNG of one shade of grey, 0 to 255. */
export function png(width: number, height: number, grey = 128): Buffer {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header[8] = 8;
  const rows = Buffer.alloc(height * (width + 1), grey);
  for (let y = 0; y < height; y++) rows[y * (width + 1)] = 0;
  return Buffer.concat([
    Buffer.from("\x89PNG\r\n\x1a\n", "latin1"),
    chunk("IHDR", header),
    chunk("IDAT", deflateSync(rows)),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}

/**
 * Returns a PNG of one colour with pale lines, as of text, and a dark mark in
 * its upper left corner.
 */
export function page(colour: readonly [number, number, number]): Buffer {
  const [width, height] = [64, 96];
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, 2], 8);
  const rows = Buffer.alloc(height * (3 * width + 1));
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const isText = x > 8 && x < 56 && y > 24 && y < 88 && y % 8 < 2;
      const isMark = x + y < 20;
      const shade = isMark ? [20, 20, 20] : isText ? [240, 240, 240] : colour;
      rows.set(shade, y * (3 * width + 1) + 1 + 3 * x);
    }
  }
  return Buffer.concat([
    Buffer.from("\x89PNG\r\n\x1a\n", "latin1"),
    chunk("IHDR", header),
    chunk("IDAT", deflateSync(rows)),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}

/** Returns a JPEG's head, of the given size and EXIF orientation: enough to read the size. */
export function jpegHead(width: number, height: number, orientation: number): Buffer {
  const app1 = Buffer.from(
    "FFE100224578696600004D4D002A00000008000101120003000000010001000000000000",
    "hex",
  );
  app1.writeUInt16BE(orientation, 28);
  const frame = Buffer.from("FFC0001108000000000301220002110103110100", "hex");
  frame.writeUInt16BE(height, 5);
  frame.writeUInt16BE(width, 7);
  return Buffer.concat([Buffer.from("FFD8", "hex"), app1, frame, Buffer.from("FFD9", "hex")]);
}

/** Returns a PDF of `pages` red pages; `padding` bytes of comment make it larger. */
export function pdf(pages = 2, title = "A Small Book", padding = 0): Buffer {
  const content = "1 0 0 rg 0 0 200 300 re f";
  const kids = Array.from({ length: pages }, (_, i) => `${5 + i} 0 R`).join(" ");
  const objects = [
    "<< /Type /Catalog /Pages 2 0 R /PageLabels << /Nums [0 << /S /r >>] >> >>",
    `<< /Type /Pages /Count ${pages} /Kids [${kids}] >>`,
    `<< /Title (${title}) >>`,
    `<< /Length ${content.length} >>\nstream\n${content}\nendstream`,
    ...Array(pages).fill("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 200 300] /Contents 4 0 R >>"),
  ];
  let text = `%PDF-1.7\n%${"x".repeat(padding)}\n`;
  const entries = objects.map((object, i) => {
    const offset = text.length;
    text += `${i + 1} 0 obj\n${object}\nendobj\n`;
    return `${String(offset).padStart(10, "0")} 00000 n \n`;
  });
  const size = objects.length + 1;
  const trailer = `trailer\n<< /Size ${size} /Root 1 0 R /Info 3 0 R >>`;
  const table = `xref\n0 ${size}\n0000000000 65535 f \n${entries.join("")}`;
  return Buffer.from(`${text}${table}${trailer}\nstartxref\n${text.length}\n%%EOF\n`, "latin1");
}

/** Returns a PDF with lines of text on each page. Parentheses and backslashes are the PDF's own. */
export function textPdf({
  title,
  author = "",
  pages,
}: {
  title: string;
  author?: string;
  pages: readonly string[][];
}): Buffer {
  const font =
    "<< /Type /Font /Subtype /Type1 /BaseFont /Times-Roman /Encoding /WinAnsiEncoding >>";
  const resources = `<< /Font << /F 4 0 R >> >>`;
  const kids = pages.map((_, k) => `${5 + 2 * k} 0 R`).join(" ");
  const objects = [
    "<< /Type /Catalog /Pages 2 0 R >>",
    `<< /Type /Pages /Count ${pages.length} /Kids [${kids}] >>`,
    `<< /Title (${title}) /Author (${author}) >>`,
    font,
    ...pages.flatMap((lines, k) => {
      const shown = lines.map((line) => `(${line}) Tj T*`).join(" ");
      const content = `BT /F 14 Tf 18 TL 30 340 Td ${shown} ET`;
      return [
        `<< /Type /Page /Parent 2 0 R /MediaBox [0 0 280 400] /Contents ${6 + 2 * k} 0 R /Resources ${resources} >>`,
        `<< /Length ${content.length} >>\nstream\n${content}\nendstream`,
      ];
    }),
  ];
  return pdfOf(objects);
}

/** Returns a PDF of objects: the first is its catalogue, the third its information. */
export function pdfOf(objects: readonly string[]): Buffer {
  let text = "%PDF-1.7\n";
  const entries = objects.map((object, k) => {
    const offset = text.length;
    text += `${k + 1} 0 obj\n${object}\nendobj\n`;
    return `${String(offset).padStart(10, "0")} 00000 n \n`;
  });
  const size = objects.length + 1;
  const table = `xref\n0 ${size}\n0000000000 65535 f \n${entries.join("")}`;
  const trailer = `trailer\n<< /Size ${size} /Root 1 0 R /Info 3 0 R >>`;
  return Buffer.from(`${text}${table}${trailer}\nstartxref\n${text.length}\n%%EOF\n`, "latin1");
}

/** A page protected by `qpdf --encrypt secret owner 256`. */
export const protectedPdf: Buffer = Buffer.from(
  "JVBERi0xLjcKJb/3ov4KMSAwIG9iago8PCAvRXh0ZW5zaW9ucyA8PCAvQURCRSA8PCAvQmFzZVZlcnNpb24gLzEuNyAvRXh0ZW5zaW9uTGV2ZWwgOCA+PiA+PiAvUGFnZXMgMyAwIFIgL1R5cGUgL0NhdGFsb2cgPj4KZW5kb2JqCjIgMCBvYmoKPDwgPj4KZW5kb2JqCjMgMCBvYmoKPDwgL0NvdW50IDEgL0tpZHMgWyA0IDAgUiBdIC9UeXBlIC9QYWdlcyA+PgplbmRvYmoKNCAwIG9iago8PCAvQ29udGVudHMgNSAwIFIgL01lZGlhQm94IFsgMCAwIDIwMCAzMDAgXSAvUGFyZW50IDMgMCBSIC9SZXNvdXJjZXMgPDwgPj4gL1R5cGUgL1BhZ2UgPj4KZW5kb2JqCjUgMCBvYmoKPDwgL0xlbmd0aCA0OCAvRmlsdGVyIC9GbGF0ZURlY29kZSA+PgpzdHJlYW0KKFv5PCLCJv8uFjT7O6YONKVZjn3taf1Z4mLaGQvYGsE2NdXfOxyeJUNUeLpTDoCyZW5kc3RyZWFtCmVuZG9iago2IDAgb2JqCjw8IC9DRiA8PCAvU3RkQ0YgPDwgL0F1dGhFdmVudCAvRG9jT3BlbiAvQ0ZNIC9BRVNWMyAvTGVuZ3RoIDMyID4+ID4+IC9GaWx0ZXIgL1N0YW5kYXJkIC9MZW5ndGggMjU2IC9PIDw0ZWJkNTA3NzE2YmQxMDZkNTRlNzkyYTNmNmY1ZGFmYTc1YzlmMDY1ZDUxOGRmMWEwNzZmNzA4MTNhZjIwYmNlYWM2MTYwNDUwYzkzZDhhMjdlNzg3ZWYxYWRjN2E4MjQ+IC9PRSA8N2RmN2Y1MmIyNDU0OTBhY2QyNWRlYmJlYjNhY2NjZDQ5OTk2OTQzZDFmNmM4Y2FiZGE3NjljODgyNDI3ZGI4OT4gL1AgLTQgL1Blcm1zIDxlMTNhY2QzZGExN2NlY2QxMDY3ZWNmZjU4NDc2OTQ4ND4gL1IgNiAvU3RtRiAvU3RkQ0YgL1N0ckYgL1N0ZENGIC9VIDwwZDZiMmIwMTFhZGFhNTBkNjVkYmEzOTEyYTY5ZDA4MGQyODNhNThiMmJjOWRhZGNhZGJiNjM2YzM5ZTRmYmUzOWFjNzBhN2FjYjQwNTA3YWE2Y2ZjMDZkZTIwYmFhOTI+IC9VRSA8YTlkODE4YzBmYmEwNWFmZjcwNjg1NzY1YTlmYTQxNzUwMzE3MDAxNjFiYjVjNzMzMTIyMDc1OWQ2ZWQ4NDQwNj4gL1YgNSA+PgplbmRvYmoKeHJlZgowIDcKMDAwMDAwMDAwMCA2NTUzNSBmIAowMDAwMDAwMDE1IDAwMDAwIG4gCjAwMDAwMDAxMzAgMDAwMDAgbiAKMDAwMDAwMDE1MSAwMDAwMCBuIAowMDAwMDAwMjEwIDAwMDAwIG4gCjAwMDAwMDAzMTYgMDAwMDAgbiAKMDAwMDAwMDQzNCAwMDAwMCBuIAp0cmFpbGVyIDw8IC9JbmZvIDIgMCBSIC9Sb290IDEgMCBSIC9TaXplIDcgL0lEIFs8OTVkMDIyMTBiNzc4OTZmNzk2MzBiNTgzM2I0YTBlZjk+PDk1ZDAyMjEwYjc3ODk2Zjc5NjMwYjU4MzNiNGEwZWY5Pl0gL0VuY3J5cHQgNiAwIFIgPj4Kc3RhcnR4cmVmCjk4MQolJUVPRgo=",
  "base64",
);

/** A page that everybody may read and nobody may change: `qpdf --encrypt "" owner 256`. */
export const ownedPdf: Buffer = Buffer.from(
  "JVBERi0xLjcKJb/3ov4KMSAwIG9iago8PCAvRXh0ZW5zaW9ucyA8PCAvQURCRSA8PCAvQmFzZVZlcnNpb24gLzEuNyAvRXh0ZW5zaW9uTGV2ZWwgOCA+PiA+PiAvUGFnZXMgMyAwIFIgL1R5cGUgL0NhdGFsb2cgPj4KZW5kb2JqCjIgMCBvYmoKPDwgPj4KZW5kb2JqCjMgMCBvYmoKPDwgL0NvdW50IDEgL0tpZHMgWyA0IDAgUiBdIC9UeXBlIC9QYWdlcyA+PgplbmRvYmoKNCAwIG9iago8PCAvQ29udGVudHMgNSAwIFIgL01lZGlhQm94IFsgMCAwIDIwMCAzMDAgXSAvUGFyZW50IDMgMCBSIC9SZXNvdXJjZXMgPDwgPj4gL1R5cGUgL1BhZ2UgPj4KZW5kb2JqCjUgMCBvYmoKPDwgL0xlbmd0aCA0OCAvRmlsdGVyIC9GbGF0ZURlY29kZSA+PgpzdHJlYW0K0dGUZkBTIQRHxuBDFs366ePHP2uJNTGZmYdYyFRvtSSA8j5JswbafLwJP0wg66GOZW5kc3RyZWFtCmVuZG9iago2IDAgb2JqCjw8IC9DRiA8PCAvU3RkQ0YgPDwgL0F1dGhFdmVudCAvRG9jT3BlbiAvQ0ZNIC9BRVNWMyAvTGVuZ3RoIDMyID4+ID4+IC9GaWx0ZXIgL1N0YW5kYXJkIC9MZW5ndGggMjU2IC9PIDxjMTcyYTA1ZmMyOTFlMTAxNjU0MWZhYmYzZDEwNmE4OWZhODJiMThiODdhNWYzZThhYTQ4ZmIyMGYwZWMxM2E4NjAwMDRlMGY2MWJkMDMwNmFhMDM0MzMxNTc4MDU4YjI+IC9PRSA8N2QyYzQ1ODE5ODdmOGNhYWY3OGVkNjU5YWYyNzMwMjdlZDE5NTlmMDY3MzVhMjQ2Nzc0MDE0ODY3MGU5OGIzZT4gL1AgLTQgL1Blcm1zIDwwZTA3YjJhOTQwYWIzMzI1ZWExODIxOGIyYzE2NjI1NT4gL1IgNiAvU3RtRiAvU3RkQ0YgL1N0ckYgL1N0ZENGIC9VIDxlMGYwMzk3NTNjMTc5Njk1YzJlMGM0ODc0YTQyOWYwNDQ0NThmZWRiNGZhZmYyODkwMDhmOGYzYmRlYjE2YjNlODdjZWY3MGIyMzA1M2ViMGNhM2JiYzEyZTEyMTYzMDQ+IC9VRSA8ZWUyYTA0ZTc3MTE5NWM5NWUyMDYzNDk1MTYzYzkyZTcwMzljZTA2ZDhjMDU4NTQ2M2QxMmRhNmU4ZmQxODczNT4gL1YgNSA+PgplbmRvYmoKeHJlZgowIDcKMDAwMDAwMDAwMCA2NTUzNSBmIAowMDAwMDAwMDE1IDAwMDAwIG4gCjAwMDAwMDAxMzAgMDAwMDAgbiAKMDAwMDAwMDE1MSAwMDAwMCBuIAowMDAwMDAwMjEwIDAwMDAwIG4gCjAwMDAwMDAzMTYgMDAwMDAgbiAKMDAwMDAwMDQzNCAwMDAwMCBuIAp0cmFpbGVyIDw8IC9JbmZvIDIgMCBSIC9Sb290IDEgMCBSIC9TaXplIDcgL0lEIFs8OGE0NjE0MjNjOTAwZWQ5NGY0OWMzZWI3NDFkYzM1MWE+PDhhNDYxNDIzYzkwMGVkOTRmNDljM2ViNzQxZGMzNTFhPl0gL0VuY3J5cHQgNiAwIFIgPj4Kc3RhcnR4cmVmCjk4MQolJUVPRgo=",
  "base64",
);
