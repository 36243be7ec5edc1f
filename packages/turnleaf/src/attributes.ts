/**
 * The attributes of `<turnleaf-book>`, a row each: what the property of the same name is by the
 * attribute's text, what it writes, and what a change acts on. Element, components for frameworks and
 * the command read this table, which needs no browser.
 */

import type { Stock, TearLine } from "./engine/shapes.ts";
import { stocks, tearLines } from "./engine/shapes.ts";
import type { TurnModelName } from "./leaf_models/model_choice.ts";
import { pageThemes } from "./themes.ts";

/** The themes, and `auto`. */
export const themes: readonly ["auto", ...typeof pageThemes] = ["auto", ...pageThemes];
/** Colours of desk, boards, paper, text and controls; `auto` is light or night, as the system. */
export type Theme = (typeof themes)[number];

// Of all words the first is the default.
const fonts = ["", "serif", "sans-serif", "legible", "dyslexic"] as const;
const alignments = ["", "justify", "start"] as const;
const hyphenations = ["", "auto", "none"] as const;
/** What dark themes may do with pages that are drawn already, the default first. */
export const darkPages: readonly ["", "invert", "dim"] = ["", "invert", "dim"];
const covers = ["auto", "hard", "soft", "none"] as const;
const cameras = ["reader", "overhead"] as const;
const bindings = ["auto", "left", "right", "top", "bottom"] as const;
const layouts = ["auto", "spread", "single"] as const;
const offsets = [1, 0] as const;

/** The properties that are attributes, by the names of the properties: `fontSize` is `font-size` in HTML. */
export interface AttributeProperties {
  /**
   * Address of a book: a PDF, an EPUB, a comic, text, an image, a manifest of images, or another
   * file that can be read.
   * @attribute src
   * @default ""
   */
  src: string;

  /**
   * Address of the package's file `pdf-worker.js`, for pages whose
   * Content-Security-Policy does not allow `blob:` in `worker-src`; the file
   * must be of this package's version, on the page's own site. It is read when
   * a book opens.
   *
   * @attribute pdf-worker
   * @default ""
   */
  pdfWorker: string;

  /**
   * Address of the package's file `turnleaf.wasm`, for pages that serve it
   * themselves: the engine inside the package is then not loaded. The file must
   * be of this package's version. It is read when a book opens.
   *
   * @attribute engine-src
   * @default ""
   */
  engineSrc: string;

  /**
   * The paper of the leaves, from 30 g/m² (`bible`) to 250 g/m² (`card`). `stocks`
   * gives single leaves another, and makes leaves of board. A change in mid-turn
   * waits until the leaf has landed.
   *
   * @attribute stock
   * @default book
   */
  stock: Stock;

  /**
   * Whether a released leaf is helped over to its side (`on`), rather than left
   * to gravity (`off`).
   *
   * @attribute assist
   * @default on
   */
  assist: boolean;

  /**
   * Width of a page on paper, such as `210mm`, `21cm` or `8.5in`: leaves move as those of a book of
   * that size. The default is what the book's file says (a PDF, a manifest, IIIF), else that of a
   * page of the area of 140 × 210 mm.
   *
   * @attribute page-width
   * @default ""
   */
  pageWidth: string;

  /**
   * Length of a played turn, in milliseconds, 0 to 60,000. With 0 pages change
   * at once, without motion.
   *
   * @attribute duration
   * @default 800
   */
  duration: number;

  /**
   * How leaves turn: bent as paper (`sheet`); as boards (`rigid`); folded flat
   * (`peel`); around a cylinder or cone (`cylinder`, `cone`); as masses on
   * springs (`mass-spring`); as a recorded thin shell (`shell`); as any
   * recorded turn (`replay`); in photographs of a turn (`photographs`). A
   * change in mid-turn waits until the leaf has landed. Without WebGL all
   * leaves are peeled. An unknown name is an `error`, and leaves turn as
   * sheets.
   *
   * @attribute model
   * @default sheet
   */
  model: TurnModelName;

  /**
   * Address of the data of `model`. For `replay`, of a recorded turn; the
   * default is a recording of a sheet turned by its fore-edge. For
   * `photographs`, of the pictures, with their numbers in braces, and the ratio
   * of their pages: `turn-{01-24}.webp#ratio=2:3`.
   *
   * @attribute model-src
   * @default ""
   */
  modelSrc: string;

  /**
   * The first and the last leaf: boards (`hard`), card (`soft`), or paper like the rest (`none`). By
   * default (`auto`) a book is in boards, with its cover's picture on the front, or its title and
   * authors where it has none; a PDF or text without a cover is paper.
   *
   * @attribute cover
   * @default auto
   */
  cover: (typeof covers)[number];

