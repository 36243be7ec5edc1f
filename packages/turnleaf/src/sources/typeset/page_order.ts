/**
 * Text that stands on an earlier or later page than its place among the other text: a caption written before its
 * table and set below it, the foot of a table, items in an order of their own.
 */

/** Something on some pages. */
export interface Paged {
  readonly first: number;
  readonly last: number;
}

/**
 * Returns those of some pieces of text, in the order of the text, none of which stands on a page before the one
 * before it: as many as can, by their weights.
 *
 * @param weightOf returns the weight of a piece, more than 0
 */
export function inPageOrder<P extends Paged>(
  pieces: readonly P[],
  weightOf: (piece: P) => number,
): readonly P[] {
  const isInOrder = pieces.every(({ first }, k) => first >= (pieces[k - 1]?.last ?? 0));
  if (isInOrder) return pieces;
  let pages = 0;
  for (const { last } of pieces) pages = Math.max(pages, last + 1);
  /** A Fenwick tree over pages: of orders that end on some page or before it, the heaviest. */
  const heaviest: (Order<P> | undefined)[] = Array.from({ length: pages + 1 });
  let best: Order<P> | undefined;
  for (const piece of pieces) {
    let before: Order<P> | undefined;
    for (let at = piece.first + 1; at > 0; at -= at & -at) before = heavier(before, heaviest[at]);
    const order = { piece, before, weight: (before?.weight ?? 0) + weightOf(piece) };
    for (let at = piece.last + 1; at <= pages; at += at & -at) {
      heaviest[at] = heavier(heaviest[at], order);
    }
    best = heavier(best, order);
  }
  const found: P[] = [];
  for (let order = best; order; order = order.before) found.push(order.piece);
  return found.reverse();
}

/** Pieces in their order, the last one first. */
interface Order<P> {
  readonly piece: P;
  readonly before: Order<P> | undefined;
  readonly weight: number;
}

function heavier<P>(one: Order<P> | undefined, other: Order<P> | undefined): Order<P> | undefined {
  return (other?.weight ?? 0) > (one?.weight ?? 0) ? other : one;
}
