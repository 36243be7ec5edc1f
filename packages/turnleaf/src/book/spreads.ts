/**
 * Which page lies where: the arithmetic of leaves and spreads.
 *
 * Leaf k (from 0) carries page 2k + 1 on its recto and 2k + 2 on its verso;
 * pages count from 1. At spread s, s leaves lie on the left: page 2s faces page
 * 2s + 1. With hard covers the first and the last leaf are the boards.
 */

/** A book's leaves and covers. */
export interface Binding {
  readonly pageCount: number;
  /** Whether the first and the last leaf are stiff boards. */
  readonly hardCover: boolean;
}

/** Fewest leaves with which two boards still hold paper between them. */
const leavesForBoards = 3;

/** A book's binding: hard covers only where paper is left between them. */
export function bind(pageCount: number, cover: "hard" | "none"): Binding {
  const leaves = Math.ceil(pageCount / 2);
  return { pageCount, hardCover: cover === "hard" && leaves >= leavesForBoards };
}

/** Leaves of the book, boards included; also the number of its last spread. */
export function leafCount(binding: Binding): number {
  return Math.ceil(binding.pageCount / 2);
}

/** Leaves of paper, without the boards. */
export function paperLeaves(binding: Binding): number {
  return leafCount(binding) - (binding.hardCover ? 2 : 0);
}

/** Leaves of paper on the left at spread `s`, which may lie between two whole ones. */
export function paperOnLeft(binding: Binding, s: number): number {
  const boards = binding.hardCover ? 1 : 0;
  return Math.min(Math.max(s - boards, 0), paperLeaves(binding));
}

/** Whether leaf `k` is a board. */
export function isBoard(binding: Binding, k: number): boolean {
  return binding.hardCover && (k === 0 || k === leafCount(binding) - 1);
}

/** The page on the left at spread `s`, or null on the closed book. */
export function leftPage(binding: Binding, s: number): number | null {
  return existing(binding, 2 * s);
}

/** The page on the right at spread `s`, or null on the closed book. */
export function rightPage(binding: Binding, s: number): number | null {
  return existing(binding, 2 * s + 1);
}

function existing(binding: Binding, page: number): number | null {
  return page >= 1 && page <= binding.pageCount ? page : null;
}

/** The spread that shows page `page` (clamped to the book). */
export function spreadOf(binding: Binding, page: number): number {
  const clamped = Math.min(Math.max(Math.round(page) || 1, 1), binding.pageCount);
  return Math.floor(clamped / 2);
}

/**
 * The first page seen at spread `s`: the left one, on the closed front the
 * cover; on a closed back without a page of its own, the last page.
 */
export function pageOf(binding: Binding, s: number): number {
  return leftPage(binding, s) ?? rightPage(binding, s) ?? binding.pageCount;
}

/** Leaves that a way turns one by one, at most. */
const mostSingle = 12;

/** Leaves that fly for all those of a longer way, each for its share, as under a thumb. */
const riffled = 9;

/**
 * The spreads at which a way from one spread to another stops: one turn each.
 * A short way turns every leaf of paper, a long one few that stand for many; a
 * board always turns by itself, for it carries its own two pages.
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

/** The stops between two spreads that no board parts. */
function turnsTo(from: number, to: number): number[] {
  const leaves = Math.abs(to - from);
  const turns = leaves <= mostSingle ? leaves : riffled;
  return Array.from(
    { length: turns },
    (_, k) => from + Math.round(((to - from) * (k + 1)) / turns),
  );
}
