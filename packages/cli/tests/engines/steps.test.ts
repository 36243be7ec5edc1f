/** One list of steps that every engine goes through: Chromium, Firefox and WebKit. */

import { readFileSync } from "node:fs";
import { PNG } from "pngjs";
import type { TurnleafBook } from "turnleaf";
import { afterAll, beforeAll, beforeEach, describe, expect, test } from "vitest";
import { serveViewer, type ViewerSite } from "../viewer_page.ts";
import { startChromium } from "./chromium.ts";
import type { DrivenBrowser, StartBrowser } from "./driven_browser.ts";
import { startFirefox, startHeadlessFirefox } from "./firefox.ts";
import { startWebKit } from "./webkit.ts";

/** The page's state for its scripts, besides the document. */
interface PageState {
  book: TurnleafBook;
  /** Errors, warnings and violations of the policy since the page was loaded. */
  complaints: string[];
  /** Animation frames that scripts requested. */
  frames: number;
}
declare global {
  var state: PageState;
}

const file = readFileSync(new URL("../../../../books/moby-dick.pdf", import.meta.url));

/** The viewer's minimum policy. */
const policy = [
  "default-src 'none'",
  "script-src 'self' 'wasm-unsafe-eval' 'nonce-map'",
  "worker-src blob:",
  "style-src 'self'",
  "img-src 'self' blob: data:",
  "connect-src 'self'",
].join("; ");

/** Where the book lies on the page, CSS pixels: small, because of software rendering. */
const box = { left: 8, top: 8, width: 264, height: 192 } as const;

/** Returns the pixel of the page at fractions of the book's width and height. */
const at = (x: number, y: number) =>
  [Math.round(box.left + x * box.width), Math.round(box.top + y * box.height)] as const;

/** The outer margin of the right page, in WebGL and on the 2D canvas. */
const foreEdge = at(0.88, 0.55);

/** Milliseconds after which a state that has not come is reported. */
const patience = 50_000;

interface Engine {
  readonly name: string;
  readonly start: StartBrowser;
  /** Whether it has WebGL 2; otherwise the book is shown on a 2D canvas. */
  readonly hasWebGL: boolean;
  readonly isHere: boolean;
}

// WebKitGTK, and a screen for Firefox, exist only on Linux.
const isLinux = process.platform === "linux";
const engines: readonly Engine[] = [
  { name: "Chromium", start: startChromium, hasWebGL: true, isHere: true },
  { name: "Firefox", start: startFirefox, hasWebGL: true, isHere: isLinux },
  { name: "Firefox, no WebGL", start: startHeadlessFirefox, hasWebGL: false, isHere: true },
  { name: "WebKitGTK", start: startWebKit, hasWebGL: true, isHere: isLinux },
];

const here = engines.filter(({ isHere }) => isHere).map((engine) => [engine.name, engine] as const);

