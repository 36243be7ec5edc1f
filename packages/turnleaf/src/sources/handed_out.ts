/** Book sources as programs get them. */

import type { PageSource } from "./page_source.ts";

/**
 * Returns a source whose methods are called on `source` itself, however they are called: it works
 * behind a Proxy, as Vue, Pinia and Alpine put around what they hold.
 */
export function handedOut(source: PageSource): PageSource {
  return bound(source, (name, value) =>
    name === "narration" && value ? bound(value as object) : value,
  );
}

/** Returns an object with the members of another, its methods bound to that. */
function bound<T extends object>(
  inner: T,
  handOut: (name: string | symbol, value: unknown) => unknown = (_, value) => value,
): T {
  return new Proxy(inner, {
    get: (_, name) => {
      const value: unknown = Reflect.get(inner, name);
      return typeof value === "function" ? value.bind(inner) : handOut(name, value);
    },
  });
}
