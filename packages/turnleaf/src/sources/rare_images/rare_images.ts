/**
 * Images of formats that few browsers show: as PNG, by the browser where it shows them, else by a decoder
 * in a worker, one image at a time, as each may take two gigabytes: its WASM has no more.
 */

import { unpack } from "../../packed.ts";
import { unshownFormat } from "../formats.ts";
import { claimedSize } from "../image_header.ts";
import { limits } from "../limits.ts";
import { loadPart } from "../load_part.ts";
import { BookError, type BookErrorDetail } from "../page_source.ts";
import { trustedScript } from "../trusted_script.ts";
import { scriptOfWorker, workerNotStarted } from "../worker_script.ts";
import type { DecodedType, DecoderMessage, DecodingTask } from "./decoder_worker.ts";

/** The formats that are decoded, and what loads the WASM of their decoders, if these have one. */
const decoders: Readonly<Record<DecodedType, (() => Promise<{ default: string }>) | null>> = {
  "image/tiff": null,
  // In the colours of print, which browsers show wrong.
  "image/jpeg": null,
  "image/jp2": () => import("packed:pdfjs-dist/wasm/openjpeg.wasm"),
};

const workerScript = scriptOfWorker(() => import("worker:./decoder_worker.ts"));

/** Characters quoted from a decoder. */
const detailLength = 100;

/** The decoding that goes on. */
let last: Promise<unknown> = Promise.resolve();

/**
 * Returns an image of a format that few browsers show as PNG. Rejects with a `BookError` where neither
 * the browser nor a decoder shows it.
 *
 * @param image of the type that its first bytes are
 * @param place the image in sentences
 * @param about what errors are about
 */
export async function asPng(image: Blob, place: string, about: BookErrorDetail): Promise<Blob> {
  const type = image.type as DecodedType;
  const shown = type === "image/jpeg" ? null : await byBrowser(image);
  if (shown) return shown;
  if (!(type in decoders)) {
    throw new BookError(
      `${place} is ${unshownFormat(type)}, which this browser does not show; convert it to PNG or JPEG.`,
      { ...about, code: "unsupported" },
    );
  }
  const decoding = last.then(() => decoded(image, type, place, about));
  last = decoding.catch(() => {});
  return await decoding;
}

/** Returns what the browser shows of an image; null if that is nothing, or the image's size is unknown or too large. */
async function byBrowser(image: Blob): Promise<Blob | null> {
  const size = await claimedSize(image);
  if (!size || size.width * size.height > limits.imagePixels) return null;
  const bitmap = await createImageBitmap(image).catch(() => null);
  if (!bitmap) return null;
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  canvas.getContext("2d")?.drawImage(bitmap, 0, 0);
  bitmap.close();
  return await canvas.convertToBlob({ type: "image/png" });
}

async function decoded(
  image: Blob,
  type: DecodedType,
  place: string,
  about: BookErrorDetail,
): Promise<Blob> {
  const [address, packed, file] = await Promise.all([
    loadPart(workerScript()),
    loadPart(decoders[type]?.() ?? Promise.resolve(null)),
    image.arrayBuffer(),
  ]);
  const code = packed ? await unpack(packed.default) : new Uint8Array();
  const reply = await inWorker(address, { type, file, code }, place);
  switch (reply?.kind) {
    case "image":
      return reply.png;
    case "large":
      throw new BookError(
        `${place} has ${reply.width} x ${reply.height} pixels, more than can be shown; make it smaller.`,
        { ...about, code: "tooLarge" },
      );
    case "damaged":
      throw new BookError(
        `${place} is ${unshownFormat(type) ?? "a JPEG"} that is damaged or of a kind that cannot be read (${reply.detail.slice(0, detailLength)}); convert it to PNG or JPEG.`,
        { ...about, code: "damaged" },
      );
    default:
      throw new BookError(
        `${place} took more than ${limits.decodingTime / 1000} seconds to decode; convert it to PNG or JPEG.`,
        { ...about, code: "tooLarge" },
      );
  }
}

/** Returns what a worker makes of an image; null if that takes too long. Ends the worker in any case. */
function inWorker(
  address: string,
  task: DecodingTask,
  place: string,
): Promise<Exclude<DecoderMessage, { kind: "forbidden" }> | null> {
  return new Promise((resolve, reject) => {
    const forbidden = (cause: unknown): BookError => workerNotStarted(place, "decodes it", cause);
    let worker: Worker | undefined;
    let timer: ReturnType<typeof setTimeout> | undefined;
    const end = (then: () => void): void => {
      clearTimeout(timer);
      worker?.terminate();
      then();
    };
    try {
      worker = new Worker(trustedScript(address), { type: "module" });
      timer = setTimeout(() => end(() => resolve(null)), limits.decodingTime);
      worker.onmessage = ({ data }: MessageEvent<DecoderMessage>) => {
        if (data.kind === "forbidden") end(() => reject(forbidden(data.detail)));
        else end(() => resolve(data));
      };
      worker.onerror = (event) => {
        event.preventDefault();
        // An event without a message comes from a script that could not be loaded.
        const { message } = event;
        end(() =>
          message
            ? resolve({ kind: "damaged", detail: message })
            : reject(forbidden(new Error("It did not load."))),
        );
      };
      worker.postMessage(task, [task.file]);
    } catch (error) {
      end(() => reject(forbidden(error)));
    }
  });
}
