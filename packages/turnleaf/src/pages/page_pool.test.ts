import { describe, expect, it } from "vitest";
import { BookError, type PagePicture, type PageSource } from "../sources/page_source.ts";
import { PagePool, type PagePoolOptions, slowTime } from "./page_pool.ts";

interface Drawing {
  readonly index: number;
  readonly width: number;
  readonly signal: AbortSignal;
  finish(): void;
  fail(error: unknown): void;
}

class FakePicture {
  isClosed = false;
  constructor(
    readonly index: number,
    readonly width: number,
    readonly height: number,
  ) {}
  close(): void {
    this.isClosed = true;
  }
}

/** Draws when the test calls it; pages are `ratio` times as high as wide. */
class FakeSource implements PageSource {
  readonly title = "Fake";
  readonly language = "";
  readonly direction = "ltr";
  readonly kind = "scan";
  readonly drawings: Drawing[] = [];
  readonly pictures: FakePicture[] = [];
  constructor(
    readonly pageCount = 100,
    readonly ratio = 1,
  ) {}
  size(): Promise<{ width: number; height: number }> {
    return Promise.resolve({ width: 1, height: this.ratio });
  }
  label(index: number): string {
    return String(index + 1);
  }
  draw(index: number, width: number, signal: AbortSignal): Promise<PagePicture> {
    return new Promise((resolve, reject) => {
      const finish = (): void => {
        const picture = new FakePicture(index, width, width * this.ratio);
        this.pictures.push(picture);
        resolve(picture as unknown as PagePicture);
      };
      signal.addEventListener("abort", () => reject(signal.reason));
      this.drawings.push({ index, width, signal, finish, fail: reject });
    });
  }
  close(): void {}
  /** The drawings under way, as "page:width". */
  get open(): string[] {
    return this.drawings.filter((d) => !d.signal.aborted).map((d) => `${d.index}:${d.width}`);
  }
  forgetAborted(): void {
    const going = this.drawings.filter((drawing) => !drawing.signal.aborted);
    this.drawings.splice(0, this.drawings.length, ...going);
  }
  async finishAll(): Promise<void> {
    for (const drawing of this.drawings.splice(0)) drawing.finish();
    await settle();
  }
  /** Draws until nothing more is requested. Returns how many drawings that took. */
  async finishEverything(most = 1000): Promise<number> {
    let count = 0;
    while (this.drawings.length > 0) {
      count += this.drawings.length;
      if (count > most) throw new Error("The pool does not come to rest.");
      await this.finishAll();
    }
    return count;
  }
}

async function settle(): Promise<void> {
  for (let i = 0; i < 5; i++) await Promise.resolve();
}

const at = (width: number, ...indices: number[]): { index: number; width: number }[] =>
  indices.map((index) => ({ index, width }));

/** Returns a pool that has drawn page 40, slowly, and page 41, which it drew roughly in much less time. */
async function slowPool(source: FakeSource, options: PagePoolOptions = {}): Promise<PagePool> {
  let time = 0;
  const pool = new PagePool(source, { ...options, now: () => time });
  pool.want(at(900, 40));
  time += 300;
  await source.finishAll();
  pool.want(at(900, 41));
  time += 10;
  await source.finishAll();
  time += 300;
  await source.finishAll();
  return pool;
}

