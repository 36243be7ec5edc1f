/** What a book's leaves are made of, how they are bound, and the air about them. */

import type { BookEngine } from "../engine/book_engine.ts";
import { type Stock, type StockFigures, stocks, type Vec3 } from "../engine/shapes.ts";

/** The paper of a book. What is left out, or could not be, is as usual. */
export interface Paper {
  /** A preset, or figures: "book" as usual. */
  readonly stock?: Stock | StockFigures;
  /** Whether the fibres lie along the spine, so that pages turn softly, as usual; or across it. */
  readonly grain?: "along" | "across";
  /** Stiffness of the binding against a leaf that leaves the gutter in a direction of its own, N: 0 to 1. */
  readonly binding?: number;
  /** Velocity of the air, m/s, each component within 20: x to the right, y to the head, z up. Still as usual. */
  readonly wind?: Vec3;
  /** Whether a leaf let go is helped over to its side, as usual, or left to gravity. */
  readonly assist?: boolean;
}

/** Stiffness of the binding where nothing is said, N. The engine's own, held to it by a test. */
const usualBinding = 0.02;

/** Whether a word names a preset stock. */
export function isStock(word: unknown): word is Stock {
  return (stocks as readonly unknown[]).includes(word);
}

/** Makes a book's leaves of a paper. Leaves in flight are laid down. */
export function applyPaper(paper: Paper, engine: BookEngine): void {
  const { stock = "book", grain = "along", binding = usualBinding, wind = [0, 0, 0] } = paper;
  if (!engine.setStock(stock)) engine.setStock("book");
  if (!engine.setBinding(grain, binding)) engine.setBinding(grain, usualBinding);
  if (!engine.setWind(wind)) engine.setWind([0, 0, 0]);
  engine.setAssist(paper.assist ?? true);
}
