/**
 * Turnleaf: a book whose pages turn as paper turns.
 *
 * Importing this module defines `<turnleaf-book>`, once, if there is a DOM; on
 * a server it does nothing.
 */

import { TurnleafBook } from "./element.ts";

export type { Theme } from "./attributes.ts";
export type { Corner, DogEar } from "./book/dog_ears.ts";
export type { PageFold, PagePlace } from "./book/page_folds.ts";
export type { Paper } from "./book/paper.ts";
export type { CoverKind, Edge, Layout } from "./book/spreads.ts";
export type { BookState } from "./book/turning.ts";
export type {
  FailureDetail,
  TurnDetail,
  TurnleafEventMap,
  WarningDetail,
} from "./element/events.ts";
export type { RecordOptions } from "./element/film_recorder.ts";
export type { PrintOptions } from "./element/printing.ts";
export type { SearchOptions } from "./element/reader_element.ts";
export type { TurnOptions } from "./element/turning_element.ts";
export { TurnleafBook } from "./element.ts";
export type { Stock, StockFigures, Vec3 } from "./engine/shapes.ts";
export type { TurnModelName } from "./leaf_models/model_choice.ts";
export type { Bytes } from "./sources/input_values.ts";
export type { Manifest, ManifestImage, ManifestPage } from "./sources/manifest.ts";
export type { ManifestLink, ManifestOutline, ManifestText } from "./sources/manifest_text.ts";
export type { BookInput, OpenOptions } from "./sources/open.ts";
export { openSource } from "./sources/open_source.ts";
export {
  type BookDetail,
  BookError,
  type BookErrorCode,
  type BookErrorDetail,
  type BookWarning,
  type BookWarningCode,
  type LinkTarget,
  type NarratedClip,
  type Narration,
  type NewIndex,
  type OutlineEntry,
  type PageBox,
  type PageColours,
  type PageField,
  type PageLink,
  type PageMedium,
  type PagePicture,
  type PageSize,
  type PageSource,
  type TextPage,
  type TextRun,
  type TitleFont,
  type Typography,
} from "./sources/page_source.ts";
export type { SearchHit } from "./text/searching.ts";
export { addLanguage } from "./words/languages.ts";
export type {
  ControlTexts,
  ElementTexts,
  ErrorTexts,
  Plural,
  Texts,
  WarningTexts,
} from "./words/texts.ts";

if (globalThis.customElements && !customElements.get("turnleaf-book")) {
  customElements.define("turnleaf-book", TurnleafBook);
}

declare global {
  interface HTMLElementTagNameMap {
    "turnleaf-book": TurnleafBook;
  }
}