describe("what is drawn", () => {
  it("draws the first pages sharp at once, at most two at a time", async () => {
    const source = new FakeSource();
    const pool = new PagePool(source);
    pool.want(at(900, 4, 5, 6));
    expect(source.open).toEqual(["4:900", "5:900"]);
    await source.finishAll();
    expect(pool.get(4)?.width).toBe(900);
    expect(source.open).toEqual(["6:900"]);
  });

  it("draws the pages in sight roughly first, where that is much quicker", async () => {
    const source = new FakeSource();
    const pool = await slowPool(source);
    pool.want(at(900, 4, 5, 6));
    expect(source.open).toEqual(["4:300", "5:300"]);
    await source.finishAll();
    expect(pool.get(4)?.width).toBe(300);
    expect(pool.sharpness(4)).toBe(0);
    expect(source.open).toEqual(["4:900", "5:900"]);
    await source.finishAll();
    expect(pool.get(4)?.width).toBe(900);
    expect(pool.sharpness(4)).toBe(900);
    expect(source.open).toEqual(["6:900"]);
  });

  it("is ready once those are sharp that may come next, as far as memory allows", async () => {
    const source = new FakeSource();
    const pool = new PagePool(source, { maxPages: 3 });
    pool.want(at(900, 4, 5, 6, 7));
    await source.finishAll();
    expect([pool.settled, pool.ready]).toEqual([true, false]);
    await source.finishAll();
    expect([pool.settled, pool.ready, source.open.length]).toEqual([true, true, 0]);
  });

  it("says that a picture is out of date until its page has been drawn again", async () => {
    const source = new FakeSource();
    const pool = new PagePool(source);
    pool.want(at(900, 4));
    await source.finishEverything();
    expect(pool.isOutdated(4)).toBe(false);
    pool.redraw(4);
    expect([pool.isOutdated(4), pool.isOutdated(5)]).toEqual([true, false]);
    await source.finishEverything();
    expect(pool.isOutdated(4)).toBe(false);
  });

  it("draws nothing roughly where sharp pictures are quick", async () => {
    let time = 0;
    const source = new FakeSource();
    const pool = new PagePool(source, { now: () => time, drawing: 1 });
    pool.want(at(900, 0));
    time += 12;
    await source.finishAll();
    pool.want(at(900, 1));
    expect(source.open).toEqual(["1:900"]);
  });

  it("tries a rough picture where a sharp one was slow, and no more where that was as slow", async () => {
    let time = 0;
    const source = new FakeSource();
    const pool = new PagePool(source, { now: () => time, drawing: 1 });
    pool.want(at(900, 0));
    time += 300;
    await source.finishAll();
    pool.want(at(900, 1));
    expect(source.open).toEqual(["1:300"]);
    time += 290;
    await source.finishAll();
    time += 300;
    await source.finishAll();
    pool.want(at(900, 2));
    expect(source.open).toEqual(["2:900"]);
  });

  it("draws at once what is wanted roughly", async () => {
    const source = new FakeSource();
    const pool = new PagePool(source);
    pool.want([{ index: 4, width: 500, isRough: true }, ...at(900, 5)]);
    expect(source.open).toEqual(["4:500", "5:900"]);
  });

  it("aborts what is no longer wanted and draws what is", async () => {
    const source = new FakeSource();
    const pool = new PagePool(source);
    pool.want(at(600, 4, 5));
    const [first] = source.drawings;
    pool.want(at(600, 20, 21));
    expect(first?.signal.aborted).toBe(true);
    expect(source.open).toEqual(["20:600", "21:600"]);
  });

  it("draws again when a page is wanted in another width, but not when roughly and narrower", async () => {
    const source = new FakeSource();
    const pool = new PagePool(source);
    pool.want(at(600, 1));
    await source.finishEverything();
    pool.want([{ index: 1, width: 400, isRough: true }]);
    expect(source.open).toEqual([]);
    pool.want(at(400, 1));
    expect(source.open).toEqual(["1:400"]);
    await source.finishEverything();
    pool.want(at(1200, 1));
    expect(source.open).toEqual(["1:1200"]);
    expect(pool.get(1)?.width).toBe(400);
  });

  it("ignores pages that the book does not have, and a page named twice", async () => {
    const source = new FakeSource(3);
    const pool = new PagePool(source);
    pool.want(at(300, -1, 2, 2, 3));
    expect(source.open).toEqual(["2:300"]);
  });

  it("draws, while paused, only what would leave a page in sight blank", async () => {
    const source = new FakeSource();
    const pool = await slowPool(source);
    pool.paused = true;
    pool.want(at(600, 0, 1, 2, 3));
    await source.finishAll();
    expect(pool.get(0)?.width).toBe(200);
    expect(source.open).toEqual([]);
    pool.paused = false;
    expect(source.open).toEqual(["0:600", "1:600"]);
  });
});

