/** The settings of the page, and the link that carries them. */

import { standardGravity } from "turnleaf/models";
import { readCreases } from "./creases.ts";
import { type LeafFigures, ownNodes, type Variant, variantNames } from "./variants.ts";

/** A complete set of settings. */
export interface Settings extends LeafFigures {
  /** The model of the leaf on the left of the page, and of the one on the right. */
  readonly left: Variant;
  readonly right: Variant;
  /** Length of a played turn, seconds. */
  readonly seconds: number;
  /** How fast time passes. */
  readonly pace: number;
  /** The visible parts of the overlay. */
  readonly masses: boolean;
  readonly springs: boolean;
  readonly lines: boolean;
  readonly strain: boolean;
  /** The creases of sheets, as `writeCreases` returns them. */
  readonly creases: string;
}

/** The valid values of a setting. */
type Bounds<T> = [T] extends [boolean]
  ? { readonly kind: "switch" }
  : [T] extends [number]
    ?
        | {
            readonly kind: "range";
            readonly least: number;
            readonly most: number;
            readonly by: number;
          }
        | { readonly kind: "numbers"; readonly of: readonly number[] }
    : string extends T
      ? { readonly kind: "creases" }
      : { readonly kind: "names"; readonly of: readonly T[] };

const onOrOff = { kind: "switch" } as const;
const range = (least: number, most: number, by: number) =>
  ({ kind: "range", least, most, by }) as const;

/** The valid values of each setting. */
export const bounds: { readonly [Name in keyof Settings]: Bounds<Settings[Name]> } = {
  left: { kind: "names", of: variantNames },
  right: { kind: "names", of: variantNames },
  grammage: range(20, 400, 5),
  caliper: range(30, 500, 1),
  stiffness: range(0.005, 10, 0.001),
  gravity: range(0, 25, 0.05),
  air: range(0, 5, 0.05),
  angle: range(0, 90, 1),
  nodes: range(ownNodes, 12, 1),
  steps: { kind: "numbers", of: [0, 60, 120, 180, 240, 480, 960] },
  seconds: range(0.3, 6, 0.1),
  pace: { kind: "numbers", of: [1, 0.25, 0.1] },
  masses: onOrOff,
  springs: onOrOff,
  lines: onOrOff,
  strain: onOrOff,
  creases: { kind: "creases" },
};

/** Standard gravity to a tenth, a place of its slider. */
const gravity = Number(standardGravity.toFixed(1));

/** The defaults. */
export const firstSettings: Settings = {
  left: "springs-both",
  right: "sheet",
  grammage: 70,
  caliper: 90,
  stiffness: 0.12,
  gravity,
  air: 1,
  angle: 0,
  nodes: ownNodes,
  steps: 0,
  seconds: 1.2,
  pace: 1,
  masses: false,
  springs: false,
  lines: false,
  strain: false,
  creases: "",
};

const names = Object.keys(firstSettings) as (keyof Settings)[];

/** Maximum length: no link of the page's own is longer. */
const longest = 600;

/**
 * Returns the part of a link that carries settings: those that differ from the
 * defaults, without "#".
 */
export function writeLink(settings: Settings): string {
  const link = new URLSearchParams();
  for (const name of names) {
    const value = settings[name];
    if (value !== firstSettings[name]) link.set(name, value === true ? "yes" : String(value));
  }
  return link.toString();
}

/**
 * An error in a link: the setting with an invalid value, or null if it is not a
 * link of this page.
 */
export class BadLink extends Error {
  readonly setting: keyof Settings | null;

  constructor(setting: keyof Settings | null) {
    super(setting === null ? "not a link of this page" : `${setting} is out of bounds`);
    this.setting = setting;
  }
}

/**
 * Reads the settings of a link.
 *
 * @param link with or without "#"; empty for the defaults
 * @throws BadLink if any part of it is not a setting within its bounds: then
 * none of it is used
 */
export function readLink(link: string): Settings {
  if (link.length > longest) throw new BadLink(null);
  const settings: Record<string, unknown> = { ...firstSettings };
  const found = new Set<string>();
  for (const [name, text] of new URLSearchParams(link.replace(/^#/, ""))) {
    const known = names.find((own) => own === name);
    if (known === undefined || found.has(name)) throw new BadLink(null);
    found.add(name);
    const value = readValue(known, text);
    if (value === undefined) throw new BadLink(known);
    settings[known] = value;
  }
  return settings as unknown as Settings;
}

function readValue(name: keyof Settings, text: string): unknown {
  const bound: Bounds<string> | Bounds<Variant> | Bounds<number> | Bounds<boolean> = bounds[name];
  if (bound.kind === "switch") return text === "yes" ? true : undefined;
  if (bound.kind === "creases") return text !== "" && readCreases(text) ? text : undefined;
  if (bound.kind === "names") return bound.of.find((known) => known === text);
  if (!/^\d{1,4}(\.\d{1,4})?$/.test(text)) return undefined;
  const number = Number(text);
  if (bound.kind === "numbers") return bound.of.find((known) => known === number);
  return number >= bound.least && number <= bound.most ? number : undefined;
}
