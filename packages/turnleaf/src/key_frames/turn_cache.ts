import { decodeTurn } from "./decode.ts";
import { TurnError } from "./file.ts";
import type { RecordedTurn } from "./recorded_turn.ts";

/** The options of a cache of turns. */
export interface TurnCacheOptions {
  /**
   * Name of the browser's store in which turns outlast the visit. The default
   * is "turnleaf-turns".
   */
  readonly name?: string;
  /**
   * Maximum of turns held in memory; the one requested longest ago is dropped
   * first. The default is 32.
   */
  readonly most?: number;
}

/** A larger file is not a turn. */
const mostBytes = 16 << 20;

/**
 * A cache of recordings: the books and pages of a document use one copy in
 * memory, later visits find it in the browser's Cache Storage, and all visitors
 * in the network's caches, because a name from `turnName` stands for one
 * content for ever and may be served with `Cache-Control: public,
 * max-age=31536000, immutable`.
 */
export class TurnCache {
  private readonly name: string;
  private readonly most: number;
  private readonly turns = new Map<string, Promise<RecordedTurn>>();

  constructor(options: TurnCacheOptions = {}) {
    this.name = options.name ?? "turnleaf-turns";
    this.most = Math.max(options.most ?? 32, 1);
  }

  /**
   * Returns the turn at an address, fetched once. Rejects with a `TurnError` if
   * there is none, and then fetches again the next time.
   */
  fetch(address: string | URL): Promise<RecordedTurn> {
    const url = new URL(address, globalThis.document?.baseURI).href;
    return this.once(url, async (store) => {
      const kept = await store?.match(url);
      const response = kept ?? (await fetch(url).catch(() => null));
      if (!response?.ok) throw new TurnError(`The recorded turn at ${url} could not be fetched.`);
      const bytes = await bytesOf(response);
      await requireName(url, bytes);
      const turn = decodeTurn(bytes);
      // Only a file named by its content is kept beyond the visit; otherwise the server is asked.
      if (!kept && nameIn(url)) await store?.put(url, new Response(bytes)).catch(() => {});
      return turn;
    });
  }

  /**
   * Returns the turn of a name, recorded once by its first caller.
   *
   * @param name identifies everything that defines it: model, paper, gesture,
   * seconds
   * @param record returns the bytes of its file, as `TurnRecorder.finish` does
   */
  record(name: string, record: () => Promise<Uint8Array<ArrayBuffer>>): Promise<RecordedTurn> {
    const key = `https://turnleaf.invalid/${encodeURIComponent(name)}`;
    return this.once(key, async (store) => {
      const kept = await store?.match(key);
      if (kept) {
        try {
          return decodeTurn(await bytesOf(kept));
        } catch {
          // An entry of another version, or of other code: it is recorded again.
        }
      }
      const bytes = await record();
      const turn = decodeTurn(bytes);
      await store?.put(key, new Response(bytes)).catch(() => {});
      return turn;
    });
  }

  /** Forgets all turns, also those kept from other visits. */
  async clear(): Promise<void> {
    this.turns.clear();
    await globalThis.caches?.delete(this.name).catch(() => false);
  }

  private once(
    key: string,
    load: (store: Cache | undefined) => Promise<RecordedTurn>,
  ): Promise<RecordedTurn> {
    const known = this.turns.get(key);
    const turn = known ?? this.open().then(load);
    // The map is in the order of requests: the first one is dropped.
    this.turns.delete(key);
    this.turns.set(key, turn);
    const [oldest] = this.turns.keys();
    if (this.turns.size > this.most && oldest !== undefined) this.turns.delete(oldest);
    if (!known) turn.catch(() => this.turns.get(key) === turn && this.turns.delete(key));
    return turn;
  }

  /**
   * Returns the browser's store; undefined if the page is not secure, or
   * storage is not allowed.
   */
  private async open(): Promise<Cache | undefined> {
    return await globalThis.caches?.open(this.name).catch(() => undefined);
  }
}

/**
 * Returns the name of a turn's file by its content: `turn-` and the first 32
 * digits of its SHA-256.
 */
export async function turnName(bytes: Uint8Array<ArrayBuffer>): Promise<string> {
  const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
  const digits = [...digest.subarray(0, 16)].map((byte) => byte.toString(16).padStart(2, "0"));
  return `turn-${digits.join("")}.tlkf`;
}

/** Returns the name by content in an address, if it has one. */
function nameIn(url: string): string | null {
  return /\/(turn-[0-9a-f]{32}\.tlkf)(?:[?#]|$)/.exec(url)?.[1] ?? null;
}

/** Checks the content against the name in its address. */
async function requireName(url: string, bytes: Uint8Array<ArrayBuffer>): Promise<void> {
  const name = nameIn(url);
  // There is no digest if the page is not secure.
  if (!name || !globalThis.crypto?.subtle || (await turnName(bytes)) === name) return;
  throw new TurnError(`The recorded turn at ${url} is another than its name says.`);
}

async function bytesOf(response: Response): Promise<Uint8Array<ArrayBuffer>> {
  const parts: Uint8Array[] = [];
  let length = 0;
  for (const reader = response.body?.getReader(); reader; ) {
    const { done, value } = await reader.read();
    if (done) break;
    length += value.length;
    if (length > mostBytes) {
      // Not awaited: what is left may never come.
      reader.cancel().catch(() => {});
      throw new TurnError("The file is too large for a recorded turn.");
    }
    parts.push(value);
  }
  const bytes = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}
