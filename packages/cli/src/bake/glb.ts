/**
 * A turn as glTF 2.0, binary: one mesh with a morph target for each key frame
 * but the first, and an animation of their weights, linearly interpolated. The
 * recto and the verso are primitives of their own, so that each has its own
 * picture.
 *
 * Positions are stored in 16 bits (KHR_mesh_quantization), because paper is
 * much thicker than the error. glTF looks from the front, y up: our x, z and
 * -y.
 */

import { type BakedMesh, placed } from "./baked_mesh.ts";
import type { Frame } from "./baked_turn.ts";
import type { PageImage } from "./page_image.ts";

/** Options besides the shape. */
export interface GlbOptions {
  readonly generator: string;
  readonly front: PageImage | null;
  readonly back: PageImage | null;
  /** Description of the turn's origin, for readers of the file. */
  readonly extras: Readonly<Record<string, unknown>>;
}

const float = 5126;
const short = 5122;
const unsignedShort = 5123;
const unsignedInt = 5125;
const largest = 32767;

/** Warm white, if a side has no picture. */
const paper = [0.94, 0.92, 0.87, 1];

/** Parts of the one buffer, and their accessors. */
class Parts {
  readonly views: object[] = [];
  readonly accessors: object[] = [];
  readonly #chunks: Uint8Array[] = [];
  length = 0;

  view(data: ArrayBufferView, options: object = {}): number {
    const bytes = new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
    this.views.push({ buffer: 0, byteOffset: this.length, byteLength: bytes.length, ...options });
    const padded = new Uint8Array(Math.ceil(bytes.length / 4) * 4);
    padded.set(bytes);
    this.#chunks.push(padded);
    this.length += padded.length;
    return this.views.length - 1;
  }

  accessor(bufferView: number, componentType: number, count: number, rest: object): number {
    this.accessors.push({ bufferView, componentType, count, ...rest });
    return this.accessors.length - 1;
  }

  get bytes(): Buffer {
    return Buffer.concat(this.#chunks);
  }
}

/** Converts x, y, z to glTF's axes. */
const turned = (values: Float32Array): Float32Array =>
  values.map((_, i) => {
    const at = i - (i % 3);
    if (i % 3 === 0) return values[at] ?? 0;
    return i % 3 === 1 ? (values[at + 2] ?? 0) : -(values[at + 1] ?? 0);
  });

const less = (a: Float32Array, b: Float32Array): Float32Array =>
  a.map((value, i) => value - (b[i] ?? 0));

const opposite = (values: Float32Array): Float32Array => values.map((value) => -value);

function bounds(values: ArrayLike<number>): { min: number[]; max: number[] } {
  const axis = (k: number, pick: (...all: number[]) => number) =>
    Array.from(values).reduce(
      (best, value, i) => (i % 3 === k ? pick(best, value) : best),
      values[k] ?? 0,
    );
  return {
    min: [0, 1, 2].map((k) => axis(k, Math.min)),
    max: [0, 1, 2].map((k) => axis(k, Math.max)),
  };
}

/** Returns the file's bytes. */
export function writeGlb(mesh: BakedMesh, frames: readonly Frame[], options: GlbOptions): Buffer {
  const parts = new Parts();
  const shapes = frames.map(({ positions }) => ({
    positions: turned(placed(mesh, positions)),
    normals: turned(mesh.normals(positions)),
  }));
  const [base, ...others] = shapes as [(typeof shapes)[number], ...typeof shapes];
  const moves = others.map(({ positions }) => less(positions, base.positions));
  const scale = [base.positions, ...moves].reduce(
    (most, values) => values.reduce((most, value) => Math.max(most, Math.abs(value)), most),
    1e-9,
  );
  const count = mesh.points.length;
  const place = (values: Float32Array): number => {
    // Four shorts per point: vertex data is aligned to four bytes.
    const shorts = new Int16Array(4 * count);
    const whole = Array.from(values, (value) => Math.round((value / scale) * largest));
    for (const [i, value] of whole.entries()) shorts[4 * Math.floor(i / 3) + (i % 3)] = value;
    const view = parts.view(shorts, { byteStride: 8, target: 34962 });
    return parts.accessor(view, short, count, { type: "VEC3", normalized: true, ...bounds(whole) });
  };
  const direction = (values: Float32Array): number =>
    parts.accessor(parts.view(values, { target: 34962 }), float, count, { type: "VEC3" });
  const POSITION = place(base.positions);
  const places = moves.map(place);
  const bends = others.map(({ normals }) => less(normals, base.normals));
  const side = (isVerso: boolean, material: number) => {
    const own = (normals: Float32Array) => direction(isVerso ? opposite(normals) : normals);
    return {
      attributes: {
        POSITION,
        NORMAL: own(base.normals),
        TEXCOORD_0: pictureAccessor(parts, mesh, isVerso),
      },
      indices: indexAccessor(parts, mesh, isVerso),
      material,
      targets: places.map((at, k) => ({
        POSITION: at,
        NORMAL: own(bends[k] ?? base.normals),
      })),
    };
  };
  const primitives = [side(false, 0), side(true, 1)];
  const json = {
    asset: { version: "2.0", generator: options.generator },
    extensionsUsed: ["KHR_mesh_quantization"],
    extensionsRequired: ["KHR_mesh_quantization"],
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ name: "leaf", mesh: 0, scale: [scale, scale, scale] }],
    meshes: [
      {
        name: "leaf",
        primitives,
        weights: others.map(() => 0),
        extras: { targetNames: frames.slice(1).map(({ time }) => `${time.toFixed(3)} s`) },
      },
    ],
    ...materials(parts, options),
    ...animation(parts, frames),
    extras: options.extras,
    accessors: parts.accessors,
    bufferViews: parts.views,
    buffers: [{ byteLength: parts.length }],
  };
  return container(JSON.stringify(json), parts.bytes);
}

