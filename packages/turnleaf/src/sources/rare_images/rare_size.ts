/** The sizes that images of formats that few browsers show claim. */

import { J2C } from "image-size/types/j2c";
import { JP2 } from "image-size/types/jp2";
import { JXL } from "image-size/types/jxl";
import { JXLStream } from "image-size/types/jxl-stream";
import { TIFF } from "image-size/types/tiff";
import type { PageSize } from "../page_source.ts";

/** Returns the size in pixels that an image claims; null if its header is not understood. */
export async function rareSize(image: Blob): Promise<PageSize | null> {
  // The header of a TIFF may be at its end.
  const bytes = new Uint8Array(await image.arrayBuffer());
  try {
    const reader = [TIFF, JXL, JXLStream, JP2, J2C].find((one) => one.validate(bytes));
    if (!reader) return null;
    const { width, height } = reader.calculate(bytes);
    return { width, height };
  } catch {
    return null;
  }
}
