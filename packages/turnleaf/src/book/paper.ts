/** The paper of a book's leaves, their binding and the air around them. */

import type { BookEngine } from "../engine/book_engine.ts";
import { type Stock, type StockFigures, stocks, type Vec3 } from "../engine/shapes.ts";
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
}

/** Default stiffness of the binding in N. A test keeps it equal to the engine's own. */
const usualBinding = 0.02;

/** Returns whether a word names a preset stock. */
export function isStock(word: unknown): word is Stock {
  return (stocks as readonly unknown[]).includes(word);
}

/**
 * Sets the paper of an engine's book, and the stocks of the leaves that have one
 * of their own. Leaves in flight are laid down.
 */
export function applyPaper(paper: Paper, engine: BookEngine, runs: readonly StockRun[] = []): void {
  const { stock = "book", grain = "along", binding = usualBinding, wind = [0, 0, 0] } = paper;
  if (!engine.setStock(stock)) engine.setStock("book");
  if (!engine.setBinding(grain, binding)) engine.setBinding(grain, usualBinding);
  if (!engine.setWind(wind)) engine.setWind([0, 0, 0]);
  engine.setAssist(paper.assist ?? true);
  for (const { first, end, stock } of runs) engine.setLeafStock(first, end, stock);
}
