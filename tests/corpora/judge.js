/** Runs in the browser: opens a book as the package does, walks every page and judges what can be judged without an eye. */
import { openSource } from "/turnleaf/index.js";
import { lettersOf, secondOpinion, textOfFormula } from "./second_opinion.js";

const never = new AbortController().signal;

/** Pixels across a page as it is judged. */
const judgedWidth = 500;

/** Maximum of pages that are drawn of a book: the first ones, and others evenly among the rest. */
const drawnPages = 40;

/** The least difference of two colours that is ink on paper, of 255. */
const inkContrast = 24;

/** Returns the pages that are drawn of so many. */
function drawnOf(count) {
  const some = Array.from({ length: drawnPages }, (_, k) => Math.floor((k * count) / drawnPages));
  return [...new Set(count > drawnPages ? some : Array.from({ length: count }, (_, k) => k))];
}

/** Returns the range of colours in a part of a picture, over its channels. */
function contrastIn({ width, height, data }, box) {
  const [left, right] = [Math.max(Math.floor(box.x), 0), Math.min(box.x + box.width, width)];
  const [top, bottom] = [Math.max(Math.floor(box.y), 0), Math.min(box.y + box.height, height)];
  const [low, high] = [
    [255, 255, 255],
    [0, 0, 0],
  ];
  for (let y = top; y < bottom; y++) {
    for (let x = left; x < right; x++) {
      for (let channel = 0; channel < 3; channel++) {
        const value = data[4 * (y * width + x) + channel];
        if (value < low[channel]) low[channel] = value;
        if (value > high[channel]) high[channel] = value;
      }
    }
  }
  return Math.max(...high.map((value, channel) => value - low[channel]));
}

/** Returns whether one of two boxes lies on most of the other. */
function overlap(a, b) {
  const across = Math.min(a.x + a.width, b.x + b.width) - Math.max(a.x, b.x);
  const down = Math.min(a.y + a.height, b.y + b.height) - Math.max(a.y, b.y);
  return across > 0.6 * Math.min(a.width, b.width) && down > 0.6 * Math.min(a.height, b.height);
}

const isWord = ({ text }) => /[\p{L}\p{N}]{2}/u.test(text);

/** Returns what is wrong with a page as it is drawn. */
function faultsOfPage(picture, size, runs, isFixed) {
  const faults = [];
  const scale = picture.width / size.width;
  const words = runs.filter((run) => isWord(run) && run.width > 1 && run.height > 1);
  const straight = words.filter(({ angle }) => angle === 0);
  const scaled = ({ x, y, width, height }) => ({
    x: x * scale - 1,
    y: y * scale - 1,
    width: width * scale + 2,
    height: height * scale + 2,
  });
  for (const run of straight) {
    if (contrastIn(picture, scaled(run)) < inkContrast) faults.push(["no ink under", run.text]);
    const isOut =
      run.x < -1 ||
      run.y < -1 ||
      run.x + run.width > size.width + 1 ||
      run.y + run.height > size.height + 1;
    if (isOut && !isFixed) faults.push(["beyond the page", run.text]);
  }
  if (!isFixed) {
    for (let k = 0; k < straight.length; k++) {
      for (let j = k + 1; j < straight.length; j++) {
        if (overlap(straight[k], straight[j])) {
          faults.push(["upon each other", `${straight[k].text} / ${straight[j].text}`]);
        }
      }
    }
  }
  return faults;
}

/**
 * Returns what one text has and another has not: stretches of either, each with
 * the letters before it. What both have, though elsewhere, is not among them.
 */
function differences(wanted, found) {
  const [lost, extra] = [[], []];
  const stretch = (text, from, to) => ({
    text: text.slice(from, to),
    after: text.slice(Math.max(from - 16, 0), from),
  });
  let [i, j] = [0, 0];
  while (i < wanted.length || j < found.length) {
    if (wanted[i] === found[j]) {
      i++;
      j++;
      continue;
    }
    const [to, from] = nextAlike(wanted, found, i, j);
    if (to > i) lost.push(stretch(wanted, i, to));
    if (from > j) extra.push(stretch(found, j, from));
    [i, j] = [to, from];
  }
  for (const one of lost) cancel(one, extra);
  for (const one of extra) cancel(one, lost);
  const isLeft = ({ text }) => text !== "";
  return { lost: lost.filter(isLeft), extra: extra.filter(isLeft) };
}

/** Letters that two texts have in common where they go on alike, and how far the place is looked for. */
const [alike, reach] = [12, 3000];

/** Returns the nearest places from which two texts go on alike after `i` and `j`; their ends if there are none. */
function nextAlike(wanted, found, i, j) {
  let best = [wanted.length, found.length];
  const cost = ([to, from]) => to - i + from - j;
  for (let to = i; to < Math.min(i + reach, wanted.length) && to - i < cost(best); to++) {
    const next = wanted.slice(to, to + alike);
    const from = found.slice(j, j + reach).indexOf(next);
    if (from >= 0 && cost([to, j + from]) < cost(best)) best = [to, j + from];
  }
  return best;
}

/** Takes a stretch out of the one of others that has it too. */
function cancel(stretch, others) {
  const other = others.find(({ text }) => text !== "" && text.includes(stretch.text));
  if (!other || stretch.text === "") return;
  other.text = other.text.replace(stretch.text, () => "");
  stretch.text = "";
}

/** Returns whether a fault is a page that says in one sentence why it cannot be shown. */
function isSentence([kind, what]) {
  return kind === "rejected" && /^[^\n]+\.$/.test(what) && !/[.!?]\s+\p{Lu}/u.test(what);
}

