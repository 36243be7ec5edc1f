/** The properties of `<turnleaf-book>` that reflect its attributes. */

import type { Stock, TearLine } from "../engine/shapes.ts";
import type { TurnModelName } from "../leaf_models/model_choice.ts";
import type { Typography } from "../sources/page_source.ts";
import { pageThemes } from "../themes.ts";
import {
  bindingOptionsOf,
  stockOf,
  swipeDistanceOf,
  tearLineOf,
  turnSecondsOf,
} from "./attributes.ts";
import type { TurnleafEventMap, TypedEventElement } from "./events.ts";
import { darkPagesOf } from "./page_theme.ts";
import { typographyOf } from "./typography.ts";

/** On a server there is no DOM: importing the package is safe there, using the element is not. */
const Base = (globalThis.HTMLElement ?? class {}) as unknown as new () => TypedEventElement;

const themes: readonly ["auto", ...typeof pageThemes] = ["auto", ...pageThemes];
/** Colours of desk, boards, paper, text and controls; `auto` is light or night, as the system. */
export type Theme = (typeof themes)[number];

type Options = ReturnType<typeof bindingOptionsOf>;

/** An element whose attributes can be read and set as properties. */
export class ReflectingElement extends Base {
  /**
   * Address of a book: a PDF, an EPUB, a comic, text, an image, a manifest of images, or another
   * file that can be read.
   * @attribute src
   * @default ""
   */
  get src(): string {
    return this.getAttribute("src") ?? "";
  }

  set src(src: string) {
    this.setAttribute("src", src);
  }

  /**
   * Address of the package's file `pdf-worker.js`, for pages whose
   * Content-Security-Policy does not allow `blob:` in `worker-src`; the file
   * must be of this package's version, on the page's own site. It is read when
   * a book opens.
   *
   * @attribute pdf-worker
   * @default ""
   */
  get pdfWorker(): string {
    return this.getAttribute("pdf-worker") ?? "";
  }

  set pdfWorker(address: string) {
    this.setAttribute("pdf-worker", address);
  }

  /**
   * Address of the package's file `turnleaf.wasm`, for pages that serve it
   * themselves: the engine inside the package is then not loaded. The file must
   * be of this package's version. It is read when a book opens.
   *
   * @attribute engine-src
   * @default ""
   */
  get engineSrc(): string {
    return this.getAttribute("engine-src") ?? "";
  }

  set engineSrc(address: string) {
    this.setAttribute("engine-src", address);
  }

  /**
   * The paper of the leaves, from 30 g/m² (`bible`) to 250 g/m² (`card`). `stocks`
   * gives single leaves another, and makes leaves of board. A change in mid-turn
   * waits until the leaf has landed.
   *
   * @attribute stock
   * @default book
   */
  get stock(): Stock {
    return stockOf(this);
  }

  set stock(stock: Stock) {
    this.setAttribute("stock", stock);
  }

  /**
   * Whether a released leaf is helped over to its side (`on`), rather than left
   * to gravity (`off`).
   *
   * @attribute assist
   * @default on
   */
  get assist(): boolean {
    return this.getAttribute("assist") !== "off";
  }

  set assist(assist: boolean) {
    this.setAttribute("assist", assist ? "on" : "off");
  }

  /**
   * Width of a page on paper, such as `210mm`, `21cm` or `8.5in`: leaves move as those of a book of
   * that size. The default is what the book's file says (a PDF, a manifest, IIIF), else that of a
   * page of the area of 140 × 210 mm.
   *
   * @attribute page-width
   * @default ""
   */
  get pageWidth(): string {
    return this.getAttribute("page-width") ?? "";
  }

  set pageWidth(width: string) {
    this.setAttribute("page-width", width);
  }

  /**
   * Length of a played turn, in milliseconds, 0 to 60,000. With 0 pages change
   * at once, without motion.
   *
   * @attribute duration
   * @default 800
   */
  get duration(): number {
    return turnSecondsOf(this) * 1000;
  }

  set duration(milliseconds: number) {
    this.setAttribute("duration", String(milliseconds));
  }

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
  get model(): TurnModelName {
    return (this.getAttribute("model") || "sheet") as TurnModelName;
  }

