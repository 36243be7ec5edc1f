/** Scripts of workers that travel inside a module. */

import { dataUrl } from "./data_url.ts";

/**
 * Returns an address at which a worker finds a script. A page without an origin of its own, as in a
 * frame with `sandbox`, may not start one from a blob: that would be of no origin, as the page is.
 */
export async function scriptAddress(code: Uint8Array<ArrayBuffer>): Promise<string> {
  const type = "text/javascript";
  if (globalThis.origin !== "null") return URL.createObjectURL(new Blob([code], { type }));
  return await dataUrl(code, type);
}