/** Writes texture coordinates: the spine is at the left of a recto, at the right of a verso. */
function pictureAccessor(parts: Parts, { places }: BakedMesh, isVerso: boolean): number {
  const shorts = Uint16Array.from(places, (place, k) =>
    Math.round((k % 2 === 1 || isVerso ? 1 - place : place) * 65535),
  );
  const view = parts.view(shorts, { byteStride: 4, target: 34962 });
  const rest = { type: "VEC2", normalized: true };
  return parts.accessor(view, unsignedShort, places.length / 2, rest);
}

/** Writes the triangles of every face, visible only from their own side. */
function indexAccessor(parts: Parts, { faces, points }: BakedMesh, isVerso: boolean): number {
  const indices: number[] = [];
  for (const [a = 0, ...others] of faces) {
    for (const [k, b] of others.slice(0, -1).entries()) {
      const c = others[k + 1] ?? 0;
      indices.push(...(isVerso ? [a, c, b] : [a, b, c]));
    }
  }
  const isSmall = points.length <= 65535;
  const data = isSmall ? Uint16Array.from(indices) : Uint32Array.from(indices);
  const view = parts.view(data, { target: 34963 });
  return parts.accessor(view, isSmall ? unsignedShort : unsignedInt, indices.length, {
    type: "SCALAR",
  });
}

function materials(parts: Parts, { front, back }: GlbOptions): object {
  const images = [front, back].filter((image) => image !== null);
  const material = (name: string, image: PageImage | null) => ({
    name,
    pbrMetallicRoughness: {
      ...(image
        ? { baseColorTexture: { index: images.indexOf(image) } }
        : { baseColorFactor: paper }),
      metallicFactor: 0,
      roughnessFactor: 0.9,
    },
  });
  const all = { materials: [material("recto", front), material("verso", back)] };
  if (images.length === 0) return all;
  return {
    ...all,
    images: images.map(({ type, bytes }) => ({ mimeType: type, bufferView: parts.view(bytes) })),
    textures: images.map((_, source) => ({ source, sampler: 0 })),
    // Not repeated; filtered when seen from afar.
    samplers: [{ magFilter: 9729, minFilter: 9987, wrapS: 33071, wrapT: 33071 }],
  };
}

/** At each frame's time the weight of its own target is 1. */
function animation(parts: Parts, frames: readonly Frame[]): object {
  if (frames.length < 2) return {};
  const times = Float32Array.from(frames, ({ time }) => time);
  const targets = frames.length - 1;
  const weights = new Float32Array(frames.length * targets);
  for (let k = 0; k < targets; k++) weights[(k + 1) * targets + k] = 1;
  const input = parts.accessor(parts.view(times), float, times.length, {
    type: "SCALAR",
    min: [times[0]],
    max: [times[times.length - 1]],
  });
  const output = parts.accessor(parts.view(weights), float, weights.length, { type: "SCALAR" });
  return {
    animations: [
      {
        name: "turn",
        samplers: [{ input, output, interpolation: "LINEAR" }],
        channels: [{ sampler: 0, target: { node: 0, path: "weights" } }],
      },
    ],
  };
}

function container(json: string, bytes: Buffer): Buffer {
  const text = Buffer.from(json);
  const padded = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, " ")]);
  const chunk = (type: number, data: Buffer): Buffer => {
    const head = Buffer.alloc(8);
    head.writeUInt32LE(data.length, 0);
    head.writeUInt32LE(type, 4);
    return Buffer.concat([head, data]);
  };
  const body = Buffer.concat([chunk(0x4e4f534a, padded), chunk(0x004e4942, bytes)]);
  const head = Buffer.alloc(12);
  head.write("glTF", 0);
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + body.length, 8);
  return Buffer.concat([head, body]);
}
