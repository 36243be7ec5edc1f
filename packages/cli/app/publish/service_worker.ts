/// <reference lib="webworker" />
/** Makes visited pages and kept books readable without a connection. Nothing is asked of any other site. */

import type { KeepMessage, KeepProgress } from "./keep_message.ts";

declare const self: ServiceWorkerGlobalScope;

/** Files kept of pages that were merely visited; the oldest give way. */
const mostVisited = 1500;
/** Files of a book that are fetched at the same time. */
const atOnce = 6;

/** Several sites of one host have caches of their own. */
const visited = `turnleaf visited ${self.registration.scope}`;
const keptName = (book: string): string => `turnleaf book ${book} ${self.registration.scope}`;

self.addEventListener("install", () => void self.skipWaiting());
self.addEventListener("activate", (event) => event.waitUntil(self.clients.claim()));
self.addEventListener("message", (event) => {
  const { addresses, book } = event.data as KeepMessage;
  const own = addresses.filter((address) => address.startsWith(self.registration.scope));
  event.waitUntil(book === undefined ? keepVisited(own) : keepBook(book, own, event.ports[0]));
});
self.addEventListener("fetch", (event) => {
  const { request } = event;
  const isOwn = request.url.startsWith(self.registration.scope);
  // Parts of a file are left to the browser: a cache has whole files alone.
  if (request.method !== "GET" || !isOwn || request.headers.has("range")) return;
  event.respondWith(isFinal(request.url) ? cacheFirst(request) : networkFirst(request));
});

/** Whether what is at an address never changes: its name or its query says which version it is. */
function isFinal(url: string): boolean {
  return url.startsWith(`${self.registration.scope}assets/`) || /\?v=[\da-f]+$/.test(url);
}

async function cacheFirst(request: Request): Promise<Response> {
  return (await caches.match(request)) ?? (await fetchAndKeep(request));
}

async function networkFirst(request: Request): Promise<Response> {
  try {
    return await fetchAndKeep(request);
  } catch (error) {
    const kept = await caches.match(request, { ignoreSearch: request.mode === "navigate" });
    if (kept) return kept;
    throw error;
  }
}

async function fetchAndKeep(request: Request): Promise<Response> {
  const response = await fetch(request);
  if (response.ok && response.type === "basic") {
    const cache = await caches.open(visited);
    // A full disk must not keep the page from being seen.
    await cache.put(request, response.clone()).catch(() => {});
  }
  return response;
}

async function keepVisited(addresses: readonly string[]): Promise<void> {
  const cache = await caches.open(visited);
  for (const address of addresses) {
    // The page has just loaded it: the browser need not ask for it again.
    const request = new Request(address, { cache: "force-cache" });
    if (!(await caches.match(address))) await cache.add(request).catch(() => {});
  }
  const keys = await cache.keys();
  for (const key of keys.slice(0, Math.max(keys.length - mostVisited, 0))) await cache.delete(key);
}

async function keepBook(
  book: string,
  addresses: readonly string[],
  port: MessagePort | undefined,
): Promise<void> {
  const tell = (progress: KeepProgress): void => port?.postMessage(progress);
  const of = addresses.length;
  try {
    const cache = await caches.open(keptName(book));
    const old = new Map((await cache.keys()).map((request) => [request.url, request]));
    let next = 0;
    let done = 0;
    const work = async (): Promise<void> => {
      for (let address = addresses[next++]; address !== undefined; address = addresses[next++]) {
        if (!old.delete(new URL(address).href)) await cache.add(address);
        tell({ done: ++done, of });
      }
    };
    await Promise.all(Array.from({ length: atOnce }, work));
    // Of a version of the book that is no more.
    for (const request of old.values()) await cache.delete(request);
  } catch {
    tell({ done: 0, of, failed: "The book could not be kept; check the connection and the disk." });
  }
}
