/** The attributes that say how leaves turn: `model`, `recording`, `photographs`. */

import { type ModelChoice, type TurnModelName, turnModels } from "../wear/model_choice.ts";

/** Addresses of pictures, at most. */
const mostPhotographs = 240;

/** `model`: a way of turning; "sheet" where the attribute names none. */
export function turnModelOf(element: Element): TurnModelName {
  const name = element.getAttribute("model");
  return turnModels.find((known) => known === name) ?? turnModels[0];
}

/** `photographs`: the addresses that the attribute lists. */
export function photographsOf(element: Element): readonly string[] {
  const list = element.getAttribute("photographs") ?? "";
  return list
    .split(/\s+/)
    .filter((address) => address !== "")
    .slice(0, mostPhotographs);
}

/** What the attributes choose. */
export function modelChoiceOf(element: Element): ModelChoice {
  const recording = element.getAttribute("recording") ?? "";
  return { model: turnModelOf(element), recording, photographs: photographsOf(element) };
}
