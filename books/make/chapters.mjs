/** A chapter as pages: its opening, its prose, and the verse and tablets in it. */
import { baseline, COLOUR, INDENT, LEAD, MEASURE, num, ROWS, SIZE } from "./measures.mjs";
import { paginate } from "./paginate.mjs";
import { drawLine, itemsOf, setParagraph } from "./paragraph.mjs";
import { chapter } from "./text.mjs";

const SINK = 8; // rows given to the heading of an opening page
const SMALL = { features: ["smcp", "onum", "pnum"], track: 0.5 };
const DROP_ROWS = 3;
const CAP_HEIGHT = 0.65; // of the em, as are small caps
const SMALL_HEIGHT = 0.43;
/** Words of each opening set in small caps after the drop cap: a phrase, as a printer would. */
const PHRASE = {
  1: 3,
  2: 2,
  3: 3,
  4: 2,
  5: 3,
  6: 5,
  7: 5,
  8: 6,
  9: 3,
  10: 5,
  11: 6,
  12: 2,
  13: 3,
  14: 3,
};

/** Prose of ordinary paragraphs as a block for the pager. */
export function proseBlock(paper, text, style = {}) {
  const items = itemsOf(paper, [{ text }], { indent: INDENT, ...style });
  return { settings: setParagraph(paper, items) };
}

/**
 * A capital from the small caps of the first line down to the third baseline; one with
 * a tail is made smaller, so that the tail keeps clear of the fourth line. `deep` is how
 * far its baseline lies below the first line's.
 */
function dropCap(paper, letter) {
  const tall = (DROP_ROWS - 1) * LEAD + SIZE * SMALL_HEIGHT;
  const { minY } = paper.shape("roman", 1, letter, []).run.glyphs[0].bbox;
  const tail = Math.max(0, -minY / 1000 - 0.05);
  const size = tail > 0.1 ? (tall + 3) / (CAP_HEIGHT + tail) : tall / CAP_HEIGHT;
  const deep = size * CAP_HEIGHT - SIZE * SMALL_HEIGHT;
  return { size, deep, cap: paper.shape("roman", size, letter, []) };
}

/** The first paragraph: a capital three lines deep, then a phrase in small caps. */
function openingBlock(paper, text, phrase) {
  const { size, deep, cap } = dropCap(paper, text[0]);
  const box = cap.run.glyphs[0].bbox;
  const edge = (box.minX * size) / 1000; // the ink, not its sidebearing, meets the margin
  const wide = (box.maxX * size) / 1000 - edge + 4;
  const words = text.slice(1).split(" ");
  const head = words.slice(0, phrase).join(" ").toLowerCase();
  const first = text[0] === "I" && head.startsWith(" ");
  const spans = [
    { text: first ? head.trim() : head, ...SMALL },
    { text: words.slice(phrase).join(" ") },
  ];
  const items = itemsOf(paper, keepNames(spans, text, phrase));
  const indent = (i) => (i < DROP_ROWS ? wide : 0);
  const settings = setParagraph(paper, items, (i) => MEASURE - indent(i), indent);
  for (const { lines } of settings) lines[0].drop = { cap, x: -edge, deep };
  return { settings };
}

/** Small caps keep the capitals of names: the phrase as it was, not in lower case. */
function keepNames(spans, text, phrase) {
  const own = text.slice(1).split(" ").slice(0, phrase).join(" ").trim();
  return [{ ...spans[0], text: own }, spans[1]];
}

/** Verse: set by its own lines, centred by the longest, never parted. */
function verseBlocks(paper, lines) {
  const size = SIZE - 0.3;
  const set = lines.map((line) => paper.shape("roman", size, line));
  const widest = Math.max(...set.map((line) => line.width));
  const draw = (at, left, y) =>
    set.forEach((line, i) => {
      const hang = lines[i].startsWith("“") ? 0 : paper.shape("roman", size, "“").width;
      at.line([line], left + (MEASURE - widest) / 2 + hang, y + i * LEAD);
    });
  return [{ space: 1 }, { rows: lines.length, draw }, { space: 1 }];
}

