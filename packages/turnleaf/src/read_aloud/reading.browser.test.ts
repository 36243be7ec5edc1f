import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { clock } from "../for_tests/clock.ts";
import { eventually } from "../for_tests/eventually.ts";
import type { NarratedClip, Narration } from "../sources/page_source.ts";
import { Reading } from "./reading.ts";

/** A player whose time the test lets pass. */
class FakeAudio extends EventTarget {
  static last: FakeAudio;
  src = "";
  currentTime = 0;
  duration = 100;
  playbackRate = 1;
  paused = true;
  ended = false;
  error = null;
  reason: Error | null = null;
  /** Where it was heard from, at each start and jump. */
  readonly starts: number[] = [];

  constructor() {
    super();
    FakeAudio.last = this;
  }

  async play(): Promise<void> {
    if (this.reason) throw this.reason;
    this.paused = false;
    this.starts.push(this.currentTime);
  }

  pause(): void {
    if (this.paused) return;
    this.paused = true;
    // As the browser's own, it reports the pause a task later.
    void clock.task().then(() => this.dispatchEvent(new Event("pause")));
  }

  load(): void {
    this.paused = true;
    this.currentTime = 0;
  }

  removeAttribute(): void {
    this.src = "";
  }

  /** Lets the sound go on to a time. */
  passTo(seconds: number): void {
    this.currentTime = seconds;
    this.dispatchEvent(new Event("timeupdate"));
  }
}

/** A book of single pages. */
class Book extends EventTarget {
  page = 1;
  bookTitle = "A book";
  state = "resting";
  get spread(): { left: null; right: number } {
    return { left: null, right: this.page };
  }
  async turnTo(page: number): Promise<boolean> {
    this.page = page;
    this.dispatchEvent(new CustomEvent("pagechange"));
    return true;
  }
}

const recording = new Blob(["sound"], { type: "audio/mpeg" });
const clip = (page: number, begin: number, end: number, more = {}): NarratedClip => ({
  pages: [{ page: page - 1, from: 0 }],
  text: `On page ${page}.`,
  recording,
  begin,
  end,
  ...more,
});

/** A narration of clips, which records what was marked. */
class FakeNarration implements Narration {
  readonly marked: (number | null)[] = [];
  /** Resolves when a clip is known. */
  delay: (number: number) => Promise<void> | undefined = () => undefined;
  readonly #clips: readonly NarratedClip[];

  constructor(clips: readonly NarratedClip[]) {
    this.#clips = clips;
  }

  async clipFrom(index: number): Promise<number | null> {
    const found = this.#clips.findIndex(({ pages }) => (pages[0]?.page ?? 0) >= index);
    return found < 0 ? null : found;
  }
  async clip(number: number): Promise<NarratedClip | null> {
    await this.delay(number);
    return this.#clips[number] ?? null;
  }
  mark(number: number | null): void {
    this.marked.push(number);
  }
}

const begin = (...clips: NarratedClip[]) => {
  const [book, narration] = [new Book(), new FakeNarration(clips)];
  const reading = new Reading(book, narration, "en");
  const reported: unknown[] = [];
  book.addEventListener("readaloudchange", (event) => reported.push((event as CustomEvent).detail));
  const done = reading.run(
    () => {},
    ({ message }) => reported.push({ message }),
  );
  const isMarked = (number: number) => eventually(() => narration.marked.at(-1)).toBe(number);
  return { book, narration, reading, done, isMarked, reported, sound: FakeAudio.last };
};

beforeEach(() => vi.stubGlobal("Audio", FakeAudio));
afterEach(() => vi.unstubAllGlobals());

