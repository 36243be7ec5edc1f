/** What is done in a film besides turning page after page: the actions of `--do`. */

import { printable, UsageProblem } from "../problem.ts";

/** A place on a page: fractions of its width and height from its upper left corner. */
export interface ActionPlace {
  readonly x: number;
  readonly y: number;
}

/** A straight fold: two places on its line, and its rest angle in degrees; undefined for the usual one. */
export interface ActionFold {
  readonly from: ActionPlace;
  readonly to: ActionPlace;
  readonly angle: number | undefined;
}

/**
 * One action, named after the method of `<turnleaf-book>` that does it. Pages are counted from 1;
 * undefined is the first visible one.
 */
export type FilmAction = {
  /** The action as it was written, for messages. */
  readonly text: string;
} & (
  | { readonly name: "next" }
  | { readonly name: "previous" }
  | { readonly name: "fold-in" }
  | { readonly name: "crumple" }
  | { readonly name: "put-back" }
  | { readonly name: "go-to"; readonly page: number }
  | { readonly name: "unfold"; readonly page: number }
  | { readonly name: "tear-out"; readonly page: number | undefined }
  | {
      readonly name: "dog-ear";
      readonly page: number | undefined;
      readonly corner: "head" | "foot" | undefined;
      readonly size: number | undefined;
    }
  | { readonly name: "fold"; readonly page: number; readonly fold: ActionFold | "letter" }
  | { readonly name: "tear-across"; readonly from: ActionPlace; readonly to: ActionPlace }
  | { readonly name: "wait"; readonly seconds: number }
);

/** Maximum number of actions of a film: as many as a book has folds and bookmarks. */
export const mostActions = 500;

/** Bounds of a wait, seconds, as of `--pause`. */
const longestWait = 60;

/** Each action as it is written. */
const usages: Readonly<Record<FilmAction["name"], string>> = {
  next: "next",
  previous: "previous",
  "go-to": "go-to PAGE",
  "dog-ear": "dog-ear [PAGE] [head|foot] [SIZE]",
  fold: "fold PAGE X,Y X,Y [ANGLE] (or fold PAGE letter)",
  unfold: "unfold PAGE",
  "fold-in": "fold-in",
  "tear-out": "tear-out [PAGE]",
  "tear-across": "tear-across X,Y X,Y",
  crumple: "crumple",
  "put-back": "put-back",
  wait: "wait SECONDS",
};

/** Takes the next argument if it has a form, and returns what it means; undefined if it has not. */
type Take = <Value>(parse: (word: string) => Value | undefined) => Value | undefined;

/** The arguments of each action; null if one that it needs is missing. */
const parsers: {
  readonly [Name in FilmAction["name"]]: (
    take: Take,
  ) => Omit<Extract<FilmAction, { name: Name }>, "name" | "text"> | null;
} = {
  next: () => ({}),
  previous: () => ({}),
  "go-to": (take) => needed({ page: take(pageOf) }),
  "dog-ear": (take) => ({ page: take(pageOf), corner: take(cornerOf), size: take(sizeOf) }),
  fold: (take) => {
    const page = take(pageOf);
    const fold = take((word) => (word === "letter" ? "letter" : undefined)) ?? lineOf(take);
    return needed({ page, fold });
  },
  unfold: (take) => needed({ page: take(pageOf) }),
  "fold-in": () => ({}),
  "tear-out": (take) => ({ page: take(pageOf) }),
  "tear-across": (take) => needed({ from: take(placeOf), to: take(placeOf) }),
  crumple: () => ({}),
  "put-back": () => ({}),
  wait: (take) => needed({ seconds: take(numberFrom(0, longestWait)) }),
};

/**
 * Parses the actions of a film: lists such as "dog-ear 8, next", one after the other. They are
 * separated by commas or semicolons; a comma between two digits belongs to a place such as 0.5,1.
 *
 * @throws UsageProblem that names the part that is not understood, and what is possible
 */
