/**
 * Shapes passed from the engine to the viewer, as flat arrays over the engine's
 * own memory. Book space: metres; x across the spine to the right, y along the
 * spine to the head, z up from the table; the spine lies at x = 0, the foot of
 * the pages at y = 0.
 */

import type { PaperMesh } from "../paper_mesh.ts";
import { presetStocks } from "../stocks.ts";

export type { PaperMesh };

/** The drawn mesh of a leaf in flight, row by row from the foot; a row runs from the spine to the fore-edge. */
export interface Surface {
  /** Points along a row. */
  readonly columns: number;
  /** Points along the spine. */
  readonly rows: number;
  /** x, y, z of each point in metres: 3 * columns * rows. */
  readonly positions: Float32Array;
  /** Unit normal of each point, on the recto's side: 3 * columns * rows. */
  readonly normals: Float32Array;
  /** Rises whenever positions change. */
  readonly version: number;
  /** Metres, if the leaf is so thick that its edges are visible. */
  readonly thickness?: number;
  /** Where its points lie on the flat paper, if the leaf is creased; another object when that changes. */
  readonly creased?: PaperMesh | undefined;
  /** How far a sheet is torn across, metres along the tear; infinite if it is a piece. */
  readonly opened?: number | undefined;
  /** Its place among loose sheets, from the table up, if it is one. */
  readonly layer?: number | undefined;
  /** Finds what of it may lie on other paper; missing where nothing does. */
  readonly papers?: LeafPapers | undefined;
}

/** Straight edges of a paper, at most: a page without two corners has six. */
export const mostPaperEdges = 6;

/** How many numbers describe a paper to what draws it: four for each of two, and three for each edge. */
export const paperNumbers: number = 4 * (2 + 3 * mostPaperEdges);

/** A flat part of a leaf, as it shades what is under it. */
export interface Paper {
  /**
   * What shaders read: the plane, with its height straight up; the part of its leaf that it shades,
   * or -1 less how much it shades, the height to which it does, half its width and the number of its
   * edges; and of each edge its inward direction, its direction over its length, and parabolas of how
   * far it is over the plane, and within a straight edge.
   */
  readonly data: Float32Array;
  readonly low: readonly [x: number, y: number];
  readonly high: readonly [x: number, y: number];
  /** Its highest point, metres. */
  readonly top: number;
}

/** Finds what of leaves lies on other paper, or close over it. */
export interface LeafPapers {
  /** Returns the parts of a creased leaf that come back over the rest of it, and all that are beyond them. */
  foldedParts(leaf: Surface): readonly number[];
  /**
   * Returns what is folded over onto the parts of a leaf, on one of its sides.
   *
   * @param sign 1 for the recto, -1 for the verso
   */
  flapsOn(leaf: Surface, sign: 1 | -1): readonly Paper[];
  /** Returns what is folded over of a leaf, as it shades other leaves close under it. */
  flapsOf(leaf: Surface): readonly Paper[];
  /**
   * Returns the parts of a loose sheet, as they shade what is under it.
   *
   * @param lies if true, they shade only what they lie on, or nearly so
   */
  papersOf(sheet: Surface, lies?: boolean): readonly Paper[];
}

/** A straight crease, from edge to edge of a leaf. */
export interface Crease {
  /** u, v, u, v of two places on its line, each 0 to 1. */
  readonly through: readonly [number, number, number, number];
  /** Angle at which it rests, radians: 0 is flat; above it the parts turn toward the recto. */
  readonly rest: number;
}

/**
 * How leaves are bound, which says what there is to tear: along the whole spine, at two staples,
 * or along a line of cuts. The engine counts them in this order.
 */
export const tearLines = ["sewn", "stapled", "perforated"] as const;

/** One of them. */
export type TearLine = (typeof tearLines)[number];

/**
 * The resting pages on one side, as curves across the spine: `layers` curves
 * from the uppermost page down to the board, each of `columns` points (x, z) in
 * metres from the spine to the fore-edge. Columns lie at the same u as a
 * leaf's, so that page and leaf meet without a seam.
 */
export interface Pile {
  readonly columns: number;
  readonly layers: number;
  /** x, z of each point: 2 * columns * layers. */
  readonly curves: Float32Array;
}

/** Returns the height of a pile's uppermost page at its fore-edge, metres: the pile's thickness. */
export function pileHeight({ curves, columns }: Pile): number {
  return curves[2 * columns - 1];
}

/** A stock that leaves may have of their own: a preset stock of paper, or grey board of 1.6 mm. */
export type LeafStockName = keyof typeof presetStocks;

/** Their names, from the lightest to the heaviest; the engine counts them in this order. */
export const leafStockNames = Object.keys(presetStocks) as readonly LeafStockName[];

/** A preset stock of paper. */
export type Stock = Exclude<LeafStockName, "board">;

/** Their names, likewise. */
export const stocks: readonly Stock[] = leafStockNames.filter((name) => name !== "board");

/** A stock in figures, in the units of the paper trade. */
export interface StockFigures {
  /** Mass per square metre, g/m². */
  readonly grammage: number;
  /** Thickness of a sheet, µm. */
  readonly caliper: number;
  /** Bending stiffness along the grain, mN·m. */
  readonly stiffnessAlong: number;
  /** Bending stiffness across the grain, mN·m. */
  readonly stiffnessAcross: number;
}

/** A point or direction in book space. */
export type Vec3 = readonly [x: number, y: number, z: number];

/** A line of sight in book space; the direction need not have unit length. */
export interface Ray {
  readonly origin: Vec3;
  readonly direction: Vec3;
}

/**
 * Returns u of a column of leaves and piles, 0 at the spine and 1 at the
 * fore-edge: columns crowd where pages bend. A test keeps it equal to the
 * engine's `crowded_columns`.
 */
export function columnPlace(column: number, columns: number): number {
  return (column / (columns - 1)) ** 1.7;
}

/**
 * Returns the column at u, and the fraction of the way to the next: the inverse
 * of `columnPlace`.
 */
export function columnAt(u: number, columns: number): number {
  return Math.min(Math.max(u, 0), 1) ** (1 / 1.7) * (columns - 1);
}

/** Returns the lowest and the highest x and y of a surface, metres. */
export function surfaceBounds({ positions }: Pick<Surface, "positions">): {
  readonly low: readonly [x: number, y: number];
  readonly high: readonly [x: number, y: number];
} {
  const low: [number, number] = [Infinity, Infinity];
  const high: [number, number] = [-Infinity, -Infinity];
  for (let at = 0; at < positions.length; at += 3) {
    for (const axis of [0, 1] as const) {
      low[axis] = Math.min(low[axis], positions[at + axis]);
      high[axis] = Math.max(high[axis], positions[at + axis]);
    }
  }
  return { low, high };
}
