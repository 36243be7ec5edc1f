/** What the attributes of `<turnleaf-book>` say to its viewer: how the book is bound, its paper, its gestures. */

import { attributeOf } from "../attributes.ts";
import type { Paper } from "../book/paper.ts";
import type { Gesture } from "../input/target.ts";
import { metresIn } from "../metres.ts";
import type { BindingOptions } from "../viewer/bound_book.ts";
import { pageThemeOf } from "./page_theme.ts";

/** Returns the options of the binding. */
export function bindingOptionsOf(element: Element): Omit<BindingOptions, "shifts"> {
  return {
    cover: attributeOf(element, "cover"),
    cloth: attributeOf(element, "cloth"),
    theme: pageThemeOf(element),
    shadows: attributeOf(element, "shadows"),
    camera: attributeOf(element, "camera"),
    tilt: attributeOf(element, "tilt"),
    margin: attributeOf(element, "margin"),
    binding: attributeOf(element, "binding"),
    layout: attributeOf(element, "layout"),
    offset: attributeOf(element, "offset"),
    hardPages: attributeOf(element, "hardPages"),
    stocks: attributeOf(element, "stocks"),
  };
}

/** Returns the paper that the attributes name. */
export function paperOf(element: Element): Paper {
  const pageWidth = metresIn(attributeOf(element, "pageWidth"));
  return {
    stock: attributeOf(element, "stock"),
    assist: attributeOf(element, "assist"),
    ...(pageWidth === undefined ? {} : { pageWidth }),
  };
}

/** Returns the length of a turn, in seconds: 0 for no motion at all. */
export function turnSecondsOf(element: Element): number {
  return attributeOf(element, "duration") / 1000;
}

/** Returns whether a gesture of the reader's acts on the book: all do where none is named. */
export function allowsGesture(element: Element, gesture: Gesture): boolean {
  const list = attributeOf(element, "gestures").trim();
  return list === "" || list.split(/\s+/).includes(gesture);
}