export function parseActions(lists: readonly string[]): FilmAction[] {
  const texts = lists
    .flatMap((list) => list.split(/;|(?<!\d),|,(?![\d.])/))
    .map((text) => text.trim().replace(/\s+/g, " "))
    .filter((text) => text !== "");
  if (texts.length === 0) {
    throw new UsageProblem(`--do is a list of actions: ${possible()}.`);
  }
  if (texts.length > mostActions) {
    throw new UsageProblem(`--do takes at most ${mostActions} actions; these are ${texts.length}.`);
  }
  return texts.map(parseAction);
}

function parseAction(text: string): FilmAction {
  const [name = "", ...words] = text.split(" ");
  if (!isAction(name)) {
    throw new UsageProblem(
      `"${printable(name)}" in --do was not understood; an action is ${possible()}.`,
    );
  }
  const rest = [...words];
  const take: Take = (parse) => {
    const value = rest[0] === undefined ? undefined : parse(rest[0]);
    if (value !== undefined) rest.shift();
    return value;
  };
  const found = parsers[name](take);
  if (found === null || rest.length > 0) {
    const [first] = rest;
    const part =
      first === undefined
        ? `"${printable(text)}" in --do is not complete`
        : `"${printable(first)}" in "${printable(text)}" was not understood`;
    throw new UsageProblem(`${part}; it is written ${usages[name]}${bounds(name)}.`);
  }
  return { text: printable(text), name, ...found } as FilmAction;
}

function isAction(name: string): name is FilmAction["name"] {
  return Object.hasOwn(usages, name);
}

/** Returns every action as a list in words. */
function possible(): string {
  const all = Object.values(usages);
  return `${all.slice(0, -1).join(", ")} or ${all.at(-1)}`;
}

/** Returns what the arguments of an action are, as part of a sentence. */
function bounds(name: FilmAction["name"]): string {
  if (name === "dog-ear") return ", its size 0.05 to 0.5";
  if (name === "fold") return ", places 0 to 1 and the angle -180 to 180";
  if (name === "tear-across") return ", places 0 to 1";
  return name === "wait" ? `, 0 to ${longestWait}` : "";
}

/** Returns the arguments, or null if one is missing. */
function needed<Found extends object>(
  found: Found,
): { [Key in keyof Found]: Exclude<Found[Key], undefined> } | null {
  const isWhole = Object.values(found).every((value) => value !== undefined);
  return isWhole ? (found as { [Key in keyof Found]: Exclude<Found[Key], undefined> }) : null;
}

/** Takes a fold along a line. */
function lineOf(take: Take): ActionFold | undefined {
  const [from, to] = [take(placeOf), take(placeOf)];
  if (!from || !to) return undefined;
  if (from.x === to.x && from.y === to.y) {
    throw new UsageProblem("A fold in --do goes through two places that are not the same.");
  }
  return { from, to, angle: take(numberFrom(-180, 180)) };
}

function pageOf(word: string): number | undefined {
  return /^\d{1,6}$/.test(word) && Number(word) > 0 ? Number(word) : undefined;
}

function cornerOf(word: string): "head" | "foot" | undefined {
  return word === "head" || word === "foot" ? word : undefined;
}

function sizeOf(word: string): number | undefined {
  return numberFrom(0.05, 0.5)(word);
}

function placeOf(word: string): ActionPlace | undefined {
  const [x, y, ...more] = word.split(",").map(numberFrom(0, 1));
  return x === undefined || y === undefined || more.length > 0 ? undefined : { x, y };
}

/** Returns what parses a number between bounds. */
function numberFrom(least: number, most: number): (word: string) => number | undefined {
  return (word) => {
    const number = Number(word);
    const isNumber = /^-?(\d+(\.\d*)?|\.\d+)$/.test(word);
    return isNumber && number >= least && number <= most ? number : undefined;
  };
}
