/**
 * A paragraph between its words and its lines: words become the boxes, glue and
 * penalties that `knuth_plass` breaks, and its breaks become lines of shaped
 * pieces. Marks at the ends of a line hang a little into the margin.
 */
import { createRequire } from "node:module";
import { settings } from "./knuth_plass.mjs";
import { MEASURE, SIZE } from "./measures.mjs";

const require = createRequire(import.meta.url);
const { hyphenateSync } = require("hyphen/en-us");

const SOFT = "\u00ad";
/** How much of its own width a mark hangs out, at the left and at the right. */
const HANG_RIGHT = {
  "-": 0.6,
  ".": 0.65,
  ",": 0.65,
  "’": 0.55,
  "”": 0.5,
  "—": 0.12,
  ";": 0.3,
  ":": 0.3,
};
const HANG_LEFT = { "“": 0.5, "‘": 0.55, W: 0.03, V: 0.04, T: 0.04, A: 0.03, Y: 0.05 };

/** Where a word may be broken: { at, hyphen } in characters, hyphens inserted or its own. */
function opportunities(word) {
  const found = [];
  let from = 0;
  for (const part of word.split(/(?<=[—-])(?=[\p{L}“‘])/u)) {
    const letters = /^[^\p{L}]*(\p{L}{5,})[^\p{L}]*$/u.exec(part);
    // A capital within a sentence is a name as a rule; names are not broken.
    if (letters && !/^\p{Lu}/u.test(letters[1])) {
      const offset = from + part.indexOf(letters[1]);
      let at = 0;
      for (const syllable of hyphenateSync(letters[1]).split(SOFT).slice(0, -1)) {
        at += syllable.length;
        if (at >= 3 && letters[1].length - at >= 3) found.push({ at: offset + at, hyphen: true });
      }
    }
    from += part.length;
    if (from < word.length) found.push({ at: from, hyphen: false });
  }
  return found;
}

/**
 * Items of a paragraph. `spans` are { text, face, features, track }; `indent`
 * is points before the first word.
 */
export function itemsOf(paper, spans, { size = SIZE, indent = 0 } = {}) {
  const items = [];
  if (indent) items.push({ kind: "box", w: indent, blank: true });
  const glue = { kind: "glue", w: 0.225 * size, stretch: 0.15 * size, shrink: 0.065 * size };
  spans.forEach((span, s) => {
    span.text
      .split(" ")
      .filter(Boolean)
      .forEach((word, i) => {
        if (i > 0 || s > 0) items.push(glue);
        pushWord(paper, items, word, { face: "roman", ...span, size });
      });
  });
  items.push({ kind: "glue", w: 0, stretch: 1e5, shrink: 0, fill: true });
  items.push({ kind: "penalty", w: 0, cost: -10000 });
  return items;
}

function pushWord(paper, items, word, style) {
  const { face, size, features, track = 0 } = style;
  const width = (text) => paper.shape(face, size, text, features).width + track * text.length;
  const hang = (mark, table) => (table[mark] ? table[mark] * width(mark) : 0);
  let from = 0;
  for (const { at, hyphen } of [...opportunities(word), { at: word.length }]) {
    const w = width(word.slice(0, at)) - (from ? width(word.slice(0, from)) : 0);
    const left = hang(word[from], HANG_LEFT);
    items.push({
      kind: "box",
      w,
      left,
      right: hang(word[at - 1], HANG_RIGHT),
      word,
      from,
      at,
      style,
    });
    if (at < word.length && hyphen) {
      items.push({
        kind: "penalty",
        w: width("-"),
        right: hang("-", HANG_RIGHT),
        cost: 75,
        hyphen,
      });
    } else if (at < word.length) {
      items.push({ kind: "penalty", w: 0, right: 0, cost: word[at - 1] === "-" ? 40 : 20 });
    }
    from = at;
  }
}

/**
 * All good settings of a paragraph: [{ lines, cost }], the best first. A line is
 * { pieces, gap, x, hyphen }. `lineWidth(i)` and `lineX(i)` shape the block.
 */
export function setParagraph(paper, items, lineWidth = () => MEASURE, lineX = () => 0) {
  const all = [...settings(items, lineWidth)].map(([, { breaks, cost }]) => ({
    cost,
    lines: breaks.map((b, i) =>
      makeLine(paper, items, b, i, breaks.length, lineWidth(i), lineX(i)),
    ),
  }));
  return all.sort((a, b) => a.cost - b.cost || a.lines.length - b.lines.length);
}

/** The pieces of one line, and what each space must give for it to be full. */
function makeLine(paper, items, { start, end, hyphen }, index, count, width, x) {
  const pieces = [];
  let indent = 0;
  let natural = 0;
  let spaces = 0;
  const add = (text, style) => {
    const piece = paper.shape(style.face, style.size, text, style.features);
    natural += piece.width + (style.track ?? 0) * piece.run.glyphs.length;
    pieces.push(style.track ? { ...piece, track: style.track } : piece);
  };
  let first = null;
  let last = null;
  for (let i = start; i < end; i++) {
    const item = items[i];
    if (item.blank) indent = item.w;
    if (item.kind === "glue" && item.w > 0 && pieces.length > 0) {
      add(" ", last.style);
      spaces += 1;
    }
    if (item.kind !== "box" || item.blank) continue;
    first ??= item;
    const begin = item.from;
    while (items[i + 1]?.kind === "penalty" && i + 2 < end && items[i + 2].from === items[i].at) {
      i += 2;
    }
    last = items[i];
    const broken = hyphen && i + 1 === end;
    add(last.word.slice(begin, last.at) + (broken ? "-" : ""), last.style);
  }
  const left = indent ? 0 : first.left;
  const hung = hyphen ? (items[end].right ?? 0) : last.right;
  const room = width - indent + left + hung - natural;
  const ending = index === count - 1;
  const gap = spaces && (!ending || room < 0) ? room / spaces : 0.025 * last.style.size;
  return { pieces, gap, x: x + indent - left, hyphen, natural: natural + indent };
}

/** Draw a line of a paragraph at the left edge and baseline given. */
export function drawLine(paper, line, left, y, colour) {
  paper.line(line.pieces, left + line.x, y, { gap: line.gap, colour });
}
