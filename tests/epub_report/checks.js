/**
 * Runs in the browser: the checks of w3c/epub-tests, each as its book states the
 * condition. A check returns whether it is met, or "n/a" if the
 * book then says that it does not apply.
 */

import { heard, heardBoth, heardOnPages, judged, readAloud, spoken } from "./reading_aloud.js";

/** Returns whether a colour is that of ink on a picture, rather than of paper. */
const isInk = (red, green, blue) => Math.min(red, green, blue) < 140;
const isPrinted = (...colour) => Math.min(...colour) < 235;
const isRed = (red, green, blue) => red > 200 && green < 60 && blue < 60;

/** How much faster than it was recorded a page that is read in six seconds is heard, to be seen meanwhile. */
const slower = 4;

/** The book opens and shows a text. */
const shows =
  (...wanted) =>
  async (book) => {
    if (book.error) return false;
    const text = (await book.texts()).join(" ");
    return wanted.every((words) => text.includes(words));
  };

/** The book opens; its pages are drawn. */
const opens = async (book) => !book.error && (await book.picture(1)).fraction(isInk) > 0;

/** The first page has a picture: more of it is coloured or grey than text alone would be. */
const showsPicture = async (book) => {
  const picture = await book.picture(1);
  return picture.fraction(isPrinted) > 0.04;
};

/** The book cannot be opened, and one sentence says so. */
const isRefused = (book) => book.error !== null;

/** The pages hold these texts, in order, one a page. */
const inOrder =
  (...wanted) =>
  async (book) => {
    const texts = await book.texts();
    return texts.length === wanted.length && wanted.every((words, k) => texts[k].includes(words));
  };

const pagesNumbered = (count) =>
  inOrder(...Array.from({ length: count }, (_, k) => `Page ${k + 1}`));

/** The width of a page of flowing text, in the unit of `size()`. */
const flowingWidth = 488;

/** Returns whether a text flows over several pages, from the one with some words on. */
async function flowsFrom(book, words) {
  const texts = await book.texts();
  const first = texts.findIndex((text) => text.includes(words));
  if (first < 0 || first + 1 >= texts.length) return false;
  const [size, next] = [await book.size(first + 1), await book.size(first + 2)];
  return size.width === flowingWidth && next.width === flowingWidth;
}

/** The side of a spread on which a page lies, in a window that shows two: "left" or "right". */
async function sideOf(book, page, width = 900, height = 500) {
  const element = await book.shown(width, height, { layout: "auto", cover: "none" });
  await element.goTo(page);
  const { left, right } = element.spread;
  return left === page ? "left" : right === page ? "right" : null;
}

/** The pages are in order, and each next one lies on a side of the one before. */
const leadsTo = (side) => async (book) => {
  const texts = await book.texts();
  const isInOrder = ["first", "second", "third", "last"].every((word, k) =>
    texts[k]?.includes(`appear ${word}`),
  );
  const element = await book.shown(1280, 800, { cover: "none" });
  await element.goTo(2);
  const { left, right } = element.spread;
  const pair = side === "right" ? [left, right] : [right, left];
  return isInOrder && pair[0] === 2 && pair[1] === 3;
};

/** The first two pages look the same. */
const looksAlike = async (book) => {
  const [one, two] = [await book.picture(1), await book.picture(2)];
  return one.differenceFrom(two) < 0.02;
};

/** Pages on which nothing is red. */
const noneIsRed =
  (...pages) =>
  async (book) => {
    for (const page of pages) {
      if ((await book.picture(page)).fraction(isRed) > 0.001) return false;
    }
    return true;
  };

/** The labels of the contents, and that each leads to its page. */
const contents =
  (...wanted) =>
  async (book) => {
    const outline = await book.outline();
    return (
      JSON.stringify(outline.map(({ title, page }) => [title, page])) === JSON.stringify(wanted)
    );
  };

/** The font that a book brings is that in which a text is set: without it, the page looks otherwise. */
const isSetInItsFont = async (book, others) => {
  const without = await others.without(/\.(otf|ttf|woff2?|odttf)$/);
  const [with_, plain] = [await book.picture(1), await without.picture(1)];
  without.close();
  return with_.differenceFrom(plain) > 0.002;
};

const not =
  (check) =>
  async (...args) =>
    !(await check(...args));

/** Pages lie beside each other in a window that shows two. */
const facesEachOther = (first) => async (book) =>
  (await sideOf(book, first)) === "left" && (await sideOf(book, first + 1)) === "right";

/** One page alone is shown where two would fit. */
const showsOnePage = async (book) => {
  const element = await book.shown(900, 500);
  return element.shownLayout === "single";
};

