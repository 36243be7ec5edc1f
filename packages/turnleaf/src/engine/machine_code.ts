/** The engine's WASM: inlined in the package, or a file that the page serves itself. */

import { unpack } from "../packed.ts";

const compiled = new Map<string, Promise<WebAssembly.Module>>();

/**
 * Returns the compiled engine: of the package itself, or the package's file turnleaf.wasm at
 * an address. It is loaded and compiled once a page; after a failure it is tried anew.
 *
 * @param address absolute, or "" for the engine in the package
 */
export function engineCode(address = ""): Promise<WebAssembly.Module> {
  let code = compiled.get(address);
  if (code === undefined) {
    code = load(address).then((bytes) => WebAssembly.compile(bytes));
    code.catch(() => compiled.delete(address));
    compiled.set(address, code);
  }
  return code;
}

async function load(address: string): Promise<Uint8Array<ArrayBuffer> | ArrayBuffer> {
  if (address === "") return unpack((await import("./turnleaf.wasm")).default);
  const response = await fetch(address);
  if (!response.ok) throw new Error(`The server said ${response.status}.`);
  return response.arrayBuffer();
}

/** The shortest module there is: its magic number and version. */
const emptyModule = Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0);

/** Whether there is WebAssembly, and the page's security policy lets it run. */
export function mayRunCode(): boolean {
  try {
    return new WebAssembly.Module(emptyModule) instanceof WebAssembly.Module;
  } catch {
    return false;
  }
}