describe("what is kept", () => {
  it("keeps at most the given number of pages and drops the farthest", async () => {
    const source = new FakeSource();
    const dropped: number[] = [];
    const pool = new PagePool(source, {
      maxPages: 4,
      onDrop: (picture) => dropped.push((picture as unknown as FakePicture).index),
    });
    pool.want(at(30, 0, 1, 2, 3));
    await source.finishEverything();
    dropped.length = 0;
    pool.want(at(30, 2, 3, 4));
    await source.finishEverything();
    expect(dropped).toEqual([0]);
    expect([0, 1, 2, 3, 4].map((index) => pool.get(index) !== null)).toEqual([
      false,
      true,
      true,
      true,
      true,
    ]);
  });

  it("comes to rest where more is wanted than fits", async () => {
    const source = new FakeSource(100, 3);
    const pool = new PagePool(source, { maxPages: 50, maxBytes: 4 * 100 * 300 * 5 });
    pool.want(at(100, ...Array.from({ length: 40 }, (_, i) => i)));
    await source.finishEverything();
    expect(pool.bytes).toBeLessThanOrEqual(4 * 100 * 300 * 5);
    expect(pool.get(0)?.width).toBe(100);
    expect(pool.get(1)?.width).toBe(100);
  });

  it("holds the pages in sight even beyond its bytes", async () => {
    const source = new FakeSource();
    const pool = new PagePool(source, { maxBytes: 1000 });
    pool.want(at(100, 7, 8, 9));
    await source.finishEverything();
    expect(pool.get(7)?.width).toBe(100);
    expect(pool.get(8)?.width).toBe(100);
    expect(pool.get(9)).toBeNull();
  });

  it("shows the better picture before it drops and closes the rough one", async () => {
    const source = new FakeSource();
    const order: string[] = [];
    const pool: PagePool = await slowPool(source, {
      onArrive: (index) => index < 40 && order.push(`arrive ${pool.get(index)?.width}`),
      onDrop: (picture) => {
        const { index, isClosed } = picture as unknown as FakePicture;
        if (index < 40) order.push(`drop ${picture.width} ${isClosed ? "closed" : "open"}`);
      },
    });
    pool.want(at(900, 0));
    await source.finishEverything();
    expect(order).toEqual(["arrive 300", "arrive 900", "drop 300 open"]);
    expect(source.pictures.find(({ index }) => index === 0)?.isClosed).toBe(true);
  });

  it("closes every picture and aborts every drawing when it is closed", async () => {
    const source = new FakeSource();
    const pool = new PagePool(source);
    pool.want(at(900, 0, 1, 2));
    await source.finishAll();
    pool.close();
    expect(source.pictures.every((picture) => picture.isClosed)).toBe(true);
    expect(source.open).toEqual([]);
    pool.want(at(900, 3));
    expect(source.open).toEqual([]);
  });

  it("closes a picture that arrives after its page was given up", async () => {
    const source = new FakeSource();
    const pool = new PagePool(source);
    pool.want(at(300, 0));
    const [drawing] = source.drawings;
    drawing?.finish();
    pool.want(at(300, 9));
    await settle();
    expect(source.pictures[0]?.isClosed).toBe(true);
    expect(pool.get(0)).toBeNull();
  });
});

/** A clock that the test drives. */
class FakeTimers {
  readonly waiting = new Map<() => void, number>();
  readonly later = (call: () => void, milliseconds: number): (() => void) => {
    this.waiting.set(call, milliseconds);
    return () => this.waiting.delete(call);
  };
  /** Fires all timers. */
  elapse(): void {
    for (const [call, milliseconds] of [...this.waiting]) {
      expect(milliseconds).toBe(slowTime);
      this.waiting.delete(call);
      call();
    }
  }
}

describe("what takes long", () => {
  it("says so, and the other pages are drawn beside it", async () => {
    const source = new FakeSource();
    const timers = new FakeTimers();
    const slow: number[] = [];
    const pool = new PagePool(source, { later: timers.later, onSlow: (index) => slow.push(index) });
    pool.want(at(300, 4, 5, 6, 7));
    expect([pool.slow(4), pool.slow(5)]).toEqual([false, false]);
    timers.elapse();
    expect(slow).toEqual([4, 5]);
    expect([pool.slow(4), pool.slow(5), pool.slow(6)]).toEqual([true, true, false]);
    // Two continue beside the two slow ones, and no more.
    expect(source.open).toEqual(["4:300", "5:300", "6:300", "7:300"]);
    source.drawings.splice(2).map((drawing) => drawing.finish());
    await settle();
    expect([pool.get(6)?.width, pool.get(7)?.width]).toEqual([300, 300]);
    // When they finish at last they are shown as any page is.
    await source.finishEverything();
    expect([pool.slow(4), pool.get(4)?.width]).toEqual([false, 300]);
    expect(timers.waiting.size).toBe(0);
  });

  it("leaves at most as many slow ones behind as are drawn at a time", () => {
    const source = new FakeSource();
    const timers = new FakeTimers();
    const pool = new PagePool(source, { later: timers.later, drawing: 1 });
    pool.want(at(300, 0, 1, 2, 3), 4);
    timers.elapse();
    timers.elapse();
    timers.elapse();
    expect(source.open).toEqual(["0:300", "1:300"]);
    // A page no longer wanted makes room, slow or not.
    pool.want(at(300, 2, 3), 4);
    expect(source.open).toEqual(["2:300"]);
    pool.close();
    expect(timers.waiting.size).toBe(0);
  });

  it("says nothing of a page that is shown already, and only drawn sharper", async () => {
    const source = new FakeSource();
    const timers = new FakeTimers();
    const slow: number[] = [];
    const pool = await slowPool(source, {
      later: timers.later,
      onSlow: (index) => slow.push(index),
    });
    pool.want(at(900, 0), 1);
    await source.finishAll();
    expect(source.open).toEqual(["0:900"]);
    timers.elapse();
    expect([slow, pool.slow(0)]).toEqual([[], false]);
  });
});