describe("reading aloud", () => {
  test("plays each clip to its end, turns to its page and marks it", async () => {
    const { book, narration, done, isMarked, sound } = begin(
      clip(1, 5, 10),
      clip(2, 10, 12),
      clip(2, 30, 31),
    );
    await isMarked(0);
    await eventually(() => sound.starts).toEqual([5]);
    // A timer that is late lets a little more be heard than the clip.
    sound.passTo(10.4);
    await isMarked(1);
    expect(book.page).toBe(2);
    // It goes on where the clip before ends: without a pause and a jump.
    expect([sound.paused, sound.starts, sound.currentTime]).toEqual([false, [5], 10.4]);
    sound.passTo(12);
    await isMarked(2);
    await eventually(() => sound.starts).toEqual([5, 30]);
    sound.passTo(31);
    await done;
    expect(narration.marked).toEqual([0, 1, 2, null]);
    expect([sound.paused, sound.src]).toEqual([true, ""]);
  });

  test("goes on where the next clip is known only once the one before is over", async () => {
    const { book, narration, done, isMarked, sound } = begin(
      clip(1, 5, 10),
      clip(2, 10, 12),
      clip(3, 12, 14),
    );
    const known: Record<number, () => void> = {};
    narration.delay = (number) => {
      if (number === 0) return undefined;
      return new Promise((resolve) => {
        known[number] = resolve;
      });
    };
    await isMarked(0);
    await eventually(() => known[1]).toBeDefined();
    sound.passTo(10);
    await clock.task();
    known[1]?.();
    await isMarked(1);
    // Known a task later, it is heard without a break.
    expect([sound.paused, sound.starts]).toEqual([false, [5]]);
    sound.passTo(12);
    await eventually(() => sound.paused).toBe(true);
    known[2]?.();
    await isMarked(2);
    await eventually(() => sound.starts).toEqual([5, 12]);
    // What was reported of the pause meanwhile ends nothing.
    await clock.pass(20);
    expect(sound.paused).toBe(false);
    known[3]?.();
    sound.passTo(14);
    await done;
    expect(book.page).toBe(3);
  });

  test("turns the page within a clip, once what stands before has been heard", async () => {
    const pages = [
      { page: 0, from: 0 },
      { page: 1, from: 0.5 },
    ];
    const { book, reading, done, isMarked, sound } = begin(clip(1, 0, 10, { pages }));
    await isMarked(0);
    await eventually(() => sound.starts.length).toBe(1);
    sound.passTo(4.9);
    expect(book.page).toBe(1);
    sound.passTo(5.1);
    expect(book.page).toBe(2);
    reading.stop();
    await done;
  });

  test("follows a reader who turns to another page", async () => {
    const { book, reading, done, isMarked, sound } = begin(
      clip(1, 0, 10),
      clip(2, 10, 20),
      clip(5, 50, 60),
    );
    await isMarked(0);
    await eventually(() => sound.starts).toEqual([0]);
    await book.turnTo(4);
    await isMarked(2);
    await eventually(() => sound.starts).toEqual([0, 50]);
    expect(book.page).toBe(5);
    reading.stop();
    await done;
  });

  test("does not turn against a reader whose leaves are still turning", async () => {
    const long = [0, 1].map((page) => ({ page, from: page / 2 }));
    const { book, reading, done, sound, isMarked } = begin(clip(1, 0, 10, { pages: long }));
    await isMarked(0);
    await eventually(() => sound.starts).toEqual([0]);
    book.state = "turning";
    sound.passTo(6);
    expect(book.page).toBe(1);
    // They have come to rest where the clip is not read.
    book.state = "resting";
    book.page = 1;
    book.dispatchEvent(new CustomEvent("pagechange"));
    await eventually(() => book.page).toBe(2);
    reading.stop();
    await done;
  });

  test("ends at once when it is stopped, also by the system, and leaves nothing running", async () => {
    for (const stop of [
      ({ reading }: ReturnType<typeof begin>) => reading.stop(),
      ({ sound }: ReturnType<typeof begin>) => sound.pause(),
    ]) {
      const begun = begin(clip(1, 0, 10), clip(2, 10, 20));
      await eventually(() => begun.sound.starts.length).toBe(1);
      stop(begun);
      await begun.done;
      expect(begun.narration.marked.at(-1)).toBe(null);
      expect([begun.sound.paused, begun.sound.src, begun.book.page]).toEqual([true, "", 1]);
      await begun.book.turnTo(2);
      expect(begun.narration.marked.at(-1)).toBe(null);
    }
  });

  test("says in one sentence where the browser plays nothing without a press, or not this", async () => {
    for (const [reason, sentence] of [
      [
        new DOMException("no", "NotAllowedError"),
        /^A book is read aloud only when its reader asks for it by a press\.$/,
      ],
      [new DOMException("no", "NotSupportedError"), /^A recording in A book cannot be played/],
    ] as const) {
      const { done, sound, reported } = begin(clip(1, 0, 10));
      sound.reason = reason;
      await done;
      expect(reported).toEqual([
        { reading: true },
        { message: expect.stringMatching(sentence) },
        { reading: false },
      ]);
    }
  });

  test("speaks text that has no recording, sentence by sentence", async () => {
    const said: SpeechSynthesisUtterance[] = [];
    vi.spyOn(speechSynthesis, "speak").mockImplementation((utterance) => {
      said.push(utterance);
      queueMicrotask(() => utterance.onend?.(new Event("end") as SpeechSynthesisEvent));
    });
    const long = `${"word ".repeat(60)}end.`;
    const { book, done } = begin(
      clip(1, 0, 0, { recording: null, text: "One. Two?" }),
      clip(2, 0, 0, { recording: null, text: long }),
    );
    await done;
    expect(said.slice(0, 2).map(({ text, lang }) => [text.trim(), lang])).toEqual([
      ["One.", "en"],
      ["Two?", "en"],
    ]);
    expect(
      said
        .slice(2)
        .map(({ text }) => text)
        .join(""),
    ).toBe(long);
    expect(said.every(({ text }) => text.length <= 200)).toBe(true);
    expect(book.page).toBe(2);
  });
});
