/**
 * What a page loads to show a book: every built file of the viewer with the
 * engine's WASM inside, but for three.js and the page sources, in kB gzip, by
 * what it is loaded for.
 *
 *   node scripts/size.mjs    fails where a part is beyond its limit
 *
 * Counted is what index.js imports, at once or later, and what that imports. Left
 * out is what is loaded only for a source of pages: a file that is imported
 * later and comes whole from src/sources or another package. The package's other
 * interfaces to the element are counted apart.
 */
import { existsSync, readFileSync } from "node:fs";
import { basename, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

/**
 * The parts by the files that belong to them, and the kB gzip that each may have.
 * The limits leave room to write plainly; they are there so that a dependency or
 * a file that slips into the wrong chunk is seen. A file in no part is one of
 * those that every book needs.
 */
const parts = {
  // 115 were meant. Keeping every leaf out of every other and of itself in what is drawn
  // added 6 to the machine code, leaves of stocks of their own 3, and sources that say where
  // their pages lie 1; packing it tighter (zopfli) would win 3 and cost clarity. What counts
  // the work of a tick and keeps a canvas for the next book took the last of 122. A sheet's
  // lists of lengths, in place of two numbers, by which it can be creased, took the last of 124.
  // Folded corners and keeping the open book until the next one is read added 3: what draws a
  // creased leaf and lists its page among the bookmarks is in every book, what folds it is not.
  // The shadows of folded corners, and the press of one held still, added 1.8.
  // Folds along any line, kept as folded corners are, and a drawing that is begun while the book is
  // read added 1. That leaves may be torn out added 2: pages that leave the book and come back, and how a loose
  // sheet is drawn, picked and shades its book; what tears it is not in every book. Flaps of
  // fold-outs that a pointer opens, and the double tap that crumples, added 1. How the
  // ragged edge of a sheet that is torn across is drawn, and its command, added 1. Lists that follow
  // their pages wherever these go, and a first frame that waits for its pages, added 0.6. The order
  // in which loose sheets lie upon each other, as they are drawn and shaded, added 0.3. A sheet whose
  // chains are restored four at a time, in half the time, added 3.6.
  "shows and turns a book": { limit: 145 },
  "the text over the pages, once they show": { files: ["book_text_overlay.js"], limit: 8 },
  "zoomed in, pages of other sizes, fold-outs, the place kept": {
    files: ["detail_pictures.js", "fit.js", "place_keeper.js"],
    limit: 6,
  },
  "toolbar and panels": { files: ["controls.js"], limit: 18 },
  "on the flat, where there is no WebGL": { files: ["canvas2d_backend.js"], limit: 10 },
  // Counted by themselves, as page sources are: a book without the attribute `model`
  // loads none of them. Live models have machine code of their own; that its sheet can be creased,
  // for baked folds and the playground, is 49 of it; that it may be torn across, which takes rows
  // that hang together for granted no more, 1; four chains and hinges at a time, 4.5.
  "another model of turning, live": {
    files: ["leaf_models.js", "lying_sheet.js", "loose_leaf.js"],
    limit: 197,
    isApart: true,
  },
  "recorded turns": {
    files: ["replay.js", "sheet_turn.js", "shell_turn.js"],
    limit: 20,
    isApart: true,
  },
  // Of the page sources, what all of them begin with.
  "opens a book of any format": { files: ["open.js"], limit: 9, isApart: true },
  // With what reads images, which are a source of pages too.
  "photographs of a turn": {
    files: ["photographs.js", "images.js", "image_header.js"],
    limit: 9,
    isApart: true,
  },
  "pages that are elements": { files: ["live_pages.js"], limit: 3 },
  // The engine again, with creases: a book without a fold, or whose leaves cannot be torn
  // out, loads none of it. 4 kB of it are folds along any line, whose parts lie upon parts, and 4 folds of leaves that
  // lie upon each other. 17 came with what crumples a sheet into a ball, the flaps of fold-outs,
  // and what keeps folded parts out of each other in what is drawn; 1 with folds that wait for
  // each other and parts that lie by how they face; 16 with what tears a loose sheet across, a grid
  // on each piece, its drawing, and the motions of pointers and command, and with what places drawn
  // points by boxes. 2 were loaded with every book before: what keeps the pages that are torn out and what
  // lists say of them, what folds along a line, and the corners that are pressed by hand. 9 draw
  // leaves that lie on each other's folds clear of each other, part by part. 6 fold the flaps of
  // fold-outs into panels, and keep held folds out of themselves. 8 bend a tear with the pull of two
  // grabs: paths that turn, the outlines of both pieces and their grids made anew, and a rehearsal
  // at rest. 5 open folds as they are uncovered, and tear folded leaves out, put back with their folds.
  // 8 let loose sheets lie upon each other: the heights of their upper sides, and their order. 7 restore
  // four chains at a time and find four hinges, 3 turn flaps in the gutter by where they are and open
  // anew what lies through itself. 2 find the outlines of what lies on other paper, for its shade: with
  // every book before was what draws the shadows of flaps.
  "folded pages, leaves torn out": {
    files: ["creasable_book.js", "folds.js", "line_folds.js", "tearing.js", "torn_pages.js"],
    limit: 237,
    isApart: true,
  },
  // Only a browser that draws elements on canvases loads it.
  "pages that are elements, live in the air": {
    files: ["live_drawings.js"],
    limit: 1,
    isApart: true,
  },
  // A book whose pages are turned loads none of it.
  "pages that are scrolled": { files: ["roll_view.js"], limit: 4, isApart: true },
  "pages inserted and removed": { files: ["page_changes.js"], limit: 2 },
  // A page without any loads none of it.
  "sounds and films on a page": { files: ["page_media.js"], limit: 1, isApart: true },
  // A book without recordings loads none of it.
  "read aloud": { files: ["reading.js"], limit: 4, isApart: true },
  "sound, printing and films": {
    files: ["sound.js", "print_pages.js", "film_recorder.js"],
    limit: 6,
  },
};

/**
 * kB gzip of all parts together but for those apart: one was added for sounds and films on pages
 * and for the question before a link leads out of an EPUB, five for folded corners, two for leaves that are torn out,
 * two for folds along any line and for opening sooner, and four for the flaps of fold-outs and for
 * sheets that are crumpled: loaded with what folds and tears pages; one for lists that follow their
 * pages and for folding out, tearing and crumpling by the menu, and one for what a flat book keeps drawn; one
 * for fold-outs of several panels, and four for a sheet that is stepped four chains at a time.
 */
const limit = 188;

/** Entries beside index.js, and the kB gzip that each may have of its own: what index.js leads to is not counted. */
const entries = {
  // three.js is 129 of it, the code that draws with it 21: shared, that would lie in more files.
  standalone: 156,
  links: 1,
  "page-flip": 4,
  "page-flip.browser": 4,
  "react-pageflip": 2,
  react: 2,
  vue: 2,
  "svelte/book_props": 2,
};

const dist = join(import.meta.dirname, "../packages/turnleaf/dist");

/** Whether a built file holds page sources and nothing of the viewer's. */
function isPageSource(name) {
  // What comes whole from another package has no map.
  if (!existsSync(join(dist, `${name}.map`))) return true;
  const map = JSON.parse(readFileSync(join(dist, `${name}.map`), "utf8"));
  return map.sources.every(
    (source) => source.includes("/src/sources/") || !source.includes("/src/"),
  );
}

/** The files that index.js needs, by name, and whether each is loaded at once. */
function filesOfViewer() {
  const found = new Map();
  const visit = (name, atOnce) => {
    if (found.has(name) && (found.get(name) || !atOnce)) return;
    found.set(name, atOnce);
    const text = readFileSync(join(dist, name), "utf8");
    for (const [, target] of text.matchAll(/(?:from|import)["'`]\.\/([^"'`]+\.js)/g)) {
      visit(target, atOnce);
    }
    for (const [, target] of text.matchAll(/import\(["'`]\.\/([^"'`]+\.js)/g)) {
      if (!isPageSource(target)) visit(target, false);
    }
  };
  visit("index.js", true);
  return found;
}

/** The files that an entry leads to by address, page sources too, and other entries not. */
function filesFrom(name, found = new Set()) {
  const isOtherEntry = found.size > 0 && basename(name, ".js") in entries;
  if (found.has(name) || isOtherEntry) return found;
  found.add(name);
  const text = readFileSync(join(dist, name), "utf8");
  for (const [, target] of text.matchAll(/(?:from|import\(?)["'`]\.\/([\w.-]+\.js)/g)) {
    filesFrom(target, found);
  }
  return found;
}

/** Sizes of the entries beside index.js, in bytes. */
export function entrySizes() {
  const shared = filesFrom("index.js");
  return Object.entries(entries).map(([entry, limit]) => {
    const own = [...filesFrom(`${entry}.js`)].filter((name) => !shared.has(name));
    const gzip = own.reduce((sum, name) => sum + gzipOf(readFileSync(join(dist, name))), 0);
    return { name: `turnleaf/${entry}, beside what index.js has`, limit, gzip };
  });
}

/** Sizes of the viewer's files in bytes, of its parts, and of all together. */
export function viewerSize() {
  const files = [...filesOfViewer()].map(([file, atOnce]) => {
    const text = readFileSync(join(dist, file));
    const name = file.replace(/-[\w-]{8}\.js$/, ".js");
    const part = Object.keys(parts).find((part) => parts[part].files?.includes(name));
    const gzip = gzipOf(text);
    return { name, part: part ?? Object.keys(parts)[0], atOnce, bytes: text.length, gzip };
  });
  files.sort((a, b) => b.gzip - a.gzip);
  const sum = (of) => of.reduce((all, file) => all + file.gzip, 0);
  const byPart = Object.entries(parts).map(([name, { limit }]) => {
    return { name, limit, gzip: sum(files.filter((file) => file.part === name)) };
  });
  return { files, parts: byPart, gzip: sum(files.filter((file) => !parts[file.part].isApart)) };
}

const gzipOf = (content) => gzipSync(content, { level: 9 }).length;
const kilobytes = (bytes) => (bytes / 1000).toFixed(1);

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const { files, parts, gzip } = viewerSize();
  for (const { name, atOnce, bytes, gzip } of files) {
    const when = atOnce ? "at once" : "later";
    console.log(
      `${name.padEnd(24)} ${kilobytes(bytes).padStart(7)} kB  ${kilobytes(gzip).padStart(6)} kB gzip  ${when}`,
    );
  }
  const all = { name: "The viewer without three.js, page sources and other models", limit, gzip };
  for (const { name, limit, gzip } of [...parts, all, ...entrySizes()]) {
    console.log(`${name}: ${kilobytes(gzip)} kB gzip of ${limit}`);
    if (gzip > limit * 1000) {
      console.error("That is too much: make it smaller, or give reasons for a higher limit.");
      process.exitCode = 1;
    }
  }
}
