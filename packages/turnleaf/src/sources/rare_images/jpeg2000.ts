/** JPEG 2000, by the OpenJPEG that pdf.js brings along: see `OpenJPEG` of its src/core/jpx.js. */

import { checkSize, type Pixels } from "./pixels.ts";

/** What the WASM exports; pointers are places in its memory. */
interface Exports {
  readonly i: WebAssembly.Memory;
  /** Starts it. */
  j(): void;
  /** Returns memory of a length. */
  k(length: number): number;
  /** Decodes a file at a place and of a length to samples of eight bits, as many a pixel as it has. Returns 0 if it succeeds. */
  m(
    at: number,
    length: number,
    components: number,
    isIndexed: number,
    hasMask: number,
    reduced: number,
    isAsked: number,
  ): number;
}

/** WASM's pages, bytes. */
const memoryPage = 1 << 16;

/** No such thing, as the C library numbers errors. */
const noSeeking = 70;

/**
 * Returns a file's picture. Throws if it is damaged.
 *
 * @param code openjpeg.wasm
 */
export async function decodeJpeg2000(
  file: Uint8Array<ArrayBuffer>,
  code: Uint8Array<ArrayBuffer>,
  mostPixels: number,
): Promise<Pixels> {
  const size = sizeIn(file);
  checkSize(size, mostPixels);
  let wasm: Exports | undefined;
  let data: Uint8ClampedArray<ArrayBuffer> | undefined;
  let reason = "";
  const memory = (): ArrayBuffer => (wasm as Exports).i.buffer as ArrayBuffer;
  const { instance } = await WebAssembly.instantiate(code, {
    a: {
      a(at: number) {
        const bytes = new Uint8Array(memory(), at);
        reason ||= new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
      },
      b: () => 0,
      c(length: number) {
        try {
          const missing = length - memory().byteLength;
          (wasm as Exports).i.grow(Math.ceil(Math.max(missing, 0) / memoryPage));
          return 1;
        } catch {
          return 0;
        }
      },
      d: () => noSeeking,
      e() {},
      f(at: number, length: number) {
        data = new Uint8ClampedArray(memory().slice(at, at + length));
      },
      g(at: number, first: number, step: number, count: number) {
        const samples = new Int32Array(memory(), at, count);
        for (let k = 0; k < count; k++) if (data) data[first + k * step] = samples[k] as number;
      },
      h(length: number) {
        data = new Uint8ClampedArray(length);
      },
    },
  });
  wasm = instance.exports as unknown as Exports;
  wasm.j();
  const at = wasm.k(file.length);
  new Uint8Array(memory()).set(file, at);
  const isDamaged = wasm.m(at, file.length, 4, 0, 0, 0, 0) !== 0;
  if (isDamaged || !data) throw new Error(reason || "it is not understood");
  return { ...size, data: withFourSamples(data, size.width * size.height) };
}

/** Returns the samples of red, green, blue and opacity of pixels of one to four: grey, with opacity or without, or colours. */
function withFourSamples(
  from: Uint8ClampedArray<ArrayBuffer>,
  count: number,
): Uint8ClampedArray<ArrayBuffer> {
  const samples = from.length / count;
  if (samples === 4) return from;
  if (![1, 2, 3].includes(samples)) throw new Error(`it has ${samples} samples a pixel`);
  const data = new Uint8ClampedArray(4 * count).fill(255);
  const [green, blue] = samples === 3 ? [1, 2] : [0, 0];
  for (let k = 0, at = 0; k < 4 * count; k += 4, at += samples) {
    data[k] = from[at] as number;
    data[k + 1] = from[at + green] as number;
    data[k + 2] = from[at + blue] as number;
    if (samples === 2) data[k + 3] = from[at + 1] as number;
  }
  return data;
}

/** Returns the size that the code stream has: the marker SIZ comes first in it (ISO/IEC 15444-1, A.5.1). */
function sizeIn(file: Uint8Array): { width: number; height: number } {
  const view = new DataView(file.buffer, file.byteOffset, file.length);
  for (let at = 0; at + 22 <= file.length; at++) {
    if (view.getUint32(at) !== 0xff4fff51) continue;
    const [right, bottom, left, top] = [8, 12, 16, 20].map((k) => view.getUint32(at + k));
    return {
      width: (right ?? 0) - (left ?? 0),
      height: (bottom ?? 0) - (top ?? 0),
    };
  }
  throw new Error("it has no size");
}