/** Returns the lines of contents with those beneath them, in order. */
function flat(entries) {
  return entries.flatMap((entry) => [entry, ...flat(entry.children)]);
}

/** Compares a book with what it says itself. */
async function compare(base, found) {
  let own;
  try {
    own = await secondOpinion(base);
  } catch (error) {
    return { opinion: error.message, faults: [] };
  }
  const faults = [];
  const { chapters, lines } = own;
  const first = chapters.findIndex(({ isLinear }) => isLinear);
  const inOrder = chapters.filter(({ isLinear }, k) => isLinear || k < first);
  const beside = chapters.filter(({ isLinear }, k) => !isLinear && k > first && first >= 0);
  const wanted = [...inOrder, ...beside].map(({ letters }) => letters).join("");
  const { lost, extra } = differences(wanted, found.letters.join(""));
  const words = ({ text, after }) => `${after}[${text.slice(0, 80)}]`;
  for (const one of lost.slice(0, 5)) faults.push(["lost", words(one)]);
  const instead = chapters.flatMap((chapter) => chapter.instead).join("");
  const more = extra.filter(({ text }) => !instead.includes(text));
  for (const one of more.slice(0, 5)) faults.push(["extra", words(one)]);
  const empty = chapters.filter(({ isEmpty }) => isEmpty).length;
  if (found.blank.length > empty) {
    faults.push(["blank", `pages ${found.blank.map((index) => index + 1).join(", ")}`]);
  }
  const entries = flat(found.outline);
  if (entries.length !== lines.length) {
    faults.push(["contents", `${entries.length} lines of ${lines.length}`]);
  } else {
    for (const [k, { title, letters }] of lines.entries()) {
      if (!letters) continue;
      const { page } = entries[k];
      const there = page ? found.letters.slice(page - 1, page + 1).join("") : "";
      if (!there.includes(letters)) {
        faults.push(["contents", `"${title.trim().slice(0, 40)}" leads to page ${page}`]);
      }
    }
  }
  return { opinion: null, faults };
}

/**
 * Opens a book and walks it.
 *
 * @param address of its file
 * @param base of the files in it, if it is an EPUB; null otherwise
 */
export async function judge(address, fileName, base, log) {
  const bytes = await (await fetch(address)).arrayBuffer();
  const file = new File([bytes], fileName);
  const begin = performance.now();
  let source;
  try {
    source = await openSource(file);
  } catch (error) {
    return { refused: error.message, isBookError: error.name === "BookError" };
  }
  const result = { faults: [], milliseconds: { first: null, all: null } };
  const fault = (kind, what, page) => result.faults.push([kind, String(what).slice(0, 240), page]);
  try {
    const bitmap = await source.draw(0, judgedWidth, never);
    bitmap.close?.();
  } catch (error) {
    fault(error.name === "BookError" ? "rejected" : "failed", error.message, 1);
  }
  result.milliseconds.first = Math.round(performance.now() - begin);
  log("counting");
  await source.settle?.();
  const { pageCount } = source;
  result.pages = pageCount;
  const found = { letters: [], blank: [], outline: [] };
  const drawn = new Set(drawnOf(pageCount));
  result.drawn = drawn.size;
  for (let index = 0; index < pageCount; index++) {
    if (index % 10 === 0) log(`page ${index + 1} of ${pageCount}`);
    let runs = [];
    try {
      runs = (await source.text?.(index, never)) ?? [];
    } catch (error) {
      fault(error.name === "BookError" ? "rejected" : "failed", error.message, index + 1);
    }
    // What a formula says on one line is its author's, or reckoned: what it shows is in its elements.
    const shown = ({ text, math }) => (math === undefined ? text : textOfFormula(math));
    // Together, as marks join the letters before them.
    found.letters.push(lettersOf(runs.map(shown).join("")));
    if (!drawn.has(index)) continue;
    try {
      const size = await source.size(index);
      const bitmap = await source.draw(index, judgedWidth, never);
      const pen = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
      pen.drawImage(bitmap, 0, 0);
      bitmap.close?.();
      const picture = pen.getImageData(0, 0, pen.canvas.width, pen.canvas.height);
      const all = { x: 0, y: 0, width: picture.width, height: picture.height };
      if (runs.length === 0 && contrastIn(picture, all) < 8) found.blank.push(index);
      const isFixed = !source.typeset;
      if (base) {
        for (const [kind, what] of faultsOfPage(picture, size, runs, isFixed)) {
          fault(kind, what, index + 1);
        }
      }
    } catch (error) {
      fault(error.name === "BookError" ? "rejected" : "failed", error.message, index + 1);
    }
  }
  // A page is empty where it is said that what stands on it cannot be shown.
  const said = new Set((source.warnings ?? []).map(({ page }) => page));
  found.blank = found.blank.filter((index) => !said.has(index + 1));
  result.blank = found.blank.length;
  try {
    found.outline = (await source.outline?.(never)) ?? [];
  } catch (error) {
    fault("failed", `outline: ${error.message}`);
  }
  result.milliseconds.all = Math.round(performance.now() - begin);
  if (base) {
    log("comparing");
    const { opinion, faults } = await compare(base, found);
    result.opinion = opinion;
    // Of a book with a document that no browser shows a page may say so.
    if (opinion !== null) result.faults = result.faults.filter((one) => !isSentence(one));
    for (const [kind, what] of faults) fault(kind, what);
  }
  source.close();
  return result;
}
