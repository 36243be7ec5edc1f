/** The page's state and its actions: settings in, two leaves moving, pictures out. */

import type { CreaseState, LeafTurn } from "turnleaf/models";
import { Clock } from "./clock.ts";
import { readCreases } from "./creases.ts";
import type { Figures } from "./figures.ts";
import { TwoLeaves } from "./leaves.ts";
import type { Picture } from "./picture.ts";
import { BothPictures, type MadeFile, Recording } from "./record.ts";
import type { Settings } from "./settings.ts";
import { fill, type Texts } from "./texts.ts";
import { leafSize, type Variant } from "./variants.ts";

/** Milliseconds of a frame for the models; the rest is for drawing. */
const budget = 14;

/** An imperceptible slowness. */
const realEnough = 1.15;

/** The settings that need new leaves. */
const making = [
  "left",
  "right",
  "grammage",
  "caliper",
  "stiffness",
  "gravity",
  "air",
  "angle",
  "nodes",
  "steps",
] as const satisfies readonly (keyof Settings)[];

/** Receives the messages of the bench. */
export interface BenchReport {
  /** How fast time passes, in a few words. */
  state(text: string): void;
  /** What went wrong, in one sentence; empty if nothing did. */
  fault(text: string): void;
  /** A recording ended by itself. */
  full(): void;
  /** The creases as they are now; none where no leaf is creased. */
  creases(states: readonly (CreaseState | null)[]): void;
  /** The bench changed its settings by itself. */
  changed(): void;
}

/** Both leaves, their pictures and their clock. */
export class Bench {
  readonly #pictures: readonly [Picture, Picture];
  readonly #figures: Figures;
  readonly #texts: Texts;
  readonly #report: BenchReport;
  readonly #clock = new Clock((seconds) => this.#frame(seconds));
  #settings: Settings;
  #leaves: TwoLeaves | null = null;
  /** Rises with every change that needs new leaves: only the last one's are used. */
  #change = 0;
  #isPaused = false;
  #recording: Recording | null = null;

  constructor(
    pictures: readonly [Picture, Picture],
    figures: Figures,
    texts: Texts,
    settings: Settings,
    report: BenchReport,
  ) {
    this.#pictures = pictures;
    this.#figures = figures;
    this.#texts = texts;
    this.#settings = settings;
    this.#report = report;
  }

  get settings(): Settings {
    return this.#settings;
  }

  get isPaused(): boolean {
    return this.#isPaused;
  }

  get isRecording(): boolean {
    return this.#recording !== null;
  }

