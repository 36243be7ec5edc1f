/** The attributes that say how leaves turn: `model` and `model-src`. */

import type { ModelChoice } from "../wear/model_choice.ts";

/** What they choose: the sheet where nothing else is named. */
export function modelChoiceOf(element: Element): ModelChoice {
  return {
    model: element.getAttribute("model") || "sheet",
    src: element.getAttribute("model-src") ?? "",
  };
}
