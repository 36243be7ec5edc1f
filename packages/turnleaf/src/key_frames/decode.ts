import { models } from "../model_names.ts";
import type { PaperMesh } from "../paper_mesh.ts";
import { BitReader } from "./bits.ts";
import {
  checksum,
  checksumLength,
  commonHeader,
  expected,
  leastPackedFrame,
  meshHeader,
  mostAlong,
  mostMultiple,
  mostPoints,
  mostQuantum,
  packedHeader,
  TurnError,
} from "./file.ts";
import { unpackMesh } from "./packed_mesh.ts";
import { PolynomialBasis } from "./polynomial_basis.ts";
import { RecordedTurn, type TurnRecord } from "./recorded_turn.ts";

const newest = 3;
/** Settings of the model that the header can name: its own, the paper's of 2014, a book's. */
const presets = 3;

/**
 * Decodes a recorded turn from the bytes of its file, of version 1, 2 or 3.
 *
 * @throws TurnError unless they are a complete and unchanged file
 */
export function decodeTurn(bytes: Uint8Array): RecordedTurn {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 6 || view.getUint32(0) !== 0x544c4b46) {
    throw new TurnError('This is not a recorded turn: it does not begin with "TLKF".');
  }
  const version = view.getUint16(4, true);
  if (version === 0 || version > newest) {
    throw new TurnError(
      `This turn is recorded in version ${version}, and this program reads versions 1 to ${newest}.`,
    );
  }
  const header = [commonHeader, packedHeader, meshHeader][version - 1];
  if (bytes.length < header + checksumLength) {
    throw new TurnError("This recorded turn ends early.");
  }
  return new RecordedTurn(version === 1 ? readWhole(view) : readPacked(view, header));
}

/** Reads what the headers of all versions have. */
function readHeader(view: DataView, most: number) {
  const model = models[view.getUint32(8, true) - 1];
  const [width, height] = [view.getFloat32(16, true), view.getFloat32(20, true)];
  const [columns, rows, frames] = [24, 28, 32].map((at) => view.getUint32(at, true));
  if (view.getUint16(6, true) !== 1) {
    throw new TurnError(
      "This turn is recorded by its masses; only recorded surfaces can be played.",
    );
  }
  const isSound =
    model !== undefined &&
    view.getUint32(12, true) < presets &&
    [width, height].every((side) => side > 0 && side < Number.POSITIVE_INFINITY) &&
    [columns, rows].every((count) => count >= 2 && count <= most) &&
    frames >= 1 &&
    columns * rows * frames <= mostPoints;
  if (!isSound) throw new TurnError("The header of this recorded turn cannot be.");
  return { model, width, height, columns, rows, frames };
}

/** Checks the length of a file, and its checksum. */
function requireWhole(view: DataView, length: number): void {
  const found = view.byteLength;
  if (found !== length) {
    throw new TurnError(`This recorded turn should be ${length} bytes long and is ${found}.`);
  }
  const bytes = new Uint8Array(view.buffer, view.byteOffset, found);
  const end = found - checksumLength;
  if (checksum(bytes.subarray(0, end)).some((byte, at) => byte !== bytes[end + at])) {
    throw new TurnError("This recorded turn is damaged: its checksum does not fit.");
  }
}

function floats(view: DataView, at: number, count: number): Float32Array {
  const values = new Float32Array(count);
  for (let i = 0; i < count; i++) values[i] = view.getFloat32(at + 4 * i, true);
  return values;
}

function readTimes(view: DataView, at: number, count: number): Float32Array {
  const times = floats(view, at, count);
  if (!times.every((time, i) => Number.isFinite(time) && (i === 0 || time > times[i - 1]))) {
    throw new TurnError("The times of this recorded turn do not rise.");
  }
  return times;
}

function readWhole(view: DataView): TurnRecord {
  const { model, width, height, columns, rows, frames } = readHeader(view, 4096);
  const count = 3 * columns * rows * frames;
  requireWhole(view, commonHeader + 4 * (frames + count) + checksumLength);
  const times = readTimes(view, commonHeader, frames);
  const positions = floats(view, commonHeader + 4 * frames, count);
  if (!positions.every(Number.isFinite)) throw badFrame();
  const even = (n: number) => Float32Array.from({ length: n }, (_, i) => i / (n - 1));
  const [u, v] = [even(columns), even(rows)];
  return { model, width, height, u, v, error: Number.NaN, times, positions };
}

