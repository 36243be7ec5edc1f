/** The attributes of `<turnleaf-book>`: what each says, and what a change of it asks for. */

import { isStock, type Paper } from "../book/paper.ts";
import type { Stock } from "../engine/shapes.ts";
import { bindingAttributes } from "./binding_options.ts";

/** What a change of an attribute can ask of the element. */
export interface AttributeEffects {
  /** Another book: it opens at its beginning. */
  open(): void;
  /** The same book, bound anew, where it lay. */
  rebind(): void;
  /** The attribute of the page has another value: the book turns there if it is a number. */
  setPage(value: string | null): void;
  /** The leaves are made of another paper. */
  changePaper(): void;
  /** The leaves turn in another way. */
  changeModel(): void;
  /** Turns take another time. */
  changePace(): void;
  /** The place is kept from now on, or no more. */
  keepPlace(): void;
  /** The controls come or go. */
  furnish(): void;
  /** The book falls silent, until a leaf moves that is to be heard. */
  hush(): void;
}

/** Every attribute that is answered when it changes, and how. */
export const attributes: Readonly<
  Record<string, (effects: AttributeEffects, value: string | null) => void>
> = {
  src: (effects) => effects.open(),
  page: (effects, value) => effects.setPage(value),
  ...Object.fromEntries(
    bindingAttributes.map((name) => [name, (to: AttributeEffects) => to.rebind()]),
  ),
  duration: (effects) => effects.changePace(),
  stock: (effects) => effects.changePaper(),
  assist: (effects) => effects.changePaper(),
  model: (effects) => effects.changeModel(),
  "model-src": (effects) => effects.changeModel(),
  address: (effects) => effects.keepPlace(),
  remember: (effects) => effects.keepPlace(),
  controls: (effects) => effects.furnish(),
  sound: (effects) => effects.hush(),
};

/** `stock`: a preset; "book" where the attribute names none. */
export function stockOf(element: Element): Stock {
  const stock = element.getAttribute("stock");
  return isStock(stock) ? stock : "book";
}

/** The paper that the attributes name. */
export function paperOf(element: Element): Paper {
  return { stock: stockOf(element), assist: element.getAttribute("assist") !== "off" };
}

/**
 * `duration`: length of a turn in seconds, 0 for no motion at all; 0.8 if the attribute is missing,
 * empty, or no number from 0 to a minute.
 */
export function turnSecondsOf(element: Element): number {
  const milliseconds = Number(element.getAttribute("duration")?.trim() || 800);
  return milliseconds >= 0 && milliseconds <= 60_000 ? milliseconds / 1000 : 0.8;
}

/** Takes over what was set before the element was defined: it lies on the element and hides the accessors. */
export function adopt(element: HTMLElement): void {
  for (const name of Object.keys(element)) {
    if (!(name in Object.getPrototypeOf(element))) continue;
    const value: unknown = Reflect.get(element, name);
    Reflect.deleteProperty(element, name);
    Reflect.set(element, name, value);
  }
}
