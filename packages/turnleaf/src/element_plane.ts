/**
 * The plane of an element as it is seen in its window: turned, scaled, skewed, mirrored or in
 * perspective by any `transform` and `zoom` of the elements around it.
 */

/** A point, CSS pixels. */
interface Point {
  readonly x: number;
  readonly y: number;
}

/** A row of a projection's matrix. */
type Row = readonly [x: number, y: number, one: number];

/** A projection of the plane: a matrix that maps homogeneous coordinates. */
export type Projection = readonly [Row, Row, Row];

/**
 * Returns the projection of a square, from 0 to 1 each way, onto four places: its corners row by
 * row (P. Heckbert, Fundamentals of Texture Mapping and Image Warping, 1989, section 2.2.3).
 */
export function projectionOnto([a, b, c, d]: readonly [Point, Point, Point, Point]): Projection {
  const [x1, x2, x3] = [b.x - d.x, c.x - d.x, a.x - b.x + d.x - c.x];
  const [y1, y2, y3] = [b.y - d.y, c.y - d.y, a.y - b.y + d.y - c.y];
  const area = x1 * y2 - x2 * y1;
  const [g, h] = [(x3 * y2 - x2 * y3) / area, (x1 * y3 - x3 * y1) / area];
  return [
    [b.x - a.x + g * b.x, c.x - a.x + h * c.x, a.x],
    [b.y - a.y + g * b.y, c.y - a.y + h * c.y, a.y],
    [g, h, 1],
  ];
}

function project(projection: Projection, x: number, y: number): Point {
  const [across, down, weight] = projection.map(([a, b, c]) => a * x + b * y + c);
  return { x: across / weight, y: down / weight };
}

/** Returns the adjugate of a projection, which is its inverse: a common factor changes nothing. */
function inverseOf([[a, b, c], [d, e, f], [g, h, i]]: Projection): Projection {
  return [
    [e * i - f * h, c * h - b * i, b * f - c * e],
    [f * g - d * i, a * i - c * g, c * d - a * f],
    [d * h - e * g, b * g - a * h, a * e - b * d],
  ];
}

/** The corners of a square, row by row. */
const corners = [
  [0, 0],
  [1, 0],
  [0, 1],
  [1, 1],
] as const;

/**
 * Maps points of the window to an element's own CSS pixels, and back. The browser says where the
 * element's corners are seen; a plane in space is seen by a projection, which four points give. So
 * whatever transforms the element is followed, as long as its corners lie before the eye.
 */
export class ElementPlane {
  readonly #element: HTMLElement;
  readonly #corners: readonly HTMLElement[];

  /** @param element is positioned, and gets an invisible child in each corner until `remove` */
  constructor(element: HTMLElement) {
    this.#element = element;
    this.#corners = corners.map(([x, y]) => {
      const corner = element.ownerDocument.createElement("i");
      corner.ariaHidden = "true";
      const [left, top] = [`${100 * x}%`, `${100 * y}%`];
      const place = { position: "absolute", left, top, width: "0", height: "0" };
      Object.assign(corner.style, { ...place, visibility: "hidden", pointerEvents: "none" });
      return corner;
    });
    element.append(...this.#corners);
  }

  /**
   * Returns where a point of the window, as `clientX` and `clientY` of an event, lies on the
   * element: CSS pixels of its own, from the upper left corner of its padding box; null while it is
   * not shown, or seen edge-on.
   */
  fromClient(x: number, y: number): Point | null {
    return this.measure()(x, y);
  }

  /** Returns what `fromClient` does, for many points at once: as the element is seen now. */
  measure(): (x: number, y: number) => Point | null {
    const { clientWidth, clientHeight } = this.#element;
    const inverse = inverseOf(this.#projection);
    return (x, y) => {
      const at = project(inverse, x, y);
      if (!Number.isFinite(at.x) || !Number.isFinite(at.y)) return null;
      return { x: at.x * clientWidth, y: at.y * clientHeight };
    };
  }

  /** Which way of the window's the element's own x axis goes, or comes closest to, at its middle. */
  get xAxis(): "right" | "left" | "down" | "up" {
    const [from, to] = [0, 1].map((x) => project(this.#projection, x, 0.5));
    const [x, y] = [to.x - from.x, to.y - from.y];
    if (Math.abs(y) > Math.abs(x)) return y > 0 ? "down" : "up";
    return x < 0 ? "left" : "right";
  }

  /**
   * How many CSS pixels of the window lie along one of the element's own, at most: along an axis, at an
   * edge. 1 while it is not shown.
   */
  get scale(): number {
    const [a, b, c, d] = this.#corners.map((corner) => corner.getBoundingClientRect());
    const along = (from: DOMRect, to: DOMRect): number => Math.hypot(to.x - from.x, to.y - from.y);
    const { clientWidth, clientHeight } = this.#element;
    const across = Math.max(along(a, b), along(c, d)) / clientWidth;
    const scale = Math.max(across, Math.max(along(a, c), along(b, d)) / clientHeight);
    return Number.isFinite(scale) && scale > 0 ? scale : 1;
  }

  /** Removes what was added to the element. */
  remove(): void {
    for (const corner of this.#corners) corner.remove();
  }

  /** That of a square, from 0 to 1 each way, onto the element in the window. */
  get #projection(): Projection {
    const [a, b, c, d] = this.#corners.map((corner) => corner.getBoundingClientRect());
    return projectionOnto([a, b, c, d]);
  }
}
