/** The worker in which an image is decoded: it may be ended at any time. */

import { limits } from "../limits.ts";
import { decodeCmykJpeg } from "./cmyk_jpeg.ts";
import { decodeJpeg2000 } from "./jpeg2000.ts";
import { type Pixels, TooManyPixels } from "./pixels.ts";
import { decodeTiff } from "./tiff.ts";

/** What the page sends, once. */
export interface DecodingTask {
  /** The image's media type. */
  readonly type: DecodedType;
  readonly file: ArrayBuffer;
  /** The WASM that decodes it; empty for a decoder that needs none. */
  readonly code: Uint8Array<ArrayBuffer>;
}

/** Types of images that are decoded. */
export type DecodedType = "image/tiff" | "image/jp2" | "image/jpeg";

/** What the worker sends: the image as PNG, or why there is none. */
export type DecoderMessage =
  | { readonly kind: "image"; readonly png: Blob }
  | { readonly kind: "large"; readonly width: number; readonly height: number }
  | { readonly kind: "forbidden"; readonly detail: string }
  | { readonly kind: "damaged"; readonly detail: string };

const scope = globalThis as unknown as {
  postMessage(message: DecoderMessage): void;
  onmessage: ((event: MessageEvent<DecodingTask>) => void) | null;
  window: unknown;
};

// UTIF asks whether there is a library beside it.
scope.window = scope;

scope.onmessage = async ({ data }) => {
  try {
    scope.postMessage({ kind: "image", png: await asPng(await pixelsOf(data)) });
  } catch (error) {
    scope.postMessage(messageFor(error));
  }
};
async function pixelsOf({ type, file, code }: DecodingTask): Promise<Pixels> {
  if (type === "image/tiff") return decodeTiff(file, limits.imagePixels);
  if (type === "image/jpeg") return decodeCmykJpeg(file, limits.imagePixels);
  return await decodeJpeg2000(new Uint8Array(file), code, limits.imagePixels);
}

async function asPng({ width, height, data }: Pixels): Promise<Blob> {
  const canvas = new OffscreenCanvas(width, height);
  const pen = canvas.getContext("2d");
  if (!pen) throw new Error("out of memory");
  pen.putImageData(new ImageData(data, width, height), 0, 0);
  return await canvas.convertToBlob({ type: "image/png" });
}

function messageFor(error: unknown): DecoderMessage {
  if (error instanceof TooManyPixels) return { kind: "large", ...error.size };
  const detail = error instanceof Error ? error.message : String(error);
  return { kind: error instanceof WebAssembly.CompileError ? "forbidden" : "damaged", detail };
}
