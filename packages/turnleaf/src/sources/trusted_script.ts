/** Addresses of scripts, and markup to be read, on pages that require Trusted Types. */

/** The rules of the policy `turnleaf`. */
export interface Policy {
  createScriptURL(address: string): string;
  createHTML(markup: string): string;
}

/** The part of the browser's `trustedTypes` used here. */
interface PolicyFactory {
  createPolicy(name: string, rules: Policy): Policy;
}

let policy: Policy | undefined;

/** Returns the policy `turnleaf`; undefined if the browser or the page has none. */
export function trustPolicy(): Policy | undefined {
  const { trustedTypes } = globalThis as { trustedTypes?: PolicyFactory };
  try {
    policy ??= trustedTypes?.createPolicy("turnleaf", {
      createScriptURL: (address) => address,
      createHTML: (markup) => markup,
    });
  } catch {
    // Without the policy, what needs it fails where Trusted Types are required, and says so.
  }
  return policy;
}

/**
 * Returns the address of a worker's script, the viewer's own or one set by the
 * page's author, as `new Worker` accepts it if the page requires Trusted Types:
 * made by the policy `turnleaf`. It is the plain address if the browser has no
 * Trusted Types or the page does not allow the policy.
 */
export function trustedScript(address: string): string {
  return trustPolicy()?.createScriptURL(address) ?? address;
}

/**
 * Returns markup as a parser or a frame accepts it if the page requires Trusted
 * Types: only for documents in which no script runs.
 */
export function trustedMarkup(markup: string): string {
  return trustPolicy()?.createHTML(markup) ?? markup;
}
