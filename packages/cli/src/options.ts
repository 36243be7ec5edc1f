/** Parses options common to several commands. Each wrong value fails in one sentence. */

import { parseArgs } from "node:util";
import { UsageProblem } from "./problem.ts";

/** A command line, parsed. */
export interface ParsedOptions {
  readonly values: Readonly<Record<string, string | undefined>>;
  /** The values of options that may be given several times, in their order. */
  readonly lists: Readonly<Record<string, readonly string[]>>;
  /** The flags that are set. */
  readonly flags: ReadonlySet<string>;
  readonly positionals: readonly string[];
}

/**
 * Parses options that take a value, each at most once but for those of `lists`, flags, and the
 * arguments between them.
 *
 * @throws UsageProblem
 */
export function parseOptions(
  args: readonly string[],
  names: readonly string[],
  flags: readonly string[] = [],
  lists: readonly string[] = [],
): ParsedOptions {
  const options = Object.fromEntries([
    ...names.map((name) => [name, { type: "string" as const }]),
    ...lists.map((name) => [name, { type: "string" as const, multiple: true }]),
    ...flags.map((name) => [name, { type: "boolean" as const }]),
  ]);
  try {
    const { values, positionals } = parseArgs({ args: [...args], allowPositionals: true, options });
    const found = values as Record<string, string | string[] | boolean | undefined>;
    return {
      values: found as Record<string, string | undefined>,
      lists: Object.fromEntries(lists.map((name) => [name, (found[name] ?? []) as string[]])),
      flags: new Set(flags.filter((name) => found[name] === true)),
      positionals,
    };
  } catch (error) {
    throw usageProblem(error);
  }
}

/** Returns the first sentence of Node's error about a command line. */
export function usageProblem(error: unknown): UsageProblem {
  const first = error instanceof Error ? (error.message.split(/\. |\n/)[0] ?? "") : "";
  return new UsageProblem(`${first.replace(/\.$/, "")}.`);
}

/**
 * Parses a number between bounds, with a default.
 *
 * @throws UsageProblem
 */
export function parseNumber(
  name: string,
  text: string | undefined,
  usual: number,
  least: number,
  most: number,
): number {
  if (text === undefined) return usual;
  const number = Number(text);
  if (/^\d+(\.\d+)?$/.test(text) && number >= least && number <= most) return number;
  throw new UsageProblem(`--${name} takes a number from ${least} to ${most}.`);
}

/**
 * Parses a width and a height such as 1280x720, whole numbers between bounds.
 *
 * @throws UsageProblem
 */
export function parseSize(
  name: string,
  text: string,
  least: number,
  most: number,
): { width: number; height: number } {
  const match = /^(\d{1,6})x(\d{1,6})$/.exec(text);
  const [width, height] = [Number(match?.[1]), Number(match?.[2])];
  if (match && [width, height].every((side) => side >= least && side <= most)) {
    return { width, height };
  }
  throw new UsageProblem(`--${name} is a size such as 1280x720, each side ${least} to ${most}.`);
}

/**
 * Parses one of some names, by default the first.
 *
 * @throws UsageProblem
 */
export function oneOf<Name extends string>(
  option: string,
  value: string | undefined,
  names: readonly Name[],
): Name {
  const name = value === undefined ? names[0] : names.find((name) => name === value);
  if (name !== undefined) return name;
  throw new UsageProblem(`--${option} is ${names.slice(0, -1).join(", ")} or ${names.at(-1)}.`);
}