describe("what fails", () => {
  it("tells why, does not try again by itself, and goes on with the other pages", async () => {
    const source = new FakeSource();
    const arrived: number[] = [];
    const pool = new PagePool(source, { drawing: 1, onArrive: (index) => arrived.push(index) });
    pool.want(at(300, 0, 1));
    source.drawings.shift()?.fail(new BookError("Page 1 is damaged."));
    await settle();
    expect(pool.failed(0)?.message).toBe("Page 1 is damaged.");
    expect(arrived).toEqual([0]);
    await source.finishEverything();
    expect(pool.get(1)?.width).toBe(300);
    expect(pool.failed(1)).toBeNull();
  });

  it("tries again once the page has been off the list, or when asked to", async () => {
    const source = new FakeSource();
    const pool = new PagePool(source);
    pool.want(at(300, 0));
    source.drawings.shift()?.fail(new BookError("No."));
    await settle();
    pool.want(at(300, 0));
    expect(source.open).toEqual([]);
    pool.retry();
    expect(source.open).toEqual(["0:300"]);
    source.drawings.shift()?.fail(new Error("odd"));
    await settle();
    expect(pool.failed(0)?.message).toBe(
      "Page 1 of Fake could not be drawn (Error: odd); turn back to it to try again.",
    );
    pool.want(at(300, 50));
    pool.want(at(300, 0));
    expect(source.open).toEqual(["0:300"]);
  });

  it("keeps the rough picture where the sharp one fails", async () => {
    const source = new FakeSource();
    const pool = await slowPool(source);
    pool.want(at(300, 0));
    await source.finishAll();
    source.drawings.shift()?.fail(new BookError("No."));
    await settle();
    expect(pool.get(0)?.width).toBe(100);
    expect(pool.failed(0)).toBeNull();
    expect(source.open).toEqual([]);
  });
});

it("holds its promises whatever is asked of it", async () => {
  const seed = (Date.now() % 0x7fffffff) | 1;
  const random = generator(seed);
  const source = new FakeSource(60, 1.4);
  const live = new Set<PagePicture>();
  const bounds = { maxPages: 6, maxBytes: 900_000 };
  const pool = new PagePool(source, {
    ...bounds,
    onArrive: (index) => {
      const picture = pool.get(index);
      if (picture) live.add(picture);
    },
    onDrop: (picture) => live.delete(picture),
  });
  const trace = `seed ${seed}`;
  for (let step = 0; step < 400; step++) {
    const first = Math.floor(random() * 60);
    const count = Math.floor(random() * 9);
    const width = 40 + Math.floor(random() * 200);
    pool.want(at(width, ...Array.from({ length: count }, (_, i) => first + i)));
    expect(source.open.length, trace).toBeLessThanOrEqual(2);
    for (let i = 0; i < random() * 6; i++) {
      const drawing = source.drawings.splice(Math.floor(random() * source.drawings.length), 1)[0];
      if (random() < 0.1) drawing?.fail(new BookError("Now and then."));
      else drawing?.finish();
      await settle();
    }
    source.forgetAborted();
    const held = [...Array(60).keys()].flatMap((index) => pool.get(index) ?? []);
    expect(new Set(held), trace).toEqual(live);
    expect(held.length, trace).toBeLessThanOrEqual(bounds.maxPages);
    expect(
      held.some((picture) => (picture as unknown as FakePicture).isClosed),
      trace,
    ).toBe(false);
  }
  await source.finishEverything(500);
  pool.close();
  expect(live.size, trace).toBe(0);
});

/**
 * Returns a generator of numbers from 0 to 1, repeatable by its seed: a linear
 * congruential generator (Numerical Recipes).
 */
function generator(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}
