/** The models that can be compared, and the leaf for the settings of one. */

import { type LeafOptions, type Model, models } from "turnleaf/models";

/** Metres: an A5 page. */
export const leafSize = { width: 0.148, height: 0.21 } as const;

type Own = Pick<LeafOptions, "model" | "preset" | "interpolate" | "discretisation"> & {
  /** Whether the dog-ear line's angle has an effect. */
  readonly isSynchronised?: boolean;
  /** Whether it replays a recording of such a leaf. */
  readonly isReplayed?: boolean;
};

const springs = { model: "mass-spring", preset: "book" } as const;

/** The options of those that are not a model as it comes, or that have a place of their own in the list. */
const chosen = {
  "paper-2014": {
    model: "mass-spring",
    preset: "paper-2014",
    isSynchronised: true,
    interpolate: true,
  },
  springs,
  "springs-synchronised": { ...springs, isSynchronised: true },
  "springs-interpolated": { ...springs, interpolate: true },
  "springs-both": { ...springs, isSynchronised: true, interpolate: true },
  sheet: { model: "sheet" },
  replay: { model: "sheet", isReplayed: true },
  "sheet-synchronised": { model: "sheet", isSynchronised: true },
  shell: { model: "shell" },
  "shell-triangles": { model: "shell", discretisation: "triangles" },
} as const satisfies Record<string, Own>;

/** The name of one in links. */
export type Variant = keyof typeof chosen | Exclude<Model, "mass-spring">;

/** Springs are there in five ways already. */
const others = models.filter((model) => model !== "mass-spring");

/** The options of each. */
const variants = {
  ...chosen,
  ...Object.fromEntries(others.map((model) => [model, { model }])),
} as Readonly<Record<Variant, Own>>;

/** All of them, in the order in which they are offered. */
export const variantNames = Object.keys(variants) as Variant[];

/** Returns whether a variant has springs, not only nodes. */
export const hasSprings = (variant: Variant): boolean => variants[variant].model === "mass-spring";

/** Returns whether a variant replays a recording rather than a live leaf. */
export const isReplayed = (variant: Variant): boolean => variants[variant].isReplayed ?? false;

/** Returns whether a variant can be creased: the live sheet, its lines not kept parallel. */
export function isCreasable(variant: Variant): boolean {
  const { model, isSynchronised, isReplayed } = variants[variant];
  return model === "sheet" && !isSynchronised && !isReplayed;
}

/** The drawn points: enough to bend smoothly, and light is computed at every fourth column. */
const points = [25, 33] as const;

/** Default columns and rows of the shell: its own grid takes minutes for a turn. */
const shellNodes = [10, 14] as const;

/** The settings of the page that make a leaf. */
export interface LeafFigures {
  /** g/m². */
  readonly grammage: number;
  /** µm. */
  readonly caliper: number;
  /** Bending stiffness across the grain, mN m. */
  readonly stiffness: number;
  /** m/s². */
  readonly gravity: number;
  /** Density relative to real air. */
  readonly air: number;
  /** The dog-ear line's angle with the spine, degrees. */
  readonly angle: number;
  /** Columns of nodes; the minimum stands for each model's own number. */
  readonly nodes: number;
  /** Steps per second; 0 for each model's own. */
  readonly steps: number;
}

/** Returns the options of the leaf that a variant and the settings make. */
export function leafOptions(variant: Variant, settings: LeafFigures): LeafOptions {
  const { isSynchronised, isReplayed: _, ...own } = variants[variant];
  const { nodes, steps, stiffness } = settings;
  const usual = own.model === "shell" ? shellNodes : undefined;
  return {
    ...leafSize,
    ...own,
    points,
    stock: {
      grammage: settings.grammage / 1e3,
      caliper: settings.caliper / 1e6,
      stiffnessAlong: (grainRatio * stiffness) / 1e3,
      stiffnessAcross: stiffness / 1e3,
    },
    gravity: settings.gravity,
    air: settings.air,
    nodes: nodes > ownNodes ? [nodes, rowsOf(nodes)] : usual,
    timeStep: steps > 0 ? 1 / steps : undefined,
    synchronise: isSynchronised ? (settings.angle * Math.PI) / 180 : "off",
  };
}

/** How much stiffer the presets' paper is along its grain than across. */
const grainRatio = 2.25;

/** Fewer columns than any choice: the model's own number. */
export const ownNodes = 3;

/**
 * Returns the rows for so many columns, nearly equally spaced; the models of
 * springs allow no more.
 */
export const rowsOf = (columns: number): number => Math.min(16, Math.round(1.4 * columns));
