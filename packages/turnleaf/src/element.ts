/** `<turnleaf-book>`: a book on a web page. */

import {
  type AttributeEffect,
  attributeName,
  attributeProperties,
  attributes,
} from "./attributes.ts";
import { readStocks } from "./book/leaf_stocks.ts";
import type { Paper } from "./book/paper.ts";
import { pagesAt, spreadOf } from "./book/spreads.ts";
import { ControlsLoader } from "./controls/controls_loader.ts";
import { bindingOptionsOf, paperOf, turnSecondsOf } from "./element/attribute_options.ts";
import { BookLifecycle, pdfWorkerOf } from "./element/book_lifecycle.ts";
import { failureDetail, sentenceOf } from "./element/failure_detail.ts";
import type { OpenBook } from "./element/open_book.ts";
import type { PageChanges } from "./element/page_changes.ts";
import { layoutLists } from "./element/page_lists.ts";
import { pageNumber, RequestedPage } from "./element/page_numbers.ts";
import { pageThemeOf, printFilterOf, watchScheme } from "./element/page_theme.ts";
import { adopt } from "./element/reflecting_element.ts";
import { openPages, ShadowTree } from "./element/shadow_tree.ts";
import { SoundAndHaptics } from "./element/sound_and_haptics.ts";
import { TearableElement } from "./element/tearable_element.ts";
import { TextSetting } from "./element/text_setting.ts";
import { WatchedChildren } from "./element/watched_children.ts";
import { loadPart } from "./sources/load_part.ts";
import type { BookInput } from "./sources/open.ts";
import type { PageList } from "./sources/page_list.ts";
import {
  BookError,
  type NewIndex,
  type PageColours,
  type PageSize,
} from "./sources/page_source.ts";
import { coloursOf } from "./themes.ts";
import type { Viewer, ViewerOptions, Zoom } from "./viewer/viewer.ts";
import type { FilmFrames } from "./viewer/viewer_options.ts";
import { elementTexts, fill, languageOf, loadLanguage, percent } from "./words/languages.ts";

/** Duration of a zoom by command, seconds. */
const zoomSeconds = 0.25;

/** What a change of an observed attribute acts on, by its name: HTML's own language, the page, and the table. */
const effects: ReadonlyMap<string, AttributeEffect> = new Map([
  ["lang", "speak"],
  ["page", "setPage"],
  ...attributeProperties.flatMap((property) => {
    const { effect } = attributes[property];
    return effect ? [[attributeName(property), effect] as const] : [];
  }),
]);

/**
 * The element's class: opens books, each in place of the one before. Its attributes are
 * described with their properties.
 */
export class TurnleafBook extends TearableElement {
  /** Attributes whose changes are observed. */
  static readonly observedAttributes: readonly string[] = [...effects.keys()];

