/** The shadow tree of `<turnleaf-book>`: its parts, its messages, its style. */

import { pagesAt } from "../book/spreads.ts";
import { ElementPlane } from "../element_plane.ts";
import type { PageSource } from "../sources/page_source.ts";
import type { BookExtent } from "../viewer/book_extent.ts";
import type { Viewer } from "../viewer/viewer.ts";
import { countOf, elementTexts, fill, list } from "../words/languages.ts";
import { followTab, keepFocus } from "./focus_keeper.ts";

/**
 * The parts of one element's shadow tree.
 *
 * @csspart stage The area in which the book lies: the element without its
 * controls.
 * @csspart message The sheet that explains why a book is not shown, or that it
 * is loading; beside a book that stays meanwhile, a line at the foot.
 */
export class ShadowTree {
  /** Holds the stage and the controls around it; takes the focus for the book. */
  readonly frame: HTMLElement = document.createElement("div");
  /** The area in which the book lies: the element without its controls. */
  readonly stage: HTMLElement = document.createElement("div");
  /**
   * The area in which the stage lies where no panel lies beside it and no bars are hidden: for that the book is
   * laid out and its text is set, so that neither changes its pages.
   */
  readonly home: HTMLElement = document.createElement("div");
  /** How the stage is seen in the window. */
  readonly plane: ElementPlane = new ElementPlane(this.stage);
  /** Gives the element its size if the page gives it none. */
  readonly #sizer = document.createElement("div");
  readonly #message = document.createElement("div");
  readonly #live = document.createElement("div");