/** A tablet of the chapel: lines centred in small caps and roman, within a black border. */
function tabletBlocks(_paper, lines) {
  const rows = lines.length + 2;
  const draw = (at, left, y) => {
    const middle = left + MEASURE / 2;
    const top = y - LEAD * 0.35;
    const high = rows * LEAD - LEAD * 0.65;
    const wide = 218;
    at.stroke(COLOUR.ink, 1.6);
    at.op(`${[middle - wide / 2, top, wide, high].map(num).join(" ")} re S`);
    at.stroke(COLOUR.ink, 0.4);
    const inner = [middle - wide / 2 + 3.2, top + 3.2, wide - 6.4, high - 6.4];
    at.op(`${inner.map(num).join(" ")} re S`);
    lines.forEach((line, i) => {
      const capital = line === line.toUpperCase();
      const style = capital
        ? { size: 10.6, features: ["c2sc", "smcp", "onum"], track: 0.9 }
        : { size: 10.4, features: ["onum", "pnum"] };
      at.words(line, middle, y + (i + 1) * LEAD, { ...style, align: "centre" });
    });
  };
  return [{ space: 1 }, { rows, draw }, { space: 1 }];
}

/** The bill of the Fates, a line of it under another in ever larger letters. */
function billBlocks(_paper, lines) {
  const sizes = [10.4, 11.2, 13.2];
  const draw = (at, left, y) =>
    lines.forEach((line, i) => {
      const features = i === 0 ? ["onum"] : ["c2sc", "smcp"];
      const style = { face: i === 0 ? "italic" : "roman", size: sizes[i], features };
      at.words(line, left + MEASURE / 2, y + i * LEAD, {
        ...style,
        track: i ? 0.8 : 0,
        align: "centre",
      });
    });
  return [{ space: 1 }, { rows: lines.length, draw }, { space: 1 }];
}

const SPECIAL = { verse: verseBlocks, tablet: tabletBlocks, bill: billBlocks };

/** Set a chapter: { number, title, pages } where a page is what `drawPage` draws. */
export function setChapter(paper, number) {
  const { title, blocks } = chapter(number);
  const made = blocks.flatMap((block, i) => {
    if (i === 0) return [openingBlock(paper, block.text, PHRASE[number])];
    if (block.kind === "prose") return [proseBlock(paper, block.text)];
    return SPECIAL[block.kind](paper, block.lines);
  });
  const flow = made.filter((block, i) => !(block.space && made[i - 1]?.space));
  const pages = paginate(flow, ROWS - SINK, ROWS);
  endLeaf(pages[pages.length - 1]);
  return { number, title, pages };
}

/** Where a chapter leaves much of its last page bare, a printer's leaf closes it. */
function endLeaf(page) {
  const row = page[page.length - 1].row + 3;
  if (row > ROWS - 8) return;
  page.push({
    row,
    draw: (at, left, y) =>
      at.words("❦", left + MEASURE / 2, y, { size: 15, features: [], align: "centre" }),
  });
}

/** What stands on a page of running text, from a row of the grid on. */
export function drawRows(paper, page, left, from = 0) {
  for (const { row, line, draw } of page) {
    const y = baseline(row + from);
    if (line?.drop) {
      const { cap, x, deep } = line.drop;
      paper.line([cap], left + x, y + deep);
    }
    if (draw) draw(paper, left, y);
    else drawLine(paper, line, left, y);
  }
}

/** The heading of a chapter. */
export function drawHeading(paper, number, title, left) {
  const middle = left + MEASURE / 2;
  paper.words(`CHAPTER ${number}`, middle, baseline(2), {
    size: 10.2,
    track: 2.3,
    features: ["lnum"],
    align: "centre",
  });
  paper.words(title, middle, baseline(4) + 2, { face: "medium", size: 23, align: "centre" });
  paper.rule(middle - 19, middle + 19, baseline(5) + 1, 0.6);
}

export { SINK };