/** Reads versions 2 and 3, which differ by the length of their header and what it adds. */
function readPacked(view: DataView, header: number): TurnRecord {
  const { model, width, height, columns, rows, frames } = readHeader(view, mostAlong);
  const meshAt = header + 4 * (columns + rows + frames);
  const packedLength = view.getUint32(44, true);
  const meshLength = header === meshHeader ? view.getUint32(52, true) : 0;
  requireWhole(view, meshAt + meshLength + packedLength + checksumLength);
  if (packedLength < leastPackedFrame * frames) throw badFrame();
  const [quantum, error] = floats(view, commonHeader, 2);
  if (!(quantum > 0 && quantum < mostQuantum && error >= 0 && error <= 1e6)) {
    throw new TurnError("The header of this recorded turn cannot be.");
  }
  const u = readPlaces(view, header, columns);
  const v = readPlaces(view, header + 4 * columns, rows);
  const times = readTimes(view, header + 4 * (columns + rows), frames);
  const bytes = (at: number, length: number) =>
    new Uint8Array(view.buffer, view.byteOffset + at, length);
  const creased =
    header === meshHeader ? readMesh(bytes(meshAt, meshLength), u, v, view) : undefined;
  const positions = unpack(bytes(meshAt + meshLength, packedLength), u, v, times, quantum);
  return { model, width, height, u, v, error, times, positions, creased };
}

function readMesh(packed: Uint8Array, u: Float32Array, v: Float32Array, view: DataView): PaperMesh {
  try {
    return unpackMesh(packed, u, v, view.getUint32(48, true));
  } catch (error) {
    if (!(error instanceof RangeError)) throw error;
    throw new TurnError("The mesh of this recorded turn cannot be.");
  }
}

function readPlaces(view: DataView, at: number, count: number): Float32Array {
  const places = floats(view, at, count);
  const rise = places.every((place, i) => i === 0 || place > places[i - 1]);
  if (!rise || places[0] !== 0 || places[count - 1] !== 1) {
    throw new TurnError("The columns or rows of this recorded turn do not rise from 0 to 1.");
  }
  return places;
}

/** Unpacks the positions of all frames from their coefficients. */
function unpack(
  packed: Uint8Array,
  u: Float32Array,
  v: Float32Array,
  times: Float32Array,
  quantum: number,
): Float32Array {
  const length = u.length * v.length;
  const positions = new Float32Array(3 * length * times.length);
  const rest = new Int32Array(length);
  const coefficients = new Float64Array(length);
  // For each axis the current frame and the two before it, in rotation.
  const kept = Array.from({ length: 9 }, () => new Int32Array(length));
  const of = (frame: number, axis: number) => kept[3 * (frame % 3) + axis];
  try {
    const basis = new PolynomialBasis(u, v);
    const reader = new BitReader(packed);
    for (let at = 0; at < 3 * times.length; at++) {
      const [frame, axis] = [Math.floor(at / 3), at % 3];
      const way = reader.bits(2);
      if (way > Math.min(frame, 2)) throw new RangeError("There are no frames before.");
      reader.run(rest);
      const multiples = of(frame, axis);
      const before = [of(frame + 2, axis), of(frame + 1, axis)] as const;
      for (let i = 0; i < length; i++) {
        const place = basis.order[i];
        const multiple = rest[i] + expected(before, times, frame, way, place);
        if (Math.abs(multiple) > mostMultiple) throw new RangeError("It is too large.");
        multiples[place] = multiple;
        coefficients[place] = multiple * quantum;
      }
      basis.write(coefficients, positions, 3 * length * frame + axis);
    }
    if (!reader.isAtEnd) throw new RangeError("There is more than the header says.");
  } catch (error) {
    throw error instanceof RangeError ? badFrame() : error;
  }
  return positions;
}

function badFrame(): TurnError {
  return new TurnError("A frame of this recorded turn cannot be read.");
}
