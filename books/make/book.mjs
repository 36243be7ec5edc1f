/**
 * The order of the book. Everything is set first, so that each page is known;
 * then the pages are drawn from cover to cover.
 */
import { drawApparatusHeading, SINK as FRONT_SINK, setApparatus } from "./apparatus.mjs";
import { drawHeading, drawRows, SINK, setChapter } from "./chapters.mjs";
import { backBoard, frontBoard } from "./cover.mjs";
import { drawEndpaper } from "./endpapers.mjs";
import { colophon, contents, dedication, halfTitle, titlePage } from "./front.mjs";
import { folio, roman, runningHead } from "./furniture.mjs";
import { blockLeft } from "./measures.mjs";
import { tailpiece } from "./ornaments.mjs";
import { Paper } from "./paper.mjs";
import { drawPlate, PLATES } from "./plates/index.mjs";

const CHAPTERS = 14;
const INFO = {
  Title: "Moby-Dick; or, The Whale (Chapters 1 to 14)",
  Author: "Herman Melville",
  Subject: "The first fourteen chapters, with eight plates",
  Keywords: "Moby-Dick, whale, Nantucket, New Bedford",
  Creator: "Turnleaf, books/make",
};

/** Pages of running text: the opening carries a heading, the others a head. */
function textPages({ pages, heading, sink, head, name, title }) {
  return pages.map((rows, i) => ({
    name: i === 0 ? name : undefined,
    title: i === 0 ? title : undefined,
    numbered: true,
    draw(paper, { left, recto }) {
      if (i === 0) heading(left);
      else runningHead(paper, recto ? head : "Moby-Dick", left);
      drawRows(paper, rows, left, i === 0 ? sink : 0);
    },
  }));
}

const plate = (name) => ({
  name: `plate-${name}`,
  draw: (paper, { left }) => drawPlate(paper, name, left),
});
const blank = { draw() {} };

/** All that comes before the arabic numbers; `lists` are filled once pages are known. */
function frontMatter(paper, lists) {
  const prefaces = setApparatus(paper).flatMap(({ title, note, pages }) =>
    textPages({
      pages,
      sink: FRONT_SINK,
      head: title,
      name: title.toLowerCase(),
      title,
      heading: (left) => drawApparatusHeading(paper, title, note, left),
    }),
  );
  return [
    { title: "Half title", draw: () => halfTitle(paper) },
    plate("breach"),
    { title: "Title page", draw: () => titlePage(paper) },
    { draw: () => colophon(paper) },
    { draw: () => dedication(paper) },
    blank,
    { title: "Contents", draw: () => contents(paper, "Contents", lists.chapters, true) },
    { draw: () => contents(paper, "The Plates", lists.plates, false) },
    ...prefaces,
  ];
}

/**
 * A plate faces the opening of its chapter: on its right if that is a verso (the
 * chapter goes on behind it); else it takes the next left-hand page.
 */
const withPlate = (pages, name) => (name ? [pages[0], plate(name), ...pages.slice(1)] : pages);

function body(paper) {
  const pages = [];
  for (let n = 1; n <= CHAPTERS; n++) {
    const { title, pages: set } = setChapter(paper, n);
    const made = textPages({
      pages: set,
      sink: SINK,
      head: title,
      name: `chapter-${n}`,
      title: `${n}. ${title}`,
      heading: (left) => drawHeading(paper, n, title, left),
    });
    const own = PLATES.find((p) => p.chapter === n);
    pages.push(...withPlate(made, own?.name));
  }
  return pages;
}

/** What stands outside the numbered pages, front and back. */
const outside = (prefix, draw, ground) => ({ label: { prefix }, draw, ground });

export async function makeBook() {
  const paper = new Paper(INFO);
  const lists = { chapters: [], plates: [] };
  const front = frontMatter(paper, lists);
  while (front.length % 2 === 0) front.push(blank);
  front.push(plate("ship"));
  const main = body(paper);
  main.push(plate("lighthouse"));
  main.push({ title: "Tailpiece", draw: (_, at) => tailpiece(paper, at) });
  const bound = bind(paper, front, main);
  fillLists(lists, bound);
  for (const page of bound) drawPage(paper, page);
  return { bytes: await paper.finish(), pages: bound };
}

/** Every page in order with its label; blanks bring the whole to a multiple of four. */
function bind(paper, front, main) {
  const pages = [
    outside("Cover", () => frontBoard(paper), null),
    outside("Endpaper 1", () => drawEndpaper(paper), null),
    outside("Endpaper 2", () => drawEndpaper(paper), null),
    outside("Endpaper 3", () => {}),
    ...front.map((page, i) => ({ ...page, label: { style: "r" }, text: roman(i + 1) })),
    ...main.map((page, i) => ({ ...page, label: { style: "D" }, text: String(i + 1) })),
  ];
  for (let n = main.length + 1; (pages.length + 4) % 4 !== 0; n++) {
    pages.push({ ...blank, label: { style: "D" }, text: String(n) });
  }
  pages.push(
    outside("Endpaper 4", () => {}),
    outside("Endpaper 5", () => drawEndpaper(paper), null),
    outside("Endpaper 6", () => drawEndpaper(paper), null),
    outside("Back cover", () => backBoard(paper), null),
  );
  return pages;
}

function fillLists(lists, pages) {
  const find = (name) => pages.find((page) => page.name === name)?.text ?? "";
  for (const name of ["Etymology", "Extracts"]) {
    const key = name.toLowerCase();
    lists.chapters.push({ title: name, label: find(key), name: key, italic: true });
  }
  for (const { name, title } of pages) {
    const found = /^chapter-(\d+)$/.exec(name ?? "");
    if (!found) continue;
    const number = Number(found[1]);
    lists.chapters.push({ number, title: title.replace(/^\d+\. /, ""), label: find(name), name });
  }
  for (const { name, title } of PLATES) {
    lists.plates.push({ title, label: find(`plate-${name}`), name: `plate-${name}` });
  }
}

function drawPage(paper, page) {
  const n = paper.page(page.label, page.ground);
  const recto = n % 2 === 1;
  const left = blockLeft(recto);
  if (page.name) paper.place(page.name);
  // A closed book shows a cover; this one lies open where its story begins.
  if (page.name === "chapter-1") paper.openHere();
  if (page.title) paper.doc.outline.addItem(page.title);
  page.draw(paper, { left, recto });
  if (page.numbered) folio(paper, page.text, left);
}
