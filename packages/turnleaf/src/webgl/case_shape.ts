/**
 * The case of a bound book as it moves: two rigid boards and the stiff spine
 * between them, each joined by a hinge of cloth. Seen in the plane across the
 * spine. Pure arithmetic.
 *
 * The spine lies flat under an open book and stands up as a board closes; its
 * lower edge stays on the table. From the back board's hinge to the front
 * board's the case runs back hinge, C, D, front hinge, where C to D is the
 * spine.
 */

import { caseSizes } from "../stage/case_sizes.ts";

/** Angles and positions of the case's parts, metres and radians. */
export interface CaseShape {
  /** x, z of the spine's edge by the back board. */
  c: [number, number];
  /** x, z of the spine's edge by the front board. */
  d: [number, number];
  backHinge: [number, number];
  frontHinge: [number, number];
  frontAngle: number;
  backAngle: number;
  /** 0 open, 1 closed over the right pile. */
  closedRight: number;
  /** 0 open, 1 closed over the left pile. */
  closedLeft: number;
}

/** Returns an open case around the spine. */
export function restingCase(): CaseShape {
  return {
    c: [0, 0],
    d: [0, 0],
    backHinge: [0, 0],
    frontHinge: [0, 0],
    frontAngle: Math.PI,
    backAngle: 0,
    closedRight: 0,
    closedLeft: 0,
  };
}

/**
 * Places the case.
 *
 * @param thickness of all leaves, metres
 * @param middle of the open book across the spine, metres
 * @param hinge length of the cloth hinge, metres
 */
export function placeCase(
  out: CaseShape,
  thickness: number,
  middle: number,
  frontAngle: number,
  backAngle: number,
  hinge: number,
): void {
  const front = Math.min(Math.PI, Math.max(0, frontAngle));
  const back = Math.min(Math.PI, Math.max(0, backAngle));
  out.frontAngle = front;
  out.backAngle = back;
  out.closedRight = 1 - front / Math.PI;
  out.closedLeft = back / Math.PI;
  const tilt = 0.5 * Math.PI * (out.closedLeft - out.closedRight);
  // From C to D: to the left when open, up when closed on the right, down on the left.
  const dx = -thickness * Math.cos(tilt);
  const dz = -thickness * Math.sin(tilt);
  if (tilt <= 0) {
    out.c[0] = (middle + thickness / 2) * (1 - out.closedRight);
    out.c[1] = 0;
    out.d[0] = out.c[0] + dx;
    out.d[1] = dz;
  } else {
    out.d[0] = (middle - thickness / 2) * (1 - out.closedLeft);
    out.d[1] = 0;
    out.c[0] = out.d[0] - dx;
    out.c[1] = -dz;
  }
  out.c[1] -= caseSizes.sink;
  out.d[1] -= caseSizes.sink;
  out.backHinge[0] = out.c[0] + hinge * Math.cos(back);
  out.backHinge[1] = out.c[1] + hinge * Math.sin(back);
  out.frontHinge[0] = out.d[0] + hinge * Math.cos(front);
  out.frontHinge[1] = out.d[1] + hinge * Math.sin(front);
}

/**
 * Returns how high pages may lie at `x` under a board that closes over them,
 * metres; Infinity if none is over them.
 *
 * @param sign 1 for the right pile under the front board, -1 for the left under
 * the back board
 */
export function lidHeight(shape: CaseShape, sign: 1 | -1, x: number): number {
  const hinge = sign === 1 ? shape.frontHinge : shape.backHinge;
  const angle = sign === 1 ? shape.frontAngle : Math.PI - shape.backAngle;
  if (angle > 1.4) return Infinity;
  const out = sign * (x - hinge[0]);
  // Under the cloth hinge the pile's shoulder is rounded, the more the flatter the board.
  if (out < 0) return hinge[1] + 0.5 * out * (1 - angle / 1.4);
  return hinge[1] + out * Math.tan(angle);
}
