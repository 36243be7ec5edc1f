/**
 * Takes the pictures of the README and the docs from the real thing: the built
 * reader with the book that comes with it, two of the examples and the playground, in a real
 * Chromium, its clock driven by hand so that a moment of a turn is the same
 * moment every time.
 *
 *   node scripts/pictures.mjs [name ...]
 */
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { serve as serveExamples } from "../examples/serve.mjs";
import { chromiumArguments, findChromium } from "./chromium.mjs";
import { filmStrip } from "./film_strip.mjs";
import { driveClock, serve } from "./reader_page.mjs";
import { paperStocks } from "./source_tables.mjs";

const root = join(import.meta.dirname, "..");

const papers = await paperStocks();
const out = join(root, "docs/pictures");
const wide = { width: 1280, height: 800 };
/** Of what moves, whose pictures take many bytes. */
const moving = { width: 1152, height: 720 };
const small = { width: 600, height: 450 };
const phone = { width: 390, height: 844 };

/** A calendar with room on the table beside it, and some above and below. */
const besideCalendar = {
  example: "18-tear-off.html",
  viewport: { width: 1200, height: 480 },
  shown: { margin: 0.09 },
  page: 1,
};

/** Each picture: where the book lies open, how it is shown, and what is done before it is taken. */
const pictures = {
  cover: { page: 1, viewport: moving },
  spread: { page: 18 },
  "turn-1": { page: 18, viewport: moving, turn: 240 },
  "turn-2": { page: 18, viewport: moving, turn: 400 },
  "cover-opening": { page: 1, viewport: moving, turn: 420 },
  riffle: { page: 60, riffle: 870 },
  drag: { page: 18, viewport: moving, drag: [0.82, 0.88, 0.6, 0.72] },
  phone: { page: 19, viewport: phone, scale: 2 },
  dark: { page: 30, shown: { controls: true, theme: "night" } },
  zoom: { page: 19, zoom: [4, 0.62, 0.42] },
  "right-to-left": { example: "03-manga.html", page: 3, viewport: moving, turn: 400 },
  calendar: {
    example: "04-calendar.html",
    page: 12,
    viewport: { width: 800, height: 1000 },
    turn: 400,
  },
  // Film strips: what is done in the frames, and the times between them in milliseconds.
  "tear-off": {
    example: "18-tear-off.html",
    viewport: { width: 900, height: 480 },
    shown: { margin: 0.15 },
    page: 1,
    strip: {
      act: tearOut,
      after: [200, 250, 250, 450],
      clip: { x: 280, y: 0, width: 620, height: 480 },
    },
  },
  "dog-ear-pressed": {
    page: 18,
    viewport: { width: 960, height: 600 },
    shown: { foldBookmarks: true },
    strip: {
      act: drawCornerIn,
      after: [60, 1100, 300, 250],
      release: 3,
      clip: { x: 470, y: 250, width: 400, height: 350 },
    },
  },
  crumple: {
    ...besideCalendar,
    strip: {
      act: tearAndCrumple,
      after: [600, 300, 250, 650],
      clip: { x: 860, y: 90, width: 340, height: 320 },
    },
  },
  "loose-sheets": {
    ...besideCalendar,
    viewport: { width: 1400, height: 480 },
    strip: {
      act: tearOutTwo,
      move: pileUp,
      after: [1000, 2600, 3600, 2000],
      clip: { x: 890, y: 0, width: 510, height: 480 },
    },
  },
  "tear-across": {
    ...besideCalendar,
    strip: {
      act: tearOutAndAcross,
      after: [430, 220, 550, 500],
      clip: { x: 790, y: 0, width: 410, height: 480 },
    },
  },
  "tear-out-folded": {
    ...besideCalendar,
    shown: { margin: 0.2 },
    strip: {
      act: foldAndTearOut,
      after: [16, 144, 200, 900],
      clip: { x: 440, y: 0, width: 660, height: 480 },
    },
  },
  "tear-bent": {
    ...besideCalendar,
    shown: { margin: 0.2 },
    strip: {
      act: tearOutAndHold,
      move: swingApart,
      after: [0, 0, 0, 250],
      clip: { x: 480, y: 0, width: 720, height: 480 },
    },
  },
  ...Object.fromEntries(
    [0, 350, 640].map((unfold, k) => [
      `fold-out-${k + 1}`,
      { example: "20-fold-outs.html", viewport: { width: 900, height: 480 }, page: 5, unfold },
    ]),
  ),
  ...Object.fromEntries(
    [0, 400, 1000, 1600].map((unfold, k) => [
      `leporello-${k + 1}`,
      { example: "20-fold-outs.html", viewport: { width: 900, height: 480 }, page: 11, unfold },
    ]),
  ),
  ...Object.fromEntries(
    papers.map((stock) => [
      `stock-${stock}`,
      { page: 18, viewport: small, stock, drag: [0.86, 0.83, 0.66, 0.5] },
    ]),
  ),
};

