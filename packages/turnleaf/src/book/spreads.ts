/**
 * Which page lies where: the arithmetic of leaves and spreads.
 *
 * Leaf k (from 0) has two faces, recto 2k and verso 2k + 1, counted in a book
 * that is bound on its left or, turned by a quarter, at its top: leaf k turns
 * from the right to the left. A book bound on its right or at its bottom is the
 * same book with its pages counted from the other end. At spread s, s leaves
 * lie on the left: face 2s - 1 is visible beside face 2s. Pages count from 1.
 * With hard covers the first and the last leaf are the boards.
 */

/** The edge at which a book is bound, as its reader holds it. */
export type Edge = "left" | "right" | "top" | "bottom";

/**
 * "spread": pages on both sides of every leaf, two of them visible. "single":
 * one page on each leaf, visible alone.
 */
export type Layout = "spread" | "single";

/** What holds the leaves: boards in cloth, card, or nothing. */
export type CoverKind = "hard" | "soft" | "none";

/** How a book is to be bound. By default it is bound at the left, in spreads, with page 1 alone. */
export interface BindOptions {
  readonly edge?: Edge;
  readonly layout?: Layout;
  /** 1, the default: page 1 has nothing beside it; 0: pages 1 and 2 face each other. */
  readonly offset?: 0 | 1;
  /**
   * Which boards of a hard cover have no pages. By default none, or both where pages 1 and 2 face
   * each other.
   */
  readonly bareBoards?: "none" | "back" | "both";
  /** Pages (from 1) on leaves of board. */
  readonly hardPages?: Iterable<number>;
  /**
   * Pages (from 2, in order) before which a face is left bare; a page named
   * twice has two before it. It has no effect if each leaf has one page.
   */
  readonly bareBefore?: readonly number[];
}

/** A book's leaves and covers, and where its pages are on them. */
export interface Binding {
  readonly pageCount: number;
  /**
   * Number of leaves, boards included; also the number of the spread at which
   * all lie on the left.
   */
  readonly leaves: number;
  /** Whether the first and the last leaf are stiff boards. */
  readonly hardCover: boolean;
  /** Whether the first and the last leaf are card. */
  readonly softCover: boolean;
  readonly edge: Edge;
  readonly layout: Layout;
  /** Whether reading goes from the left of the engine's book to its right. */
  readonly reversed: boolean;
  /** Whether the spine lies across the screen: the engine's right is then at the bottom. */
  readonly quarterTurned: boolean;
  /**
   * The first and the last spread at which the book may lie open. Without
   * boards, a spread of bare paper does not count.
   */
  readonly first: number;
  readonly last: number;
  /** Leaves of board among the paper, from 0. */
  readonly hardLeaves: ReadonlySet<number>;
  /** The face of page 1 in the order of reading, and how many faces on each next page is. */
  readonly lead: number;
  readonly step: 1 | 2;
  /** Pages with a bare face before them, and those faces in the order of reading. */
  readonly bareBefore: readonly number[];
  readonly bareFaces: readonly number[];
}

/** Minimum of leaves with which two boards still hold paper between them. */
const leavesForBoards = 3;

/** Binds a book. Hard covers need paper between them; a book too thin for that gets none. */
export function bind(pageCount: number, cover: CoverKind, options: BindOptions = {}): Binding {
  const { edge = "left", layout = "spread", offset = 1, hardPages = [] } = options;
  const step = layout === "single" ? 2 : 1;
  const shifted = step === 1 && offset === 0;
  // If page 1 faces page 2, it has the back of its leaf to itself, and no page is left for a board.
  const bare = cover === "hard" ? (options.bareBoards ?? (shifted ? "both" : "none")) : "none";
  const lead = (bare === "both" ? 2 : 0) + (shifted ? 1 : 0);
  const bareBefore = step === 1 ? (options.bareBefore ?? []) : [];
  const faces = lead + step * (pageCount - 1) + bareBefore.length + 1;
  const leaves = Math.ceil(faces / 2) + (bare === "none" ? 0 : 1);
  const hardCover = cover === "hard" && leaves >= leavesForBoards;
  const reversed = edge === "right" || edge === "bottom";
  // The book does not lie open at a spread that shows only bare paper.
  const begin = lead === 0 || hardCover ? 0 : 1;
  const last = Math.ceil(faces / 2);
  // Boards without pages close over the last page; one page on each leaf leaves nothing else beyond it.
  const hasBack = bare !== "none" && hardCover;
  const ends = step === 2 ? hasBack : hardCover || faces === 2 * leaves;
  const end = ends ? leaves : step === 2 ? last - 1 : leaves - 1;
  const binding = {
    pageCount,
    leaves,
    hardCover,
    softCover: cover === "soft" && leaves >= leavesForBoards,
    edge,
    layout,
    reversed,
    quarterTurned: edge === "top" || edge === "bottom",
    first: reversed ? leaves - end : begin,
    last: reversed ? leaves - begin : end,
    hardLeaves: new Set<number>(),
    lead,
    step,
    bareBefore,
    bareFaces: bareBefore.map((page, index) => lead + page - 1 + index),
  } as const;
  for (const page of hardPages) {
    if (page >= 1 && page <= pageCount) binding.hardLeaves.add(faceOfPage(binding, page) >> 1);
  }
  return binding;
}

/**
 * Returns the number of leaves, boards included; also the number of the spread
 * at which all lie on the left.
 */
export function leafCount(binding: Binding): number {
  return binding.leaves;
}

