/** Addresses of scripts on pages that require Trusted Types. */

/** The part of the browser's `trustedTypes` used here. */
interface PolicyFactory {
  createPolicy(
    name: string,
    rules: { createScriptURL(address: string): string },
  ): { createScriptURL(address: string): string };
}

let policy: ReturnType<PolicyFactory["createPolicy"]> | undefined;

/**
 * Returns the address of a worker's script, the viewer's own or one set by the
 * page's author, as `new Worker` accepts it if the page requires Trusted Types:
 * made by the policy `turnleaf`. It is the plain address if the browser has no
 * Trusted Types or the page does not allow the policy.
 */
export function trustedScript(address: string): string {
  const { trustedTypes } = globalThis as { trustedTypes?: PolicyFactory };
  try {
    policy ??= trustedTypes?.createPolicy("turnleaf", { createScriptURL: (address) => address });
  } catch {
    // Without the policy, `new Worker` fails where Trusted Types are required, and says so.
  }
  return policy?.createScriptURL(address) ?? address;
}