  constructor() {
    this.frame.className = "frame";
    this.frame.tabIndex = 0;
    this.frame.setAttribute("role", "group");
    this.stage.setAttribute("part", "stage");
    this.home.className = "home";
    this.#sizer.className = "room";
    this.#message.setAttribute("part", "message");
    this.#message.setAttribute("role", "status");
    this.#live.className = "live";
    this.#live.setAttribute("aria-live", "polite");
    followTab(this.frame);
    this.stage.append(this.#message, this.#live);
    this.frame.append(this.home, this.stage);
  }

  /** Attaches it to its element, and its style again if another document has dropped that. */
  attach(element: HTMLElement): void {
    let root = element.shadowRoot;
    if (root === null) {
      // The frame takes the focus: the element's own attributes belong to the page.
      root = element.attachShadow({
        mode: "open",
        delegatesFocus: true,
        // Pages that are elements need no attribute for it.
        slotAssignment: "manual",
      });
      element.attachInternals().role = "group";
      root.append(this.#sizer, this.frame);
      keepFocus(root, () => this.frame.focus({ preventScroll: true }));
    }
    if (root.adoptedStyleSheets.length === 0) addStyle(root, style);
  }

  /**
   * Sizes the element for a book: where the web page leaves its width open, it is as wide as two
   * pages, as a film is as wide as its frames.
   */
  fit({ placeRatio, placeWidth }: Pick<BookExtent, "placeRatio" | "placeWidth">): void {
    this.#sizer.style.setProperty("--ratio", String(placeRatio));
    this.#sizer.style.setProperty("--width", `${placeWidth}px`);
  }

  /**
   * Shows a sentence where the page would be; an empty one removes it.
   *
   * @param isBeside whether it leaves a book in sight: it is then a line at the foot
   */
  say(sentence: string, role: "status" | "alert" = "status", isBeside = false): void {
    this.#message.setAttribute("role", role);
    this.#message.classList.toggle("beside", isBeside);
    this.#message.textContent = sentence;
    this.#message.hidden = sentence === "";
  }

  /** Removes a failure beside a book that its reader goes on with. */
  readOn(): void {
    const { classList, role } = this.#message;
    if (classList.contains("beside") && role === "alert") this.say("");
  }

  /** Announces a text to screen readers. */
  announce(text: string): void {
    this.#live.textContent = text;
  }
}

/** Returns which pages lie open, such as "Pages iv and v of 112", in a language. */
export function openPages(source: PageSource, viewer: Viewer, tag: string): string {
  const { spread } = viewer.turning;
  const seen = pagesAt(viewer.binding, spread).map((page) => source.label(page - 1));
  const { back, pageOpen, pagesOpen } = elementTexts(tag);
  const text = [back, pageOpen][seen.length] ?? pagesOpen;
  return fill(text, {
    pages: list(tag, seen),
    n: countOf(tag, {
      pageCount: source.pageCount,
      estimated: source.isEstimated ?? false,
      guessed: source.isGuessed ?? false,
    }),
  });
}

/**
 * Adds a style sheet to a shadow tree: not a `<style>` element, which pages
 * with a strict security policy forbid. A constructed sheet belongs to one
 * document for good, and a tree that moves to another loses its sheets, so each
 * is made in the window in which the tree is now.
 *
 * @returns a function that removes it
 */
export function addStyle(root: ShadowRoot, css: string): () => void {
  const view = root.ownerDocument.defaultView;
  // A document without a window shows nothing.
  if (view === null) return () => undefined;
  const sheet = new view.CSSStyleSheet();
  sheet.replaceSync(css);
  root.adoptedStyleSheets = [...root.adoptedStyleSheets, sheet];
  return () => {
    root.adoptedStyleSheets = root.adoptedStyleSheets.filter((other) => other !== sheet);
  };
}

/** The desk by night, by the attribute or by the system, and what lies on dark pages. */
const dark = (
  selector: string,
  middle: string,
  edge: string,
  accent: string,
): string => /* css */ `${selector} {
  --turnleaf-desk: radial-gradient(ellipse at 50% 38%, ${middle}, ${edge} 95%);
  --turnleaf-accent: ${accent}; color-scheme: dark;
  --lay: normal; --selected: rgb(110 160 235 / 0.38); --hit: rgb(255 190 50 / 0.28); --here: rgb(255 176 32 / 0.5);
}`;
const night = (selector: string): string => dark(selector, "#171614", "#0b0a0a", "#eba58d");

/**
 * The element's own style; outside it the page decides. The controls bring
 * their own.
 *
 * @cssproperty --turnleaf-desk Background of the book, if the element has
 * controls or a theme.
 * @cssproperty --turnleaf-accent Selected items, and the focus outline.
 */
export const style: string = /* css */ `
:host {
  display: block; position: relative; overflow: hidden; min-height: 12rem;
  --turnleaf-desk: radial-gradient(ellipse at 50% 38%, #efece6, #cfc9be 95%);
  --turnleaf-accent: #8a3324; color-scheme: light;
  --lay: multiply; --selected: rgb(178 203 238 / 0.996); --hit: rgb(255 214 90 / 0.55); --here: rgb(255 176 32 / 0.85);
}
:host([theme="sepia"]) {
  --turnleaf-desk: radial-gradient(ellipse at 50% 38%, #dcd0b8, #b3a384 90%);
  --turnleaf-accent: #7f2f20;
}
${dark(':host([theme="grey"])', "#35332f", "#232220", "#f7c9b8")}
${night(':host([theme="night"])')}
@media (prefers-color-scheme: dark) { ${night(':host(:is([controls], [theme]):not([theme="light"], [theme="sepia"], [theme="grey"]))')} }
:host(:is([controls], [theme])) { background: var(--turnleaf-desk); }
.frame:focus { outline: none; }
.frame:focus-visible { outline: none; }
/* It would stand around a book that is read on after a panel, a field or a key of the book's. */
.frame.tabbed:focus-visible > [part="stage"]::after {
  content: ""; position: absolute; inset: 4px; border: 2px solid var(--turnleaf-accent); border-radius: 8px; pointer-events: none;
}
:host([hidden]) { display: none; }
.frame { position: absolute; inset: 0; container: turnleaf / size; }
.room {
  width: max(20rem, var(--width, 0px)); padding-top: min(100% / var(--ratio, 1.2), 90vh); visibility: hidden; pointer-events: none;
}
:host([controls]) .room { padding-bottom: 100px; }
[part="stage"], .home { position: absolute; inset: 0; overflow: hidden; color-scheme: light; }
.home { visibility: hidden; pointer-events: none; }
:host([controls]) :is([part="stage"], .home) { inset-block: 48px 52px; }
/* Where fingers turn pages and the bars would take a fifth of the height, as on phones that lie, they lie over the book. */
@media (hover: none) {
  @container turnleaf (max-height: 499px) { :host([controls]) :is([part="stage"], .home) { inset-block: 0; } }
}
[part="canvas"] { position: absolute; inset: 0; width: 100%; height: 100%; display: block; }
[part="message"] {
  position: absolute; inset: 0; margin: auto; width: min(20rem, 70%); aspect-ratio: 2 / 3; max-height: 84%;
  display: grid; place-content: center; box-sizing: border-box; padding: 2rem; text-align: center;
  background: #fbf5e8; color: #211d1a; font: italic 1.05rem/1.5 Georgia, serif; text-wrap: balance;
  border-radius: 1px 3px 3px 1px; box-shadow: 0 0.1rem 0.4rem rgb(40 30 20 / 0.25), 0 1rem 3rem rgb(40 30 20 / 0.2);
}
[part="message"][role="status"] { color: rgb(33 29 26 / 0.7); }
[part="message"].beside {
  inset: auto 0 0.75rem; width: fit-content; max-width: calc(100% - 3rem); aspect-ratio: auto;
  padding: 0.5rem 1rem; font-size: 0.95rem; border-radius: 3px; pointer-events: none; z-index: 1;
}
[part="message"].beside[role="status"] { animation: late 0.5s step-end; }
@keyframes late { from { visibility: hidden; } }
[part="message"][hidden], .by-day { display: none; }
@media print {
  .by-day { display: block; }
  .by-day > canvas { position: absolute; background: #fff; }
  [part="stage"]:has(> .by-day > canvas) { filter: none !important; }
  [part="stage"]:has(> .by-day > canvas) > [part="canvas"] { visibility: hidden; }
  :host(:is([controls], [theme])) { background: none; }
  :host([controls]) .room { padding-bottom: 0; }
  .home { inset: auto; width: var(--screen-width, 100%); height: var(--screen-height, 100%); }
  /* As on the screen, with all that lies over it, and as large as fits; the quotient of two lengths is a tangent. */
  .frame > [part="stage"][part] {
    inset: 50% auto auto 50%; width: var(--screen-width, 100%); height: var(--screen-height, 100%);
    translate: -50% -50%; filter: var(--printed, none);
    scale: min(tan(atan2(100cqw, var(--screen-width, 100cqw))), tan(atan2(100cqh, var(--screen-height, 100cqh))));
  }
}
.live { user-select: none; -webkit-user-select: none; position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
`;