  /**
   * The typeface of flowing text, as of an EPUB: `serif`, `sans-serif`, `legible`
   * (Atkinson Hyperlegible), `dyslexic` (OpenDyslexic), or the book's own.
   *
   * @attribute font
   * @default ""
   */
  font: (typeof fonts)[number];

  /**
   * The size of everything in flowing text, as a factor of the book's own: 0.5 to 3. With 1, type of
   * 16 px is 16 CSS pixels high on the screen, however large the book is shown.
   *
   * @attribute font-size
   * @default 1
   */
  fontSize: number;

  /**
   * The distance of lines in flowing text, as a factor of the type's size: 1 to
   * 3; 0 for the book's own.
   *
   * @attribute line-height
   * @default 0
   */
  lineHeight: number;

  /**
   * The width of the margins around flowing text, as a factor of the usual ones: 0 to 2.
   *
   * @attribute margins
   * @default 1
   */
  margins: number;

  /**
   * Whether the lines of flowing text are of one length (`justify`) or as long as their words
   * (`start`). The default is as the book has it; where it says nothing, of one length if the browser
   * divides words of their language, so that there are no gaps, and as long as their words if not.
   *
   * @attribute text-align
   * @default ""
   */
  textAlign: (typeof alignments)[number];

  /**
   * Whether words of flowing text are divided at the ends of lines (`auto`), in languages that the
   * browser divides, and in English, German, French, Spanish, Italian and Portuguese, or not (`none`).
   * The default is as the book has it; where it says nothing, lines of one length have their words divided
   * if the browser divides words of their language.
   *
   * @attribute hyphens
   * @default ""
   */
  hyphens: (typeof hyphenations)[number];

  /**
   * Space that is added between the letters of flowing text, in units of the type's size: 0 to 1.
   *
   * @attribute letter-spacing
   * @default 0
   */
  letterSpacing: number;

  /**
   * Space that is added between its words, likewise.
   *
   * @attribute word-spacing
   * @default 0
   */
  wordSpacing: number;

  /**
   * What the themes `grey` and `night` do with pages that are drawn already, as those of PDFs, scans and
   * comics: turn lightness over and keep hues (`invert`), or dim them (`dim`). By default documents are
   * inverted, and scans, comics and covers dimmed.
   *
   * @attribute dark-pages
   * @default ""
   */
  darkPages: (typeof darkPages)[number];

  /**
   * CSS colour of the boards.
   *
   * @attribute cloth
   * @default #6a2a26
   */
  cloth: string;

  /**
   * How strong the shadows are that leaves throw on pages and on each other: 0
   * (none) to 1.
   *
   * @attribute shadows
   * @default 1
   */
  shadows: number;

  /**
   * From where the book is seen: by a `reader`, who sees the open book from right above, or as far
   * from it as `tilt` says, and a closed book in boards from nearer and a little beside its spine; or
   * from `overhead`, whatever `tilt` says, so that a closed book lies where its pages lie when it is open.
   *
   * @attribute camera
   * @default reader
   */
  camera: (typeof cameras)[number];

  /**
   * How far a reader's eye leans back from right above the open book, degrees: 0 to 12. At 0 pages at
   * rest are drawn pixel by pixel. Zoomed in, the book is seen from above. Where a leaf
   * would rise out of the picture of a leaning eye, the book is smaller. `remember` keeps it.
   *
   * @attribute tilt
   * @default 0
   */
  tilt: number;

  /**
   * How much of the element stays free around the open book: a fraction of its width, or of its
   * height, at each edge of the two between which the book just fits; 0 to 0.25. A leaf
   * that swings upright is seen in the margin; below 0.02 some of it may be cut off at the edge.
   *
   * @attribute margin
   * @default 0.03
   */
  margin: number;

  /**
   * The gestures that act on the book, as a list: `drag` (a leaf is dragged or
   * flicked), `click` (a click at an edge or a corner turns), `corner` (a corner
   * lifts under a mouse), `wheel` (it turns), `zoom` (a pinch, a double tap, the
   * wheel with Ctrl). Empty for all; `none` for none, so that
   * only keys and commands turn pages.
   *
   * @attribute gestures
   * @default ""
   */
  gestures: string;

  /**
   * Minimum length of a flick that turns a leaf, CSS pixels. A shorter one only
   * drags it.
   *
   * @attribute swipe-distance
   * @default 0
   */
  swipeDistance: number;