/** The first page is shown by itself, in the middle of a window where two would fit. */
const standsInTheMiddle = async (book) => {
  const [width, height] = [900, 500];
  const element = await book.shown(width, height);
  const { left, right } = element.spread;
  const [run] = await book.runs(1);
  // It may be seen in pieces, as the page curves.
  const pieces = () => [...element.shadowRoot.querySelectorAll(".text .print span")];
  for (let k = 0; k < 200 && !(element.settled && pieces().length > 0); k++) {
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  const seen = pieces().map((piece) => piece.getBoundingClientRect());
  const start = Math.min(...seen.map((piece) => piece.left));
  const scale = (Math.max(...seen.map((piece) => piece.right)) - start) / run.width;
  const middle = start + ((await book.size(1)).width / 2 - run.x) * scale;
  const off = middle - element.getBoundingClientRect().left - width / 2;
  // A shut book is seen from beside its middle; in a spread it would be off by a quarter.
  return [left, right].filter(Boolean).join() === "1" && Math.abs(off) < 0.05 * width;
};

/** The first link of the first page leads to a page. */
const linkLeadsTo = (page) => async (book) => {
  const [link] = await book.links(1);
  return link?.to.page === page;
};

/**
 * A link out of the book shows its address and asks; only then is it opened, in
 * a window of its own.
 */
const asksBefore = (address) => async (book) => {
  const element = await book.shown(900, 500);
  const find = (selector) => element.shadowRoot.querySelector(selector);
  for (let k = 0; k < 200 && !find(".text a"); k++) {
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  const link = find(".text a");
  const isLink = address.test(link.href);
  const opened = [];
  const { click } = HTMLAnchorElement.prototype;
  // What the browser would open is taken down here.
  HTMLAnchorElement.prototype.click = function () {
    opened.push([this.href, this.target]);
  };
  try {
    const isStopped = !link.dispatchEvent(
      new MouseEvent("click", { bubbles: true, cancelable: true }),
    );
    const question = find("[part=note]");
    const isAsked = question.matches(":popover-open") && question.textContent.includes(link.href);
    const isEarly = opened.length > 0;
    question.querySelector("button").click();
    const [first] = opened;
    return (
      isLink && isStopped && isAsked && !isEarly && first[0] === link.href && first[1] === "_blank"
    );
  } finally {
    HTMLAnchorElement.prototype.click = click;
  }
};

/** A sound below the text of the first page is played by the button that is seen there, and is decoded. */
const isHeard = async (book) => {
  const element = await book.shown(900, 500, { layout: "single" });
  const find = (selector) => element.shadowRoot.querySelector(selector);
  const becomes = async (condition) => {
    for (let k = 0; k < 200 && !condition(); k++) {
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    return condition();
  };
  const [text] = await book.runs(1);
  const [medium] = await book.source.media(0, new AbortController().signal);
  const button = () => find(".text [part=medium] button");
  const isBelow = medium.y > text.y;
  if (!(await becomes(() => button()?.offsetWidth > 20))) return false;
  button().click();
  const isPlayed = await becomes(() => {
    const player = find(".text audio");
    return player && player.currentTime > 0.2 && !player.muted && player.volume === 1;
  });
  return isBelow && isPlayed && find(".text audio").webkitAudioDecodedByteCount > 0;
};

/** Returns the title and what else the controls show of a book. */
async function shownDetails(book) {
  const element = await book.shown(900, 500, { controls: "" });
  return [element.bookTitle, ...element.details.map(({ value }) => value)];
}

/** Returns whether the first link of a page is to a note that is shown over the page. */
async function footnoteOn(book, page) {
  const [link] = await book.links(page);
  return link?.note !== undefined;
}

/** Returns the size of the first box with a border of ink on a picture: pixels; null if there is none. */
function boxIn(picture) {
  const { width, height } = picture;
  let top = null;
  for (let y = 0; y < height; y++) {
    let [run, longest] = [0, 0];
    for (let x = 0; x < width; x++) {
      run = isInk(...picture.at(x / (width - 1), y / (height - 1))) ? run + 1 : 0;
      longest = Math.max(longest, run);
    }
    // The line above the box, and the next one that is not of the same border, beneath it.
    if (longest < width / 10 || (top && y < top.y + 10)) continue;
    if (top) return { width: longest, height: y - top.y };
    top = { y };
  }
  return null;
}

/** A box has the content of another document in it, and is no square, as a script in it would make it. */
const showsFrame = async (book, others) => {
  const without = await others.without(/iframe_content/);
  const [shown, empty] = [await book.picture(1, 900), await without.picture(1, 900)];
  without.close();
  const box = boxIn(shown);
  return box !== null && box.width > 3 * box.height && shown.differenceFrom(empty) > 0.002;
};

/** A page says that something is wrong with it. */
const reportsError = async (book) => {
  if (book.error !== null || /damaged in line \d+/.test(await book.text(1))) return true;
  return "a chapter that is not well-formed is repaired, and says so only where something is missing";
};

/** One page of its own size for each picture of the spine. */
const plates = (count) => async (book) => {
  if (book.pageCount !== count) return false;
  for (const page of [1, 2, count]) {
    const picture = await book.picture(page);
    if (picture.fraction((...colour) => Math.min(...colour) < 200) < 0.05) return false;
  }
  return true;
};

const wait = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** Shows a book, and returns the element, what is scrolled in it, and the places of the pages in that. */
async function scrolled(book, width, height) {
  const element = await book.shown(width, height);
  const roll = element.shadowRoot.querySelector("[part=roll]");
  const sheets = () => [...(roll?.querySelectorAll(".roll-page") ?? [])];
  for (let k = 0; k < 200 && !sheets()[0]?.querySelector("canvas"); k++) await wait(50);
  return { element, roll, sheets };
}

/** Returns whether some pages are scrolled, at the latest after a while. */
async function hasSheets({ sheets }, count) {
  for (let k = 0; k < 100 && sheets().length !== count; k++) await wait(50);
  return sheets().length === count;
}

/** Returns whether a reader can scroll to the end of what is scrolled, page by page, and each is drawn. */
async function scrollsToItsEnd({ roll, sheets }) {
  const { overflowY, visibility } = getComputedStyle(roll);
  if (roll.hidden || overflowY !== "auto" || visibility !== "visible") return false;
  if (roll.scrollHeight <= roll.clientHeight) return false;
  for (const sheet of sheets()) {
    roll.scrollTop = sheet.offsetTop;
    for (let k = 0; k < 200 && !sheet.querySelector("canvas"); k++) await wait(50);
    if (!sheet.querySelector("canvas")) return false;
  }
  roll.scrollTop = roll.scrollHeight;
  return Math.abs(roll.scrollTop + roll.clientHeight - roll.scrollHeight) <= 1;
}

/** A finger goes from right to left over what is scrolled. */
function swipeOver(roll) {
  const { left, top, width, height } = roll.getBoundingClientRect();
  const touch = { pointerId: 9, pointerType: "touch", bubbles: true, composed: true };
  const at = (x) => ({ ...touch, clientX: left + x * width, clientY: top + height / 2 });
  roll.dispatchEvent(new PointerEvent("pointerdown", at(0.8)));
  roll.dispatchEvent(new PointerEvent("pointerup", at(0.3)));
}

/** Each chapter is scrolled by itself, and a swipe across leads from one to the next. */
const scrollsByChapters = async (book) => {
  const numbers = Array.from({ length: book.pageCount }, (_, k) => book.source.roll?.(k));
  const firsts = numbers.flatMap((roll, k) => (k === 0 || roll !== numbers[k - 1] ? [k + 1] : []));
  if (firsts.length !== 4) return false;
  // So low that the shortest chapter is longer.
  const shown = await scrolled(book, 600, 250);
  for (const [k, first] of firsts.entries()) {
    const count = (firsts[k + 1] ?? book.pageCount + 1) - first;
    if (!(await hasSheets(shown, count)) || shown.element.page !== first) return false;
    if (!(await scrollsToItsEnd(shown))) return false;
    swipeOver(shown.roll);
    if (k + 1 < firsts.length && shown.element.page !== firsts[k + 1]) return false;
    await wait(300);
  }
  return true;
};

/** All pages are one roll, as wide as the window if they are of fixed layout, without a gap. */
const scrollsAsOne = (isWide) => async (book) => {
  const shown = await scrolled(book, 600, 500);
  if (!(await hasSheets(shown, book.pageCount))) return false;
  if (!(await scrollsToItsEnd(shown))) return false;
  const boxes = shown.sheets().map((sheet) => sheet.getBoundingClientRect());
  const hangsTogether = boxes.every(
    (box, k) => k === 0 || Math.abs(box.top - boxes[k - 1].bottom) < 0.01,
  );
  const fits = boxes.every(({ width }) => !isWide || width === shown.roll.clientWidth);
  return hangsTogether && fits;
};

/** Pictures that are one roll. */
const rollOf = (count) => async (book) =>
  (await plates(count)(book)) && (await scrollsAsOne(true)(book));

/** A grid of thin lines, drawn in the page's own pixels, and nothing red. */
const grid = async (book) =>
  (await book.picture(1, 900)).fraction(isPrinted) > 0.03 && (await noneIsRed(1)(book));

const icbMulti = async (book) =>
  (await grid(book)) && (await book.picture(2)).fraction(isRed) > 0.02;

const svgIcbMulti = async (book) => {
  const isGreen = (red, green, blue) => green > red + 30 && green > blue + 20;
  const [second, third] = [await book.picture(2), await book.picture(3)];
  return (
    second.fraction(isGreen) === 0 && third.fraction(isGreen) > 0.01 && second.fraction(isRed) > 0.8
  );
};

/** A heart is filled with stars: a part of its page is green, and less than if it were filled whole. */
const starPattern = (most) => async (book) => {
  const isGreen = (red, green, blue) => green > red + 20 && green > blue + 10;
  const green = (await book.picture(1)).fraction(isGreen);
  return green > 0.01 && green < most;
};

const reflowAfter = (words) => (book) => flowsFrom(book, words);

const behavesAsGlobalBis = async (book) => {
  const texts = await book.texts();
  const fixed = texts.findIndex((text, k) => k > 0 && text.includes("pre-paginated, with a green"));
  const page = fixed >= 0 ? fixed + 1 : -1;
  if (page < 2 || page === texts.length) return false;
  const picture = await book.picture(page);
  return !isRed(...picture.at(0.05, 0.05)) && (await book.size(page)).width !== flowingWidth;
};

/** A page that is a picture, of its own size, between text that flows over several pages. */
const fixedPictureBetween = async (book) => {
  const texts = await book.texts();
  const third = texts.findIndex((text) => text.includes("Third Section"));
  const size = await book.size(third);
  const around = [await book.size(1), await book.size(third + 2)];
  return third > 2 && texts[third - 1] === "" && around.every(({ width }) => width !== size.width);
};

/** What is read stands on green, as the book styles it, and the rest of the page is grey. */
const marksWhatIsRead = async (book) => {
  const isGreen = (red, green, blue) => Math.hypot(red - 13, green - 146, blue - 95) < 12;
  let isMarked = false;
  let isGreyBeside = false;
  const stretches = await readAloud(book, async (element) => {
    if (element.page !== 2 || (isMarked && isGreyBeside)) return;
    const picture = book.pictureOf(await element.drawPage(2, 500));
    isMarked ||= picture.fraction(isGreen) > 0.005;
    // The darkest of the ink: grey on white is never darker.
    const isBlack = (...colour) => Math.max(...colour) < 90;
    isGreyBeside ||= picture.fraction(isGreen) > 0.005 && picture.fraction(isBlack) < 0.0005;
  });
  return judged(stretches, stretches?.length === 1) && isMarked && isGreyBeside;
};

/** While one chapter is read, the reader turns to another by the contents, which is read from its start. */
const followsNavigation = async (book) => {
  let hasTurned = false;
  const stretches = await readAloud(book, async (element) => {
    if (hasTurned || !element.readingAloud) return;
    hasTurned = true;
    const chapter = (await element.outline()).find(({ title }) => title.includes("2"));
    await element.goTo(chapter.page);
  });
  const [first, last] = [stretches?.[0], stretches?.at(-1)];
  const isOther = last?.recording !== first?.recording && last?.from < 0.5 && last?.to > 6;
  return judged(stretches, hasTurned && isOther);
};

/** Checks by the identifiers of the tests. */
export const checks = {
  "cnt-css-fonts_ot": isSetInItsFont,
  "cnt-css-fonts_tt": isSetInItsFont,
  "cnt-css-fonts_woff": isSetInItsFont,
  "cnt-css-fonts_woff2": isSetInItsFont,
  "cnt-mathml-support": async (book) => {
    const formula = (await book.runs(1)).find(({ math }) => math?.includes("<msup>"));
    if (!formula) return false;
    const { width } = await book.size(1);
    const picture = await book.picture(1, 2 * width);
    // The lowest ink of its first letter, and of the power at its end.
    const lowest = (from, to) => {
      const rows = Array.from({ length: 2 * Math.ceil(formula.height) }, (_, k) => k);
      const columns = Array.from({ length: Math.ceil(2 * (to - from)) }, (_, k) => from + k / 2);
      const { height } = picture;
      const at = (x, row) => picture.at(x / width, (2 * formula.y + row) / (height - 1))[0];
      return rows.findLast((row) => columns.some((x) => at(x, row) < 128)) ?? -1;
    };
    const end = formula.x + formula.width;
    const [base, power] = [lowest(formula.x, formula.x + 8), lowest(end - 6, end)];
    return power >= 0 && power < base - 6;
  },
  // It fills its page; the other has the width of text.
  "cnt-svg-css": starPattern(0.25),
  "cnt-svg-css-inclusion": starPattern(0.1),
  "cnt-svg-css-reference": async (book) => {
    const isGreen = (red, green, blue) => green > red + 20 && green > blue + 10;
    return (await book.picture(1)).fraction(isGreen) > 0.05;
  },
  "cnt-svg-embedded": showsPicture,
  "cnt-svg-support": async (book) =>
    (await shows("Test passes")(book)) && (await showsPicture(book)),
  "css-epub-hyphens": async (book) => {
    // The book says that the type's size may have to be another for its condition.
    for (const size of [1, 1.25, 1.5, 1.75, 2]) {
      await book.setSize(size);
      const lines = await book.lines();
      const at = ["The nineteenth", "2. This", "The art", "3. This", "Those who"].map((words) =>
        lines.findIndex((line) => line.startsWith(words)),
      );
      if (at.includes(-1)) return "a block of the book is missing";
      const ends = (from, to) => lines.slice(from, to).filter((line) => line.endsWith("\u00ad"));
      const [none, manual, auto] = [ends(at[0], at[1]), ends(at[2], at[3]), ends(at[4])];
      if (none.length === 0 && manual.length > 0 && auto.length > 0) return true;
    }
    return false;
  },
  "css-epub-text-transform": async (book) => {
    const runs = (await book.runs(1)).filter(({ vertical }) => vertical);
    const [japanese, english] = ["これはテストです。", "123456abcdef"].map((words) =>
      runs.find(({ text }) => text.trim() === words),
    );
    if (!japanese || !english) return "the text is not as the book has it";
    // Beneath each other, upright letters of full width are as far apart as the Japanese ones.
    const [one, other] = [japanese, english].map(({ text, height }) => height / text.trim().length);
    return Math.abs(one - other) < 0.02 * one && Math.abs(japanese.width - english.width) < 1;
  },
  "css-epub-line-break": async (book) => {
    // Those of Japanese alone are of the blocks that are to be broken.
    const lines = (await book.lines())
      .map((line) => line.trim())
      .filter((line) => /^[\u3000-\u9fff]{5,}$/.test(line));
    return lines.length >= 8 && lines.every((one) => !/[々ぁ]$/.test(one));
  },
  "cnt-xhtml-support": shows("Test passes if you see this."),
  "lay-fxl-layout-default": reflowAfter("renders as a reflowable document"),
  "lay-fxl-layout-pre-paginated": pagesNumbered(4),
  "lay-fxl-layout-pre-paginated-spreads": async (book) =>
    (await pagesNumbered(4)(book)) && (await facesEachOther(2)(book)),
  "lay-fxl-orientation-default": pagesNumbered(4),
  "lay-fxl-page-spread-combined": facesEachOther(2),
  "lay-fxl-page-spread-left": async (book) => (await sideOf(book, 2)) === "left",
  "lay-fxl-page-spread-right": async (book) => (await sideOf(book, 1)) === "right",
  "lay-fxl-spread-auto": facesEachOther(2),
  "lay-fxl-spread-both": async (book) => {
    // In a window higher than wide, as in one wider than high.
    for (const [width, height] of [
      [400, 800],
      [900, 500],
    ]) {
      const element = await book.shown(width, height);
      await element.goTo(2);
      const { left, right } = element.spread;
      if (element.shownLayout !== "spread" || left !== 2 || right !== 3) return false;
    }
    return true;
  },
  "lay-fxl-spread-default": facesEachOther(2),
  "lay-fxl-spread-landscape": facesEachOther(2),
  "lay-fxl-spread-none": showsOnePage,
  "lay-fxl-svg-icb_multi": svgIcbMulti,
  "lay-fxl-xhtml-icb": grid,
  "lay-fxl-xhtml-icb_invalid_meta": async (book) => (await grid(book)) && (await looksAlike(book)),
  "lay-fxl-xhtml-icb_multi": icbMulti,
  "lay-fxl-xhtml-icb_multi_declarations": looksAlike,
  "lay-fxl-xhtml-icb_repeated-in-meta": async (book) =>
    (await grid(book)) && (await looksAlike(book)),
  "lay-fxl-xhtml-icb_units": looksAlike,
  "fxl-page-spread-center": standsInTheMiddle,
  "fxl-page-spread-break": async (book) => {
    const texts = await book.texts();
    const pageOf = (words) => texts.findIndex((text) => text.includes(words)) + 1;
    return (
      (await sideOf(book, pageOf("Page 2"))) === "right" &&
      (await sideOf(book, pageOf("Page 3"))) === "left" &&
      pageOf("Page 3") === pageOf("Page 2") + 1
    );
  },
  "fxl-spine-overrides_behave-as-global": reflowAfter("This text is long"),
  "fxl-spine-overrides_behave-as-global-bis": behavesAsGlobalBis,
  "fxl-spine-overrides_duplicate": reflowAfter("This text is long"),
  "lay-page-layout-both": reflowAfter("Page 2."),
  "lay-page-layout-both-spread": async (book) => {
    // Two pages of text lie side by side where each has room for its lines.
    const room = [1500, 900];
    await book.shown(...room, { layout: "auto", cover: "none" });
    const texts = await book.texts();
    const pageOf = (words) => texts.findIndex((text) => text.includes(words)) + 1;
    return (
      (await flowsFrom(book, "Page 2.")) &&
      (await sideOf(book, pageOf("Page 2."), ...room)) === "left" &&
      (await sideOf(book, pageOf("Page 5."), ...room)) === "left" &&
      texts[pageOf("Page 3.") - 2] !== ""
    );
  },
  "lay-pkg-flow-paginated": reflowAfter("Loomings"),
  "lay-pkg-flow-scrolled-continuous": scrollsAsOne(false),
  "lay-pkg-flow-scrolled-doc": scrollsByChapters,
  "lay-pp-embedded-images": plates(9),
  "lay-pp-embedded-images-svg": plates(9),
  "lay-pp-images-in-spine": plates(9),
  "lay-pp-images-mixed": plates(9),
  "lay-pp-layout-default": reflowAfter("renders as a reflowable document"),
  "lay-pp-layout-pre-paginated": pagesNumbered(4),
  "lay-pp-layout-pre-paginated-spreads": async (book) =>
    (await pagesNumbered(4)(book)) && (await facesEachOther(2)(book)),
  "lay-pp-page-spread-combined": facesEachOther(2),
  "lay-pp-page-spread-left": async (book) => (await sideOf(book, 2)) === "left",
  "lay-pp-page-spread-right": async (book) => (await sideOf(book, 1)) === "right",
  "lay-pp-spine-overrides_behave-as-global": reflowAfter("This text is long"),
  "lay-pp-spine-overrides_behave-as-global-bis": behavesAsGlobalBis,
  "lay-pp-spine-overrides_image-only-pp": reflowAfter("This text is long"),
  "lay-pp-spine-overrides_image-only-reflow": fixedPictureBetween,
  "lay-pp-spine-overrides_image-spine-pp": reflowAfter("This text is long"),
  "lay-pp-spine-overrides_image-spine-reflow": fixedPictureBetween,
  "lay-pp-spread-none": showsOnePage,
  "lay-pp-svg-icb_multi": svgIcbMulti,
  "lay-pp-xhtml-icb": grid,
  "lay-pp-xhtml-icb_invalid_meta": async (book) => (await grid(book)) && (await looksAlike(book)),
  "lay-pp-xhtml-icb_multi": icbMulti,
  "lay-pp-xhtml-icb_multi_declarations": looksAlike,
  "lay-pp-xhtml-icb_repeated-in-meta": async (book) =>
    (await grid(book)) && (await looksAlike(book)),
  "lay-pp-xhtml-icb_units": looksAlike,
  "lay-rendition-flow-pre-pag": async (book) => {
    const element = await book.shown(900, 500);
    const texts = await book.texts();
    const own = texts.flatMap((text, k) =>
      text.includes("should appear in its own") ? [k + 1] : [],
    );
    for (const page of own) {
      await element.goTo(page);
      const roll = element.shadowRoot.querySelector("[part=roll]");
      for (let k = 0; k < 200 && !roll.hidden; k++) await wait(50);
      if (!roll.hidden) return false;
    }
    return own.length === 2 && own[1] === own[0] + 1;
  },
  "lay-roll-embedded-images": rollOf(9),
  "lay-roll-embedded-images-svg": rollOf(9),
  "lay-roll-images-in-spine": rollOf(9),
  "lay-roll-images-mixed": rollOf(9),
  "lay-viewport-meta-prop": async (book) => {
    const sizes = [];
    for (const page of [1, 2, 3, 4]) sizes.push(JSON.stringify(await book.size(page)));
    const element = await book.shown(900, 500);
    for (const page of [1, 3, 4]) {
      await element.goTo(page);
      element.zoom = 2;
      if (element.zoom !== 2) return false;
      element.zoom = 1;
    }
    return new Set(sizes).size === 1;
  },
  // No more is heard, although the recording goes on.
  "mol-audio": heard(29.268, 44.783, 1),
  "mol-audio-exceeding-clipend": heardBoth(29.268, null, 0, 18.5),
  "mol-audio-no-clipbegin": heard(0, 87.85),
  // To the end of the recording, 88.05 s.
  "mol-audio-no-clipend": heard(29.268, 88.05),
  "mol-css": marksWhatIsRead,
  "mol-navigation": followsNavigation,
  "mol-support_xhtml": heard(29.268, 182),
  "mol-support_xhtml-fxl": heard(29.268, 182),
  "mol-support_xhtml-load": heardOnPages(29.268, 182, "Call me Ishmael"),
  "mol-support_xhtml-load-fxl": heardOnPages(29.268, 182, "Call me Ishmael"),
  "mol-support_xhtml-load-next": heardOnPages(29.268, 182, "Call me Ishmael"),
  "mol-support_xhtml-load-next-fxl": heardOnPages(29.268, 182, "Call me Ishmael"),
  "mol-timing-synchronization": heard(29.268, 182),
  "mol-timing-synchronization_fxl": heardOnPages(29.268, 87.85, "Call me Ishmael", slower),
  "mol-timing-synchronization_multiple_audio": heardBoth(29.268, 87.85, 0, 18.5),
  "mol-timing-synchronization_multiple_audio-fxl": heardBoth(29.268, 87.85, 0, 18.5),
  "mol-timing-synchronization_svg": heard(29.268, 87.85),
  "mol-timing-synchronization_svg-fxl": heard(29.268, 87.85),
  "mol-tts_multi": spoken("Call me Ishmael.", "high time to get to sea", "ocean with me."),
  "mol-tts_single": spoken("Call me Ishmael.", "high time to get to sea", "ocean with me."),
  "mol-ignore": shows("Call me Ishmael", "cooled by breezes"),
  "nav-access": contents(["Test passes if you can see this link", 1]),
  "nav-activation": async (book) => {
    const element = await book.shown(900, 500, { layout: "single" });
    const second = (await element.outline())[1];
    await element.goTo(second.page);
    return (await book.text(element.page)).includes("navigation link leads here");
  },
  "nav-non-text_img": contents(["Start page", 1], ["Description of the Abbey of Sénanque", 2]),
  "nav-non-text_img_title": contents(
    ["Start page", 1],
    ["Description of the Abbey of Sénanque", 2],
  ),
  "nav-spine_in-spine": async (book) => {
    const outline = await book.outline();
    return outline.length === 2 && outline[0].page === 2 && outline[1].page === 3;
  },
  "nav-spine_in-spine-hidden-toc-css": async (book) =>
    (await contents(["The first link", 2], ["The second link", 3])(book)) &&
    !(await book.text(1)).includes("second link"),
  "nav-spine_in-spine-hidden-toc-html": async (book) =>
    (await contents(["The first link", 2], ["The second link", 3])(book)) &&
    !(await book.text(1)).includes("second link"),
  "nav-spine_in-spine-no-list-style": contents(
    ["Test passes if you can see two links: the first link", 2],
    ["the second link", 3],
  ),
  "nav-spine_not-in-spine": contents(
    ["Test passes if you can see two links (first link)", 1],
    ["Test passes if you can see two links (second link)", 2],
  ),
  "ocf-font_obfuscation": isSetInItsFont,
  "ocf-font_obfuscation-bis": not(isSetInItsFont),
  "ocf-metainf-inc": shows("can be accessed without any error"),
  "ocf-metainf-manifest": async (book) =>
    book.pageCount === 1 && (await book.outline()).length <= 1,
  "ocf-package_arbitrary": shows("Test passes if you see this."),
  "ocf-package_multiple": shows("Test passes if you see this."),
  "ocf-url_link-leaking-relative": showsPicture,
  "ocf-url_link-path-absolute": showsPicture,
  "ocf-url_link-relative": showsPicture,
  "ocf-url_manifest": shows("Test passes if this page opens."),
  "ocf-url_relative": shows("Test passes if this page opens."),
  "ocf-zip-comp": isRefused,
  "ocf-zip-mult": isRefused,
  "pkg-collections-unknown": opens,
  "pkg-creator-order": async (book) => (await shownDetails(book))[1] === "Dave Cramer",
  "pkg-dir_but_not_content": async (book) => {
    const runs = await book.runs(1);
    const left = Math.min(...runs.map(({ x }) => x));
    return (
      runs.some(({ text, x }) => text.includes("Test passes") && x === left) &&
      runs.filter(({ text }) => /List entry/.test(text)).every(({ x }) => x < left + 80)
    );
  },
  "pkg-dir-auto_root-rtl": titleRuns("ltr"),
  "pkg-dir-auto_root-unset": titleRuns("ltr"),
  "pkg-dir_creator-rtl": creatorRuns("rtl"),
  "pkg-dir_rtl-root-ltr": titleRuns("rtl"),
  "pkg-dir_rtl-root-unset": titleRuns("rtl"),
  "pkg-dir_unset-root-rtl": titleRuns("rtl"),
  "pkg-dir_unset-root-unset": titleRuns("ltr"),
  "pkg-manifest-unknown": opens,
  "pkg-manifest-unlisted-resource": noneIsRed(1),
  "pkg-meta-unknown": opens,
  "pkg-meta-whitespace": async (book) => {
    const shown = await shownDetails(book);
    return (
      shown.includes("Dave Cramer") &&
      shown.every((text) => text === text.trim() && !/\s\s/.test(text))
    );
  },
  "pkg-spine-duplicate-item-hyperlink": linkLeadsTo(2),
  "pkg-spine-duplicate-item-rendering": inOrder(
    "three identical",
    ...Array(3).fill("occurs three times"),
  ),
  "pkg-spine-duplicate-item-ui": async (book) => {
    const element = await book.shown(900, 500, { layout: "single" });
    element.toggleBookmark(2);
    element.toggleBookmark(4);
    return element.bookmarks.join() === "2,4";
  },
  "pkg-spine-nonlinear-activation": linkLeadsTo(2),
  "pkg-spine-order": inOrder("appear first", "appear second", "appear third", "appear last"),
  "pkg-spine-order-svg": async (book) => await pagesNumbered(4)(book),
  "pkg-spine-progression-default": leadsTo("left"),
  "pkg-spine-progression-pre-paginated": async (book) => {
    const element = await book.shown(900, 500, { cover: "none" });
    await element.goTo(2);
    return element.spread.left === 2 && element.spread.right === 3;
  },
  "pkg-spine-progression_ltr": leadsTo("right"),
  "pkg-spine-progression_rtl": leadsTo("left"),
  "pkg-spine-unknown": opens,
  "pkg-title-order": async (book) => (await shownDetails(book))[0] === "pkg-title-order",
  "pkg-unique-id": async (book, others) => {
    const other = await others.open(
      others.name === "pkg-unique-id" ? "pkg-unique-id_duplicate" : "pkg-unique-id",
    );
    const [one, two] = [
      (await book.shown(900, 500)).bookTitle,
      (await other.shown(900, 500)).bookTitle,
    ];
    other.close();
    return one !== two;
  },
  "pkg-version-backward": opens,
  "pss-support": (book) => footnoteOn(book, 1),
  "pss-support_ignore-title": async (book) =>
    (await footnoteOn(book, 1)) && !(await footnoteOn(book, 2)),
  "pub-cmt-avif": showsPicture,
  "pub-cmt-gif": showsPicture,
  "pub-cmt-jpeg": showsPicture,
  "pub-cmt-jxl": showsPicture,
  "pub-cmt-png": showsPicture,
  "pub-cmt-svg": showsPicture,
  "pub-cmt-webp": showsPicture,
  "pub-data-urls_browsing-context": showsPicture,
  "pub-data-urls_top-level-content": async (book) =>
    book.pageCount === 2 &&
    (await book.picture(1)).fraction((r, g, b) => r > 250 && g > 250 && b > 250) > 0.005,
  "pub-file-urls": async (book, { foreign }) =>
    (await opens(book)) && (await foreign()).length === 0,
  "pub-foreign_image": async (book) =>
    (await book.picture(1)).fraction((...colour) => Math.min(...colour) < 235) > 0.02,
  "pub-foreign_json-spine": shows("Test passes"),
  "pub-foreign_xml-spine": shows("Test passes"),
  "pub-foreign_xml-suffix-spine": shows("Test passes"),
  "pub-foreign_bad-fallback": isRefused,
  "pub-cmt-mp3": isHeard,
  "pub-cmt-mp4": isHeard,
  "pub-cmt-opus": isHeard,
  "pub-external-links": asksBefore(/^https:/),
  "pub-external-links_consent": asksBefore(/^mailto:/),
  "pub-xml-external-id": async (book) => !(await book.texts()).join(" ").includes("Test fails"),
  "pub-xml-names": reportsError,
  "pub-xml-non-validating_unclosed": reportsError,
  "pub-xml-non-validating_comment": async (book) =>
    !(await book.texts()).join(" ").includes("Test fails"),
  // What stands in the frame is that the test is not relevant without scripts.
  "scr-not-support_ccscript-modify-host": async (book, others) =>
    (await showsFrame(book, others)) &&
    (await shows("must not be able to modify this text")(book)) &&
    "n/a",
  "scr-not-support_ccscript-modify-size": async (book, others) =>
    (await showsFrame(book, others)) && "n/a",
  "scr-storage-delete": shows("does not support scripting, hence this test succeeds"),
  "scr-support-fallback": not(shows("the test fails")),
  "sec-untrusted-consent_network": async (book, { foreign }) => {
    for (let page = 1; page <= book.pageCount; page++) await book.picture(page);
    return (await foreign()).length === 0;
  },
  "sec-untrusted-consent_scripting": shows("No script has been executed."),
};

/** The creator's name, as the controls show it, is set in a direction. */
function creatorRuns(direction) {
  return async (book) => {
    const element = await book.shown(900, 500, { controls: "" });
    const find = (selector) => element.shadowRoot.querySelector(selector);
    find('[part~="toolbar"] [aria-label="Contents"]').click();
    for (let k = 0; k < 100 && !find(".details li"); k++) {
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    const creator = find(".details li");
    return creator.offsetParent !== null && getComputedStyle(creator).direction === direction;
  };
}

/** The title, as the controls show it, is set in a direction. */
function titleRuns(direction) {
  return async (book) => {
    const element = await book.shown(900, 500, { controls: "" });
    const title = element.shadowRoot.querySelector("[part~=title]");
    return getComputedStyle(title).direction === direction;
  };
}