/** Runs in the page too: a frame that nobody sees is not drawn, as software GL takes a second for each. */
function drawWhatIsSeen() {
  const { prototype } = WebGL2RenderingContext;
  const { drawElements, getParameter } = prototype;
  // As on a graphics card, where what moves is as sharp as what rests.
  prototype.getParameter = function (name) {
    return name === this.RENDERER ? "a graphics card" : getParameter.call(this, name);
  };
  prototype.drawElements = function (...what) {
    if (window.clock.last) drawElements.apply(this, what);
  };
}

/** Has the uppermost leaf torn out. */
async function tearOut(page) {
  await page.evaluate(() => void document.querySelector("turnleaf-book").tearOut());
  // What tears it is there before the clock goes on.
  await page.waitForTimeout(1000);
}

/** Tears out and begins to crumple what lies beside the book then. */
async function tearAndCrumple(page) {
  await tearOut(page);
  await page.evaluate(() => {
    window.clock.pass(2600);
    document.querySelector("turnleaf-book").crumple();
  });
}

/** Tears out two days one after the other: the second is put aside upon the first. */
async function tearOutTwo(page) {
  await tearOut(page);
  await page.evaluate(() => window.clock.pass(2600));
  await tearOut(page);
}

/** Crumples the upper of two sheets, tears a third out, which falls upon the ball, and tears that across. */
async function pileUp(page, k) {
  if (k === 1) {
    await page.evaluate(() => {
      window.clock.pass(1600);
      document.querySelector("turnleaf-book").crumple();
    });
  }
  if (k === 2) await tearOut(page);
  if (k === 3) {
    await page.evaluate(() => {
      document.querySelector("turnleaf-book").tearAcross({ x: 0, y: 0.5 }, { x: 1, y: 0.45 });
    });
  }
}

/** Tears out, and begins to tear across what lies beside the book then. */
async function tearOutAndAcross(page) {
  await tearOut(page);
  await page.evaluate(() => {
    window.clock.pass(2600);
    document.querySelector("turnleaf-book").tearAcross({ x: 0, y: 0.42 }, { x: 1, y: 0.55 });
  });
}

/** Has the clock go on until a command of the book, by its name and arguments, is done: what it needs is loaded in real time. */
async function carriedOut(page, command, ...how) {
  await page.evaluate(
    ([command, how]) => {
      window.isDone = false;
      const done = () => {
        window.isDone = true;
      };
      document
        .querySelector("turnleaf-book")
        [command](...how)
        .then(done);
    },
    [command, how],
  );
  while (!(await page.evaluate(() => window.isDone))) {
    await page.evaluate(() => window.clock.pass(100));
    await page.waitForTimeout(100);
  }
}

/** Folds the right page in two, then tears it out. */
async function foldAndTearOut(page) {
  await carriedOut(page, "fold", 1, { x: 0, y: 0.6 }, { x: 1, y: 0.6 }, 160);
  await tearOut(page);
}

