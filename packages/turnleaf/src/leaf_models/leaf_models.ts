/** Models of a book's leaves other than the engine's sheet. Loaded on first use. */

import { cleanText } from "../sources/book_text.ts";
import { loadPart } from "../sources/load_part.ts";
import { BookError } from "../sources/page_source.ts";
import type { LeafModel } from "./leaf_model.ts";
import { type ModelChoice, turnModels } from "./model_choice.ts";

/**
 * Opens the model of a choice: null for the sheet, which needs none. Rejects
 * with a `BookError` if it cannot be loaded, or if there is none of the name;
 * the signal aborts its requests.
 */
export async function openModel(
  { model, modelSrc }: ModelChoice,
  signal: AbortSignal,
): Promise<LeafModel | null> {
  const name = turnModels.find((known) => known === model);
  if (name === undefined) {
    const known = turnModels.join(", ");
    const said = cleanText(model, 40);
    throw new BookError(`No way of turning a page is named "${said}"; there are ${known}.`, {
      code: "misused",
    });
  }
  if (name === "sheet") return null;
  if (name === "photographs") {
    const { PhotographsModel } = await loadPart(import("./photographs.ts"));
    return await PhotographsModel.open(modelSrc, signal);
  }
  // The shell is too slow to be simulated here.
  if (name === "replay" || name === "shell") {
    const { ReplayModel } = await loadPart(import("./replay.ts"));
    if (name === "replay" && modelSrc) return await ReplayModel.at(modelSrc);
    return await ReplayModel.ofOwn(name === "replay" ? "sheet" : "shell");
  }
  const { LooseModel } = await loadPart(import("./loose_leaf.ts"));
  return await LooseModel.open(name);
}
