/** The tab in which the reader chooses how flowing text is set: a sample of it, and a row for each choice. */

import { typographyAttributes } from "../element/typography.ts";
import type { Typography } from "../sources/page_source.ts";
import { stackOf, typefaceNames } from "../sources/typeset/typefaces/typefaces.ts";
import { fill } from "../words/languages.ts";
import type { ControlledBook } from "./book.ts";
import { type Choice, type ChoiceRow, choiceOf, type ScaleTexts, scaleOf } from "./choices.ts";
import { make } from "./make.ts";
import type { PanelTab } from "./panel.ts";
import { ThemeRow } from "./theme_row.ts";
import { showTypeface, TypeSample } from "./type_sample.ts";
import type { Wording } from "./wording.ts";

/** The sizes of type that are chosen step by step, as factors of the book's own: each about a seventh more. */
const sizes = [0.7, 0.8, 0.9, 1, 1.15, 1.3, 1.5, 1.75, 2, 2.3, 2.6, 3];

/** Sets the type one step larger (1) or smaller (-1). */
export type StepType = (by: 1 | -1) => void;

/** One choice a row; each is an attribute of the element. */
export class TypeTab implements PanelTab {
  readonly element: HTMLElement = make("div", { class: "view typeset" });
  /** Sets the type one step larger or smaller. */
  readonly stepSize: StepType;
  readonly #sample: TypeSample;
  readonly #themes: ThemeRow;
  readonly #rows: readonly ChoiceRow[];

  constructor(book: ControlledBook, wording: Wording) {
    const { texts, number } = wording;
    const scale = (label: string): ScaleTexts => ({
      label,
      less: fill(texts.lessOf, { name: label }),
      more: fill(texts.moreOf, { name: label }),
    });
    const own: Choice = ["", texts.booksOwn];
    const steps = (values: readonly number[]): Choice[] =>
      values.map((value) => [String(value), number(value)]);
    const percents = (values: readonly number[], usual: number): Choice[] =>
      values.map((value) => [
        value === usual ? "" : String(value),
        `${number(Math.round(100 * value))} %`,
      ]);
    const size = scaleOf(
      book,
      "font-size",
      { label: texts.typeSize, less: texts.smallerType, more: texts.largerType },
      percents(sizes, 1),
      ["A", "A"],
    );
    size.element.classList.add("sizes");
    this.stepSize = size.step;
    const face = choiceOf(
      book,
      "font",
      texts.typeface,
      [
        own,
        ["serif", texts.serif],
        ["sans-serif", texts.sansSerif],
        ["legible", "Atkinson"],
        ["dyslexic", "OpenDyslexic"],
      ],
      (button, value) => {
        const letters = make("b", { "aria-hidden": "true" }, "Aa");
        letters.style.fontFamily = stackOf(value as Typography["font"]);
        button.prepend(letters);
      },
    );
    face.element.classList.add("faces");
    this.#rows = [
      size,
      face,
      scaleOf(book, "line-height", scale(texts.lineHeight), [
        own,
        ...steps([1.2, 1.3, 1.4, 1.5, 1.6, 1.8, 2]),
      ]),
      scaleOf(book, "margins", scale(texts.margins), percents([0.25, 0.5, 0.75, 1, 1.25, 1.5], 1)),
      choiceOf(book, "text-align", texts.alignment, [
        own,
        ["justify", texts.justified],
        ["start", texts.ragged],
      ]),
      choiceOf(book, "hyphens", texts.hyphens, [own, ["auto", texts.on], ["none", texts.off]]),
      scaleOf(book, "letter-spacing", scale(texts.letterSpacing), [
        own,
        ...steps([0.02, 0.05, 0.08, 0.12, 0.16]),
      ]),
      scaleOf(book, "word-spacing", scale(texts.wordSpacing), [
        own,
        ...steps([0.05, 0.1, 0.2, 0.3, 0.5]),
      ]),
    ];
    this.#sample = new TypeSample(texts.typeSample, book);
    const reset = make("button", { type: "button", class: "plain" }, texts.asInBook);
    reset.addEventListener("click", () => {
      for (const name of typographyAttributes) book.removeAttribute(name);
    });
    this.#themes = new ThemeRow(book, wording, "radio");
    this.element.append(
      this.#sample.element,
      ...this.#rows.map(({ element }) => element),
      this.#themes.element,
      reset,
    );
  }

  show(): void {
    for (const name of typefaceNames) showTypeface(name);
    this.refresh();
  }

  hide(): void {}

  refresh(): void {
    for (const row of this.#rows) row.refresh();
    this.#sample.refresh();
    this.#themes.refresh();
  }

  focus(): void {
    this.element.querySelector("button")?.focus({ preventScroll: true });
  }
}
