/** Etymology and Extracts: the two prefaces Melville set before his story. */
import { baseline, COLOUR, INDENT, LEAD, MEASURE, ROWS, SIZE } from "./measures.mjs";
import { paginate } from "./paginate.mjs";
import { itemsOf, setParagraph } from "./paragraph.mjs";
import { etymology, extracts } from "./text.mjs";

const SINK = 7;
const NOTE = 10.6;

const prose = (paper, spans, size, indent = INDENT) => ({
  settings: setParagraph(paper, itemsOf(paper, spans, { size, indent })),
});

/** A quotation with its source in italics after a dash. */
function quote(paper, { text, lines, from }) {
  const source = `—${from.replace(/\.$/, "")}.`.replace("”.", "”");
  if (text) return [prose(paper, [{ text }, { text: source, face: "italic" }], NOTE)];
  const draw = (at, left, y) => {
    lines.forEach((line, i) => {
      const hang = line.startsWith("“") ? at.shape("roman", NOTE, "“").width : 0;
      at.words(line, left + INDENT * 3 - hang, y + i * LEAD, { size: NOTE });
    });
    const end = { face: "italic", size: NOTE, align: "right" };
    at.words(source, left + MEASURE, y + lines.length * LEAD, end);
  };
  return [{ rows: lines.length + 1, draw }];
}

/** The names of the whale in thirteen tongues, two columns of them. */
function names(table) {
  const rows = Math.ceil(table.length / 2);
  const draw = (at, left, y) => {
    table.forEach(([word, tongue], i) => {
      const line = y + (i % rows) * LEAD;
      const middle = left + (i < rows ? 62 : 202);
      const hebrew = /[\u05d0-\u05ea]/.test(word);
      const style = hebrew
        ? { face: "hebrew", size: 11.5, features: [] }
        : /[α-ω]/.test(word)
          ? { size: 11.2, features: [] }
          : { size: 11, features: ["c2sc", "smcp"], track: 0.6 };
      at.words(word, middle - 4, line, { ...style, align: "right" });
      at.words(tongue, middle + 5, line, { face: "italic", size: 11.2 });
    });
  };
  return { rows, draw };
}

/** Both prefaces as { title, note, pages }, to be drawn like chapters. */
export function setApparatus(paper) {
  const word = etymology();
  const list = extracts();
  const first = [
    prose(paper, [{ text: word.note }], SIZE, 0),
    { space: 1 },
    ...word.quotes.flatMap((q) => quote(paper, q)),
    { space: 1 },
    names(word.names),
  ];
  const second = [
    ...list.preface.map((text, i) => prose(paper, [{ text }], SIZE, i ? INDENT : 0)),
    { space: 1 },
    ...list.quotes.flatMap((q) => quote(paper, q)),
  ];
  return [
    {
      title: "Etymology",
      note: "Supplied by a Late Consumptive Usher to a Grammar School",
      pages: paginate(first, ROWS - SINK, ROWS),
    },
    {
      title: "Extracts",
      note: "Supplied by a Sub-Sub-Librarian",
      pages: paginate(second, ROWS - SINK, ROWS),
    },
  ];
}

export function drawApparatusHeading(paper, title, note, left) {
  const middle = left + MEASURE / 2;
  paper.words(title, middle, baseline(2) + 4, { face: "medium", size: 23, align: "centre" });
  paper.words(note, middle, baseline(3) + 8, { face: "italic", size: 11, align: "centre" });
  paper.rule(middle - 19, middle + 19, baseline(4) + 6, 0.6, COLOUR.ink);
}

export { SINK };
