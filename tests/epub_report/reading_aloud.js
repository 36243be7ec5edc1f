/** Runs in the browser: books read aloud as their readers would have them, and what is then to be heard and seen. */

/** How much faster than it was recorded a recording is heard. */
const speed = 8;

/** Milliseconds between two looks at what is heard. */
const lookEvery = 10;

/** Milliseconds after which a book that is still read is too slow. */
const patience = 100_000;

/** What is heard of recordings, in stretches without a break. */
class Listener {
  stretches = [];
  #players = new Set();
  #timer = 0;
  #play = HTMLMediaElement.prototype.play;

  constructor() {
    const listener = this;
    HTMLMediaElement.prototype.play = function () {
      listener.#players.add(this);
      this.playbackRate = speed;
      return listener.#play.call(this);
    };
    this.#timer = setInterval(() => this.#look(), lookEvery);
  }

  #look() {
    const now = performance.now();
    for (const player of this.#players) {
      if (player.paused || player.readyState < 3) continue;
      const { currentTime: time, currentSrc: recording } = player;
      const last = this.stretches.at(-1);
      const passed = last ? (speed * (now - last.ended)) / 1000 : 0;
      const goesOn =
        last?.recording === recording && time >= last.to && time - last.to < passed + 0.5;
      if (goesOn) Object.assign(last, { to: time, ended: now });
      else this.stretches.push({ recording, from: time, to: time, began: now, ended: now });
    }
  }

  end() {
    clearInterval(this.#timer);
    HTMLMediaElement.prototype.play = this.#play;
  }
}

/** The button of the controls that has the book read aloud; null if there is none to be seen. */
function buttonOf(element) {
  const button = element.shadowRoot.querySelector('[part~="toolbar"] [aria-label="Read aloud"]');
  return button?.offsetParent ? button : null;
}

/**
 * Opens a book, presses the button of its controls that has it read aloud, and
 * waits until it has been read. Returns what was heard, in stretches; null if
 * there is no such button.
 *
 * @param during called again and again meanwhile, with the element
 */
export async function readAloud(book, during = () => {}) {
  const element = await book.shown(900, 500, { controls: "", layout: "single" });
  // The controls are a part that is loaded by itself.
  for (let k = 0; k < 100 && buttonOf(element) === null; k++) await pause(50);
  const button = buttonOf(element);
  if (button === null) return null;
  const listener = new Listener();
  try {
    const isOver = new Promise((resolve, reject) => {
      element.addEventListener("readaloudchange", ({ detail }) => detail.reading || resolve());
      element.addEventListener("error", ({ detail }) => reject(new Error(detail.message)));
      setTimeout(reject, patience, new Error("It is still being read."));
    });
    button.click();
    let isReading = true;
    const watching = (async () => {
      for (; isReading; await pause(50)) await during(element);
    })();
    await isOver.finally(() => {
      isReading = false;
    });
    await watching;
    return listener.stretches;
  } finally {
    listener.end();
  }
}

const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** How exactly a stretch is known, seconds: one look, and the one before. */
const exactly = (4 * speed * lookEvery) / 1000;

/** Returns whether what was heard is from one second of a recording to another, as exactly as it is known. */
export function isStretch(stretch, from, to) {
  return (
    stretch !== undefined &&
    Math.abs(stretch.from - from) < exactly + 0.1 &&
    Math.abs(stretch.to - to) < exactly + 0.1
  );
}

/** Returns true if what was heard is as it should be; otherwise throws what was heard, in words. */
export function judged(stretches, isRight) {
  if (stretches !== null && isRight) return true;
  const inWords = ({ from, to }) => `${from.toFixed(2)} to ${to.toFixed(2)} s`;
  throw new Error(
    stretches === null
      ? "nothing in the controls has it read aloud"
      : `heard of the recording: ${stretches.map(inWords).join(", then ") || "nothing"}`,
  );
}

/** The book is read aloud from one second of its recording to another, and nothing else is heard. */
export const heard = (from, to) => async (book) => {
  const stretches = await readAloud(book);
  return judged(stretches, stretches?.length === 1 && isStretch(stretches[0], from, to));
};

/** The same, and its pages, from the second one on, are turned to one after another as they are read. */
export const heardOnPages =
  (from, to, ...pages) =>
  async (book) => {
    const shown = new Set();
    const stretches = await readAloud(book, (element) => shown.add(element.page));
    shown.delete(1);
    const isAll = stretches?.length === 1 && isStretch(stretches[0], from, to);
    return judged(stretches, isAll) && [...shown].join() === pages.join();
  };

/** Two recordings are heard one after the other: the second from its start, without a gap that is heard. */
export const heardBoth = (from, to, from2, to2) => async (book) => {
  const stretches = await readAloud(book);
  const [first, second] = stretches ?? [];
  const isRight =
    stretches?.length === 2 &&
    isStretch(first, from, to ?? first.to) &&
    isStretch(second, from2, to2) &&
    first.recording !== second.recording &&
    second.began - first.ended < 500;
  return judged(stretches, isRight);
};

/** A text is spoken by the browser's own voice, whose words are taken down here. */
export const spoken =
  (...wanted) =>
  async (book) => {
    const said = [];
    speechSynthesis.speak = (utterance) => {
      said.push(utterance.text);
      setTimeout(() => utterance.onend(new Event("end")));
    };
    try {
      if ((await readAloud(book)) === null) return false;
    } finally {
      delete speechSynthesis.speak;
    }
    const text = said.join(" ").replace(/\s+/g, " ");
    return wanted.every((words) => text.includes(words));
  };
