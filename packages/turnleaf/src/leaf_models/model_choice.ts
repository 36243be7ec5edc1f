/** The choice of a model of turning. */

/** The models: the engine's own first. */
export const turnModels = [
  "sheet",
  "rigid",
  "peel",
  "cylinder",
  "cone",
  "mass-spring",
  "shell",
  "replay",
  "photographs",
] as const;

/** The name of a model of turning. */
export type TurnModelName = (typeof turnModels)[number];

/** One of them, or the unknown name that was given in place of one. */
export interface ModelChoice {
  readonly model: string;
  /** Address of its data, if it needs any: a recorded turn, or photographs of one. */
  readonly modelSrc: string;
}
