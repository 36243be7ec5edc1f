/**
 * The sound of paper: noise that crackles as the leaves bend, a soft thud where they land, and the
 * ripping of fibres where they tear.
 */

import type { Stock, StockFigures } from "../engine/shapes.ts";
import { presetStocks } from "../stocks.ts";
import type { Motion } from "./motion.ts";

/** Bending speed, rad/s, and speed lost on landing, m/s, at which two thirds of the full loudness are reached. */
const usualBending = 2;
const usualImpact = 0.3;

/** Power of tearing, W, at which the same is reached: a page of 0.2 J that comes off in a third of a second. */
const usualTearing = 0.6;

/** Times in which the sound follows the leaves and fades after a landing, seconds. */
const following = 0.025;
const dying = 0.05;

/** Length of the noise loop, seconds. */
const noiseLength = 1.5;

/** Returns noise with the crackle of fibres that break one by one. Always the same. */
function crackle(context: BaseAudioContext): AudioBuffer {
  const { sampleRate } = context;
  const buffer = context.createBuffer(1, Math.round(noiseLength * sampleRate), sampleRate);
  const samples = buffer.getChannelData(0);
  const decay = Math.exp(-500 / sampleRate);
  let [random, burst] = [1, 0];
  const next = (): number => {
    random = (Math.imul(random, 1664525) + 1013904223) >>> 0;
    return random / 2 ** 32;
  };
  for (let i = 0; i < samples.length; i++) {
    burst *= decay;
    if (next() < 90 / sampleRate) burst += next();
    samples[i] = (2 * next() - 1) * Math.min(0.2 + burst, 1);
  }
  return buffer;
}

/** The sound of one book, as nodes of an audio context. */
export class PaperSound {
  readonly #context: BaseAudioContext;
  readonly #noise: AudioBuffer;
  readonly #bend: BiquadFilterNode;
  readonly #brush: BiquadFilterNode;
  readonly #bending: GainNode;
  readonly #landing: GainNode;
  readonly #rip: BiquadFilterNode;
  readonly #tearing: GainNode;
  #source: AudioBufferSourceNode | null = null;
  #loudness = 1;

  constructor(context: BaseAudioContext) {
    this.#context = context;
    this.#noise = crackle(context);
    const voice = (type: BiquadFilterType): [BiquadFilterNode, GainNode] => {
      const filter = new BiquadFilterNode(context, { type, Q: 0.8 });
      const gain = new GainNode(context, { gain: 0 });
      filter.connect(gain).connect(context.destination);
      return [filter, gain];
    };
    [this.#bend, this.#bending] = voice("bandpass");
    [this.#brush, this.#landing] = voice("lowpass");
    [this.#rip, this.#tearing] = voice("highpass");
  }

  /** The paper: the lighter, the higher and softer. Bible paper whispers, card snaps. */
  set stock(stock: Stock | StockFigures) {
    const grammage =
      typeof stock === "string" ? 1000 * presetStocks[stock].grammage : Math.max(stock.grammage, 1);
    const light = Math.sqrt(70 / grammage);
    this.#bend.frequency.value = Math.min(4200 * light, 9000);
    this.#brush.frequency.value = Math.min(700 * light, 3000);
    this.#rip.frequency.value = Math.min(1800 * light, 5000);
    this.#loudness = Math.min(0.5 / light, 1);
  }

  /** Plays the motion of the book, from `time` on by the context's clock. */
  move({ bending, impact, tearing }: Motion, time: number): void {
    if (this.#source === null) {
      this.#source = new AudioBufferSourceNode(this.#context, { buffer: this.#noise, loop: true });
      this.#source.connect(this.#bend);
      this.#source.connect(this.#brush);
      this.#source.connect(this.#rip);
      this.#source.start(time);
    }
    const part = (of: number, usual: number): number =>
      this.#loudness * (1 - Math.exp(-of / usual));
    this.#bending.gain.setTargetAtTime(0.5 * part(bending, usualBending), time, following);
    // Fibres that part sound at once, and no longer than they part.
    this.#tearing.gain.setTargetAtTime(0.8 * part(tearing, usualTearing), time, following / 4);
    if (impact > 0.02) {
      this.#landing.gain.cancelScheduledValues(time);
      this.#landing.gain.setTargetAtTime(part(impact, usualImpact), time, 0.004);
      this.#landing.gain.setTargetAtTime(0, time + 0.016, dying);
    }
  }

  /** Fades from `time` on, and then calls `silent`, unless it moves again before. */
  rest(time: number, silent: () => void): void {
    const source = this.#source;
    if (source === null) return;
    this.#source = null;
    for (const { gain } of [this.#bending, this.#tearing]) {
      gain.setTargetAtTime(0, time, following);
    }
    source.onended = () => {
      source.disconnect();
      if (this.#source === null) silent();
    };
    source.stop(time + 8 * dying);
  }
}
