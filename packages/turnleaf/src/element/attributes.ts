/** The attributes of `<turnleaf-book>`: their meaning, and the effect of a change. */

import { readStocks } from "../book/leaf_stocks.ts";
import { isStock, type Paper } from "../book/paper.ts";
import { type Stock, type TearLine, tearLines } from "../engine/shapes.ts";
import type { Gesture } from "../input/target.ts";
import { metresIn } from "../metres.ts";
import type { BindingOptions } from "../viewer/bound_book.ts";
import { pageThemeOf, themeAttributes } from "./page_theme.ts";
import { typographyAttributes } from "./typography.ts";

/** The attributes of the binding. */
export const bindingAttributes: readonly string[] = [
  "cover",
  "cloth",
  "shadows",
  "camera",
  "tilt",
  "margin",
  "binding",
  "layout",
  "offset",
  "hard-pages",
  "stocks",
];

const covers = ["auto", "hard", "soft", "none"] as const;
const bindings = ["auto", "left", "right", "top", "bottom"] as const;
const layouts = ["auto", "spread", "single"] as const;
const cameras = ["reader", "overhead"] as const;

/** Returns the options in an element's attributes; an invalid value counts as missing. */
export function bindingOptionsOf(element: Element): Omit<BindingOptions, "shifts"> {
  const word = <W extends string>(name: string, words: readonly W[]): W =>
    words.find((known) => known === element.getAttribute(name)) ?? words[0];
  return {
    cover: word("cover", covers),
    cloth: element.getAttribute("cloth") ?? "#6a2a26",
    theme: pageThemeOf(element),
    shadows: numberIn(element, "shadows", 0, 1) ?? 1,
    camera: word("camera", cameras),
    tilt: numberIn(element, "tilt", 0, 12) ?? 0,
    margin: numberIn(element, "margin", 0, 0.25) ?? 0.03,
    binding: word("binding", bindings),
    layout: word("layout", layouts),
    offset: element.getAttribute("offset") === "0" ? 0 : 1,
    hardPages: element.getAttribute("hard-pages") ?? "",
    stocks: element.getAttribute("stocks") ?? "",
  };
}

/** The possible effects of a change of an attribute. */
export interface AttributeEffects {
  /** The language is another. */
  speak(): void;
  /** Another book: it opens at its beginning. */
  open(): void;
  /** The same book, bound again, where it lay. */
  rebind(): void;
  /** A list of pages of board or of stocks is another: it names pages as they lie now. */
  listPages(name: "hardPages" | "stocks", list: string): void;
  /** The attribute of the page has another value: the book turns there if it is a number. */
  setPage(value: string | null): void;
  /** The leaves are made of another paper. */
  changePaper(): void;
  /** The leaves turn in another way. */
  changeModel(): void;
  /** Flowing text is set in another way. */
  typeset(): void;
  /** The book is shown in other colours. */
  recolour(): void;
  /** Turns take another time. */
  changePace(): void;
  /** The place is kept from now on, or no longer. */
  keepPlace(): void;
  /** The controls appear or disappear. */
  updateControls(): void;
  /** Leaves may be torn out from now on, or no longer. */
  allowTearing(): void;
  /** Stops the sound until a leaf moves that should be heard. */
  stopSound(): void;
  /** Loads what folds pages, where they may be folded. */
  allowFolding(): void;
}

/** Every observed attribute and the effect of its change. */
export const attributes: Readonly<
  Record<string, (effects: AttributeEffects, value: string | null) => void>
> = {
  lang: (effects) => effects.speak(),
  src: (effects) => effects.open(),
  page: (effects, value) => effects.setPage(value),
  ...Object.fromEntries(
    bindingAttributes.map((name) => [name, (to: AttributeEffects) => to.rebind()]),
  ),
  ...Object.fromEntries(
    typographyAttributes.map((name) => [name, (to: AttributeEffects) => to.typeset()]),
  ),
  ...Object.fromEntries(
    themeAttributes.map((name) => [name, (to: AttributeEffects) => to.recolour()]),
  ),
  "hard-pages": (effects, value) => effects.listPages("hardPages", value ?? ""),
  stocks: (effects, value) => {
    for (const error of readStocks(value ?? "").errors)
      console.warn(`turnleaf-book: stocks: ${error}`);
    effects.listPages("stocks", value ?? "");
  },
  duration: (effects) => effects.changePace(),
  stock: (effects) => effects.changePaper(),
  assist: (effects) => effects.changePaper(),
  "page-width": (effects) => effects.changePaper(),
  model: (effects) => effects.changeModel(),
  "model-src": (effects) => effects.changeModel(),
  address: (effects) => effects.keepPlace(),
  remember: (effects) => effects.keepPlace(),
  controls: (effects) => effects.updateControls(),
  sound: (effects) => effects.stopSound(),
  "fold-bookmarks": (effects) => effects.allowFolding(),
  tearable: (effects) => effects.allowTearing(),
};

/** Returns the preset of `stock`; "book" if the attribute names none. */
export function stockOf(element: Element): Stock {
  const stock = element.getAttribute("stock");
  return isStock(stock) ? stock : "book";
}

/** Returns how leaves are bound that may be torn out, by `tearable`; null if none may. */
export function tearLineOf(element: Element): TearLine | null {
  const line = element.getAttribute("tearable");
  return line === "" ? "sewn" : (tearLines.find((known) => known === line) ?? null);
}

/** Returns the paper that the attributes name. */
export function paperOf(element: Element): Paper {
  const pageWidth = metresIn(element.getAttribute("page-width") ?? "");
  return {
    stock: stockOf(element),
    assist: element.getAttribute("assist") !== "off",
    ...(pageWidth === undefined ? {} : { pageWidth }),
  };
}

/**
 * Returns the length of a turn by `duration`, in seconds: 0 for no motion at
 * all; 0.8 if the attribute is missing, empty, or not a number from 0 to a
 * minute.
 */
export function turnSecondsOf(element: Element): number {
  return (numberIn(element, "duration", 0, 60_000) ?? 800) / 1000;
}

/**
 * Returns whether a gesture of the reader's acts on the book, by `gestures`:
 * all do if the attribute is missing or empty.
 */
export function allowsGesture(element: Element, gesture: Gesture): boolean {
  const list = element.getAttribute("gestures")?.trim();
  return !list || list.split(/\s+/).includes(gesture);
}

/** Returns the minimum length of a flick that turns, by `swipe-distance`, CSS pixels. */
export function swipeDistanceOf(element: Element): number {
  return numberIn(element, "swipe-distance", 0, Number.MAX_VALUE) ?? 0;
}

/** Returns an attribute's number; undefined if it is missing, empty, or not between the two. */
function numberIn(element: Element, name: string, least: number, most: number): number | undefined {
  const number = Number(element.getAttribute(name)?.trim() || Number.NaN);
  return number >= least && number <= most ? number : undefined;
}

/**
 * Applies properties that were set before the element was defined: they lie on
 * the element and hide the accessors.
 */
export function adopt(element: HTMLElement): void {
  for (const name of Object.keys(element)) {
    if (!(name in Object.getPrototypeOf(element))) continue;
    const value: unknown = Reflect.get(element, name);
    Reflect.deleteProperty(element, name);
    Reflect.set(element, name, value);
  }
}
