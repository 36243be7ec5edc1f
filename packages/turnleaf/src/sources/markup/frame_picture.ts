/** Frames in a chapter: what stands in one is drawn as a picture, so that it can reach nothing. */

import { dataUrl } from "../data_url.ts";
import type { PageSize } from "../page_source.ts";
import { type FlowContent, styleAttribute } from "../typeset/flow_book.ts";
import { styleElements } from "../typeset/style_elements.ts";
import { xmlOf } from "./xml.ts";

/** The size of a frame that does not say its own, as browsers have it, and the longest side: CSS pixels. */
const usualSize: PageSize = { width: 300, height: 150 };
const longestSide = 2000;

/** Returns the size that a frame names. */
export function frameSize(frame: Element): PageSize {
  const side = (name: "width" | "height"): number => {
    const length = Number.parseInt(frame.getAttribute(name) ?? "", 10);
    return length > 0 ? Math.min(length, longestSide) : usualSize[name];
  };
  return { width: side("width"), height: side("height") };
}

/** Returns clean content as the address of a picture. */
export function framePicture(
  { root, styles }: FlowContent,
  { width, height }: PageSize,
): Promise<string> {
  const markup = xmlOf(root).replaceAll(` ${styleAttribute}="`, ' style="');
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" style="font-size: 16px">${styleElements(styles)}<foreignObject width="${width}" height="${height}">${markup}</foreignObject></svg>`;
  return dataUrl(new TextEncoder().encode(svg), "image/svg+xml");
}