  /**
   * The edge at which the book is bound; `auto` follows the reading direction.
   *
   * @attribute binding
   * @default auto
   */
  binding: (typeof bindings)[number];

  /**
   * Two pages or one; `auto` follows the available space.
   *
   * @attribute layout
   * @default auto
   */
  layout: (typeof layouts)[number];

  /**
   * 1: the first page stands alone; 0: pages 1 and 2 face each other.
   * @attribute offset
   * @default 1
   */
  offset: (typeof offsets)[number];

  /**
   * Pages of board, as numbers and ranges from 1, such as "1-2,9". They are pages of the book as
   * it lies when the list is set, and stay of board as others come and go.
   * @attribute hard-pages
   * @default ""
   */
  hardPages: string;

  /**
   * Stocks of leaves, each with its pages (from 1) and ranges of them, such as
   * "card 1-2, coated 17-24, 30": one of those of `stock`, or board. A
   * number alone is of the stock before it. A leaf whose two pages are of
   * different stocks is of the one named last. All others are of `stock`, but for
   * those of `hard-pages`, which are board, and a soft cover's, which are card.
   * Pages beyond the last count for nothing: "board 1-999" is a book of board. As
   * other pages come and go, those of the list keep their stock, and what comes between two of a
   * range has theirs. An open book is bound anew where it lies open.
   *
   * @attribute stocks
   * @default ""
   */
  stocks: string;

  /**
   * Whether the reader's controls are shown: toolbar, side panel, slider.
   * @attribute controls
   * @default off
   */
  controls: boolean;

  /**
   * The colours of desk, boards, edges, paper, text and controls: `light`, `sepia`, `grey` or `night`;
   * `auto` is light or night, as the system. Pictures keep their colours. An element with neither
   * controls nor a theme is `light`.
   *
   * @attribute theme
   * @default auto
   */
  theme: Theme;

  /**
   * Whether the open page is kept in the document's address, as `#page=23`, or as
   * `#page=23&at=3:1204` of flowing text, whose words it names. It is the address of one book: of
   * several in a document that have the attribute, of the first. A jump, as by a link, is a step in
   * the browser's history.
   *
   * @attribute address
   * @default off
   */
  address: boolean;

  /**
   * Whether page, zoom, bookmarks and the choices of type and theme are kept over a
   * reload, in the browser's local storage.
   * @attribute remember
   * @default off
   */
  remember: boolean;

  /**
   * Whether a bookmarked page has its corner folded over, until its bookmark is removed, and
   * whether a corner is folded that a pointer draws in over its page and holds still there.
   *
   * @attribute fold-bookmarks
   * @default off
   */
  foldBookmarks: boolean;

  /**
   * How the leaves are bound where a reader may tear them out by pulling one hard away from the
   * spine: `sewn`, along all of it; `stapled`, at two staples; `perforated`, along a line of cuts;
   * `none` if none may be torn out. An attribute without a value means sewn. Covers stay, of boards or of card, and so
   * does a book on the flat.
   *
   * @attribute tearable
   * @default none
   */
  tearable: TearLine | "none";

  /**
   * Whether leaves make a sound, from the reader's first gesture on.
   *
   * @attribute sound
   * @default off
   */
  sound: boolean;

  /**
   * Whether a phone vibrates when a leaf is grabbed and when it lands.
   *
   * @attribute vibrate
   * @default off
   */
  vibrate: boolean;
}

/** What a change of an attribute acts on. */
export type AttributeEffect =
  /** The language is another. */
  | "speak"
  /** Another book: it opens at its beginning. */
  | "open"
  /** The attribute of the page has another value: the book turns there if it is a number. */
  | "setPage"
  /** The same book, bound again, where it lay. */
  | "rebind"
  /** The list of the pages of board is another: it names pages as they lie now. */
  | "listHardPages"
  /** The list of stocks is another, likewise. */
  | "listStocks"
  /** The leaves are made of another paper. */
  | "changePaper"
  /** The leaves turn in another way. */
  | "changeModel"
  /** Turns take another time. */
  | "changePace"
  /** Flowing text is set in another way. */
  | "typeset"
  /** The book is shown in other colours. */
  | "recolour"
  /** The place is kept from now on, or no longer. */
  | "keepPlace"
  /** The controls appear or disappear. */
  | "updateControls"
  /** The sound stops until a leaf moves that should be heard. */
  | "stopSound"
  /** What folds pages is loaded, where they may be folded. */
  | "allowFolding"
  /** Leaves may be torn out from now on, or no longer. */
  | "allowTearing";

