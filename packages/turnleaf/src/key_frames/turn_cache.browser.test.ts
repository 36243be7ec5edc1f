import { afterEach, expect, it, vi } from "vitest";
import { TurnCache, TurnRecorder, turnName } from "./key_frames.ts";

const name = "turnleaf-turns-of-a-test";

afterEach(async () => {
  vi.restoreAllMocks();
  await caches.delete(name);
});

function file(): Uint8Array<ArrayBuffer> {
  const recorder = new TurnRecorder({ width: 0.1, height: 0.2, u: [0, 1], v: [0, 1] });
  recorder.add(0, [0, 0, 0, 0.1, 0, 0, 0, 0.2, 0, 0.1, 0.2, 0]);
  recorder.add(1, [0, 0, 0, -0.1, 0, 0, 0, 0.2, 0, -0.1, 0.2, 0]);
  return recorder.finish().bytes;
}

/** Responds to requests and counts them. */
function serve(body: BodyInit, status = 200) {
  return vi
    .spyOn(globalThis, "fetch")
    .mockImplementation(async () => new Response(body, { status }));
}

it("fetches a turn once for all who ask, and not again on another visit", async () => {
  const bytes = file();
  const asked = serve(bytes);
  const address = `/turns/${await turnName(bytes)}`;
  const cache = new TurnCache({ name });
  const [a, b] = await Promise.all([cache.fetch(address), cache.fetch(address)]);
  expect(a).toBe(b);
  expect(a.duration).toBe(1);
  expect((await new TurnCache({ name }).fetch(address)).frames).toBe(2);
  expect(asked).toHaveBeenCalledTimes(1);
  await cache.clear();
  await new TurnCache({ name }).fetch(address);
  expect(asked).toHaveBeenCalledTimes(2);
});

it("keeps no file beyond the visit whose name is not its content's, and trusts no wrong one", async () => {
  const asked = serve(file());
  await new TurnCache({ name }).fetch("/turn.tlkf");
  await new TurnCache({ name }).fetch("/turn.tlkf");
  expect(asked).toHaveBeenCalledTimes(2);
  const wrong = `/turn-${"0".repeat(32)}.tlkf`;
  await expect(new TurnCache({ name }).fetch(wrong)).rejects.toThrow("another than its name says");
  expect(await (await caches.open(name)).keys()).toEqual([]);
});

it("says in one sentence what cannot be fetched, and asks again the next time", async () => {
  const asked = serve("", 404);
  const cache = new TurnCache({ name });
  await expect(cache.fetch("/none.tlkf")).rejects.toThrow(/none\.tlkf could not be fetched\.$/);
  asked.mockRejectedValueOnce(new TypeError("offline"));
  await expect(cache.fetch("/none.tlkf")).rejects.toThrow("could not be fetched.");
  asked.mockImplementation(async () => new Response(file()));
  expect((await cache.fetch("/none.tlkf")).columns).toBe(2);
  serve(new Uint8Array(17 << 20));
  await expect(new TurnCache({ name }).fetch("/large.tlkf")).rejects.toThrow("too large");
  // What is left of a file, and the end of giving it up, may never come.
  const endless = new ReadableStream({
    pull: (stream) => stream.enqueue(new Uint8Array(1 << 20)),
    cancel: () => new Promise(() => {}),
  });
  serve(endless);
  await expect(new TurnCache({ name }).fetch("/endless.tlkf")).rejects.toThrow("too large");
});

it("records a turn once, in this visit and the next", async () => {
  const record = vi.fn(async () => file());
  const cache = new TurnCache({ name });
  const ask = (cache: TurnCache) => cache.record("sheet, book paper, corner, 1 s", record);
  const [a, b] = await Promise.all([ask(cache), ask(cache)]);
  expect(a).toBe(b);
  await ask(new TurnCache({ name }));
  expect(record).toHaveBeenCalledTimes(1);
  // A damaged entry is recorded again.
  const store = await caches.open(name);
  for (const key of await store.keys()) await store.put(key, new Response("damaged"));
  expect((await ask(new TurnCache({ name }))).frames).toBe(2);
  expect(record).toHaveBeenCalledTimes(2);
});

it("holds no more turns than it may, and works where the browser stores nothing", async () => {
  vi.spyOn(caches, "open").mockRejectedValue(new DOMException("Forbidden.", "SecurityError"));
  const record = vi.fn(async () => file());
  const cache = new TurnCache({ name, most: 2 });
  for (const turn of ["a", "b", "a", "c", "a"]) await cache.record(turn, record);
  expect(record).toHaveBeenCalledTimes(3);
  await cache.record("b", record);
  expect(record).toHaveBeenCalledTimes(4);
});
