/**
 * The sheet the book is drawn on: a thin layer over PDFKit that keeps to what a
 * book needs. Coordinates are points, y down from the head of the page.
 *
 * Deflate runs in JavaScript (fflate): zlib's output depends on its build and on
 * the processor, and the book must come out byte for byte the same everywhere.
 */
import { createRequire } from "node:module";
import zlib from "node:zlib";
import { zlibSync } from "fflate";
import PDFDocument from "pdfkit";
import { BLEED, COLOUR, num, PAGE } from "./measures.mjs";

zlib.deflateSync = (data) => Buffer.from(zlibSync(data, { level: 9 }));

const require = createRequire(import.meta.url);
const garamond = "@expo-google-fonts/eb-garamond";
const FACES = {
  roman: `${garamond}/400Regular/EBGaramond_400Regular.ttf`,
  italic: `${garamond}/400Regular_Italic/EBGaramond_400Regular_Italic.ttf`,
  medium: `${garamond}/500Medium/EBGaramond_500Medium.ttf`,
  hebrew: "@expo-google-fonts/frank-ruhl-libre/400Regular/FrankRuhlLibre_400Regular.ttf",
};

/** "#rrggbb" as the three operands of a PDF colour. */
const rgb = (hex) =>
  [1, 3, 5].map((i) => num3(Number.parseInt(hex.slice(i, i + 2), 16) / 255)).join(" ");
const num3 = (v) => String(Math.round(v * 1000) / 1000);

export class Paper {
  constructor(info) {
    this.doc = new PDFDocument({
      autoFirstPage: false,
      size: [PAGE.width, PAGE.height],
      margin: 0,
      pdfVersion: "1.7",
      lang: "en",
      displayTitle: true,
      info: { ...info, CreationDate: new Date(Date.UTC(2024, 9, 18)) },
    });
    this.chunks = [];
    this.doc.on("data", (chunk) => this.chunks.push(chunk));
    this.faces = {};
    this.shapes = new Map();
    for (const [name, file] of Object.entries(FACES)) {
      this.doc.registerFont(name, require.resolve(file));
      this.faces[name] = this.doc.font(name)._font;
    }
    this.labels = [];
    this.pages = 0;
  }

  /** A new page. `ground` fills it; `label` is what a reader calls it. */
  page(label, ground = COLOUR.paper) {
    this.doc.addPage();
    this.labels.push(label);
    this.pages += 1;
    if (ground) this.ground(ground);
    return this.pages;
  }

  /** Fill the page with a colour, past its edges, so that no pixel at them stays bare. */
  ground(hex) {
    const [x, y, w, h] = [-BLEED, -BLEED, PAGE.width + 2 * BLEED, PAGE.height + 2 * BLEED];
    this.op(`${rgb(hex)} rg ${num(x)} ${num(y)} ${num(w)} ${num(h)} re f`);
  }

  /** Raw operators, one string a call; PDFKit has already turned y down. */
  op(operators) {
    this.doc.addContent(operators);
  }

  /** A drawing kept once in the file under a name, to be shown any number of times. */
  form(name, operators) {
    this.forms ??= {};
    if (this.forms[name]) return;
    const box = [-PAGE.width, -PAGE.height, PAGE.width * 2, PAGE.height * 2];
    const ref = this.doc.ref({ Type: "XObject", Subtype: "Form", BBox: box, Resources: {} });
    ref.end(operators);
    this.forms[name] = ref;
  }

  /** Show a form with its origin at (x, y). */
  show(name, x, y) {
    this.doc.page.xobjects[name] ??= this.forms[name];
    this.op(`q 1 0 0 1 ${num(x)} ${num(y)} cm /${name} Do Q`);
  }

  fill(hex) {
    this.op(`${rgb(hex)} rg`);
  }

  stroke(hex, width) {
    this.op(`${rgb(hex)} RG ${num(width)} w`);
  }

  /**
   * Shape a piece of text: { width, glyphs: [{ id, advance, natural }] }, the
   * widths in points, kerning within `advance`. Pieces are kept, as a book
   * repeats its words.
   */
  shape(face, size, text, features = ["onum", "pnum"]) {
    const key = `${face}|${features.join()}|${text}`;
    let run = this.shapes.get(key);
    if (!run) {
      run = this.faces[face].layoutRun(text, ["kern", "liga", ...features]);
      this.shapes.set(key, run);
    }
    return { run, face, size, width: (run.advanceWidth * this.faces[face].scale * size) / 1000 };
  }

