/** A cover board that is not open on the table: it swings about the spine, or lies closed over the leaves. */

import { caseSizes } from "../draw/case_shape.ts";
import type { FaceDetail } from "../draw/stage.ts";
import type { PagePicture } from "../sources/page_source.ts";
import { type Brush, drawDetail, fillBetween, light, type Stops, shade } from "./draw_book.ts";
import { stretchTo } from "./layout.ts";

/** How much larger the fore-edge of a board that stands upright looks: it is nearer to the eye. */
const nearness = 0.16;

/** Width in device pixels of the slices in which a picture is drawn on a board that is seen at an angle. */
const sliceWidth = 3;

/** The hinge's groove and the rounded fore-edge of a board seen from outside. */
const groove: Stops = [
  [0, shade(0.5)],
  [0.014, light(0.1)],
  [0.03, shade(0.1)],
  [0.046, shade(0.42)],
  [0.062, shade(0.06)],
  [0.075, light(0.12)],
  [0.1, shade(0)],
  [0.97, shade(0)],
  [1, shade(0.3)],
];

/**
 * Draws a board.
 *
 * @param angle radians from lying on the right
 * @param picture on the face that is seen
 * @param isOutside whether that is the outer one
 * @param detail on the same face, seen where the board lies flat
 */
export function drawBoard(
  brush: Brush,
  angle: number,
  picture: PagePicture | null,
  isOutside: boolean,
  detail: FaceDetail | null,
): void {
  const { pen, shape, unit } = brush;
  const { rim } = caseSizes;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const [width, height] = [shape.width + rim, shape.height];
  /** Across the board from the hinge (0) to its edge (1), and along it in metres from the head. */
  const at = (u: number, y: number): [x: number, y: number] => [
    cos * u * width,
    height / 2 + (y - height / 2) * (1 + nearness * sin * u),
  ];
  const corners = [at(0, -rim), at(1, -rim), at(1, height + rim), at(0, height + rim)];
  pen.save();
  pen.shadowColor = "rgb(29 21 14 / 0.45)";
  pen.shadowBlur = (0.02 + 0.16 * sin) * width * unit;
  pen.shadowOffsetY = (0.006 + 0.04 * sin) * width * unit;
  pen.fillStyle = shape.cloth;
  pen.beginPath();
  for (const corner of corners) pen.lineTo(...corner);
  pen.fill();
  pen.restore();
  pen.save();
  pen.beginPath();
  for (const corner of corners) pen.lineTo(...corner);
  pen.clip();
  // Outside a picture covers the board; inside, the paper leaves a rim of cloth.
  const inset = isOutside ? 0 : rim;
  const share = (width - inset) / width;
  if (picture && picture.width > 0) {
    const count = sin < 0.01 ? 1 : Math.ceil((Math.abs(cos) * width * unit) / sliceWidth) + 1;
    for (let k = 0; k < count; k++) {
      const [u0, u1] = [k / count, (k + 1) / count];
      const [x0, top] = at(u0 * share, inset - rim);
      const [x1] = at(u1 * share, 0);
      const [, bottom] = at(u0 * share, height + rim - inset);
      const from = cos > 0 ? u0 : 1 - u1;
      // A little wider, or the ground would shine through between two slices.
      const start = Math.min(x0, x1);
      const end = start + Math.abs(x1 - x0) + (count > 1 ? 1 / unit : 0);
      const { width: w, height: h } = picture;
      const part: [number, number, number, number] = shape.rolled
        ? [0, from * h, w, h / count]
        : [from * w, 0, w / count, h];
      pen.save();
      stretchTo(pen, [start, top, end, bottom], shape.rolled);
      pen.drawImage(picture, ...part, 0, 0, 1, 1);
      if (count === 1) drawDetail(pen, detail);
      pen.restore();
    }
  }
  const edge = cos * width;
  const all = [Math.min(0, edge), -height, Math.max(0, edge), 2 * height] as const;
  if (isOutside) fillBetween(pen, [0, 0, edge, 0], groove, all);
  fillBetween(
    pen,
    [0, 0, edge, 0],
    [
      [0, shade(0.2 * sin)],
      [1, shade(0.5 * sin)],
    ],
    all,
  );
  pen.restore();
}
