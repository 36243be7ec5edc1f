/** Runs in the browser: books read aloud as their readers would have them, and what is then to be heard and seen. */

/** How much faster than it was recorded a recording is heard, where it is long. */
const fast = 16;

/** Milliseconds after which a book that is still read is too slow. */
const patience = 100_000;

/** Returns the members of the browser's players by which a sound begins, ends and jumps. */
function playersMembers() {
  const { play, pause, load } = HTMLMediaElement.prototype;
  const time = Object.getOwnPropertyDescriptor(HTMLMediaElement.prototype, "currentTime");
  return { play, pause, load, time };
}

/** Takes down what is heard of recordings, in stretches without a break: seconds, and when they end. */
class Listener {
  stretches = [];
  #players = new Set();
  /** The stretch that is heard now. */
  #open = null;
  #members = playersMembers();

  /** @param speed how much faster recordings are heard */
  constructor(speed) {
    const { play, pause, load, time } = this.#members;
    const begins = (player) => this.#begins(player);
    const ends = (player) => this.#ends(player);
    Object.assign(HTMLMediaElement.prototype, {
      play() {
        this.playbackRate = speed;
        begins(this);
        return play.call(this);
      },
      pause() {
        ends(this);
        pause.call(this);
      },
      load() {
        ends(this);
        load.call(this);
      },
    });
    Object.defineProperty(HTMLMediaElement.prototype, "currentTime", {
      configurable: true,
      get: time.get,
      set(seconds) {
        const isHeard = !this.paused;
        ends(this);
        time.set.call(this, seconds);
        if (isHeard) begins(this);
      },
    });
  }

  #begins(player) {
    if (this.#open) return;
    const from = player.currentTime;
    this.#open = { recording: player.src, from, to: from, began: performance.now() };
    if (this.#players.has(player)) return;
    this.#players.add(player);
    player.addEventListener("ended", () => this.#ends(player));
  }

  #ends(player) {
    if (!this.#open) return;
    const stretch = { ...this.#open, to: player.currentTime, ended: performance.now() };
    this.#open = null;
    // A player that was stopped before it began was not heard.
    if (stretch.to > stretch.from) this.stretches.push(stretch);
  }

  end() {
    const { time, ...others } = this.#members;
    Object.assign(HTMLMediaElement.prototype, others);
    Object.defineProperty(HTMLMediaElement.prototype, "currentTime", time);
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
 * @param speed how much faster than it was recorded it is heard
 */
export async function readAloud(book, during = () => {}, speed = fast) {
  const element = await book.shown(900, 500, { controls: "", layout: "single" });
  // The controls are a part that is loaded by itself.
  for (let k = 0; k < 100 && buttonOf(element) === null; k++) await wait(50);
  const button = buttonOf(element);
  if (button === null) return null;
  const listener = new Listener(speed);
  try {
    const isOver = new Promise((resolve, reject) => {
      element.addEventListener("readaloudchange", ({ detail }) => detail.reading || resolve());
      element.addEventListener("error", ({ detail }) => reject(new Error(detail.message)));
      setTimeout(reject, patience, new Error("It is still being read."));
    });
    button.click();
    let isReading = true;
    const watching = (async () => {
      for (; isReading; await wait(50)) await during(element);
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

const wait = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** Milliseconds by which a busy machine may be late. */
const late = 150;

/** Returns whether what was heard is from one second of a recording to another. */
function isStretch(stretch, from, to, speed = fast) {
  return (
    stretch !== undefined &&
    Math.abs(stretch.from - from) < 0.05 &&
    stretch.to > to - 0.1 &&
    stretch.to < to + (speed * late) / 1000
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
export const heard =
  (from, to, speed = fast) =>
  async (book) => {
    const stretches = await readAloud(book, () => {}, speed);
    return judged(stretches, stretches?.length === 1 && isStretch(stretches[0], from, to, speed));
  };

/** The same, and the pages of what is read, which are all from its first words on, are turned to one after another. */
export const heardOnPages =
  (from, to, firstWords, speed = fast) =>
  async (book) => {
    const shown = new Set();
    const stretches = await readAloud(book, (element) => shown.add(element.page), speed);
    shown.delete(1);
    judged(stretches, stretches?.length === 1 && isStretch(stretches[0], from, to, speed));
    const texts = await book.texts();
    const first = texts.findIndex((text) => text.replace(/\s+/g, " ").includes(firstWords));
    const pages = [...texts.keys()].filter((k) => k >= first && first >= 0).map((k) => k + 1);
    if (pages.length > 0 && [...shown].join() === pages.join()) return true;
    throw new Error(`pages turned to: ${[...shown].join(", ")}, not ${pages.join(", ")}`);
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
