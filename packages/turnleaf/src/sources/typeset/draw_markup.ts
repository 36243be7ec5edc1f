import { fitPixels } from "../limits.ts";
import type { PageBox, PageSize } from "../page_source.ts";

/**
 * Draws a part of an SVG with markup in it. Rejects if the browser cannot, or
 * the page's policy does not allow images as data.
 *
 * @param region in fractions of the page
 * @param width of the drawing, pixels
 */
export async function drawMarkup(
  svg: string,
  size: PageSize,
  region: PageBox,
  width: number,
): Promise<ImageBitmap> {
  const part = { width: size.width * region.width, height: size.height * region.height };
  const pixels = fitPixels(part, width);
  const picture = new Image();
  // By data, as a blob would taint the canvas in WebKit.
  picture.src = `data:image/svg+xml,${encodeURIComponent(svg)}`;
  await picture.decode();
  // In Chromium embedded fonts and pictures are ready one task later.
  await new Promise((resolve) => setTimeout(resolve));
  const canvas = new OffscreenCanvas(pixels.width, pixels.height);
  const pen = canvas.getContext("2d") as OffscreenCanvasRenderingContext2D;
  const scale = pixels.width / part.width;
  pen.setTransform(
    scale,
    0,
    0,
    pixels.height / part.height,
    -region.x * size.width * scale,
    -region.y * size.height * (pixels.height / part.height),
  );
  pen.drawImage(picture, 0, 0, size.width, size.height);
  return canvas.transferToImageBitmap();
}
