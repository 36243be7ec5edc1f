/** The paper of a book's leaves, their binding and the air around them. */

import type { BookEngine } from "../engine/book_engine.ts";
import type { Stock, StockFigures, Vec3 } from "../engine/shapes.ts";
import type { StockRun } from "./leaf_stocks.ts";

/** The paper of a book. Missing or invalid values fall back to their defaults. */
export interface Paper {
  /** A preset, or figures. The default is "book". */
  readonly stock?: Stock | StockFigures;
  /** Direction of the fibres: "along" the spine, the default, lets pages turn softly. */
  readonly grain?: "along" | "across";
  /**
   * Stiffness of the binding against a leaf that leaves the gutter at an angle
   * of its own, in N: 0 to 1.
   */
  readonly binding?: number;
  /**
   * Velocity of the air in m/s, each component within 20: x to the right, y to
   * the head, z up. The default is still air.
   */
  readonly wind?: Vec3;
  /**
   * If true, the default, a released leaf is helped over to its side; otherwise
   * it is left to gravity.
   */
  readonly assist?: boolean;
  /**
   * Width of a page in metres, 0.005 to 5: its leaves move as those of a book of that size. The
   * default is what the book's source knows, else that of a page of 0.0294 m², as 140 x 210 mm.
   */
  readonly pageWidth?: number;
}

/** Default stiffness of the binding in N. A test keeps it equal to the engine's own. */
const usualBinding = 0.02;

/** The size of a page as it is drawn, metres, and whether it is bound at its head or foot. */
interface DrawnPage {
  readonly width: number;
  readonly height: number;
  readonly quarterTurned: boolean;
}

/**
 * Returns how many times as large as it is drawn a book is whose pages are `width` metres wide; 1 if
 * that is not known, or not 0.005 to 5.
 */
export function scaleOf(width: number | undefined, page: DrawnPage): number {
  if (width === undefined || !(width >= 0.005 && width <= 5)) return 1;
  return width / (page.quarterTurned ? page.height : page.width);
}

/**
 * Sets the paper of an engine's book, and the stocks of the leaves that have one
 * of their own. Leaves in flight are laid down.
 *
 * @param scale how many times as large as it is drawn the book is
 */
export function applyPaper(
  paper: Paper,
  engine: BookEngine,
  runs: readonly StockRun[] = [],
  scale = 1,
): void {
  const { stock = "book", grain = "along", binding = usualBinding, wind = [0, 0, 0] } = paper;
  if (!engine.setStock(stock)) engine.setStock("book");
  if (!engine.setBinding(grain, binding)) engine.setBinding(grain, usualBinding);
  if (!engine.setWind(wind)) engine.setWind([0, 0, 0]);
  engine.setAssist(paper.assist ?? true);
  if (!engine.setScale(scale)) engine.setScale(1);
  for (const { first, end, stock } of runs) engine.setLeafStock(first, end, stock);
}