describe.each(here)("%s", (_, { start, hasWebGL }) => {
  let browser: DrivenBrowser;
  let site: ViewerSite;
  let hasFailed = false;

  beforeAll(async () => {
    site = await serveViewer((path) => (path === "/book.pdf" ? file : null), policy);
    browser = await start();
  }, 120_000);
  afterAll(async () => {
    await browser?.close();
    await site?.stop();
  });
  beforeEach(({ skip, onTestFailed, task }) => {
    // Each step begins where the previous one ended.
    if (hasFailed) skip("a step before it failed");
    onTestFailed(() => {
      hasFailed = true;
    });
    Object.assign(task.meta, { browser: browser.version });
  });

  /** Waits, with each frame of the page, until a function of it returns a value, compared as JSON. */
  const comesToBe = async <T>(look: () => T, expected: NoInfer<T>): Promise<void> => {
    const last = await browser.run(
      `async () => {
        const end = performance.now() + ${patience};
        for (;;) {
          const value = (${look})();
          const isThere = JSON.stringify(value) === ${JSON.stringify(JSON.stringify(expected))};
          if (isThere || performance.now() > end) return value;
          await new Promise(requestAnimationFrame);
        }
      }` as never,
    );
    expect(last).toEqual(expected);
  };
  const pageShown = () => browser.run(() => state.book.page);
  const comesTo = (page: number) => comesToBe(() => state.book.page, page);
  const comesToRest = () => comesToBe(() => state.book.settled, true);
  const hasNoComplaint = async () =>
    expect(await browser.run(() => state.complaints.splice(0))).toEqual([]);

  /** Moves the pressed pointer to another place over some frames, as a reader does. */
  async function movePressed(
    from: readonly [number, number],
    to: readonly [number, number],
    steps = 10,
  ) {
    await browser.movePointer(...from);
    await browser.pressButton();
    for (let step = 1; step <= steps; step++) {
      const t = step / steps;
      await browser.movePointer(from[0] + (to[0] - from[0]) * t, from[1] + (to[1] - from[1]) * t);
      await browser.run(() => new Promise((resolve) => requestAnimationFrame(() => resolve(0))));
    }
    await browser.releaseButton();
  }

  /** Expects paper with ink well within the open pages. */
  async function showsPrintOnPaper() {
    const { width, data } = PNG.sync.read(await browser.screenshot());
    let [all, paper, ink] = [0, 0, 0];
    const [[left, top], [right, bottom]] = [at(0.15, 0.25), at(0.85, 0.85)];
    for (let y = top; y < bottom; y++) {
      for (let x = left; x < right; x++) {
        const [green, below] = [y, y + 1].map((y) => data[4 * (y * width + x) + 1]);
        all++;
        if (green > 225) paper++;
        // Shadows are soft; ink has edges, however small it is.
        if (Math.abs(green - below) > 12) ink++;
      }
    }
    expect(paper / all).toBeGreaterThan(0.3);
    expect(ink / all).toBeGreaterThan(0.1);
  }

  /** Returns the uppermost place on a page without text, at a fraction of the book's width. */
  async function bareAt(fraction: number): Promise<readonly [number, number]> {
    const [x] = at(fraction, 0);
    const y = await browser.run(
      (x, top, bottom) => {
        for (let y = top; y < bottom; y++) {
          const found = state.book.shadowRoot?.elementFromPoint(x, y);
          if (found?.localName === "canvas") return y;
        }
        return null;
      },
      x,
      // The book's head is above this when it is seen whole.
      at(0, 0.25)[1],
      at(0, 0.9)[1],
    );
    return [x, y ?? expect.fail("All of it is text.")];
  }

  test("opens a PDF", async () => {
    await browser.open(site.url);
    const opened = await browser.run((size) => {
      const complaints: string[] = [];
      const book = document.createElement("turnleaf-book") as TurnleafBook;
      globalThis.state = { book, complaints, frames: 0 };
      const hear = (target: EventTarget, name: string, say: (event: never) => unknown) =>
        target.addEventListener(name, (event) => complaints.push(String(say(event as never))));
      hear(globalThis, "error", ({ message }: ErrorEvent) => message);
      hear(globalThis, "unhandledrejection", ({ reason }: PromiseRejectionEvent) => reason);
      hear(document, "securitypolicyviolation", (violation: SecurityPolicyViolationEvent) =>
        [violation.effectiveDirective, violation.blockedURI].join(" "),
      );
      hear(book, "error", ({ detail }: CustomEvent<{ message: string }>) => detail.message);
      for (const level of ["error", "warn"] as const) {
        console[level] = (...words) => {
          const texts = words.map((word) =>
            word instanceof Error ? `${word}\n${word.stack}` : String(word),
          );
          complaints.push(texts.join(" "));
        };
      }
      const { requestAnimationFrame } = globalThis;
      globalThis.requestAnimationFrame = (call) => {
        state.frames++;
        return requestAnimationFrame(call);
      };
      Object.assign(book.style, { width: `${size.width}px`, height: `${size.height}px` });
      const done = new Promise((resolve) => {
        book.addEventListener("load", () => resolve(true), { once: true });
        book.addEventListener("error", () => resolve(complaints), { once: true });
      });
      // Fewer frames than usual are drawn in software.
      book.duration = 300;
      book.src = "book.pdf";
      document.body.append(book);
      return done;
    }, box);
    expect(opened).toBe(true);
    await comesToRest();
    const place = await browser.run(() => {
      const { left, top, width, height } = state.book.getBoundingClientRect();
      return { left, top, width, height };
    });
    expect(place).toEqual(box);
    expect(await browser.run(() => [state.book.pageCount, state.book.page])).toEqual([112, 18]);
    const drawn = site.asked.flatMap((path) => /\/(webgl|canvas2d)_backend-/.exec(path)?.[1] ?? []);
    // With both and nothing said, the context was lost for good; with the 2D canvas alone, there was none.
    const said = await browser.run(() => state.complaints.join("; "));
    expect(drawn, said).toEqual([hasWebGL ? "webgl" : "canvas2d"]);
    await showsPrintOnPaper();
    await hasNoComplaint();
  });

  test("a drag turns a leaf", async () => {
    await movePressed(foreEdge, at(0.12, 0.5));
    await comesTo(20);
    await comesToRest();
    await hasNoComplaint();
  });

  test("a click on the edge turns a leaf", async () => {
    await browser.movePointer(...foreEdge);
    await browser.pressButton();
    await browser.releaseButton();
    await comesTo(22);
    await comesToRest();
    await hasNoComplaint();
  });

  test("arrow keys turn leaves", async () => {
    await browser.run(() => state.book.focus());
    await browser.pressKeys("ArrowRight");
    await comesTo(24);
    await browser.pressKeys("ArrowLeft");
    await comesTo(22);
    await comesToRest();
    await hasNoComplaint();
  });

  test("a double click zooms, another zooms back", async () => {
    const isZoomed = () => browser.run(() => state.book.zoom > 1.2);
    // On a busy machine the two clicks may be too far apart for a double click, and the
    // page's text, which a click would select, may come after the place was looked for.
    const doubleClick = async (fraction: number, zoomed: boolean) => {
      for (let times = 0; times < 10 && (await isZoomed()) !== zoomed; times++) {
        await browser.movePointer(...(await bareAt(fraction)));
        await browser.doubleClick();
        await browser.run(async (zoomed) => {
          for (let k = 0; k < 60 && state.book.zoom > 1.2 !== zoomed; k++) {
            await new Promise(requestAnimationFrame);
          }
        }, zoomed);
        await comesToRest();
      }
      expect(await isZoomed()).toBe(zoomed);
    };
    await doubleClick(0.7, true);
    await doubleClick(0.5, false);
    expect(await browser.run(() => state.book.zoom)).toBe(1);
    expect(await pageShown()).toBe(22);
    await hasNoComplaint();
  });

  test("a search finds and marks a place", async () => {
    const shown = await browser.run(async () => {
      const hits = await state.book.search("never mind how long");
      return [hits.length, await state.book.showHit(hits[0] ?? null)];
    });
    expect(shown).toEqual([1, true]);
    await comesTo(18);
    await comesToRest();
    await comesToBe(() => {
      const mark = state.book.shadowRoot?.querySelector("[part~=mark-here]");
      return mark !== null && mark !== undefined && mark.getBoundingClientRect().width > 5;
    }, true);
    await browser.run(() => state.book.showHit(null));
    await hasNoComplaint();
  });

  test("text is selected with the mouse, copied and pasted", async () => {
    const heading = "Loomings";
    const boxOfHeading = () =>
      browser.run((text) => {
        const spans = [...(state.book.shadowRoot?.querySelectorAll("[part=text] span") ?? [])];
        const span = spans.find(({ textContent }) => textContent?.trim() === text);
        if (!span) return null;
        const { left, right, top, bottom } = span.getBoundingClientRect();
        return { left, right, middle: (top + bottom) / 2 };
      }, heading);
    await comesToBe(() => {
      const spans = [...(state.book.shadowRoot?.querySelectorAll("[part=text] span") ?? [])];
      return spans.some(({ textContent }) => textContent?.trim() === "Loomings");
    }, true);
    const { left, right, middle } = (await boxOfHeading()) ?? expect.fail();
    const pixels = Math.ceil(right) - Math.ceil(left) + 2;
    await movePressed([Math.ceil(left), middle], [Math.ceil(left) + pixels, middle], pixels);
    await browser.pressKeys("Control", "c");
    await browser.run(() => {
      const field = document.createElement("textarea");
      document.body.append(field);
      field.focus();
    });
    await browser.pressKeys("Control", "v");
    await comesToBe(() => document.querySelector("textarea")?.value.trim(), heading);
    await browser.run(() => document.querySelector("textarea")?.remove());
    expect(await pageShown()).toBe(18);
    await hasNoComplaint();
  });

  test("many leaves riffle", async () => {
    // There and back, so that leaves are seen at every angle.
    for (const page of [60, 18]) {
      expect(await browser.run((page) => state.book.goTo(page), page)).toBe(true);
      expect(await pageShown()).toBe(page);
    }
    await comesToRest();
    await showsPrintOnPaper();
    await hasNoComplaint();
  });

  test("destroy() leaves nothing behind", async () => {
    const left = await browser.run(async (hasWebGL) => {
      const canvas = state.book.shadowRoot?.querySelector("canvas");
      state.book.destroy();
      const frames = async (count: number): Promise<void> => {
        for (let k = 0; k < count; k++) await new Promise(requestAnimationFrame);
      };
      await frames(5);
      const before = state.frames;
      await frames(20);
      return {
        isOnPage: document.querySelector("turnleaf-book") !== null,
        hasContext: hasWebGL && canvas?.getContext("webgl2")?.isContextLost() === false,
        // But those of this test.
        frames: state.frames - before - 20,
      };
    }, hasWebGL);
    expect(left).toEqual({ isOnPage: false, hasContext: false, frames: 0 });
    await hasNoComplaint();
  });
});