/** Returns the number of leaves of paper, without the boards. */
export function paperLeaves(binding: Binding): number {
  return leafCount(binding) - (binding.hardCover ? 2 : 0);
}

/** Returns the number of paper leaves on the left at spread `s`, which may be fractional. */
export function paperOnLeft(binding: Binding, s: number): number {
  const boards = binding.hardCover ? 1 : 0;
  return Math.min(Math.max(s - boards, 0), paperLeaves(binding));
}

/** Returns whether leaf `k` is a board. */
export function isBoard(binding: Binding, k: number): boolean {
  return binding.hardCover && isOutermost(binding, k);
}

/** Returns whether leaf `k` is of a cover, of boards or of card. */
export function isCover(binding: Binding, k: number): boolean {
  return (binding.hardCover || binding.softCover) && isOutermost(binding, k);
}

function isOutermost(binding: Binding, k: number): boolean {
  return k === 0 || k === leafCount(binding) - 1;
}

/** Returns the page on the engine's left at spread `s`, or null if there is none. */
export function leftPage(binding: Binding, s: number): number | null {
  return pageOnFace(binding, 2 * s - 1);
}

/** Returns the page on the engine's right at spread `s`, or null if there is none. */
export function rightPage(binding: Binding, s: number): number | null {
  return pageOnFace(binding, 2 * s);
}

/** Returns the pages that lie open at spread `s`, in the order of reading. */
export function pagesAt(binding: Binding, s: number): number[] {
  const pages = [leftPage(binding, s), rightPage(binding, s)].filter((page) => page !== null);
  return binding.reversed ? pages.reverse() : pages;
}

/** Returns the sign by which spreads count as reading goes on. */
export function forward(binding: Binding): 1 | -1 {
  return binding.reversed ? -1 : 1;
}

/** Returns the direction of reading from one spread to another. */
export function directionOf(binding: Binding, from: number, to: number): "forward" | "backward" {
  return (to - from) * forward(binding) > 0 ? "forward" : "backward";
}

/** Returns the spread nearest to `s` at which the book may lie open. */
export function clampSpread(binding: Binding, s: number): number {
  return Math.min(Math.max(s, binding.first), binding.last);
}

/** Returns the spread that shows page `page` (clamped to the book). */
export function spreadOf(binding: Binding, page: number): number {
  const clamped = Math.min(Math.max(Math.round(page) || 1, 1), binding.pageCount);
  return (faceOfPage(binding, clamped) + 1) >> 1;
}

/**
 * Returns the first visible page at spread `s` in the order of reading; on a
 * closed side without a page of its own, the nearest.
 */
export function pageOf(binding: Binding, s: number): number {
  const [page] = pagesAt(binding, s);
  if (page !== undefined) return page;
  const read = binding.reversed ? leafCount(binding) - s : s;
  return 2 * read <= binding.lead ? 1 : binding.pageCount;
}

/**
 * Returns the edge of a page that lies at the spine, as it is read, or "board"
 * for a page on the boards of a hard cover.
 */
export function spineOf(binding: Binding, page: number): Edge | "board" {
  const face = faceOfPage(binding, page);
  if (isBoard(binding, face >> 1)) return "board";
  const isRecto = face % 2 === 0;
  if (binding.quarterTurned) return isRecto ? "top" : "bottom";
  return isRecto ? "left" : "right";
}

/** Returns the leaf (from 0, boards included) of a page of this book. */
export function leafOf(binding: Binding, page: number): number {
  return faceOfPage(binding, page) >> 1;
}

/** Returns the face of a page of this book. */
function faceOfPage(binding: Binding, page: number): number {
  const bare = countUpTo(binding.bareBefore, page);
  const read = binding.lead + binding.step * (page - 1) + bare;
  return binding.reversed ? 2 * binding.leaves - 1 - read : read;
}

function pageOnFace(binding: Binding, face: number): number | null {
  const read = binding.reversed ? 2 * leafCount(binding) - 1 - face : face;
  const bare = countUpTo(binding.bareFaces, read);
  if (binding.bareFaces[bare - 1] === read) return null;
  const page = (read - bare - binding.lead) / binding.step + 1;
  return Number.isInteger(page) && page >= 1 && page <= binding.pageCount ? page : null;
}

/** Returns how many numbers of an ascending list are at most `most`. */
export function countUpTo(list: readonly number[], most: number): number {
  let [low, high] = [0, list.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((list[middle] as number) <= most) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Maximum of leaves that a jump turns one by one. */
const mostSingle = 12;

/**
 * Leaves that fly in a longer jump. Each stands for an equal part of all
 * leaves, as in a riffle.
 */
const riffled = 9;

/**
 * Returns the spreads at which the turns from one spread to another end. A
 * short jump turns every leaf of paper, a long one few that stand for many. A
 * board always turns by itself, because it carries two pages of its own.
 */
export function waypoints(binding: Binding, from: number, to: number): number[] {
  const last = leafCount(binding);
  const boards = binding.hardCover ? [1, last - 1] : [];
  const between = boards.filter((s) => (from < to ? s > from && s < to : s < from && s > to));
  if (from > to) between.reverse();
  const way: number[] = [];
  for (const stop of [...between, to]) way.push(...turnsTo(way.at(-1) ?? from, stop));
  return way;
}

/** Returns the ends of the turns between two spreads with no board between them. */
function turnsTo(from: number, to: number): number[] {
  const leaves = Math.abs(to - from);
  const turns = leaves <= mostSingle ? leaves : riffled;
  return Array.from(
    { length: turns },
    (_, k) => from + Math.round(((to - from) * (k + 1)) / turns),
  );
}