  set model(model: TurnModelName) {
    this.setAttribute("model", model);
  }

  /**
   * Address of the data of `model`. For `replay`, of a recorded turn; the
   * default is a recording of a sheet turned by its fore-edge. For
   * `photographs`, of the pictures, with their numbers in braces, and the ratio
   * of their pages: `turn-{01-24}.webp#ratio=2:3`.
   *
   * @attribute model-src
   * @default ""
   */
  get modelSrc(): string {
    return this.getAttribute("model-src") ?? "";
  }

  set modelSrc(address: string) {
    this.setAttribute("model-src", address);
  }

  /**
   * The first and the last leaf: boards (`hard`), card (`soft`), or paper like the rest (`none`). By
   * default (`auto`) a book is in boards, with its cover's picture on the front, or its title and
   * authors where it has none; a PDF or text without a cover is paper.
   *
   * @attribute cover
   * @default auto
   */
  get cover(): Options["cover"] {
    return bindingOptionsOf(this).cover;
  }

  set cover(cover: Options["cover"]) {
    this.setAttribute("cover", cover);
  }

  /**
   * The typeface of flowing text, as of an EPUB: `serif`, `sans-serif`, `legible`
   * (Atkinson Hyperlegible), `dyslexic` (OpenDyslexic), or the book's own.
   *
   * @attribute font
   * @default ""
   */
  get font(): Typography["font"] {
    return typographyOf(this).font;
  }

  set font(font: Typography["font"]) {
    this.setAttribute("font", font);
  }

  /**
   * The size of everything in flowing text, as a factor of the book's own: 0.5 to 3. With 1, type of
   * 16 px is 16 CSS pixels high on the screen, however large the book is shown.
   *
   * @attribute font-size
   * @default 1
   */
  get fontSize(): number {
    return typographyOf(this).size;
  }

  set fontSize(factor: number) {
    this.setAttribute("font-size", String(factor));
  }

  /**
   * The distance of lines in flowing text, as a factor of the type's size: 1 to
   * 3; 0 for the book's own.
   *
   * @attribute line-height
   * @default 0
   */
  get lineHeight(): number {
    return typographyOf(this).lineHeight;
  }

  set lineHeight(factor: number) {
    this.setAttribute("line-height", String(factor));
  }

  /**
   * The width of the margins around flowing text, as a factor of the usual ones: 0 to 2.
   *
   * @attribute margins
   * @default 1
   */
  get margins(): number {
    return typographyOf(this).margins;
  }

  set margins(factor: number) {
    this.setAttribute("margins", String(factor));
  }

  /**
   * Whether the lines of flowing text are of one length (`justify`) or as long as their words
   * (`start`). The default is as the book has it; where it says nothing, of one length if the browser
   * divides words of their language, so that there are no gaps, and as long as their words if not.
   *
   * @attribute text-align
   * @default ""
   */
  get textAlign(): Typography["align"] {
    return typographyOf(this).align;
  }

  set textAlign(align: Typography["align"]) {
    this.setAttribute("text-align", align);
  }

  /**
   * Whether words of flowing text are divided at the ends of lines (`auto`), in languages that the
   * browser divides, and in English, German, French, Spanish, Italian and Portuguese, or not (`none`).
   * The default is as the book has it; where it says nothing, lines of one length have their words divided
   * if the browser divides words of their language.
   *
   * @attribute hyphens
   * @default ""
   */
  get hyphens(): Typography["hyphens"] {
    return typographyOf(this).hyphens;
  }

  set hyphens(hyphens: Typography["hyphens"]) {
    this.setAttribute("hyphens", hyphens);
  }

  /**
   * Space that is added between the letters of flowing text, in units of the type's size: 0 to 1.
   *
   * @attribute letter-spacing
   * @default 0
   */
  get letterSpacing(): number {
    return typographyOf(this).letterSpacing;
  }

  set letterSpacing(space: number) {
    this.setAttribute("letter-spacing", String(space));
  }

  /**
   * Space that is added between its words, likewise.
   *
   * @attribute word-spacing
   * @default 0
   */
  get wordSpacing(): number {
    return typographyOf(this).wordSpacing;
  }

  set wordSpacing(space: number) {
    this.setAttribute("word-spacing", String(space));
  }

