/** Images that lie as their camera held them, made as they are to be seen. */

import { exifFlag, exifOrientation, flagsAt } from "./exif_orientation.ts";
import { claimedSize } from "./image_header.ts";
import { limits } from "./limits.ts";

/** How a picture of a width and height is drawn upright, by its orientation: what `transform` takes. */
const turns: Readonly<
  Record<
    number,
    (width: number, height: number) => [number, number, number, number, number, number]
  >
> = {
  2: (width) => [-1, 0, 0, 1, width, 0],
  3: (width, height) => [-1, 0, 0, -1, width, height],
  4: (_, height) => [1, 0, 0, -1, 0, height],
  5: () => [0, 1, 1, 0, 0, 0],
  6: (_, height) => [0, 1, -1, 0, height, 0],
  7: (width, height) => [0, -1, -1, 0, height, width],
  8: (width) => [0, -1, 1, 0, 0, width],
};

/**
 * Returns a WebP as it is to be seen, if its camera held it otherwise: some browsers turn it and some do not.
 * Films, and what cannot be read, stay as they are.
 */
export async function uprightWebp(image: Blob): Promise<Blob> {
  const orientation = (await exifOrientation(image)) ?? 1;
  const size = orientation === 1 ? null : await claimedSize(image);
  if (!size || size.width * size.height > limits.imagePixels) return image;
  const bytes = new Uint8Array(await image.arrayBuffer());
  // No browser turns what says nothing of a camera.
  bytes[flagsAt] = (bytes[flagsAt] as number) & ~exifFlag;
  const still = new Blob([bytes], { type: image.type });
  const bitmap = await createImageBitmap(still).catch(() => null);
  return bitmap ? await turnedImage(bitmap, orientation) : image;
}

/** Returns a picture of an orientation upright, as PNG, and closes it. */
export async function turnedImage(bitmap: ImageBitmap, orientation: number): Promise<Blob> {
  const { width, height } = bitmap;
  const canvas =
    orientation >= 5 ? new OffscreenCanvas(height, width) : new OffscreenCanvas(width, height);
  const pen = canvas.getContext("2d");
  const turn = turns[orientation];
  if (turn) pen?.setTransform(...turn(width, height));
  pen?.drawImage(bitmap, 0, 0);
  bitmap.close();
  return await canvas.convertToBlob({ type: "image/png" });
}
