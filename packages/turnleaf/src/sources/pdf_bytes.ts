import type { PdfLibrary } from "./pdf_runtime.ts";

/** The location of a PDF's bytes. */
export interface PdfInput {
  /** The file's name in sentences. */
  readonly name: string;
  readonly from: string | Blob;
  /** Bytes, if known. */
  readonly length?: number;
}

/** From this size on a file is read in the pieces that its visible pages need, never whole. */
const largeFile = 24 << 20;

/** Returns the parameters of pdf.js that say where the bytes come from. */
export async function place(pdfjs: PdfLibrary, input: PdfInput): Promise<object> {
  const { from } = input;
  const isLarge = (input.length ?? 0) > largeFile;
  if (typeof from === "string") {
    return { url: from, disableAutoFetch: isLarge, disableStream: isLarge };
  }
  if (!isLarge) return { data: new Uint8Array(await from.arrayBuffer()) };
  return { range: blobRange(pdfjs, from), disableAutoFetch: true };
}

/** Reads a large local file piece by piece. */
function blobRange(pdfjs: PdfLibrary, blob: Blob): object {
  class BlobRange extends pdfjs.PDFDataRangeTransport {
    override requestDataRange(begin: number, end: number): void {
      blob
        .slice(begin, end)
        .arrayBuffer()
        .then((bytes) => this.onDataRange(begin, new Uint8Array(bytes)))
        // The file was removed: the pages not yet read stay unread.
        .catch(() => this.abort());
    }
  }
  return new BlobRange(blob.size, null);
}
