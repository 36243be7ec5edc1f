import type { PageBox, PageSize } from "./page_source.ts";

/**
 * Returns a part of an image in a size. It is drawn before it is resized: of an image that a camera has
 * turned by a quarter, Chromium's `createImageBitmap` takes another part.
 *
 * @param part in the image's pixels, within it
 */
export async function cropImage(
  image: ImageBitmap,
  { x, y, width, height }: PageBox,
  pixels: PageSize,
): Promise<ImageBitmap> {
  const [across, down] = [Math.max(Math.round(width), 1), Math.max(Math.round(height), 1)];
  const canvas = new OffscreenCanvas(across, down);
  const pen = canvas.getContext("2d");
  if (!pen) throw new Error("out of memory");
  pen.drawImage(image, x, y, width, height, 0, 0, across, down);
  return await createImageBitmap(canvas, {
    resizeWidth: pixels.width,
    resizeHeight: pixels.height,
    resizeQuality: "high",
  });
}
