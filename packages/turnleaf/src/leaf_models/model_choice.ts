/** The choice of a model of turning. */

import { type Model, models } from "../model_names.ts";

/** The name of a model of turning: one of the engine's, or a turn that was recorded. */
export type TurnModelName = Model | "replay" | "photographs";

/** All of them. */
export const turnModels: readonly TurnModelName[] = [...models, "replay", "photographs"];

/** One of them, or the unknown name that was given in place of one. */
export interface ModelChoice {
  readonly model: string;
  /** Address of its data, if it needs any: a recorded turn, or photographs of one. */
  readonly modelSrc: string;
}