  readonly #tree = new ShadowTree();
  readonly #life = new BookLifecycle(this, this.#tree.stage, this.#tree.home, {
    prepare: async () => {
      await Promise.all([this.#keepPlace(), loadLanguage(languageOf(this))]);
    },
    restore: (source, src) => this.#restore(source, src),
    plane: this.#tree.plane,
    replacing: () => {
      this.#soundAndHaptics.close();
      this.#forget();
    },
    options: (source) => this.#options(source),
    turn: (by, isTap) => this.press(by, isTap),
    announceZoom: () => this.announceZoom(),
    calm: () => this.isCalm,
    goTo: (page, top) => void this.turnTo(page, { top, jump: true }),
    typography: () => this.#text.take(),
    password: () => this.password,
    askPassword: async (isWrong, signal) =>
      this.controls ? await this.#controls.askPassword(this, isWrong, signal) : null,
    leaving: () => this.#leave(),
    opened: (book) => this.#opened(book),
    changing: (change) => void this.#followSource(change),
    measured: () => this.#laidOut(),
    renumbered: (moved, pageCount) => {
      this.moveLists(moved.placeOf ?? moved, pageCount);
      this.jumps.follow(moved);
    },
    lists: () => this.lists,
    warned: () => this.reportWarnings(),
    missingPart: (error) => this.reportMissingPart(error),
    failed: (error) => this.#fail(error),
  });
  /**
   * The film that is made of the books that open, null for none.
   *
   * @internal
   */
  filmFrames: FilmFrames | null = null;
  /** Changes the book's pages, once they are to be changed. */
  #pageChanges: Promise<PageChanges> | null = null;
  readonly #text: TextSetting = new TextSetting(
    this,
    this.#tree.home,
    () => this.#life.book,
    (error) => this.reportMissingPart(error),
  );
  readonly #controls = new ControlsLoader((error) => this.reportMissingPart(error));
  readonly #soundAndHaptics = new SoundAndHaptics(
    this,
    () => this.#leaves.stock ?? "book",
    (error) => this.reportMissingPart(error),
  );
  #input: BookInput | null = null;
  #paper: Paper | null = null;
  readonly #asked = new RequestedPage();
  /** Ends what follows the system while the element is in a document. */
  #watching: AbortController | null = null;
  /** The page where this book was last closed. */
  #left: { readonly page: number; readonly anchor?: string; readonly view: Zoom } | null = null;
  /** What is said while no book is open: why not. */
  #status: "missing" | "opening" | null = null;
  /** Whether the last book could not be opened, and no other is being read. */
  #hasFailed = false;
  /** Whether the element is in a document. */
  #connected = false;
  /** What the book that opens was bound by, as text. */
  #boundBy = "";
  /** The element's children, of which a book opens when the first of them comes. */
  readonly #children = new WatchedChildren(this, () => {
    const isOther = this.src !== "" || this.#input !== null;
    if (!isOther && this.#life.isIdle && this.#children.input !== "") this.#reopen();
  });

  /**
   * The book's contents: images in order, a manifest, or a file as it was
   * chosen, dropped or fetched (a `File`, a `FileList`, a `Blob` of any type,
   * an `ArrayBuffer`, a typed array), or elements of the web page, which become
   * children of this one. While it is set, `src` does nothing, as with a video's
   * `srcObject`; null gives `src` its place back. Without either, the element's
   * own children are the pages. The open book stays, and can be turned, until
   * the new one has been read; if that fails it stays, and a sentence and an
   * `error` say why.
   */
  get pages(): BookInput | null {
    return this.#input;
  }

  set pages(pages: BookInput | null) {
    this.#input = pages ?? null;
    this.#openAnew();
  }

  /**
   * The password of a protected PDF, read when the book opens. Without it the
   * controls ask the reader; without controls such a file is an `error`.
   */
  password = "";

  /**
   * The paper in figures, the stiffness of the binding, and the wind; it
   * overrides the attributes.
   */
  get paper(): Paper | null {
    return this.#paper;
  }

  set paper(paper: Paper | null) {
    this.#paper = paper;
    this.#viewer?.setPaper(this.#leaves);
  }

  /** Whether the visible pages are at full sharpness, set for the size in which they are shown, and nothing moves. */
  get settled(): boolean {
    return !this.#text.isPending && (this.#viewer?.settled ?? false);
  }

  /**
   * Whether the book is settled, the pages that the next turn brings into
   * view are drawn, as far as memory allows, and where leaves may be torn out, what tears them is
   * loaded.
   */
  get ready(): boolean {
    return this.settled && !this.isLoadingTears && (this.#viewer?.ready ?? false);
  }

  /**
   * Whether a book is being read, or about to be shown.
   *
   * @internal
   */
  get isOpening(): boolean {
    return this.#life.isOpening;
  }

  /**
   * Where the open book lies: the rectangle around its two pages, or the one
   * that is shown alone, CSS pixels from the element's upper left corner. The
   * same while the book is shut and while leaves turn; null while none is open.
   */
  get bookBounds(): DOMRect | null {
    const viewer = this.#viewer;
    if (viewer === undefined) return null;
    const { from, to } = viewer.extent.bounds;
    const { offsetLeft, offsetTop } = this.#tree.stage;
    return new DOMRect(from.x + offsetLeft, from.y + offsetTop, to.x - from.x, to.y - from.y);
  }

  /**
   * Inserts pages before page `at` (from 1), or after the last. The visible
   * page stays. Resolves, once the book is at rest and they are in it, to
   * whether they are. Rejects with a `BookError`, and changes nothing, if they
   * cannot be opened, one of the first eight cannot be drawn, or there is no
   * page `at`. A later one that cannot be drawn is a `pageerror` when it is
   * about to be seen.
   */
  insertPages(at: number, pages: BookInput): Promise<boolean> {
    return this.#changePages(at, 0, pages);
  }

  /**
   * Removes `count` pages from page `from` (from 1) on. Resolves and rejects as
   * `insertPages` does.
   */
  removePages(from: number, count = 1): Promise<boolean> {
    return this.#changePages(from, count, null);
  }

  /** Replaces page `page` (from 1) by other pages. Resolves and rejects as `insertPages` does. */
  replacePage(page: number, pages: BookInput): Promise<boolean> {
    return this.#changePages(page, 1, pages);
  }

  /**
   * Draws a page (from 1, by default every open one) anew, as it looks now: one whose looks have
   * changed without the book's knowledge, as those of a page source of your own or of an element with
   * a canvas. `settled` says when it is drawn. What is painted on a canvas of a page that is an
   * element is seen in the air as it is when the leaf takes off, without this.
   */
  redraw(page?: number): void {
    const book = this.#life.book;
    if (book === null) return;
    const { binding, turning } = book.viewer;
    for (const each of page === undefined ? pagesAt(binding, turning.spread) : [page]) {
      if (!Number.isInteger(each) || each < 1 || each > book.source.pageCount) continue;
      book.source.outdate(each - 1);
      book.viewer.redraw(each);
      book.roll?.redraw(each);
    }
  }

  /** The zoom level: 1 for the whole book, to 8. Setting it zooms about the middle. */
  get zoom(): number {
    return this.#viewer?.zoomLevel ?? this.#left?.view.level ?? 1;
  }

  set zoom(level: number) {
    this.zoomTo(level);
  }

  /**
   * Zooms to a level (1 to 8). The point `at`, in CSS pixels from the element's
   * upper left corner, stays where it is. The default is the middle.
   */
  zoomTo(level: number, at?: { x: number; y: number }): void {
    const { clientWidth, clientHeight, offsetLeft, offsetTop } = this.#tree.stage;
    const place = at
      ? { x: at.x - offsetLeft, y: at.y - offsetTop }
      : { x: clientWidth / 2, y: clientHeight / 2 };
    this.#viewer?.zoom(Number(level), place, place, this.isCalm ? 0 : zoomSeconds);
  }

  /**
   * Returns where a point of the window, as `clientX` and `clientY` of an event, lies on the element:
   * CSS pixels from its upper left corner, as `bookBounds` and `zoomTo` have them, however it and the
   * elements around it are transformed; null while it is not shown, or seen edge-on.
   */
  pointAt(clientX: number, clientY: number): DOMPoint | null {
    const at = this.#tree.plane.fromClient(clientX, clientY);
    const { offsetLeft, offsetTop } = this.#tree.stage;
    return at && new DOMPoint(at.x + offsetLeft, at.y + offsetTop);
  }

  /**
   * Returns how large the book would be shown beside a panel, as a fraction of its size without one.
   *
   * @param width of the panel, CSS pixels
   *
   * @internal
   */
  fractionBeside(width: number): number {
    return this.#viewer?.extent.fractionBeside(width) ?? 1;
  }

  /**
   * Announces a text to screen readers.
   *
   * @internal
   */
  announce(text: string): void {
    this.#tree.announce(text);
  }

  /**
   * Announces the zoom level to screen readers.
   *
   * @internal
   */
  announceZoom(): void {
    this.announce(percent(languageOf(this), this.zoom));
  }

  /** Focuses the book, also from one of its controls: keys then turn its pages. */
  override focus(options?: FocusOptions): void {
    this.#tree.frame.focus(options);
  }

  /** @internal */
  connectedCallback(): void {
    adopt(this);
    this.#tree.attach(this);
    this.#connected = true;
    this.connectReader();
    this.#updateControls();
    this.#watching = new AbortController();
    const view = this.ownerDocument.defaultView ?? window;
    const { signal } = this.#watching;
    watchScheme(view, () => this.#recolour(), signal);
    view.addEventListener("beforeprint", () => this.#setPrintFilter(), { signal });
    void this.#speak(false);
    this.#children.watch();
    this.#reopen();
  }

  /** @internal A move that keeps the state, by `moveBefore`, changes nothing. */
  connectedMoveCallback(): void {}

  /** @internal */
  disconnectedCallback(): void {
    this.#leave();
    this.#asked.failed();
    this.disconnectReader();
    this.#connected = false;
    this.#watching?.abort();
    this.#children.stop();
    this.#updateControls();
    // Inserted again it opens the whole book, without the pages that were added.
    if (this.#left) {
      const { page } = this.homePlace;
      this.#left = { ...this.#left, page, anchor: this.source?.first.anchor?.(page - 1) };
    }
    if (this.#life.book) this.returnLists();
    this.#text.stop();
    this.#life.close();
    this.reportLists();
    this.updateState();
  }

  /** @internal */
  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    const effect = effects.get(name);
    if (effect !== undefined && before !== now) this.#effects[effect](now);
  }

  readonly #effects: Readonly<Record<AttributeEffect, (value: string | null) => void>> = {
    speak: () => {
      if (this.#connected) void this.#speak(true);
    },
    open: () => {
      if (this.#input === null) this.#openAnew();
    },
    rebind: () => this.#viewer?.rebind(this.#binding),
    recolour: () => this.#recolour(),
    listHardPages: () => this.#relist("hardPages"),
    listStocks: () => {
      for (const error of readStocks(this.stocks).errors)
        console.warn(`turnleaf-book: stocks: ${error}`);
      this.#relist("stocks");
    },
    setPage: (value) => {
      this.page = value as unknown as number;
    },
    changePaper: () => this.#viewer?.setPaper(this.#leaves),
    changeModel: () => void this.#viewer?.setModel(this),
    typeset: () => this.#text.attributeChanged(),
    changePace: () => {
      if (this.#viewer) this.#viewer.turning.seconds = turnSecondsOf(this);
    },
    keepPlace: () => void this.#keepPlace(),
    updateControls: () => {
      this.#updateControls();
      this.#recolour();
    },
    stopSound: () => this.#soundAndHaptics.close(),
    allowFolding: () => this.foldOpened(),
    allowTearing: () => this.allowTearing(),
  };

  /** Pages of a list are of board, or of other stocks, from now on. */
  #relist(name: "hardPages" | "stocks"): void {
    this.listPages(name, this[name]);
    this.#viewer?.rebind(this.#binding);
  }

  /** @internal */
  protected override get textSize(): PageSize {
    return this.#text.size;
  }

  /** @internal */
  protected override get book(): OpenBook | null {
    return this.#life.book;
  }

  get #viewer(): Viewer | undefined {
    return this.#life.book?.viewer;
  }

  /** Returns the page at which somebody wants a book to open, else its source does; null if nobody does. */
  #namedPage(source?: PageList): number | null {
    const said = pageNumber(this.getAttribute("page")) ?? source?.openingPage ?? null;
    return this.#asked.page ?? this.keptPage(source, this.#left?.page ?? null) ?? said;
  }

  /** @internal */
  protected override firstPage(source?: PageList): number {
    const page = this.#namedPage(source) ?? 1;
    return Math.min(Math.max(Math.round(page) || 1, 1), source?.pageCount ?? page);
  }

  /** Prepares for another book: it opens at its beginning, without the other's bookmarks. */
  #forget(): void {
    this.forgetBook();
    this.#left = null;
  }

  /** Remembers where the open book lies, and stops its sound. */
  #leave(): void {
    this.#soundAndHaptics.close();
    if (this.#viewer) this.#left = { page: this.page, view: this.#viewer.view };
  }

  #keepPlace(): Promise<void> {
    return this.keepPlace().catch((error: unknown) => this.reportMissingPart(error));
  }

  #updateControls(): void {
    const shown = this.#connected && this.controls;
    this.#controls.set(shown, this, this.#tree.frame, this.#tree.stage);
  }

  /** @internal */
  protected override openAt(page: number): Promise<boolean> | null {
    if (this.#viewer !== undefined && !this.#life.isReading) return null;
    const lies = this.#asked.ask(page);
    // The next book opens there, but nothing is awaited where none is to come.
    if (this.#hasFailed) this.#asked.failed();
    return lies;
  }

  get #leaves(): Paper {
    return { ...paperOf(this), ...this.#paper };
  }

  /** Opens another book in place of the open one, which stays until that has been read. */
  #openAnew(): void {
    const isNone = this.#input === null && this.src === "";
    // The element's own children can be distinguished from the pages of the open book only without that.
    if (isNone) {
      this.#soundAndHaptics.close();
      this.#forget();
      this.#life.close();
      this.#asked.failed();
    } else if (!this.#life.book) this.#forget();
    // It is meant for the book that opens.
    if (!isNone && this.justSet !== null) void this.#asked.ask(this.justSet);
    this.#reopen();
  }

  /** Says whether a book opens, or is missing, until one is open. */
  #sayStatus(): void {
    if (this.#status === null) return;
    const text = elementTexts(languageOf(this))[this.#status];
    this.#tree.say(text, "status", this.#life.book !== null);
  }

  /**
   * Says what is said now in the element's language, once that is loaded.
   *
   * @param isOther whether another has been spoken
   */
  async #speak(isOther: boolean): Promise<void> {
    const isNew = await loadLanguage(languageOf(this));
    if (!isNew && !isOther) return;
    this.#sayStatus();
    this.describe();
  }

  #reopen(): void {
    // The parser's attributes come one by one before the element is connected: one book, not four.
    if (!this.#connected) return;
    const input = this.#input ?? (this.src || this.#children.input);
    this.#status = input === "" ? "missing" : "opening";
    this.#hasFailed = false;
    this.#sayStatus();
    if (input === "") this.#life.close();
    else this.#life.open(input, this.src);
    this.updateState();
  }

  async #restore(source: PageList, src: string): Promise<void> {
    const found = await this.#text.restore(source, (typography) =>
      this.restorePlace(source, src, typography, this.#left?.anchor),
    );
    if (this.#left && found !== null) this.#left = { ...this.#left, page: found };
  }

  /** The options in the attributes: lists of pages name them as they lie now. */
  get #binding() {
    return { ...bindingOptionsOf(this), ...layoutLists(this.lists) };
  }

  /**
   * What is done now with the pages of the open book that are drawn already: "" if the theme is not
   * dark, or all pages are text that is set in its colours, or elements.
   *
   * @internal
   */
  get darkPagesNow(): PageColours["pictures"] {
    const { source } = this;
    return source ? source.darkened(this.page - 1) : "";
  }

  /** Shows the book in the colours that the attributes and the system say. */
  #recolour(): void {
    const book = this.#life.book;
    const theme = pageThemeOf(this);
    if (!book) return;
    const colours = coloursOf(theme, this.darkPages);
    if (JSON.stringify(colours) === JSON.stringify(book.source.colours)) return;
    book.source.colours = colours;
    book.viewer.recolour(theme);
    book.roll?.recolour();
    this.#printByDay(book);
  }

  #printByDay(book: OpenBook): void {
    book.printByDay().catch((error: unknown) => this.reportMissingPart(error));
  }

  /**
   * Sets how the web page's own print shows the book where its pages are not drawn by day yet: in the colours of
   * now turned over, as no page is drawn while it prints.
   */
  #setPrintFilter(): void {
    const filter = printFilterOf(this.source?.colours ?? null, this.darkPagesNow);
    this.#tree.stage.style.setProperty("--printed", filter);
  }

  #options(source: PageList): ViewerOptions {
    source.colours = coloursOf(pageThemeOf(this), this.darkPages);
    const binding = this.#binding;
    this.#boundBy = JSON.stringify(binding);
    return {
      ...binding,
      paper: () => this.#leaves,
      page: () => this.firstPage(source),
      opensShut: () => this.#namedPage(source) === null,
      turnSeconds: () => turnSecondsOf(this),
      filmFrames: this.filmFrames,
      model: () => this,
      onStart: (low, high, forward) => {
        if (!this.#viewer) return;
        this.#soundAndHaptics.take();
        this.#tree.readOn();
        this.turnStarted(low, high, forward);
      },
      onRest: (from, to) => {
        this.#soundAndHaptics.lie();
        this.turnEnded(from, to);
      },
      slowText: (label) => fill(elementTexts(languageOf(this)).slowPage ?? "", { label }),
      failureText: (error, page) => sentenceOf(error, languageOf(this), page),
      onFailure: (page, error, isOpen) => {
        const detail = failureDetail(error, languageOf(this), page);
        if (isOpen) this.#tree.announce(detail.message);
        this.emit("pageerror", { ...detail, page });
      },
      calm: () => this.isCalm,
      onPageWidth: () => this.#text.follow(),
      onLayout: () => this.#laidOut(),
      onPage: (from, to) => this.pageChanged(from, to, from < to ? "forward" : "backward"),
      onMotion: (...frame) => {
        this.updateState();
        this.#soundAndHaptics.follow(...frame);
        this.filmed();
      },
      foldsByHand: () => this.foldBookmarks,
      onPress: ({ page, corner, size }) => this.dogEar(page, corner, size),
      tearing: this.tearOwner((work) => this.#soundAndHaptics.tear(work)),
      onMissingPart: (error) => this.reportMissingPart(error),
      onZoom: (zoom) => this.emit("zoomchange", { zoom }),
    };
  }

  #opened(book: OpenBook): void {
    const { source, viewer } = book;
    const { binding } = viewer;
    // A page may have been requested since the book was laid open.
    const isElsewhere = this.#asked.page !== null && this.#asked.page !== this.#left?.page;
    if (this.#asked.page !== null) viewer.lay(spreadOf(binding, this.#asked.page));
    this.#asked.opened((page) => spreadOf(binding, page) === viewer.turning.spread);
    if (this.#left && !isElsewhere) viewer.view = this.#left.view;
    this.#left = null;
    this.#status = null;
    this.#tree.say("");
    this.#tree.fit(viewer.extent);
    this.describe();
    this.turnsOpened();
    this.#follow(viewer);
    this.foldOpened();
    this.tearOpened(source);
    this.#printByDay(book);
    this.emit("load", { pageCount: source.pageCount, title: source.title });
  }

  /** Binds and sets a book that has just opened as attributes say that were changed meanwhile. */
  #follow(viewer: Viewer): void {
    const binding = this.#binding;
    if (JSON.stringify(binding) !== this.#boundBy) viewer.rebind(binding);
    if (this.#text.isOutdated) void this.#text.setAnew();
  }

  async #changePages(at: number, count: number, input: BookInput | null): Promise<boolean> {
    const book = () => this.#life.book;
    const worker = pdfWorkerOf(this);
    this.#pageChanges ??= loadPart(import("./element/page_changes.ts")).then(
      ({ PageChanges }) => new PageChanges(),
    );
    const changes = await this.#pageChanges;
    const isMade = await changes.change(book, at, count, input, worker);
    if (isMade) this.pagesChanged();
    return isMade;
  }

  /** Makes a change of the pages that their source asks for, once the book is at rest. */
  async #followSource(change: () => NewIndex): Promise<void> {
    if (await this.#life.book?.followSource(change)) this.pagesChanged();
  }

  /** @internal */
  protected override pagesChanged(): void {
    if (this.#life.book === null) return;
    this.reportLists();
    this.describe();
    this.emit("pageschange", { pageCount: this.pageCount });
  }

  #laidOut(): void {
    const viewer = this.#viewer;
    if (viewer === undefined) return;
    this.#tree.fit(viewer.extent);
    this.describe();
    const { layout, edge } = viewer.binding;
    this.emit("layoutchange", { layout, binding: edge });
  }

  /** @internal */
  protected override describe(): void {
    const book = this.#life.book;
    if (book === null) return;
    const text = openPages(book.source, book.viewer, languageOf(this));
    book.canvas.setAttribute("aria-label", `${book.source.title}. ${text}`);
    this.#tree.frame.setAttribute("aria-label", book.source.title);
    this.#tree.announce(text);
  }

  #fail(error: unknown): void {
    const detail = failureDetail(error, languageOf(this));
    this.#status = null;
    this.#hasFailed = true;
    this.#tree.say(detail.message, "alert", this.#life.book !== null);
    this.#asked.failed();
    this.updateState();
    this.emit("error", detail);
  }

  /** @internal */
  protected override reportMissingPart(error: unknown): void {
    if (!(error instanceof Error)) return;
    const isSentence = error instanceof BookError;
    const { message } = error;
    this.emit(
      "error",
      isSentence ? failureDetail(error, languageOf(this)) : { message, code: "failed" },
    );
  }
}
