/**
 * Where the print of a resting page lies on the pixels of the screen. Seen from right
 * above a page is its bitmap, scaled by one number; a bitmap of just that width
 * lies on the screen pixel by pixel, on both pages at one height, and only
 * where the page rises out of the gutter is it bent. Pure arithmetic, in
 * pixels of the screen from the upper left corner of the canvas.
 */

/** A place on the screen or on a bitmap, pixels. */
type Pixel = readonly [x: number, y: number];

/** The print of one page. */
export interface PrintGrid {
  /** Where the bitmap's upper left corner is, were the page flat: whole pixels. */
  readonly corner: Pixel;
  /** Width of the bitmap: whole pixels; and its height. */
  readonly size: Pixel;
  /** Points from the spine outward, on the screen: of length 1, along one of its axes. */
  readonly outward: Pixel;
  /**
   * How much narrower the page is seen than it is, as it rises out of the gutter: distance of the
   * spine from the edge of the bitmap that lies there.
   */
  readonly shortened: number;
}

/**
 * How far from the spine's edge of its bitmap a page is bent, in units of `shortened`: as far as
 * it must be to rise at no more than the 76 degrees of the steepest page, where it is seen at
 * 1 / 4.1 of its width.
 */
const bentOver = 1 + 2 / (4.1 - 1);

/**
 * Lays the print of a page.
 *
 * @param width of the bitmap, whole pixels
 * @param height of it
 * @param middle where the middle of the page is seen
 * @param spine where the middle of its edge at the spine is seen
 * @param outward see `PrintGrid`
 */
export function layPrint(
  width: number,
  height: number,
  middle: Pixel,
  spine: Pixel,
  outward: Pixel,
): PrintGrid {
  const size: Pixel = [width, height];
  const corner: Pixel = [Math.round(middle[0] - width / 2), Math.round(middle[1] - height / 2)];
  const edge = spineEdge(size, outward);
  const at = dot(outward, [spine[0] - corner[0], spine[1] - corner[1]]);
  return { corner, size, outward, shortened: Math.max(at - edge, 0) };
}

/** Returns where a place on the bitmap, pixels from its upper left corner, is on the screen. */
export function placeOfPrint(grid: PrintGrid, place: Pixel): Pixel {
  const { corner, size, outward, shortened } = grid;
  const from = dot(outward, place) - spineEdge(size, outward);
  const moved = bentOutward(shortened, from) - from;
  return [corner[0] + place[0] + moved * outward[0], corner[1] + place[1] + moved * outward[1]];
}

/** Returns how far from the edge of the bitmap is seen what is printed so far from it. */
function bentOutward(shortened: number, printed: number): number {
  const reach = bentOver * shortened;
  if (printed >= reach || shortened === 0) return printed;
  // The inverse of `bend` in `printGridChunk`.
  const flat = reach - shortened;
  const t = (Math.sqrt(flat * flat + 4 * shortened * (reach - printed)) - flat) / (2 * shortened);
  return reach - flat * t;
}

/** Returns the place of the bitmap's edge at the spine along `outward`. */
function spineEdge(size: Pixel, outward: Pixel): number {
  return Math.min(dot(outward, size), 0);
}

function dot([x, y]: Pixel, [u, v]: Pixel): number {
  return x * u + y * v;
}

/**
 * `gridPlace()`: the place on the bitmap, pixels from its upper left corner, that is seen at
 * a pixel of the canvas; its `z` says how many of them one of the screen is there, toward the spine.
 */
export const printGridChunk: string = /* glsl */ `
// The bitmap's upper left corner on the canvas, from below, pixels of the canvas; how many of the
// screen's one of these is, 0 if there is no grid; and whether they divide one.
uniform vec4 gridCorner;
uniform vec2 gridSize;
uniform vec3 gridSpine;

vec3 gridPlace() {
  vec2 at = gridCorner.z * vec2(gl_FragCoord.x - gridCorner.x, gridCorner.y - gl_FragCoord.y);
  vec2 outward = gridSpine.xy;
  float shortened = gridSpine.z;
  float reach = ${bentOver.toFixed(6)} * shortened;
  float from = dot(outward, at) - min(dot(outward, gridSize), 0.0);
  if (from >= reach || shortened <= 0.0) return vec3(at, 1.0);
  float flatly = reach - shortened;
  float t = (reach - from) / flatly;
  float bend = reach - flatly * t - shortened * t * t;
  return vec3(at + (bend - from) * outward, 1.0 + 2.0 * shortened * t / flatly);
}
`;
