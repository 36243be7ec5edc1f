/**
 * Filling pages: which setting each paragraph takes, and where pages end, found
 * for a whole chapter at once by dynamic programming over (block, row reached).
 * No page ends on the first line of a paragraph or begins with its last, and
 * none is short unless nothing else will do: a paragraph set a line longer or
 * shorter mends most pages (F. Mittelbach, "Effective Floating Strategies" and
 * M. F. Plass, "Optimal Pagination Techniques", 1981, treat the same search).
 */

const SHORT = 60_000; // a page one line short
const STEP = 25; // keeps demerits of line and page on one scale

/**
 * Blocks are { settings: [{ lines, cost }] } for paragraphs, { rows, draw, solid }
 * for what cannot be parted, { space } for blank rows that vanish at a page's ends.
 * Returns pages of [{ row, line | draw }].
 */
export function paginate(blocks, firstRows, rows) {
  const room = (page) => (page === 0 ? firstRows : rows);
  let states = new Map([["0|0", { page: 0, used: 0, cost: 0, from: null, put: null }]]);
  for (const block of blocks) {
    const next = new Map();
    for (const state of states.values()) {
      for (const step of steps(block, state, room)) {
        const key = `${step.page}|${step.used}`;
        if (!next.has(key) || next.get(key).cost > step.cost) next.set(key, step);
      }
    }
    if (next.size === 0) throw new Error("A chapter that cannot be paged.");
    states = next;
  }
  const ends = [...states.values()].map((s) => ({ ...s, cost: s.cost + endCost(s) }));
  return collect(ends.reduce((a, b) => (b.cost < a.cost ? b : a)));
}

/** A last page of a line or two looks like an accident. */
const endCost = ({ used, page }) => (page > 0 && used < 5 ? 400_000 : 0);

function* steps(block, state, room) {
  const { page, used } = state;
  if (block.space) {
    const free = room(page) - used;
    const gone = used === 0 || free <= block.space;
    const at = gone ? (used === 0 ? { page, used } : { page: page + 1, used: 0 }) : null;
    const short = gone && used > 0 ? free * 2000 : 0;
    yield {
      ...(at ?? { page, used: used + block.space }),
      cost: state.cost + short,
      from: state,
      put: [],
    };
    return;
  }
  if (block.rows) {
    const fits = used + block.rows <= room(page);
    const at = fits ? { page, row: used } : { page: page + 1, row: 0 };
    const cost = state.cost + (fits ? 0 : (room(page) - used) * 4000);
    const put = [{ page: at.page, row: at.row, draw: block.draw }];
    yield { page: at.page, used: at.row + block.rows, cost, from: state, put };
    return;
  }
  const least = block.settings[0].cost;
  for (const setting of block.settings) {
    const extra = (setting.cost - least) / STEP;
    for (const split of splits(setting.lines.length, page, used, room, setting.lines)) {
      const put = split.put.map((p) => ({ ...p, line: setting.lines[p.index] }));
      yield { ...split.end, cost: state.cost + extra + split.cost, from: state, put };
    }
  }
}

/** The ways n lines run from (page, used) on, with at most one row wanting a page. */
function splits(n, page, used, room, lines) {
  const found = [];
  const go = (index, p, row, put, cost) => {
    const left = n - index;
    const free = room(p) - row;
    if (left <= free) {
      const rest = Array.from({ length: left }, (_, k) => ({
        page: p,
        row: row + k,
        index: index + k,
      }));
      found.push({ put: [...put, ...rest], end: { page: p, used: row + left }, cost });
      return;
    }
    for (const wanting of [0, 1]) {
      const take = free - wanting;
      if (take < 0) continue;
      const orphan = index === 0 && take === 1;
      const widow = left - take === 1;
      if (orphan || widow) continue;
      const taken = Array.from({ length: take }, (_, k) => ({
        page: p,
        row: row + k,
        index: index + k,
      }));
      const broken = take > 0 && lines[index + take - 1].hyphen ? 3000 : 0;
      go(index + take, p + 1, 0, [...put, ...taken], cost + wanting * SHORT + broken);
    }
  };
  go(0, page, used, [], 0);
  return found;
}

function collect(end) {
  const pages = [];
  for (let s = end; s?.put; s = s.from) {
    for (const { page, ...what } of s.put) {
      pages[page] ??= [];
      pages[page].push(what);
    }
  }
  for (const page of pages) page.sort((a, b) => a.row - b.row);
  return pages;
}
