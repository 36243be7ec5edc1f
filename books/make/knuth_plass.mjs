/**
 * Breaking a paragraph into lines as a whole: D. E. Knuth and M. F. Plass,
 * "Breaking Paragraphs into Lines", Software: Practice and Experience 11 (1981).
 *
 * Items are boxes { w, left, right }, glue { w, stretch, shrink } and penalties
 * { w, cost, hyphen }; `left` and `right` are how far a box may hang into the
 * margin at the ends of a line. Nodes are kept per line number, so that one pass
 * yields the best setting of every length: what the paper calls looseness.
 */

/** A last line shorter than this, in points, is a stub that hardly clears an indent. */
const STUB = 36;

const TOLERANCES = [1.6, 2.6, 5, 12];

/**
 * The best breaks for each number of lines, as Map<lines, { breaks, cost }>.
 * `widthOf(line)` is the measure of a line (drop caps make it vary).
 */
export function settings(items, widthOf) {
  for (const tolerance of TOLERANCES) {
    const found = pass(items, widthOf, tolerance);
    if (found.size > 0) return found;
  }
  throw new Error("A paragraph that no tolerance can set.");
}

/** Running sums of widths, so that a line is measured by subtraction. */
function sums(items) {
  const total = [{ w: 0, stretch: 0, shrink: 0 }];
  for (const item of items) {
    const last = total[total.length - 1];
    const penalty = item.kind === "penalty";
    total.push({
      w: last.w + (penalty ? 0 : item.w),
      stretch: last.stretch + (item.stretch ?? 0),
      shrink: last.shrink + (item.shrink ?? 0),
    });
  }
  return total;
}

const isBreak = (items, i) =>
  items[i].kind === "penalty"
    ? items[i].cost < 10000
    : items[i].kind === "glue" && !items[i].fill && items[i - 1]?.kind === "box";

/** First item of the line after a break: glue and penalties at its head are dropped. */
function lineStart(items, at) {
  let i = at;
  while (i < items.length && items[i].kind !== "box") i += 1;
  return i;
}

function pass(items, widthOf, tolerance) {
  const total = sums(items);
  const last = items.length - 1;
  let active = [{ at: -1, start: 0, line: 0, fit: 1, cost: 0, hyphen: false, from: null }];
  const done = new Map();
  for (let i = 0; i <= last; i++) {
    if (!isBreak(items, i)) continue;
    const best = new Map();
    const keep = [];
    for (const node of active) {
      const ratio = stretchOf(items, total, node.start, i, widthOf(node.line));
      if (ratio >= -1 && i !== last) keep.push(node);
      if (ratio < -1 || ratio > tolerance) continue;
      const stub = i === last && total[i].w - total[node.start].w < STUB;
      const next = judge(items[i], node, ratio, i === last, stub);
      const key = next.line * 4 + next.fit;
      if (!best.has(key) || best.get(key).cost > next.cost) best.set(key, next);
    }
    for (const node of best.values()) {
      node.at = i;
      node.start = lineStart(items, i);
      if (i < last) keep.push(node);
      else if (!done.has(node.line) || done.get(node.line).cost > node.cost) {
        done.set(node.line, node);
      }
    }
    active = keep;
  }
  return new Map([...done].map(([line, node]) => [line, trace(node)]));
}

/** How much the glue of a line from `start` to break `i` must stretch (> 0) or shrink. */
function stretchOf(items, total, start, i, width) {
  const item = items[i];
  let w = total[i].w - total[start].w - (items[start].left ?? 0);
  if (item.kind === "penalty") w += item.w - (item.right ?? 0);
  const before = items[item.kind === "penalty" && item.w > 0 ? i : i - 1];
  if (before?.kind === "box") w -= before.right ?? 0;
  const gap = width - w;
  if (Math.abs(gap) < 1e-6) return 0;
  const give =
    gap > 0 ? total[i].stretch - total[start].stretch : total[i].shrink - total[start].shrink;
  return give > 0 ? gap / give : gap > 0 ? 1e6 : -1e6;
}

/** The node after a line: demerits for badness, hyphens, and uneven neighbours. */
function judge(item, node, ratio, end, stub) {
  const badness = 100 * Math.abs(ratio) ** 3;
  const fit = ratio < -0.5 ? 0 : ratio <= 0.5 ? 1 : ratio <= 1 ? 2 : 3;
  const cost = item.cost ?? 0;
  let demerits = (10 + badness) ** 2;
  if (cost > 0) demerits += cost * cost;
  if (item.hyphen && node.hyphen) demerits += 25_000;
  if (end && node.hyphen) demerits += 30_000;
  if (stub) demerits += 150_000;
  if (Math.abs(fit - node.fit) > 1) demerits += 3000;
  return {
    line: node.line + 1,
    fit,
    cost: node.cost + demerits,
    hyphen: Boolean(item.hyphen),
    from: node,
  };
}

/** The breaks along a chain of nodes: [{ start, end, hyphen }] a line. */
function trace(node) {
  const breaks = [];
  for (let n = node; n.from; n = n.from) {
    breaks.unshift({ start: n.from.start, end: n.at, hyphen: n.hyphen });
  }
  return { breaks, cost: node.cost };
}
