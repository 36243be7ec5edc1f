import { expect, it } from "vitest";
import { openSource } from "./open.ts";

const never = new AbortController().signal;

const names = [
  ...["jpg", "png", "webp", "avif"].flatMap((type) =>
    Array.from({ length: 8 }, (_, k) => `${k + 1}.${type}`),
  ),
  // What says how it lies is behind its pixels, 90 kB.
  "late.webp",
];

/** Returns the pixels of a picture. */
function pixelsOf(picture: CanvasImageSource, width: number, height: number): Uint8ClampedArray {
  const pen = new OffscreenCanvas(width, height).getContext("2d")!;
  pen.drawImage(picture, 0, 0);
  return pen.getImageData(0, 0, width, height).data;
}

it.each(names)("%s lies as its camera held it", async (name) => {
  const address = new URL(`./fixtures/turned/${name}`, import.meta.url).href;
  const element = new Image();
  // Some browsers turn no WebP: the same picture as PNG, which is turned by all.
  element.src = address.replace(/(\d)\.webp$/, "$1.png");
  await element.decode();
  // That one has no such twin: it is turned by a quarter.
  const isLate = name === "late.webp";
  const { naturalWidth, naturalHeight } = element;
  const [width, height] = isLate ? [naturalHeight, naturalWidth] : [naturalWidth, naturalHeight];
  const source = await openSource(new File([await (await fetch(address)).blob()], name));
  expect(await source.size(0)).toEqual({ width, height });
  const whole = (await source.draw(0, width, never)) as ImageBitmap;
  expect([whole.width, whole.height]).toEqual([width, height]);
  if (isLate) return;
  const meant = pixelsOf(element, width, height);
  expect(pixelsOf(whole, width, height)).toEqual(meant);
  // Half as large: the middles of its quarters.
  const half = (await source.draw(0, width / 2, never)) as ImageBitmap;
  const [across, down] = [width / 2, height / 2];
  const small = pixelsOf(half, across, down);
  for (const [x, y] of [0.25, 0.75].flatMap((y) => [0.25, 0.75].map((x) => [x, y] as const))) {
    const at = 4 * (Math.floor(y * down) * across + Math.floor(x * across));
    const to = 4 * (Math.floor(y * height) * width + Math.floor(x * width));
    for (let k = 0; k < 3; k++) {
      expect(Math.abs((small[at + k] ?? 0) - (meant[to + k] ?? 255))).toBeLessThan(60);
    }
  }
  // The lower right quarter alone.
  const region = { x: 0.5, y: 0.5, width: 0.5, height: 0.5 };
  const part = (await source.draw(0, width / 2, never, region)) as ImageBitmap;
  const pen = new OffscreenCanvas(width, height).getContext("2d")!;
  pen.drawImage(element, 0, 0);
  const { data } = pen.getImageData(width / 2, height / 2, width / 2, height / 2);
  expect(pixelsOf(part, width / 2, height / 2)).toEqual(data);
});