/** An attribute whose property has values of one type. */
export interface Attribute<Value> {
  /** Returns the value of the attribute's text, null where it is missing: the default of any other text. */
  read(text: string | null): Value;
  /** Returns the text of a value: true for an attribute that needs none, null for one that is not there. */
  write(value: Value): string | true | null;
  /** What a change acts on; undefined where it is read anew whenever it is needed. */
  readonly effect: AttributeEffect | undefined;
  /** All values, where they are few. */
  readonly words?: readonly Value[];
}

/** Any text but "", which counts as missing. */
function text<Value extends string>(
  effect?: AttributeEffect,
  usual = "" as Value,
): Attribute<Value> {
  return { effect, read: (given) => (given || usual) as Value, write: String };
}

/** One of several words, the first by default. */
function word<Value extends string | number>(
  words: readonly Value[],
  effect: AttributeEffect,
  whenEmpty: Value = words[0],
): Attribute<Value> {
  const named = (given: string | null): Value | undefined =>
    words.find((known) => String(known) === given);
  const read = (given: string | null): Value =>
    named(given) ?? (given === "" ? whenEmpty : words[0]);
  return { effect, words, read, write: String };
}

/** A number from `least` to `most`. */
function number(
  least: number,
  most: number,
  usual: number,
  effect?: AttributeEffect,
): Attribute<number> {
  const read = (given: string | null): number => {
    const value = Number(given?.trim() || Number.NaN);
    return value >= least && value <= most ? value : usual;
  };
  return { effect, read, write: String };
}

/** True where the attribute is there. */
function flag(effect?: AttributeEffect): Attribute<boolean> {
  return { effect, read: (given) => given !== null, write: (on) => (on ? true : null) };
}

/** True unless the attribute says "off". */
function unlessOff(effect: AttributeEffect): Attribute<boolean> {
  return { effect, read: (given) => given !== "off", write: (on) => (on ? "on" : "off") };
}

/** The table. */
export const attributes: {
  readonly [Name in keyof AttributeProperties]: Attribute<AttributeProperties[Name]>;
} = {
  src: text("open"),
  pdfWorker: text(),
  engineSrc: text(),
  stock: word(["book", ...stocks.filter((name) => name !== "book")], "changePaper"),
  assist: unlessOff("changePaper"),
  pageWidth: text("changePaper"),
  duration: number(0, 60_000, 800, "changePace"),
  model: text<TurnModelName>("changeModel", "sheet"),
  modelSrc: text("changeModel"),
  cover: word(covers, "rebind"),
  font: word(fonts, "typeset"),
  fontSize: number(0.5, 3, 1, "typeset"),
  lineHeight: number(1, 3, 0, "typeset"),
  margins: number(0, 2, 1, "typeset"),
  textAlign: word(alignments, "typeset"),
  hyphens: word(hyphenations, "typeset"),
  letterSpacing: number(0, 1, 0, "typeset"),
  wordSpacing: number(0, 1, 0, "typeset"),
  darkPages: word(darkPages, "recolour"),
  cloth: text("rebind", "#6a2a26"),
  shadows: number(0, 1, 1, "rebind"),
  camera: word(cameras, "rebind"),
  tilt: number(0, 12, 0, "rebind"),
  margin: number(0, 0.25, 0.03, "rebind"),
  gestures: text(),
  swipeDistance: number(0, Number.MAX_VALUE, 0),
  binding: word(bindings, "rebind"),
  layout: word(layouts, "rebind"),
  offset: word(offsets, "rebind"),
  hardPages: text("listHardPages"),
  stocks: text("listStocks"),
  controls: flag("updateControls"),
  theme: word(themes, "recolour"),
  address: flag("keepPlace"),
  remember: flag("keepPlace"),
  foldBookmarks: flag("allowFolding"),
  tearable: word(["none", ...tearLines], "allowTearing", "sewn"),
  sound: flag("stopSound"),
  vibrate: flag(),
};

/** The properties of the table, in its order. */
export const attributeProperties = Object.keys(attributes) as (keyof AttributeProperties)[];

/** Returns the name in HTML of a property's attribute. */
export function attributeName(property: string): string {
  return property.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
}

/** Returns the names in HTML of the attributes whose change has an effect, in the table's order. */
export function attributesThat(effect: AttributeEffect): readonly string[] {
  const properties = attributeProperties.filter((name) => attributes[name].effect === effect);
  return properties.map(attributeName);
}

/** Returns the value of an element's attribute, by its property. */
export function attributeOf<Name extends keyof AttributeProperties>(
  element: Pick<Element, "getAttribute">,
  property: Name,
): AttributeProperties[Name] {
  return attributes[property].read(element.getAttribute(attributeName(property)));
}
