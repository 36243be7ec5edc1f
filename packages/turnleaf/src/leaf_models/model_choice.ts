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

/** One of them, or what was named in place of one. */
export interface ModelChoice {
  readonly model: string;
  /** Address of what it shows, where it shows something: a recorded turn, or photographs of one. */
  readonly modelSrc: string;
}