  /** Applies settings; new leaves lie flat where the previous ones were. */
  async set(settings: Settings): Promise<void> {
    const before = this.#settings;
    this.#settings = settings;
    const areSame = making.every((name) => settings[name] === before[name]);
    if (!this.#leaves || !areSame) await this.#make();
    else {
      if (settings.creases !== before.creases) this.#crease(this.#leaves, before.creases);
      this.show();
    }
  }

  /** Starts a turn of both leaves. */
  play(by: LeafTurn): void {
    this.#leaves?.play(by, this.#settings.seconds);
    this.#go();
  }

  /** Grabs both leaves at a place. */
  grab({ u, v }: { u: number; v: number }): void {
    this.#leaves?.grab(u, v);
    this.#go();
  }

  /** Pulls both to a place, metres. */
  hold(x: number, y: number, z: number): void {
    this.#leaves?.hold(x, y, z);
    this.#go();
  }

  /** Releases both. */
  release(): void {
    this.#leaves?.release();
    this.#go();
  }

  /** Pauses or resumes time. */
  set isPaused(isPaused: boolean) {
    this.#isPaused = isPaused;
    if (isPaused) this.#clock.stop();
    else this.#go();
    this.#sayState();
  }

  /** Pauses time and advances by one tick. */
  step(): void {
    this.isPaused = true;
    this.#leaves?.advance(0, 0);
    this.#moved();
  }

  /** Draws everything again after a change of the settings or of the size on the screen. */
  show(): void {
    const leaves = this.#leaves;
    if (!leaves) return;
    for (const [k, picture] of this.#pictures.entries()) {
      picture.draw(this.#variants[k], leaves.pair[k].leaf, this.#settings);
    }
    this.#figures.show(leaves.pair, this.#names);
    this.#report.creases(leaves.creaseStates());
    this.#sayState();
  }

  /** Returns both current pictures. */
  picture(): HTMLCanvasElement {
    this.show();
    return new BothPictures(this.#pictures.map(({ canvas }) => canvas)).canvas;
  }

  /** Starts a recording with the current picture. */
  record(): void {
    const leaves = this.#leaves;
    if (!leaves || this.#recording) return;
    const both = new BothPictures(this.#pictures.map(({ canvas }) => canvas));
    this.#recording = new Recording(both, leaves.pair, this.#variants, leafSize);
    this.show();
    this.#recording.frame(leaves.time);
  }

  /**
   * Ends it.
   *
   * @returns the recorded files
   * @throws Error if it cannot be saved
   */
  async finishRecording(): Promise<MadeFile[]> {
    const recording = this.#recording;
    this.#recording = null;
    return (await recording?.finish()) ?? [];
  }

  get #variants(): readonly Variant[] {
    return [this.#settings.left, this.#settings.right];
  }

  get #names(): string[] {
    return this.#variants.map((variant) => this.#texts.variants[variant]);
  }

  async #make(): Promise<void> {
    const change = ++this.#change;
    const side = this.#leaves?.pair[0].side ?? "right";
    try {
      const leaves = await TwoLeaves.create(this.#settings, side);
      if (change !== this.#change) {
        leaves.destroy();
        return;
      }
      // Frames of other leaves do not belong to the recording.
      if (this.#recording) this.#report.full();
      this.#leaves?.destroy();
      this.#leaves = leaves;
      this.#figures.clear();
      this.#report.fault("");
      if (this.#settings.creases !== "") this.#crease(leaves, "");
      this.show();
    } catch (error) {
      if (change !== this.#change) return;
      const reason = error instanceof Error ? error.message : String(error);
      this.#report.fault(fill(this.#texts.noLeaf, { reason }));
    }
  }

  /** Creases the sheets as the settings say; if they cannot be, the setting is what it was. */
  #crease(leaves: TwoLeaves, before: string): void {
    try {
      const isOther = leaves.crease(readCreases(this.#settings.creases) ?? []);
      // Frames of another mesh do not belong to the recording.
      if (this.#recording && isOther && leaves.areCreasable) this.#report.full();
      if (leaves.areCreasable) this.#go();
      this.#report.fault("");
    } catch (error) {
      const reason = error instanceof Error ? error.message : String(error);
      this.#settings = { ...this.#settings, creases: before };
      this.#report.fault(fill(this.#texts.creases.rejected, { reason }));
      this.#report.changed();
    }
  }

  #go(): void {
    if (!this.#isPaused) this.#clock.start();
  }

  #frame(seconds: number): { passed: number; isStill: boolean } {
    const leaves = this.#leaves;
    if (!leaves) return { passed: 0, isStill: true };
    const passed = leaves.advance(seconds * this.#settings.pace, budget);
    this.#moved();
    return { passed, isStill: leaves.isStill };
  }

  #moved(): void {
    const leaves = this.#leaves;
    if (!leaves) return;
    this.#mend(leaves);
    this.#figures.add(leaves.time, leaves.pair);
    this.show();
    this.#recording?.frame(leaves.time);
    if (this.#recording?.isFull) this.#report.full();
  }

  /** Replaces leaves whose model broke down, which would not be drawn any more. */
  #mend(leaves: TwoLeaves): void {
    for (const { leaf } of leaves.pair) {
      if (Number.isFinite(leaf.measure().kinetic)) continue;
      leaf.lay("right");
      this.#report.fault(this.#texts.notFinite);
    }
  }

  #sayState(): void {
    const { states } = this.#texts;
    const { slowness } = this.#clock;
    if (this.#isPaused) this.#report.state(states.paused);
    else if (this.#leaves?.isStill !== false) this.#report.state(states.still);
    else if (!(slowness > realEnough)) this.#report.state(states.real);
    else {
      const n = String(Number(slowness.toPrecision(slowness < 10 ? 2 : 3)));
      this.#report.state(fill(states.slower, { n }));
    }
  }
}
