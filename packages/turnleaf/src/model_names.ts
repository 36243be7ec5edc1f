/**
 * The engine's models of turning, each at its number in files less 1: as
 * `ModelKind::ALL` of engine/src/models/kind.rs lists them.
 */
export const models = [
  "mass-spring",
  "sheet",
  "shell",
  "rigid",
  "peel",
  "cylinder",
  "cone",
] as const;

/** The name of a model of the engine. */
export type Model = (typeof models)[number];