  /**
   * Draw shaped pieces on one line from x: `gap` points are added to each space
   * and `track` after every glyph. Spaces are real glyphs, so that the text can
   * be selected and searched.
   */
  line(pieces, x, y, { gap = 0, track = 0, colour = COLOUR.ink } = {}) {
    const out = [`BT ${rgb(colour)} rg 1 0 0 -1 ${num(x)} ${num(y)} Tm`];
    for (let i = 0; i < pieces.length; ) {
      const { face, size, track: own } = pieces[i];
      const glyphs = [];
      const positions = [];
      const same = (p) => p.face === face && p.size === size && p.track === own;
      for (; i < pieces.length && same(pieces[i]); i++) {
        glyphs.push(...pieces[i].run.glyphs);
        positions.push(...pieces[i].run.positions);
      }
      const font = this.faces[face];
      this.doc.page.fonts[font.id] ??= font.ref();
      const text = this.operands({ glyphs, positions }, font, size, gap, own ?? track);
      out.push(`/${font.id} ${num(size)} Tf [${text}] TJ`);
    }
    this.op(`${out.join(" ")} ET`);
  }

  /** The operand of TJ: strings of glyphs, parted where the pen must be moved. */
  operands(run, font, size, gap, track) {
    let text = "";
    let owed = 0; // thousandths of an em not yet moved
    let hex = "";
    run.glyphs.forEach((glyph, i) => {
      const id = font.subset.includeGlyph(glyph.id);
      font.widths[id] ??= glyph.advanceWidth * font.scale;
      font.unicode[id] ??= glyph.codePoints;
      const space = glyph.codePoints[0] === 32 ? gap : 0;
      const { xAdvance, xOffset } = run.positions[i];
      const before = Math.round(owed + xOffset);
      if (before !== 0) {
        if (hex) text += `<${hex}>`;
        text += -before;
        hex = "";
        owed -= before;
      }
      hex += `000${id.toString(16)}`.slice(-4);
      owed += xAdvance - font.widths[id] + ((space + track) * 1000) / size;
    });
    if (hex) text += `<${hex}>`;
    const after = Math.round(owed);
    return after !== 0 ? `${text}${-after}` : text;
  }

  /** A single piece, set left, centred or right of x. Returns its width. */
  words(text, x, y, style = {}) {
    const { face = "roman", size = 11, features, track = 0, align = "left", colour } = style;
    const piece = this.shape(face, size, text, features);
    const width = piece.width + track * (piece.run.glyphs.length - 1);
    const shift = align === "centre" ? width / 2 : align === "right" ? width : 0;
    this.line([piece], x - shift, y, { track, colour });
    return width;
  }

  /** A thin rule. */
  rule(x0, x1, y, width = 0.5, hex = COLOUR.ink) {
    this.stroke(hex, width);
    this.op(`${num(x0)} ${num(y)} m ${num(x1)} ${num(y)} l S`);
  }

  /** Make the box a link to a named place. */
  link(x, y, width, height, name) {
    this.doc.goTo(x, y, width, height, name);
  }

  place(name) {
    this.doc.addNamedDestination(name, "Fit");
  }

  /** The file asks readers to open it at the page being drawn. */
  openHere() {
    this.doc._root.data.OpenAction = [this.doc.page.dictionary, "Fit"];
  }

  /** Close the file: page labels, then the bytes. */
  async finish() {
    const nums = [];
    this.labels.forEach((label, i) => {
      const before = this.labels[i - 1];
      const goesOn = before && before.style === label.style && before.prefix === label.prefix;
      if (goesOn && label.style) return;
      const entry = {};
      if (label.style) Object.assign(entry, { S: label.style, St: label.start ?? 1 });
      if (label.prefix) entry.P = new String(label.prefix);
      nums.push(i, entry);
    });
    this.doc._root.data.PageLabels = this.doc.ref({ Nums: nums });
    this.doc._root.data.PageLabels.end();
    this.doc._root.data.PageLayout = "TwoPageRight";
    const ended = new Promise((resolve) => this.doc.on("end", resolve));
    this.doc.end();
    await ended;
    return Buffer.concat(this.chunks);
  }
}
