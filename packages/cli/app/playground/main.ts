/** The playground: two models turn the same page side by side, held at the same place. */

import { Bench } from "./bench.ts";
import { makeControls } from "./controls.ts";
import { Figures } from "./figures.ts";
import { followHand } from "./hand.ts";
import { Kept } from "./keep.ts";
import { make } from "./make.ts";
import { drawPages } from "./page_pictures.ts";
import { Picture } from "./picture.ts";
import { BadLink, firstSettings, readLink, type Settings, writeLink } from "./settings.ts";
import { fill, textsFor } from "./texts.ts";
import { type Variant, variantNames } from "./variants.ts";

const { language, texts } = textsFor(navigator.language);
document.documentElement.lang = language;
document.title = texts.title;

/** Messages: how fast time passes, and what went wrong. */
const state = make("p", { className: "status" });
const fault = make("p", { className: "fault" });
state.setAttribute("role", "status");
fault.setAttribute("role", "alert");

const figures = new Figures(texts);
const kept = new Kept(texts.files);
const button = (text: string, act: () => void): HTMLButtonElement => {
  const made = make("button", { type: "button" }, text);
  made.addEventListener("click", act);
  return made;
};

const sides = (["left", "right"] as const).map((side, k) => {
  const select = make(
    "select",
    { ariaLabel: texts.models[k] },
    ...variantNames.map((value) => make("option", { value }, texts.variants[value])),
  );
  select.addEventListener("change", () => change({ [side]: select.value as Variant }));
  const canvas = make("canvas", { tabIndex: 0 });
  canvas.setAttribute("role", "application");
  const figure = make("figure", { className: "picture" }, make("figcaption", {}, select), canvas);
  return { side, select, canvas, figure };
});

const pause = button(texts.pause, () => {
  bench.isPaused = !bench.isPaused;
  showPause();
});
const record = button(texts.record, () => {
  if (bench.isRecording) void keepRecording();
  else bench.record();
  showRecord();
});
const controls = makeControls(texts, change, [
  make(
    "div",
    { className: "buttons" },
    record,
    button(texts.copy, () => void copyLink()),
    button(texts.picturePng, () => void keepPicture()),
    button(texts.settingsJson, keepSettings),
  ),
  kept.element,
]);
const hand = make(
  "div",
  { className: "hand" },
  ...(["edge", "corner", "let-go"] as const).map((by) =>
    button(texts.turns[by], () => {
      bench.play(by);
    }),
  ),
  pause,
  button(texts.step, () => {
    bench.step();
    showPause();
  }),
  state,
);

const pages = drawPages();
document
  .getElementById("bench")
  ?.append(
    make("header", {}, make("h1", {}, texts.title), make("p", {}, texts.intro), fault),
    make("section", { className: "pair" }, ...sides.map(({ figure }) => figure), hand),
    figures.element,
    controls.form,
  );

const [first, second] = sides.map(({ canvas }) => new Picture(canvas, pages, () => bench.show()));
const bench = new Bench([first, second], figures, texts, settingsOfLink(), {
  state: (text) => {
    if (state.textContent !== text) state.textContent = text;
  },
  fault: (text) => {
    // An error in a link stays until there is another message.
    if (text !== "" || hasMoved) fault.textContent = text;
  },
  full: () => void keepRecording(),
  creases: (states) => controls.follow(states),
  changed: () => showChanged(),
});
/** Whether the reader has changed anything since the link was read. */
let hasMoved = false;
for (const picture of [first, second]) {
  followHand(picture, {
    grab: (place) => bench.grab(place),
    hold: (x, y, z) => bench.hold(x, y, z),
    release: () => bench.release(),
  });
}

function showSettings(): void {
  const { settings } = bench;
  controls.show(settings);
  for (const { side, select, canvas } of sides) {
    select.value = settings[side];
    canvas.ariaLabel = fill(texts.picture, { model: texts.variants[settings[side]] });
  }
}

function showPause(): void {
  pause.textContent = bench.isPaused ? texts.resume : texts.pause;
  pause.setAttribute("aria-pressed", String(bench.isPaused));
}

function showRecord(): void {
  record.textContent = bench.isRecording ? texts.stop : texts.record;
  record.setAttribute("aria-pressed", String(bench.isRecording));
}

function change(changed: Partial<Settings>): void {
  hasMoved = true;
  void bench.set({ ...bench.settings, ...changed });
  showChanged();
}

/** Shows the settings, and writes them into the address. */
function showChanged(): void {
  const link = writeLink(bench.settings);
  history.replaceState(null, "", link === "" ? location.pathname : `#${link}`);
  showSettings();
}

/** Returns the settings in the address; the first ones if it has none that are valid. */
function settingsOfLink(): Settings {
  try {
    return readLink(location.hash);
  } catch (error) {
    const name = error instanceof BadLink ? error.setting : null;
    fault.textContent = name ? fill(texts.badLinkAt, { name: texts.names[name] }) : texts.badLink;
    return firstSettings;
  }
}

async function copyLink(): Promise<void> {
  try {
    await navigator.clipboard.writeText(location.href);
    state.textContent = texts.copied;
  } catch {
    state.textContent = texts.notCopied;
  }
}

async function keepPicture(): Promise<void> {
  const canvas = bench.picture();
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve));
  if (blob) kept.add("turn.png", blob, "", true);
}

function keepSettings(): void {
  const text = `${JSON.stringify({ ...bench.settings, link: location.href }, null, 2)}\n`;
  kept.add("turn.json", new Blob([text], { type: "application/json" }), "", true);
}

async function keepRecording(): Promise<void> {
  try {
    const files = bench.finishRecording();
    showRecord();
    for (const { name, blob, error } of await files) {
      const note = error === undefined ? "" : `${Number((100 * error).toPrecision(2))} %`;
      kept.add(name, blob, note && fill(texts.replayError, { error: note }));
    }
  } catch {
    fault.textContent = texts.notRecorded;
  }
}

addEventListener("hashchange", () => {
  fault.textContent = "";
  hasMoved = false;
  const settings = settingsOfLink();
  void bench.set(settings);
  showSettings();
});

const resized = new ResizeObserver(() => {
  for (const picture of [first, second]) picture.resize();
  bench.show();
});
for (const { canvas } of [first, second]) resized.observe(canvas);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => bench.show());

showPause();
showRecord();
showSettings();
void bench.set(bench.settings);