/** Has two fingers take what was torn out where it lies, on either side of the middle of its left edge. */
async function tearOutAndHold(page) {
  await tearOut(page);
  await page.evaluate(() => {
    window.clock.pass(2600);
    const element = document.querySelector("turnleaf-book");
    const canvas = element.shadowRoot.querySelector("canvas");
    // Pointers without a device cannot be captured.
    canvas.setPointerCapture = () => {};
    window.fingers = (name, places) => {
      for (const [k, [clientX, clientY]] of places.entries()) {
        const who = { pointerId: k + 1, pointerType: "touch", isPrimary: k === 0, buttons: 1 };
        const how = { bubbles: true, composed: true, cancelable: true, clientX, clientY };
        canvas.dispatchEvent(new PointerEvent(name, { ...who, ...how }));
      }
    };
    window.fingersAt = (away, degrees) => {
      const angle = ((90 + degrees) * Math.PI) / 180;
      const [x, y] = [away * Math.cos(angle), away * Math.sin(angle)];
      return [
        [777 - x, 240 - y],
        [777 + x, 240 + y],
      ];
    };
    window.fingers("pointerdown", window.fingersAt(50, 0));
  });
}

/** Has both fingers go apart, and swing as they do; at last they come back and let go. */
async function swingApart(page, k) {
  await page.evaluate((k) => {
    for (let frame = 1; frame <= 16; frame++) {
      const part = (16 * k + frame) / 48;
      // Torn through, each brings its piece back beside the other's.
      const places = k < 3 ? [50 + 190 * part, 50 * part] : [240 - 10 * frame, 50];
      window.fingers("pointermove", window.fingersAt(...places));
      window.clock.pass(1000 / 60);
    }
    if (k === 3) window.fingers("pointerup", window.fingersAt(80, 50));
  }, k);
}

/** Draws the foot corner of the right page in over it. */
async function drawCornerIn(page, { width, height }) {
  // What folds pages is loaded, and the book bound by it, before the corner is grabbed.
  for (const command of ["dogEar", "unfold"]) await carriedOut(page, command, 2);
  const [x0, y0, x1, y1] = [0.855, 0.928, 0.798, 0.833];
  await page.mouse.move(x0 * width, y0 * height);
  await page.mouse.down();
  for (let k = 1; k <= 12; k++) {
    const at = (from, to) => from + ((to - from) * k) / 12;
    await page.mouse.move(at(x0, x1) * width, at(y0, y1) * height);
    await page.evaluate(() => window.clock.pass(30));
  }
}

/** Takes the frames of a film strip. */
async function takeStrip(page, viewport, { act, move, after, release, clip }) {
  const frames = [];
  await act(page, viewport);
  for (const [k, milliseconds] of after.entries()) {
    if (k === release) await page.mouse.up();
    await move?.(page, k);
    const rests = await page.evaluate((milliseconds) => {
      window.clock.pass(milliseconds);
      if (!window.clock.rests) return false;
      // It has come to rest before, in a frame that was not drawn.
      document.querySelector("turnleaf-book").redraw();
      return true;
    }, milliseconds);
    // What is loaded for it comes in real time.
    await page.waitForTimeout(500);
    if (rests) await page.evaluate(() => window.clock.pass(1));
    frames.push(await page.screenshot({ clip }));
  }
  return frames;
}

