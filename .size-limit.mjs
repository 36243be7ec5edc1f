/**
 * What a page loads, in kB gzip, by what it is loaded for: `make size`. The limits leave room to write
 * plainly; they are there so that a dependency or a file in the wrong chunk is seen.
 */
import { readdirSync, readFileSync } from "node:fs";

const dist = "packages/turnleaf/dist";
const kilobytes = (limit) => ({ limit: `${limit} kB`, gzip: true });

const chunks = (names) => names.split(" ").map((chunk) => `${dist}/${chunk}-????????.js`);

/** Returns a line for chunks of the viewer, by their names without hashes. */
const part = (name, limit, names) => ({ name, path: chunks(names), ...kilobytes(limit) });

/** Returns the names of chunks that are built and begin with code that `open_file.ts` imports: readers of formats. */
function readers() {
  const source = readFileSync("packages/turnleaf/src/sources/open_file.ts", "utf8");
  const names = [...source.matchAll(/import\("\.\/(?:\w+\/)?(\w+)\.ts"\)/g)].map(
    ([, name]) => name,
  );
  const built = readdirSync(dist).map((file) => file.replace(/-.{8}\.js$/, ""));
  // Those of PDF and of images are lines of their own.
  const others = ["pdf", "images", "tiff_pages"];
  return [...new Set(names)].filter((name) => built.includes(name) && !others.includes(name));
}

/** Returns a line for an entry of the package: its own file, and the chunks that only it loads. */
const entry = (name, limit, names = "") => ({
  name: `turnleaf/${name}`,
  path: [`${dist}/${name}.js`, ...(names ? chunks(names) : [])],
  ...kilobytes(limit),
});

/** What most books load, at once or later. */
const usual = [
  part("the text over the pages, once they show", 11.4, "book_text_overlay"),
  part(
    "zoomed in, pages of other sizes, fold-outs, the place kept",
    6,
    "detail_pictures fit place_keeper",
  ),
  part("toolbar and panels", 19, "controls"),
  part("on the flat, where there is no WebGL", 10, "canvas2d_backend"),
  part("pages that are elements", 3, "live_pages"),
  part("pages inserted and removed", 2, "page_changes"),
  part("sound, printing and films", 6, "sound print_pages film_recorder"),
];

/** What only a book or a page that uses it loads. */
const apart = [
  part("another model of turning, live", 198, "leaf_models lying_sheet loose_leaf"),
  part("recorded turns", 20, "replay sheet_turn shell_turn"),
  // The table of formats has their names, endings and media types too, as the command reads it.
  part("opens a book of any format", 13.6, "open"),
  part("photographs of a turn", 9.3, "photographs images image_header"),
  part("folded pages, leaves torn out", 243, "creasable_book folds line_folds tearing torn_pages"),
  part("pages that are elements, live in the air", 1, "live_drawings"),
  part("printed by day, of a book that is shown by night", 1, "day_print"),
  part("pages that are scrolled", 4, "roll_view"),
  part("sounds and films on a page", 1, "page_media"),
  part("read aloud", 4, "reading"),
  part("six languages besides English, of which an element loads its own", 16, "texts_*"),
  part("reads PDF", 1650, "pdf pdf.*.min.mjs cmaps jbig2.wasm openjpeg.wasm Foxit*.pfb"),
  part(
    "reads other formats",
    // Alignment, division of words, running heads and folios; tables that are turned and split, switches; XZ.
    // Packages, contents and chapters however they are written. What lies beyond its page, formulas, heights.
    // What files are that are not opened, links in tars, what several programs write of a comic.
    278,
    `${readers().join(" ")} budget clean_markup data_url file_paths font_type html_pages legacy_names media_overlays names package_document parse_markup svg unpacker unpacker_worker.ts writing_direction decode_text`,
  ),
  part("decodes TIFF and JPEG 2000", 60, "rare_images rare_size tiff_pages decoder_worker.ts"),
  part("cuts strips into pages", 2, "strips"),
  part("typefaces, of which a reader loads the one that is chosen", 582, "legible dyslexic"),
  part(
    "divides words of seven languages, of which a book loads its own",
    158,
    "hyphen en-us en-gb de-1996 es fr it pt",
  ),
  // Loaded for a book whose XML is not well-formed.
  part("repairs XML", 30, "repaired_xml"),
  // Loaded for a text whose bytes are no UTF-8 and that declares nothing else: letters by language.
  part("tells old encodings by their letters", 13, "legacy_encoding"),
  entry("standalone", 159, "standalone_* three.module"),
  entry("links", 1),
  entry("models", 196.1),
  entry("keyframes", 8),
  entry("leaf-stage", 20.2),
  entry("page-flip", 5),
  entry("page-flip.browser", 5),
  entry("react-pageflip", 2),
  entry("react", 3),
  entry("vue", 3),
  entry("svelte/book_props", 3),
  entry("pdf-worker", 440),
];

/** Returns a line for all files but those of other lines: a new file counts here. */
const allBut = (lines, name, limit) => ({
  name,
  path: [`${dist}/*.js`, ...lines.flatMap(({ path }) => path.map((file) => `!${file}`))],
  ...kilobytes(limit),
});

export default [
  allBut([...usual, ...apart], "shows and turns a book", 173.6),
  ...usual,
  ...apart,
  allBut(apart, "all that a usual book loads", 226),
];
