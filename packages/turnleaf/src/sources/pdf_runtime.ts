import { unpack } from "../packed.ts";
import { loadPart } from "./load_part.ts";
import { trustedScript } from "./trusted_script.ts";
import { scriptAddress } from "./worker_script.ts";

/** The library, loaded once, when the first PDF is opened. */
export type PdfLibrary = typeof import("pdfjs-dist");

let library: Promise<PdfLibrary> | undefined;
let worker: Promise<string> | undefined;
let renderer: Promise<string> | undefined;

/** Loads pdf.js. Rejects with the error of its code in an unsupported browser. */
export function loadPdfLibrary(): Promise<PdfLibrary> {
  library ??= start().catch((error: unknown) => {
    library = undefined;
    throw error;
  });
  return library;
}

async function start(): Promise<PdfLibrary> {
  completePromise();
  return await loadPart(import("pdfjs-dist/legacy/build/pdf.mjs"));
}

/** Restores what old versions of zone.js remove and pdf.js's own polyfills rely on. */
function completePromise(): void {
  Promise.withResolvers ??= function withResolvers<T>(): PromiseWithResolvers<T> {
    let resolve!: PromiseWithResolvers<T>["resolve"];
    let reject!: PromiseWithResolvers<T>["reject"];
    const promise = new Promise<T>((onResolve, onReject) => {
      resolve = onResolve;
      reject = onReject;
    });
    return { promise, resolve, reject };
  };
}

/**
 * Returns the address of the worker that reads documents. Both of pdf.js's
 * workers start from blob URLs, because no other way works in every bundler
 * without configuration; a page whose security policy forbids that
 * (`worker-src` without `blob:`) gives their address instead.
 */
export function blobWorker(): Promise<string> {
  worker ??= loadPart(import("packed:pdfjs-dist/legacy/build/pdf.worker.min.mjs")).then(scriptUrl);
  return forgetIfRejected(worker, () => {
    worker = undefined;
  });
}

/**
 * Returns the address of the worker that draws pages. If it does not start,
 * pdf.js draws them in the page.
 *
 * @param address of the worker that reads documents, if it is not a blob: its
 * file does both
 */
export async function rendererAddress(address?: string): Promise<string> {
  if (address) return `${address}#renderer`;
  renderer ??= loadPart(import("packed:pdfjs-dist/legacy/build/pdf.renderer.min.mjs")).then(
    scriptUrl,
  );
  return await forgetIfRejected(renderer, () => {
    renderer = undefined;
  });
}

/**
 * Makes documents opened from now on draw their pages by the worker at
 * `address`. Redefines the property, because pdf.js accepts only a string,
 * which is not one if the page requires Trusted Types.
 */
export function useRenderer(pdfjs: PdfLibrary, address: string): void {
  const value = trustedScript(address);
  Object.defineProperty(pdfjs.GlobalWorkerOptions, "rendererSrc", { value, configurable: true });
}

function forgetIfRejected<T>(promise: Promise<T>, forget: () => void): Promise<T> {
  promise.catch(forget);
  return promise;
}

async function scriptUrl(packed: { default: string }): Promise<string> {
  return await scriptAddress(await unpack(packed.default));
}

/** Files that are being loaded. */
let loads = 0;

/** Returns whether files that pdf.js has requested are being loaded: it waits for them. */
export function isLoadingData(): boolean {
  return loads > 0;
}

/**
 * The files that pdf.js requests while it reads: character maps of Chinese,
 * Japanese and Korean, decoders of JPEG 2000 and JBIG2, two symbol fonts. Each
 * is in a module of its own and is loaded on request.
 */
export class PackedDataFactory {
  async fetch({ kind, filename }: { kind: string; filename: string }): Promise<Uint8Array> {
    loads++;
    try {
      if (kind === "cMapUrl") return await characterMap(filename);
      const load = packedFiles[filename];
      if (!load) throw new Error(`No such file: ${filename}`);
      return await unpack((await load()).default);
    } finally {
      loads--;
    }
  }
}

const packedFiles: Record<string, () => Promise<{ default: string }>> = {
  "openjpeg.wasm": () => import("packed:pdfjs-dist/wasm/openjpeg.wasm"),
  "jbig2.wasm": () => import("packed:pdfjs-dist/wasm/jbig2.wasm"),
  "FoxitSymbol.pfb": () => import("packed:pdfjs-dist/standard_fonts/FoxitSymbol.pfb"),
  "FoxitDingbats.pfb": () => import("packed:pdfjs-dist/standard_fonts/FoxitDingbats.pfb"),
};

let characterMaps: Promise<Map<string, Uint8Array>> | undefined;

async function characterMap(filename: string): Promise<Uint8Array> {
  characterMaps ??= import("packed:pdfjs-dist/cmaps/")
    .then((packed) => unpack(packed.default))
    .then(unpackFolder);
  const map = (await characterMaps).get(filename);
  if (!map) throw new Error(`No such character map: ${filename}`);
  // A copy: pdf.js transfers the bytes to its worker.
  return map.slice();
}

/** The files of a packed folder: a table's length, the table {name: [offset, length]}, the bytes. */
function unpackFolder(bytes: Uint8Array): Map<string, Uint8Array> {
  const start = 4 + new DataView(bytes.buffer).getUint32(0, true);
  const table = JSON.parse(new TextDecoder().decode(bytes.subarray(4, start)));
  return new Map(
    Object.entries<[number, number]>(table).map(([name, [offset, length]]) => [
      name,
      bytes.subarray(start + offset, start + offset + length),
    ]),
  );
}