async function take(browser, reader, examples, name) {
  const {
    page: number,
    example,
    viewport = wide,
    scale,
    shown,
    stock,
    zoom,
    turn,
    riffle,
    drag,
    strip,
    unfold,
  } = pictures[name];
  const page = await browser.newPage({ viewport, deviceScaleFactor: scale });
  page.setDefaultTimeout(180_000);
  await page.addInitScript(driveClock);
  await page.addInitScript(drawWhatIsSeen);
  await page.goto(example ? examples + example : `${reader}#page=${number}`);
  await page.waitForFunction(() => document.querySelector("turnleaf-book")?.pageCount);
  const settled = () =>
    page.waitForFunction(() => document.querySelector("turnleaf-book").settled, null, {
      polling: 100,
    });
  if (example) {
    await page.evaluate((number) => {
      const book = document.querySelector("turnleaf-book");
      Object.assign(book.style, { position: "fixed", inset: "0" });
      book.page = number;
      window.clock.pass(4000);
    }, number);
  }
  // The book alone, on the warm desk, where nothing else is asked for.
  await page.evaluate((shown) => Object.assign(document.querySelector("turnleaf-book"), shown), {
    controls: false,
    theme: "light",
    ...shown,
  });
  await settled();
  // The neighbours too, so that the page beneath is there.
  await page.waitForTimeout(3000);
  if (zoom) {
    const [level, x, y] = zoom;
    const at = { x: x * viewport.width, y: y * viewport.height };
    await page.evaluate(
      ([level, at]) => document.querySelector("turnleaf-book").zoomTo(level, at),
      [level, at],
    );
    await settled();
    // Its sharper picture.
    await page.waitForTimeout(3000);
  }
  await page.evaluate(() => {
    window.clock.free = false;
  });
  if (stock) {
    await page.evaluate((stock) => {
      document.querySelector("turnleaf-book").stock = stock;
    }, stock);
  }
  if (turn) {
    await page.evaluate((milliseconds) => {
      document.querySelector("turnleaf-book").next();
      window.clock.pass(milliseconds);
    }, turn);
  }
  if (riffle) {
    // One call every 75 ms, as a held key repeats, and time between for the pages that come into sight to be drawn.
    for (let t = 0; t < riffle; t += 75) {
      await page.evaluate(() => {
        document.querySelector("turnleaf-book").next();
        window.clock.pass(75);
      });
      await page.waitForTimeout(2500);
    }
    await page.waitForTimeout(5000);
    await page.evaluate(() => window.clock.pass(1));
  }
  if (drag) {
    const [x0, y0, x1, y1] = drag.map(
      (fraction, i) => fraction * (i % 2 ? viewport.height : viewport.width),
    );
    await page.mouse.move(x0, y0);
    await page.mouse.down();
    await page.mouse.move(x1, y1, { steps: 8 });
    await page.evaluate(() => window.clock.pass(700));
  }
  if (unfold) {
    // Its flap is there before the clock goes on.
    await page.evaluate(
      (number) => void document.querySelector("turnleaf-book").unfold(number),
      number,
    );
    await page.waitForTimeout(3000);
    await page.evaluate((milliseconds) => window.clock.pass(milliseconds), unfold);
  }
  const file = join(out, `${name}.png`);
  if (strip) {
    const frames = await takeStrip(page, viewport, strip);
    writeFileSync(file, await filmStrip(browser, frames));
  } else await page.screenshot({ path: file });
  await page.close();
  console.log(`docs/pictures/${name}.png`);
}

/** The playground: its settings, and what is done before its picture is taken. */
const playgrounds = {
  // In the middle of a turn by the corner, with what the paper's figures show.
  playground: { link: "masses=yes&springs=yes", button: "Turn by corner", pass: 480 },
  // The sheet folded along two lines, beside the one without creases.
  "playground-creases": {
    link: "left=sheet-synchronised&creases=62.0.100.27.150_45.100.100.62.-120",
    viewport: { width: 1280, height: 1000 },
    pass: 2500,
  },
};

async function takePlayground(browser, name) {
  const { link, button, pass, viewport = wide } = playgrounds[name];
  const playground = await serve("playground");
  try {
    const page = await browser.newPage({ viewport, locale: "en-GB" });
    page.setDefaultTimeout(180_000);
    await page.addInitScript(driveClock);
    await page.goto(`${playground.url}#${link}`);
    await page.waitForFunction(() => document.querySelector(".plot p")?.textContent);
    await page.evaluate(() => {
      window.clock.free = false;
    });
    if (button) await page.getByRole("button", { name: button }).click();
    await page.evaluate((milliseconds) => window.clock.pass(milliseconds), pass);
    await page.screenshot({ path: join(out, `${name}.png`) });
    await page.close();
    console.log(`docs/pictures/${name}.png`);
  } finally {
    playground.stop();
  }
}

mkdirSync(out, { recursive: true });
const all = [...Object.keys(pictures), ...Object.keys(playgrounds)];
const names = process.argv.length > 2 ? process.argv.slice(2) : all;
const [reader, examples] = await Promise.all([serve(), serveExamples()]);
const browser = await chromium.launch({ executablePath: findChromium(), args: chromiumArguments });
try {
  for (const name of names) {
    if (name in playgrounds) await takePlayground(browser, name);
    else await take(browser, reader.url, examples.url, name);
  }
} finally {
  await browser.close();
  reader.stop();
  await examples.stop();
}
