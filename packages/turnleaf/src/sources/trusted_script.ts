/** Addresses of scripts on pages that require Trusted Types. */

/** What this file needs of the browser's `trustedTypes`. */
interface PolicyFactory {
  createPolicy(
    name: string,
    rules: { createScriptURL(address: string): string },
  ): { createScriptURL(address: string): string };
}

let policy: ReturnType<PolicyFactory["createPolicy"]> | undefined;

/**
 * The address of a worker's script, which is the viewer's own or one that the page's author set, as
 * `new Worker` takes it where the page requires Trusted Types: made by the policy `turnleaf`. It is
 * the plain address where the browser has no Trusted Types or the page does not allow the policy.
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
