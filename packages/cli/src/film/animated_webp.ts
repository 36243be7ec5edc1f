/** Animated WebP: still pictures of it, which Chromium encodes, in one file that any browser plays. */

import { rename, writeFile } from "node:fs/promises";
import { ChromiumPage } from "../chromium/devtools.ts";
import { fileProblem } from "../problem.ts";
import type { Frames } from "./frames.ts";

/** How good the pictures are, 0 to 1: letters stay clear, and a turn of a second is some 600 kB. */
const quality = 0.72;

/** What has changed since the picture before: a still, and where it goes. */
export interface WebpFrame {
  /** A WebP file of one picture without transparency. */
  readonly still: Uint8Array;
  /** Even numbers. */
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
  /** How long it is seen, milliseconds. */
  readonly milliseconds: number;
}

/** Returns the part of a picture that has changed as a WebP; null if nothing has. Runs in Chromium. */
const encoder = /* js */ `
globalThis.encodeChange = (() => {
  let before = null;
  return async (png) => {
    const bytes = Uint8Array.from(atob(png), (letter) => letter.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const { width, height } = bitmap;
    const pen = new OffscreenCanvas(width, height).getContext("2d", { alpha: false, willReadFrequently: true });
    pen.drawImage(bitmap, 0, 0);
    const now = new Uint32Array(pen.getImageData(0, 0, width, height).data.buffer);
    let [left, top, right, bottom] = before ? [width, height, 0, 0] : [0, 0, width, height];
    for (let at = 0; before && at < now.length; at++) {
      if (now[at] === before[at]) continue;
      const [x, y] = [at % width, Math.floor(at / width)];
      [left, top, right, bottom] = [Math.min(left, x), Math.min(top, y), Math.max(right, x + 1), Math.max(bottom, y + 1)];
    }
    before = now;
    if (right <= left) return null;
    const [x, y] = [left & ~1, top & ~1];
    const part = new OffscreenCanvas(right - x, bottom - y);
    part.getContext("2d", { alpha: false }).drawImage(bitmap, -x, -y);
    const blob = await part.convertToBlob({ type: "image/webp", quality: ${quality} });
    const still = new Uint8Array(await blob.arrayBuffer());
    let text = "";
    for (const byte of still) text += String.fromCharCode(byte);
    return { x, y, width: part.width, height: part.height, still: btoa(text) };
  };
})();`;

/**
 * Writes a film to `out` as an animated WebP that goes on for ever, complete or not at all.
 *
 * @param chromium the browser that encodes the pictures
 * @throws Problem if that does not start, or the file cannot be written
 */
export async function encodeWebp(
  chromium: string,
  frames: Frames,
  { fps, width, height }: { readonly fps: number; readonly width: number; readonly height: number },
  out: string,
  signal: AbortSignal,
): Promise<void> {
  const page = await ChromiumPage.start(chromium, width, height);
  const stop = (): void => void page.close();
  signal.addEventListener("abort", stop, { once: true });
  const changes: WebpFrame[] = [];
  try {
    await page.evaluate(encoder);
    const time = (number: number): number => Math.round((1000 * number) / fps);
    let from = 0;
    for (let number = 0; number <= frames.count; number++) {
      signal.throwIfAborted();
      const isEnd = number === frames.count;
      const png = isEnd ? "" : (await frames.read(number)).toString("base64");
      const change = isEnd
        ? undefined
        : await page.evaluate<(Omit<WebpFrame, "still"> & { still: string }) | null>(
            `encodeChange("${png}")`,
          );
      if (change === null) continue;
      // What was seen until now has its time.
      const last = changes.pop();
      if (last) changes.push({ ...last, milliseconds: time(number) - time(from) });
      if (!change) break;
      from = number;
      changes.push({ ...change, still: Buffer.from(change.still, "base64"), milliseconds: 0 });
    }
  } finally {
    signal.removeEventListener("abort", stop);
    await page.close();
  }
  const part = `${out}.part`;
  try {
    await writeFile(part, animatedWebp(changes, width, height));
    await rename(part, out);
  } catch (error) {
    throw fileProblem(out, error);
  }
}

/** Returns an animated WebP that goes on for ever, of what changes from picture to picture. */
export function animatedWebp(frames: readonly WebpFrame[], width: number, height: number): Buffer {
  const animation = 0x02;
  const header = Buffer.from([animation, 0, 0, 0, ...int24(width - 1), ...int24(height - 1)]);
  // Over what colour, and how often: for ever.
  const loop = Buffer.alloc(6);
  const pictures = frames.map(({ still, x, y, width, height, milliseconds }) => {
    const where = [x / 2, y / 2, width - 1, height - 1, milliseconds].flatMap(int24);
    // It takes the place of what was there, and stays.
    return chunk("ANMF", Buffer.concat([Buffer.from([...where, 0x02]), pictureIn(still)]));
  });
  const body = Buffer.concat([
    Buffer.from("WEBP"),
    chunk("VP8X", header),
    chunk("ANIM", loop),
    ...pictures,
  ]);
  return chunk("RIFF", body);
}

/** Returns the picture's own chunk of a WebP file. */
function pictureIn(file: Uint8Array): Uint8Array {
  const view = Buffer.from(file.buffer, file.byteOffset, file.byteLength);
  for (let at = 12; at + 8 <= view.length; ) {
    const length = view.readUInt32LE(at + 4);
    const end = at + 8 + length + (length % 2);
    if (/^VP8[ L]$/.test(view.toString("latin1", at, at + 4))) return view.subarray(at, end);
    at = end;
  }
  throw new Error("A picture is no WebP.");
}

function chunk(name: string, data: Uint8Array): Buffer {
  const head = Buffer.alloc(8);
  head.write(name, "latin1");
  head.writeUInt32LE(data.length, 4);
  return Buffer.concat([head, data, Buffer.alloc(data.length % 2)]);
}

function int24(value: number): [number, number, number] {
  return [value & 255, (value >> 8) & 255, (value >> 16) & 255];
}
