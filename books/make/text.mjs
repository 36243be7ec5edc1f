/**
 * From the plain text of 1851 to blocks fit for setting: quotation marks are
 * turned, dashes and ellipses made whole, verse and tablets told from prose.
 * A block is { kind: "prose" | "verse" | "tablet" | "bill", text | lines }.
 */
import { readFileSync } from "node:fs";

const read = (name) => readFileSync(new URL(`./text/${name}.txt`, import.meta.url), "utf8");

/** Words that open with an elision; their mark is an apostrophe, never a quotation mark. */
const ELIDED = /(^|[\s—“(])'(em|balmed|tis|twas|twould|twill|gainst|mong|bout|till)\b/gi;

/** Straight marks become curly: opening after a space, a dash or another opening mark. */
export function curl(text) {
  return text
    .replace(/\.\.\.\./g, ".…")
    .replace(/\.\.\./g, "…")
    .replace(/--/g, "—")
    .replace(/—-/g, "—")
    .replace(ELIDED, "$1’$2")
    .replace(/(^|[\s—([“‘])"/g, "$1“")
    .replace(/(^|[\s—([“])'/g, "$1‘")
    .replace(/(“)"/g, "$1“")
    .replace(/"/g, "”")
    .replace(/'/g, "’")
    .replace(/’”/g, "’\u200a”")
    .replace(/“‘/g, "“\u200a‘")
    .replace(/ {2,}/g, " ")
    .trim();
}

const verse = (source) =>
  source
    .trim()
    .split(/\s*\n\s*| {4,}/)
    .map((line) => curl(line));

/** One chapter: { number, title, blocks }. Its first line is its heading. */
export function chapter(number) {
  const [head, ...rest] = read(`chapter_${number}`).split(/\n\s*\n/);
  const title = head.replace(/^CHAPTER \d+\. /, "").replace(/\.\s*$/, "");
  const blocks = rest
    .filter((part) => part.trim())
    .map((part) => {
      if (/^ {4}/.test(part)) return { kind: "verse", lines: verse(part) };
      if (part.startsWith('"Grand Contested')) return { kind: "bill", lines: bill(part) };
      if (part.startsWith("SACRED TO THE MEMORY")) return { kind: "tablet", lines: tablet(part) };
      return { kind: "prose", text: curl(part.replace(/\s+/g, " ")) };
    });
  return { number, title, blocks };
}

/** The tablets of the chapel, broken by sense as they would be cut in marble. */
function tablet(source) {
  return curl(source.replace(/\s+/g, " "))
    .replace(/, (?=Who, at|NATHAN|SETH|Near the|November|Forming|December|August|off P)/g, ",|")
    .replace(/ (?=JOHN|ROBERT|The late|Who were|On the|Who in|was killed|on the coast)/g, "|")
    .replace(/ (?=BY HIS|CAPTAIN|OF THE SHIP|in the P|SHIPMATES)/g, "|")
    .replace(/ (THIS (?:TABLET|MARBLE)) /, "|$1|")
    .split("|")
    .map((line) => line.trim())
    .filter(Boolean);
}

/** The playbill of the Fates: its three lines one under another. */
const bill = (source) => curl(source.replace(/\s+/g, " ")).split(/ (?=“)/);

/** Etymology: the usher's note, the quotations, and the table of names. */
export function etymology() {
  const parts = read("etymology")
    .split(/\n\s*\n/)
    .slice(1);
  const table = parts
    .pop()
    .split("\n")
    .filter((line) => line.trim());
  return {
    note: curl(parts[0]),
    quotes: parts.slice(1).map(quotation),
    names: table.map((line) => line.trim().replace(/\.$/, "").split(/,\s+/)),
  };
}

/** A quotation and where it is from: { lines | text, from }. */
function quotation(source) {
  const at = source.lastIndexOf("—");
  const from = curl(source.slice(at + 1).replace(/\s+/g, " "));
  const body = source
    .slice(0, at)
    .replace(/\* \* \*/g, "…")
    .replace(/^\s*—-/, "");
  if (/^ {3}/.test(source)) return { lines: verse(body.trimEnd()), from };
  return { text: curl(body.replace(/\s+/g, " ")), from };
}

/** Which of the eighty extracts this edition keeps, by the name of their source. */
const KEPT = [
  /—Genesis/,
  /—Job/,
  /—Jonah/,
  /—Psalms/,
  /—Isaiah/,
  /Plutarch/,
  /Pliny/,
  /Lucian/,
  /Other or/,
  /Stowe/,
  /Lord Bacon/,
  /King Henry/,
  /—Hamlet/,
  /Davenant/,
  /Hobbes/,
  /Pilgrim/,
  /Paradise Lost/,
  /There Leviathan/,
  /Dryden/,
  /Goldsmith, Nat/,
  /Cowper/,
  /Paley/,
  /Whale Song/,
];

/** The Sub-Sub-Librarian's preface and the extracts kept, in their order. */
export function extracts() {
  const parts = read("extracts")
    .split(/\n\s*\n/)
    .slice(1);
  const preface = parts.slice(0, 2).map((p) => curl(p.replace(/ EXTRACTS\.\s*$/, "")));
  const quotes = parts.slice(2).filter((p) => KEPT.some((want) => want.test(p)));
  return { preface, quotes: quotes.map(quotation) };
}
