/** Which way pages are turned, where somebody chose one. */

/** The ways: the engine's own first. */
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

/** A way of turning a page. */
export type TurnModelName = (typeof turnModels)[number];

/** One of them, and what it needs. */
export interface ModelChoice {
  readonly model: TurnModelName;
  /** Of `replay`: the file of a recorded turn, or its address. */
  readonly recording?: string | Uint8Array;
  /** Of `photographs`: addresses of pictures of a turn, from the right page lying to the left one. */
  readonly photographs?: readonly string[];
}
