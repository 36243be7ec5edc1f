/** Workers of the viewer's own: their scripts, and what is said where the browser does not start one. */

import { unpack } from "../packed.ts";
import { dataUrl } from "./data_url.ts";
import { BookError } from "./page_source.ts";

/**
 * Returns an address at which a worker finds a script. A page without an origin of its own, as in a
 * frame with `sandbox`, may not start one from a blob: that would be of no origin, as the page is.
 */
export async function scriptAddress(code: Uint8Array<ArrayBuffer>): Promise<string> {
  const type = "text/javascript";
  if (globalThis.origin !== "null") return URL.createObjectURL(new Blob([code], { type }));
  return await dataUrl(code, type);
}

/**
 * Returns a function that resolves to the address of a worker's script, which is loaded when it is first
 * asked for, and again where that failed.
 */
export function scriptOfWorker(load: () => Promise<{ default: string }>): () => Promise<string> {
  let script: Promise<string> | undefined;
  return () => {
    script ??= load().then(
      async ({ default: packed }) => await scriptAddress(await unpack(packed)),
    );
    script.catch(() => {
      script = undefined;
    });
    return script;
  };
}

/**
 * Returns the error for a worker that the browser did not start, or in which it forbids WASM.
 *
 * @param name the file in sentences
 * @param does what the worker does, such as "unpacks it"
 */
export function workerNotStarted(name: string, does: string, cause: unknown): BookError {
  const said = String(cause);
  let remedy = "allow blob: in worker-src of this page's Content-Security-Policy";
  if (/Trusted/.test(said)) {
    remedy = "allow turnleaf in trusted-types of this page's Content-Security-Policy";
  } else if (/wasm|WebAssembly|CompileError/i.test(said)) {
    remedy = "allow 'wasm-unsafe-eval' in script-src of this page's Content-Security-Policy";
  }
  return new BookError(
    `${name} cannot be read, as the browser did not start the script that ${does}; ${remedy}.`,
    { code: "blocked", source: name, cause },
  );
}
