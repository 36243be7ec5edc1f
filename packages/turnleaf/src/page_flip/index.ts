/**
 * A drop-in for page-flip 2.0.7: `new PageFlip(host, options)`. Importing this
 * module defines `<turnleaf-book>`, which shows the book.
 */

import "../index.ts";

export type { Orientation, PageRect } from "./book_place.ts";
export type { WidgetEvent } from "./event_listeners.ts";
export {
  type BookMode,
  type FlipCorner,
  type FlipEvents,
  type FlippingState,
  PageFlip,
} from "./page_flip.ts";
export type { FlipSetting } from "./settings.ts";
