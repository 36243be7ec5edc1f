/** Folds pages along lines that a caller names. Loaded when the first is folded so. */

import { meetsSpine, type PageFold } from "../book/page_folds.ts";
import { spineOf } from "../book/spreads.ts";
import { BookError } from "../sources/page_source.ts";
import type { Viewer } from "../viewer/viewer.ts";
import { cleanFolds } from "./fold_lists.ts";
import type { PageLists } from "./page_lists.ts";

/** Why a page is not folded. */
const noFold =
  "A fold needs a page, two places on it (x and y from 0 to 1) and an angle from -180 to 180 degrees.";
const atSpine = "A page cannot be folded along a line that meets its spine.";
const tooNear = "This line is too near to other folds of the page, or to its edges.";

/**
 * Folds a page of the open book, whose folds and corners are as lists say. Resolves to the folds
 * that there are then; to null if the page is none that folds. Rejects with a `BookError` if it is
 * not folded along that line.
 */
export async function foldAlong(
  asked: PageFold,
  viewer: Viewer,
  { folds: before, dogEars }: PageLists,
): Promise<readonly PageFold[] | null> {
  if (asked.page > viewer.binding.pageCount) return null;
  const [fold] = cleanFolds([{ ...asked, angle: asked.angle === 0 ? 1 : asked.angle }]);
  if (fold === undefined) throw new BookError(noFold, { code: "misused" });
  const spine = spineOf(viewer.binding, fold.page);
  if (spine === "board") return null;
  if (meetsSpine(fold, spine)) throw new BookError(atSpine, { code: "misused" });
  const folds = cleanFolds([...before, { ...fold, angle: asked.angle }]);
  const found = await viewer.sheets.fold([...dogEars, ...folds], true);
  if (!found) return null;
  if (!folds.every((one) => found.includes(one))) throw new BookError(tooNear, { code: "misused" });
  return folds;
}
