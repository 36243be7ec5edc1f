import { afterEach, expect, test, vi } from "vitest";
import type { TurnleafBook } from "./element.ts";
import { book, happens, scans } from "./for_tests/element_books.ts";
import { eventually } from "./for_tests/eventually.ts";
import { TurnRecorder } from "./key_frames/key_frames.ts";
import { turnModels } from "./leaf_models/model_choice.ts";

afterEach(() => {
  vi.restoreAllMocks();
  document.body.replaceChildren();
});

/** Returns a board of two by two points that swings over; `far` is the fraction of the way. */
function file(far = 1): Uint8Array<ArrayBuffer> {
  const recorder = new TurnRecorder({ width: 0.15, height: 0.2, u: [0, 1], v: [0, 1] });
  for (let k = 0; k <= 30; k++) {
    const angle = (far * Math.PI * k) / 30;
    const [x, z] = [0.15 * Math.cos(angle), 0.15 * Math.sin(angle)];
    recorder.add(k / 30, [0, 0, 0, x, 0, z, 0, 0.2, 0, x, 0.2, z]);
  }
  return recorder.finish().bytes;
}

/** Responds to requests below /turns/ with these bytes, to others as usual. */
function serve(body: Uint8Array<ArrayBuffer>, status = 200): void {
  const { fetch } = globalThis;
  vi.spyOn(globalThis, "fetch").mockImplementation(async (input, init) =>
    String(input).includes("/turns/") ? new Response(body, { status }) : fetch(input, init),
  );
}

const ready = (element: TurnleafBook): Promise<void> => eventually(() => element.ready).toBe(true);

/**
 * Returns the errors of a book with this model, before and during a turn, which
 * it makes in any case.
 */
async function faults(attributes: Record<string, string>): Promise<string[]> {
  const element = book(scans(8), { cover: "none", duration: "300", page: "2", ...attributes });
  const said: string[] = [];
  element.addEventListener("error", (event) => said.push(event.detail.message));
  await happens(element, "load");
  await ready(element);
  expect(await element.next()).toBe(true);
  expect(await element.previous()).toBe(true);
  return said;
}

test("a book turns as a recording that the page gives", async () => {
  serve(file());
  expect(await faults({ model: "replay", "model-src": "/turns/board.tlkf" })).toEqual([]);
  expect(fetch).toHaveBeenCalledWith(expect.stringContaining("/turns/board.tlkf"));
});

const damaged = file();
damaged[60] ^= 1;

test.for([
  ["that is damaged", damaged, 200, "This recorded turn is damaged: its checksum does not fit."],
  ["that is none", new TextEncoder().encode("<!doctype html>"), 200, 'does not begin with "TLKF".'],
  ["that is not there", new Uint8Array(), 404, "could not be fetched."],
  ["of half a turn", file(0.5), 200, "record a turn from one side to the other."],
] as const)(
  "of a turn file %s one sentence tells, and leaves turn as sheets",
  async ([what, bytes, status, sentence]) => {
    serve(bytes, status);
    const address = `/turns/${encodeURIComponent(what)}.tlkf`;
    const said = await faults({ model: "replay", "model-src": address });
    expect(said).toHaveLength(1);
    expect(said[0]).toContain(`The turn file ${what}.tlkf `);
    expect(said[0]).toContain(sentence);
  },
);

test("an address that is none is reported likewise", async () => {
  expect(await faults({ model: "replay", "model-src": "http://" })).toEqual([
    "The turn file http: cannot be played. Its address is none.",
  ]);
});

test("an unknown model is reported in one sentence that lists the names", async () => {
  expect(await faults({ model: "origami" })).toEqual([
    `No way of turning a page is named "origami"; there are ${turnModels.join(", ")}.`,
  ]);
});
