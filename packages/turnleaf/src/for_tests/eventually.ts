/** Assertions of what will be, by the clock of the tests. */

import { expect } from "vitest";
import { clock } from "./clock.ts";

/**
 * Asserts what will be: `await eventually(() => book.page).toBe(3)`. It takes what `expect` takes, and
 * draws frames until that holds.
 */
export function eventually<T>(get: () => T): ReturnType<typeof expect.poll<T>> {
  const along = (path: readonly string[]): unknown =>
    new Proxy(() => undefined, {
      get: (_, name: string) => along([...path, name]),
      apply: (_, __, expected: readonly unknown[]) =>
        clock.untilPasses(async () => {
          const assertion = path
            .slice(0, -1)
            .reduce((at, name) => Reflect.get(at, name), expect(await get()) as object);
          return Reflect.get(assertion, path.at(-1) as string).apply(assertion, expected);
        }),
    });
  return along([]) as ReturnType<typeof expect.poll<T>>;
}
