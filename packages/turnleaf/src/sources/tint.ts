/** Pages that are drawn already, in other colours: paper and ink of a theme, or dimmed. */

import type { PageColours, PagePicture } from "./page_source.ts";

/** How bright pictures are that are dimmed. */
const dimmed = 0.8;

/**
 * Returns the picture of a page in other colours. By night lightness is turned over and hues stay, or the
 * picture is dimmed; else the paper of a document, and its ink, have the colour of the theme's. The
 * picture of a page that needs no other colours is returned as it is; else it is the caller's still.
 *
 * @param what ink on paper, or a picture whose colours are its own
 */
export function tinted(
  picture: PagePicture,
  what: "print" | "picture",
  { paper, ink, isDark, pictures }: PageColours,
): PagePicture {
  const isTurned = isDark && (pictures || (what === "print" ? "invert" : "dim")) === "invert";
  if (!isDark && what === "picture") return picture;
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [picture.width, picture.height];
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  const fill = (mode: GlobalCompositeOperation, [red, green, blue]: Channels): void => {
    pen.globalCompositeOperation = mode;
    pen.fillStyle = `rgb(${red} ${green} ${blue})`;
    pen.fillRect(0, 0, canvas.width, canvas.height);
  };
  // What is clear in a picture is white paper.
  fill("source-over", [255, 255, 255]);
  pen.drawImage(picture, 0, 0);
  if (isDark && !isTurned) {
    fill("multiply", [255 * dimmed, 255 * dimmed, 255 * dimmed]);
    return canvas;
  }
  if (isTurned) {
    fill("difference", [255, 255, 255]);
    // Hue and saturation as they were, of what is dark now.
    pen.globalCompositeOperation = "color";
    pen.drawImage(picture, 0, 0);
  }
  const [black, white] = isDark ? [paper, ink] : [ink, paper];
  const [low, high] = [channelsOf(black), channelsOf(white)];
  fill("multiply", high.map((value, k) => value - (low[k] ?? 0)) as Channels);
  fill("lighter", low);
  return canvas;
}

type Channels = [red: number, green: number, blue: number];

/** Returns red, green and blue of a CSS colour of six digits, 0 to 255. */
function channelsOf(colour: string): Channels {
  const at = (from: number): number => Number.parseInt(colour.slice(from, from + 2), 16);
  return [at(1), at(3), at(5)];
}