  /**
   * What the themes `grey` and `night` do with pages that are drawn already, as those of PDFs, scans and
   * comics: turn lightness over and keep hues (`invert`), or dim them (`dim`). By default documents are
   * inverted, and scans, comics and covers dimmed.
   *
   * @attribute dark-pages
   * @default ""
   */
  get darkPages(): ReturnType<typeof darkPagesOf> {
    return darkPagesOf(this);
  }

  set darkPages(how: ReturnType<typeof darkPagesOf>) {
    this.setAttribute("dark-pages", how);
  }

  /**
   * CSS colour of the boards.
   *
   * @attribute cloth
   * @default #6a2a26
   */
  get cloth(): string {
    return bindingOptionsOf(this).cloth;
  }

  set cloth(colour: string) {
    this.setAttribute("cloth", colour);
  }

  /**
   * How strong the shadows are that leaves throw on pages and on each other: 0
   * (none) to 1.
   *
   * @attribute shadows
   * @default 1
   */
  get shadows(): number {
    return bindingOptionsOf(this).shadows;
  }

  set shadows(strength: number) {
    this.setAttribute("shadows", String(strength));
  }

  /**
   * From where the book is seen: by a `reader`, who sees the open book from right above, or as far
   * from it as `tilt` says, and a closed book in boards from nearer and a little beside its spine; or
   * from `overhead`, whatever `tilt` says, so that a closed book lies where its pages lie when it is open.
   *
   * @attribute camera
   * @default reader
   */
  get camera(): Options["camera"] {
    return bindingOptionsOf(this).camera;
  }

  set camera(camera: Options["camera"]) {
    this.setAttribute("camera", camera);
  }

  /**
   * How far a reader's eye leans back from right above the open book, degrees: 0 to 12. At 0 pages at
   * rest are drawn pixel by pixel. Zoomed in, the book is seen from above. Where a leaf
   * would rise out of the picture of a leaning eye, the book is smaller. `remember` keeps it.
   *
   * @attribute tilt
   * @default 0
   */
  get tilt(): number {
    return bindingOptionsOf(this).tilt;
  }

  set tilt(degrees: number) {
    this.setAttribute("tilt", String(degrees));
  }

  /**
   * How much of the element stays free around the open book: a fraction of its width, or of its
   * height, at each edge of the two between which the book just fits; 0 to 0.25. A leaf
   * that swings upright is seen in the margin; below 0.02 some of it may be cut off at the edge.
   *
   * @attribute margin
   * @default 0.03
   */
  get margin(): number {
    return bindingOptionsOf(this).margin;
  }

  set margin(fraction: number) {
    this.setAttribute("margin", String(fraction));
  }

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
  get gestures(): string {
    return this.getAttribute("gestures") ?? "";
  }

  set gestures(list: string) {
    this.setAttribute("gestures", list);
  }

  /**
   * Minimum length of a flick that turns a leaf, CSS pixels. A shorter one only
   * drags it.
   *
   * @attribute swipe-distance
   * @default 0
   */
  get swipeDistance(): number {
    return swipeDistanceOf(this);
  }

  set swipeDistance(pixels: number) {
    this.setAttribute("swipe-distance", String(pixels));
  }

  /**
   * The edge at which the book is bound; `auto` follows the reading direction.
   *
   * @attribute binding
   * @default auto
   */
  get binding(): Options["binding"] {
    return bindingOptionsOf(this).binding;
  }

  set binding(edge: Options["binding"]) {
    this.setAttribute("binding", edge);
  }

  /**
   * Two pages or one; `auto` follows the available space.
   *
   * @attribute layout
   * @default auto
   */
  get layout(): Options["layout"] {
    return bindingOptionsOf(this).layout;
  }

  set layout(layout: Options["layout"]) {
    this.setAttribute("layout", layout);
  }

  /**
   * 1: the first page stands alone; 0: pages 1 and 2 face each other.
   * @attribute offset
   * @default 1
   */
  get offset(): Options["offset"] {
    return bindingOptionsOf(this).offset;
  }

  set offset(offset: Options["offset"]) {
    this.setAttribute("offset", String(offset));
  }

