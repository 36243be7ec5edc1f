/** Keeps what was visited, or a whole book, for reading without a connection. */

import type { KeepMessage, KeepProgress } from "./keep_message.ts";

/** Registers the service worker, which then keeps what this page has loaded. */
export async function keepVisited(): Promise<ServiceWorkerRegistration | null> {
  if (!("serviceWorker" in navigator)) return null;
  try {
    const root = new URL(document.body.dataset.root ?? "", location.href);
    const address = new URL("service-worker.js", root).href;
    await navigator.serviceWorker.register(trusted(address), { scope: root.href });
    const registration = await navigator.serviceWorker.ready;
    await loaded();
    const addresses = performance
      .getEntriesByType("resource")
      .map(({ name }) => name)
      .filter((name) => name.startsWith(root.href));
    send(registration, { addresses: [location.href.split("#", 1)[0] ?? "", ...addresses] });
    return registration;
  } catch {
    // Not served safely, or not allowed: the site works online all the same.
    return null;
  }
}

/** Keeps a book whole. Rejects with a sentence if that fails. */
export function keepBook(
  registration: ServiceWorkerRegistration,
  book: string,
  addresses: readonly string[],
  progress: (fraction: number) => void,
): Promise<void> {
  return new Promise((resolve, reject) => {
    const channel = new MessageChannel();
    channel.port1.onmessage = ({ data }: MessageEvent<KeepProgress>) => {
      if (data.failed !== undefined) reject(new Error(data.failed));
      else if (data.done === data.of) resolve();
      else progress(data.done / data.of);
    };
    const absolute = addresses.map((address) => new URL(address, location.href).href);
    send(registration, { addresses: absolute, book }, [channel.port2]);
  });
}

function send(
  registration: ServiceWorkerRegistration,
  message: KeepMessage,
  ports: MessagePort[] = [],
): void {
  registration.active?.postMessage(message, ports);
}

function loaded(): Promise<void> {
  if (document.readyState === "complete") return Promise.resolve();
  return new Promise((resolve) => addEventListener("load", () => resolve(), { once: true }));
}

/** Returns an address as the page's policy wants it where scripts are loaded from. */
function trusted(address: string): string {
  const types = (globalThis as { trustedTypes?: TrustedTypes }).trustedTypes;
  const policy = types?.createPolicy("turnleaf-site", { createScriptURL: (url) => url });
  return (policy?.createScriptURL(address) ?? address) as string;
}

/** What this page needs of the browser's own `trustedTypes`. */
interface TrustedTypes {
  createPolicy(
    name: string,
    rules: { createScriptURL(url: string): string },
  ): { createScriptURL(url: string): unknown };
}
