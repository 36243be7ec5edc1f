/** Fonts that an EPUB obfuscates by its identifier, and what is encrypted otherwise. */

import type { FilePaths } from "../archive/file_paths.ts";

/** What of a package is needed. */
interface Identified {
  readonly metadata: { readonly identifier?: unknown };
}

/** How to read the files of a book. */
export interface FontDecoder {
  /** Makes a font's bytes readable, in place. */
  decode(path: string, bytes: Uint8Array<ArrayBuffer>): Promise<void>;
  /** Returns whether any of some files is encrypted in a way that needs a key from a shop. */
  isProtected(paths: readonly string[]): boolean;
}

const idpf = "http://www.idpf.org/2008/embedding";
const adobe = "http://ns.adobe.com/pdf/enc#RC";

/**
 * @param encryption the book's `encryption.xml`, if it has one
 * @param paths of the book's files
 */
export async function fontDecoder(
  encryption: Document | null,
  { metadata }: Identified,
  paths: FilePaths,
): Promise<FontDecoder> {
  const methods = new Map<string, string>();
  for (const data of encryption?.getElementsByTagNameNS("*", "EncryptedData") ?? []) {
    const [method] = data.getElementsByTagNameNS("*", "EncryptionMethod");
    const [reference] = data.getElementsByTagNameNS("*", "CipherReference");
    const path = paths.resolve(reference?.getAttribute("URI") ?? "", "");
    if (path !== null) methods.set(path, method?.getAttribute("Algorithm") ?? "");
  }
  const identifier = String(metadata.identifier ?? "").replace(/[ \t\r\n]/g, "");
  return {
    async decode(path, bytes) {
      const method = methods.get(path);
      if (method === idpf) {
        const hash = await crypto.subtle.digest("SHA-1", new TextEncoder().encode(identifier));
        xor(bytes, new Uint8Array(hash), 1040);
      } else if (method === adobe) {
        const digits = identifier.replace(/^urn:uuid:/i, "").replaceAll("-", "");
        xor(
          bytes,
          Uint8Array.from(digits.match(/../g) ?? [], (two) => Number.parseInt(two, 16)),
          1024,
        );
      }
    },
    isProtected: (files) =>
      files.some((path) => {
        const method = methods.get(path);
        return method !== undefined && method !== idpf && method !== adobe;
      }),
  };
}

function xor(bytes: Uint8Array, key: Uint8Array, length: number): void {
  if (key.length === 0) return;
  for (let k = 0; k < Math.min(length, bytes.length); k++) {
    bytes[k] = (bytes[k] as number) ^ (key[k % key.length] as number);
  }
}
