/** The attribute that says how leaves turn: `model`. */

import { type ModelChoice, turnModels } from "../wear/model_choice.ts";

/** What it chooses: the sheet where it names nothing else. */
export function modelChoiceOf(element: Element): ModelChoice {
  const name = element.getAttribute("model");
  return { model: turnModels.find((known) => known === name) ?? turnModels[0] };
}
