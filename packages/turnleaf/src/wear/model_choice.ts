/** Which way pages are turned, where somebody chose one. */

/** The ways: the engine's own first. */
export const turnModels = ["sheet", "rigid", "peel", "cylinder", "cone", "mass-spring"] as const;

/** A way of turning a page. */
export type TurnModelName = (typeof turnModels)[number];

/** One of them. */
export interface ModelChoice {
  readonly model: TurnModelName;
}
