/** The grain of what a book is bound in: the edges of its leaves, cloth, headbands. */

import {
  DataTexture,
  LinearFilter,
  LinearMipmapLinearFilter,
  RepeatWrapping,
  RGBAFormat,
  type Texture,
  UnsignedByteType,
} from "three";

/** Texels of a grain, four bytes each. */
interface Texels {
  readonly data: Uint8Array;
  readonly width: number;
  readonly height: number;
}

/** Texels by what draws them: kept for every book of the page, as drawing them takes a twentieth of a second. */
const drawn = new Map<() => Texels, Texels>();

/** Grain textures, the same for every book that one stage draws. */
export class BookGrains {
  /** The edges of the leaves in a pile: x along the edge, y through the pile's thickness. */
  readonly leafEdges: Texture = grainTexture(drawLeafEdges);
  readonly cloth: Texture = grainTexture(drawCloth);
  /** The stripes of a headband, along x. */
  readonly headband: Texture = grainTexture(drawHeadband);

  /** @param anisotropy from 1 for none */
  constructor(anisotropy: number) {
    for (const grain of this.#all) grain.anisotropy = anisotropy;
  }

  dispose(): void {
    for (const grain of this.#all) grain.dispose();
  }

  get #all(): readonly Texture[] {
    return [this.leafEdges, this.cloth, this.headband];
  }
}

/**
 * Draws the edges of a pile's leaves as bands that differ at every scale, so
 * that some show at any distance and none beat with the pixels: x along the
 * edge, y through the pile's thickness. Red is brightness, half = as it is.
 */
function drawLeafEdges(): Texels {
  const [width, height] = [64, 512];
  const random = randomNumbers(7);
  const level = new Float32Array(width * height);
  for (let step = 2; step <= 256; step *= 2) {
    // Fewer, stronger bands; each wanders a little along the edge.
    const weight = 0.085 * (step / 16) ** 0.12;
    const count = height / step;
    const bands = Float32Array.from({ length: count }, () => random() - 0.5);
    const phases = Float32Array.from({ length: count }, () => random() * 2 * Math.PI);
    for (let y = 0; y < height; y++) {
      for (let x = 0; x < width; x++) {
        const sway = 0.12 * Math.sin((2 * Math.PI * x) / width + phases[Math.floor(y / step)]);
        const at = (y + sway * step) / step;
        const a = bands[(Math.floor(at) + count) % count];
        const b = bands[(Math.floor(at) + 1 + count) % count];
        const t = at - Math.floor(at);
        level[y * width + x] += weight * (a + (b - a) * t * t * (3 - 2 * t)) * 2;
      }
    }
  }
  // Signatures: a darker line now and then.
  for (let y = 10; y < height; y += 24 + Math.floor(random() * 26)) {
    for (let x = 0; x < width; x++) {
      level[y * width + x] -= 0.22;
      level[(y + 1) * width + x] -= 0.14;
    }
  }
  return texelsOf(level, width, height);
}

/**
 * Draws book cloth: threads over and under, thick and thin places. Red is
 * brightness, half = as it is.
 */
function drawCloth(): Texels {
  const size = 512;
  const threads = 128;
  const random = randomNumbers(3);
  const warp = Float32Array.from({ length: threads }, () => random() - 0.5);
  const weft = Float32Array.from({ length: threads }, () => random() - 0.5);
  const level = new Float32Array(size * size);
  const spots = Float32Array.from({ length: 32 * 32 }, () => 2 * random() - 1);
  /** Returns smooth noise from -1 to 1 with a period of 32. */
  const mottle = (x: number, y: number): number => {
    const i = Math.floor(x);
    const j = Math.floor(y);
    const left = i % 32;
    const right = (i + 1) % 32;
    const above = (j % 32) * 32;
    const below = ((j + 1) % 32) * 32;
    const s = (x - i) * (x - i) * (3 - 2 * (x - i));
    const t = (y - j) * (y - j) * (3 - 2 * (y - j));
    const low = spots[above + left] + (spots[above + right] - spots[above + left]) * s;
    const high = spots[below + left] + (spots[below + right] - spots[below + left]) * s;
    return low + (high - low) * t;
  };
  const across = size / threads;
  /** Height of a thread at each texel across it. */
  const heights = Float64Array.from({ length: across }, (_, k) => Math.sin((Math.PI * k) / across));
  for (let y = 0; y < size; y++) {
    for (let x = 0; x < size; x++) {
      const u = x / across;
      const v = y / across;
      const i = Math.floor(u);
      const j = Math.floor(v);
      const over = (i + j) % 2 === 0;
      const round = heights[(over ? x : y) % across];
      const thread = over ? warp[i] : weft[j];
      const unevenness = 0.035 * (mottle(u / 16, v / 16) + mottle(u / 4, v / 4));
      level[y * size + x] =
        unevenness + 0.2 * (round - 0.64) + 0.09 * thread + 0.1 * (random() - 0.5);
    }
  }
  return texelsOf(level, size, size);
}

/** Returns texels of levels from -1 to 1. */
function texelsOf(level: Float32Array, width: number, height: number): Texels {
  const data = new Uint8Array(4 * width * height);
  for (let k = 0; k < level.length; k++) {
    const value = Math.min(255, Math.max(0, Math.round(127.5 * (1 + level[k]))));
    data[4 * k] = data[4 * k + 1] = data[4 * k + 2] = value;
    data[4 * k + 3] = 255;
  }
  return { data, width, height };
}

function grainTexture(draw: () => Texels): Texture {
  const texels = drawn.get(draw) ?? draw();
  drawn.set(draw, texels);
  const { data, width, height } = texels;
  const texture = new DataTexture(data, width, height, RGBAFormat, UnsignedByteType);
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.generateMipmaps = true;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** Returns a generator of numbers from 0 to 1, the same for the same seed (mulberry32). */
function randomNumbers(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/**
 * Draws a headband's stripes, alternately dark and light along x. Red is
 * brightness, half = as it is.
 */
function drawHeadband(): Texels {
  const level = Float32Array.from(
    { length: 32 },
    (_, x) => 0.75 * Math.sin((x * Math.PI) / 16) - 0.1,
  );
  return texelsOf(level, 32, 1);
}
