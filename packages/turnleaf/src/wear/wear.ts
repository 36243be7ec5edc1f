/** Models of a book's leaves beside the engine's own sheet. Loaded where one is asked for. */

import type { LeafModel } from "./leaf_model.ts";
import { LooseModel, looseModels } from "./loose.ts";
import type { ModelChoice } from "./model_choice.ts";

/** Makes the model of a choice. Rejects with one sentence where it cannot be had. */
export async function openModel(choice: ModelChoice): Promise<LeafModel | null> {
  const loose = looseModels.find((known) => known === choice.model);
  return loose ? await LooseModel.open(loose) : null;
}