  /**
   * Pages of board, as numbers and ranges from 1, such as "1-2,9". They are pages of the book as
   * it lies when the list is set, and stay of board as others come and go.
   * @attribute hard-pages
   * @default ""
   */
  get hardPages(): string {
    return bindingOptionsOf(this).hardPages;
  }

  set hardPages(pages: string) {
    this.setAttribute("hard-pages", pages);
  }

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
  get stocks(): string {
    return bindingOptionsOf(this).stocks;
  }

  set stocks(list: string) {
    this.setAttribute("stocks", list);
  }

  /**
   * Whether the reader's controls are shown: toolbar, side panel, slider.
   * @attribute controls
   * @default off
   */
  get controls(): boolean {
    return this.hasAttribute("controls");
  }

  set controls(shown: boolean) {
    this.toggleAttribute("controls", shown);
  }

  /**
   * The colours of desk, boards, edges, paper, text and controls: `light`, `sepia`, `grey` or `night`;
   * `auto` is light or night, as the system. Pictures keep their colours. An element with neither
   * controls nor a theme is `light`.
   *
   * @attribute theme
   * @default auto
   */
  get theme(): Theme {
    const theme = this.getAttribute("theme");
    return themes.find((known) => known === theme) ?? "auto";
  }

  set theme(theme: Theme) {
    this.setAttribute("theme", theme);
  }

  /**
   * Whether the open page is kept in the document's address, as `#page=23`, or as
   * `#page=23&at=3:1204` of flowing text, whose words it names: for one book per document. A jump,
   * as by a link, is a step in the browser's history.
   *
   * @attribute address
   * @default off
   */
  get address(): boolean {
    return this.hasAttribute("address");
  }

  set address(kept: boolean) {
    this.toggleAttribute("address", kept);
  }

  /**
   * Whether page, zoom, bookmarks and the choices of type and theme are kept over a
   * reload, in the browser's local storage.
   * @attribute remember
   * @default off
   */
  get remember(): boolean {
    return this.hasAttribute("remember");
  }

  set remember(kept: boolean) {
    this.toggleAttribute("remember", kept);
  }

  /**
   * Whether a bookmarked page has its corner folded over, until its bookmark is removed, and
   * whether a corner is folded that a pointer draws in over its page and holds still there.
   *
   * @attribute fold-bookmarks
   * @default off
   */
  get foldBookmarks(): boolean {
    return this.hasAttribute("fold-bookmarks");
  }

  set foldBookmarks(folds: boolean) {
    this.toggleAttribute("fold-bookmarks", folds);
  }

  /**
   * How the leaves are bound where a reader may tear them out by pulling one hard away from the
   * spine: `sewn`, along all of it; `stapled`, at two staples; `perforated`, along a line of cuts;
   * `none` if none may be torn out. An attribute without a value means sewn. Covers stay, of boards or of card, and so
   * does a book on the flat.
   *
   * @attribute tearable
   * @default none
   */
  get tearable(): TearLine | "none" {
    return tearLineOf(this) ?? "none";
  }

  set tearable(line: TearLine | "none") {
    this.setAttribute("tearable", line);
  }

  /**
   * Whether leaves make a sound, from the reader's first gesture on.
   *
   * @attribute sound
   * @default off
   */
  get sound(): boolean {
    return this.hasAttribute("sound");
  }

  set sound(heard: boolean) {
    this.toggleAttribute("sound", heard);
  }

  /**
   * Whether a phone vibrates when a leaf is grabbed and when it lands.
   *
   * @attribute vibrate
   * @default off
   */
  get vibrate(): boolean {
    return this.hasAttribute("vibrate");
  }

  set vibrate(felt: boolean) {
    this.toggleAttribute("vibrate", felt);
  }

  /** @internal */
  protected emit<K extends keyof TurnleafEventMap>(
    name: K,
    detail: TurnleafEventMap[K]["detail"],
  ): void {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  /**
   * Returns whether no listener cancels an event.
   *
   * @internal
   */
  protected ask<K extends keyof TurnleafEventMap>(
    name: K,
    detail: TurnleafEventMap[K]["detail"],
  ): boolean {
    return this.dispatchEvent(new CustomEvent(name, { detail, cancelable: true }));
  }
}
